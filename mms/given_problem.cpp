#include "mms/given_problem.hpp"

#include "core/space/resolution.hpp"
#include "core/space/tail_moment.hpp"
#include "mms/admissible/admissibility.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/plain_solution.hpp"
#include "mms/problem_builder.hpp"
#include "mms/sample_points.hpp"
#include "mms/sampled_fields.hpp"
#include "mms/separation.hpp"
#include "mms/text/error_text.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;
using GiNaC::ex;

namespace {

ArrayXd values(const ex& formula, const ArrayXd& x, double t) {
    return compile_tape({formula}).evaluate(x, ArrayXd::Constant(1, t)).row(0);
}

/// One of the given expressions with the beam's values in it, or zero if it is left out. plain: as
/// it is written.
ex given(const std::optional<SourceText>& source, const Beam& beam, bool at_start,
         const std::string& what, PlainExpression& plain) {
    if (!source)
        return 0;
    SymbolTable symbols = model_symbol_table();
    if (at_start)
        symbols.erase("t");
    const ex expression = parse_expression(*source, symbols, &plain);
    require_stops_in_use(*source, beam);
    return located(*source, what, [&] { return substituted(expression, beam_values(beam)); });
}

void require_finite(const ex& formula, const SourceText& source, double final_time,
                    const std::string& what) {
    const ArrayXd x = sample_points(0.0, 1.0);
    const Tape tape = located(source, what, [&] { return compile_tape({formula}); });
    for (const double t : sample_points(0.0, final_time)) {
        const ArrayXd sampled = tape.evaluate(x, ArrayXd::Constant(1, t)).row(0);
        for (Index k = 0; k < x.size(); ++k)
            if (!std::isfinite(sampled(k)))
                throw InputError(source.begin(), what + " is not finite at x = " +
                                                     number_text(x(k)) + ", t = " + number_text(t));
    }
}

/// u(0) = u'(0) = 0 (5), and where stops are rigid g1 ≤ u(1) ≤ g2 (6).
void require_admissible_start(const ex& u, const ex& u_x, const SourceText& source,
                              const Beam& beam) {
    const ArrayXd points = sample_points(0.0, 1.0);
    const ArrayXd deflection = values(u, points, 0.0);
    const ArrayXd slope = values(u_x, points, 0.0);
    const double tolerance = 1e-12 * deflection.abs().maxCoeff();
    const double tip = deflection(points.size() - 1);
    if (std::abs(deflection(0)) > tolerance)
        throw InputError(source.begin(), "(5): u0(0) is " + number_text(deflection(0)) +
                                             "; it must be 0; a factor x^2 makes it so");
    if (std::abs(slope(0)) > 1e-12 * slope.abs().maxCoeff())
        throw InputError(source.begin(), "(5): the slope of u0 at x = 0 is " +
                                             number_text(slope(0)) +
                                             "; it must be 0; a factor x^2 makes it so");
    const bool rigid = beam.stops.epsilon == 0.0; // penalised stops yield
    if (rigid && (tip < beam.stops.lower - tolerance || tip > beam.stops.upper + tolerance))
        throw InputError(source.begin(), "(6): u0(1) is " + number_text(tip) +
                                             "; it must be between the stops " +
                                             number_text(beam.stops.lower) + " and " +
                                             number_text(beam.stops.upper));
}

/// ∫_y^1 (x − y) q dx for q = x^n, by parts twice: the antiderivative's antiderivative is
/// x^{n+2}/((n+1)(n+2)), so it is (y^{n+2} − 1)/((n+1)(n+2)) + (1 − y)/(n+1).
ex moment_of_power(int n) {
    const GiNaC::realsymbol& y = model_symbols().x;
    const GiNaC::numeric first(n + 1);
    return (pow(y, n + 2) - 1) / (first * (n + 2)) + (1 - y) / first;
}

/// The same for a polynomial in x with coefficients in t.
ex moment_of_polynomial(const ex& q) {
    const ex expanded = q.expand();
    ex moment = 0;
    for (int n = 0; n <= expanded.degree(model_symbols().x); ++n)
        moment += expanded.coeff(model_symbols().x, n) * moment_of_power(n);
    return moment;
}

/// y ↦ ∫_y^1 (x − y) q dx for a profile q.
SpaceFunction moment_of_profile(const SpaceFunction& profile) {
    ProblemData alone;
    alone.profiles = {profile};
    alone.body_force.terms = {{0, 0}};
    return [profile, resolution = resolve(alone, {&alone.body_force}, 0.0)](const ArrayXd& y) {
        return tail_moment(resolution.intervals(), profile, y);
    };
}

/// The same for what does not separate.
SpaceTimeFunction moment_in_time(const ex& q, double final_time) {
    ProblemData alone;
    alone.body_force.rest = [tape = compile_tape({q})](const ArrayXd& x, double t) -> ArrayXd {
        return tape.evaluate(x, ArrayXd::Constant(1, t)).row(0);
    };
    return
        [rest = alone.body_force.rest,
         resolution = resolve(alone, {&alone.body_force}, final_time)](const ArrayXd& y, double t) {
            return tail_moment(
                resolution.intervals(), [&](const ArrayXd& x) { return rest(x, t); }, y);
        };
}

/// The moment of the body force: closed where q is polynomial in x, integrated where not.
Field moment_of(const ex& q, double final_time, ProblemBuilder& builder) {
    const GiNaC::realsymbol& x = model_symbols().x;
    const Separation parts = separated(q);
    ex closed = 0;
    ex rest = parts.rest;
    std::vector<Field::Term> integrated;
    for (const SeparatedProduct& product : parts.products) {
        if (product.profile.is_polynomial(x) && product.profile.degree(x) <= 16) {
            closed += product.amplitude * moment_of_polynomial(product.profile);
            continue;
        }
        const ScaledProfile scaled = scaled_profile(product.profile);
        if (scaled.function)
            integrated.push_back(
                builder.term(product.amplitude * scaled.size, moment_of_profile(scaled.function)));
        else
            rest += product.amplitude * product.profile;
    }
    Field result = builder.field({closed});
    result.terms.insert(result.terms.end(), integrated.begin(), integrated.end());
    if (!rest.is_zero())
        result.rest = moment_in_time(rest, final_time);
    return result;
}

/// Holds computed values against what the data's texts say at sampled points.
class GivenTexts {
public:
    GivenTexts(const Beam& beam, double final_time)
        : constants_(plain_constants(beam)), points_(sample_points(0.0, final_time, true)) {}

    [[nodiscard]] const SamplePoints& points() const { return points_; }

    /// Throws InputError where the values are not those of ∂_x^order of the expression.
    void require(const std::optional<SourceText>& source, const PlainExpression& plain, int order,
                 const std::string& what, const ComputedValues& computed) const {
        if (!source)
            return;
        auto names = constants_;
        std::vector<Bounded<long double>> text;
        for (Index k = 0; k < points_.x.size(); ++k) {
            names["x"] = BoundedJet<long double>::x(points_.x(k), order);
            names["t"] = BoundedJet<long double>::t(points_.t(k), 0);
            text.push_back(evaluated(plain, names).derivative(order, 0));
        }
        if (const auto k = first_disagreement(text, computed))
            throw InputError(source->begin(),
                             disagreement_text(what, points_.x(*k), points_.t(*k),
                                               computed.values(*k),
                                               text[static_cast<std::size_t>(*k)].value));
    }

    void require(const std::optional<SourceText>& source, const PlainExpression& plain, int order,
                 const std::string& what, const ex& formula) const {
        const ArrayXd computed = compile_tape({formula}).evaluate(points_.x, points_.t).row(0);
        require(source, plain, order, what, ComputedValues::of(computed));
    }

private:
    std::map<std::string, BoundedJet<long double>> constants_;
    SamplePoints points_;
};

} // namespace

ProblemData given_problem(const GivenData& data, const Beam& beam, double final_time) {
    require_final_time(final_time);
    PlainExpression plain_theta, plain_u, plain_source, plain_force;
    const ex theta = given(data.theta0, beam, true, "theta0", plain_theta);
    const ex u = given(data.u0, beam, true, "u0", plain_u);
    const ex heat_source = given(data.heat_source, beam, false, "heat_source", plain_source);
    const ex body_force = given(data.body_force, beam, false, "body_force", plain_force);
    const GivenTexts texts(beam, final_time);

    const GiNaC::realsymbol& x = model_symbols().x;
    ex curvature = 0;
    if (data.theta0)
        require_finite(theta, *data.theta0, final_time, "theta0");
    if (data.u0) {
        const ex u_x = located(*data.u0, "u0", [&] { return derivative(u, x); });
        curvature = located(*data.u0, "u0", [&] { return derivative(u_x, x); });
        require_finite(u, *data.u0, final_time, "u0");
        require_finite(u_x, *data.u0, final_time, "u0'");
        require_finite(curvature, *data.u0, final_time, "u0''");
        texts.require(data.u0, plain_u, 0, "u0", u);
        texts.require(data.u0, plain_u, 1, "u0'", u_x);
        require_admissible_start(u, u_x, *data.u0, beam);
    }
    if (data.heat_source)
        require_finite(heat_source, *data.heat_source, final_time, "heat_source");
    if (data.body_force)
        require_finite(body_force, *data.body_force, final_time, "body_force");

    ProblemBuilder builder({{0.0, std::numeric_limits<double>::infinity()}}, final_time);
    ProblemData problem;
    problem.theta_initial = builder.field({theta});
    problem.curvature_initial = builder.field({curvature});
    problem.heat_source = builder.field({heat_source});
    problem.body_force = builder.field({body_force});
    problem.moment_load = moment_of(body_force, final_time, builder);
    builder.finish(problem);
    const SampledFields sampled(problem, texts.points().x, texts.points().t);
    texts.require(data.theta0, plain_theta, 0, "theta0", sampled.of(problem.theta_initial));
    texts.require(data.u0, plain_u, 2, "u0''", sampled.of(problem.curvature_initial));
    texts.require(data.heat_source, plain_source, 0, "heat_source",
                  sampled.of(problem.heat_source));
    texts.require(data.body_force, plain_force, 0, "body_force", sampled.of(problem.body_force));
    return problem;
}

} // namespace tvbeam
