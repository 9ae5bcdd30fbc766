#include "studies/reference/reference_solution.hpp"

#include "core/norms/error_norms.hpp"
#include "core/run.hpp"
#include "core/time/time_levels.hpp"
#include "studies/reference/piecewise_polynomial.hpp"
#include "studies/runs/beam_runs.hpp"
#include "studies/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <new>
#include <stdexcept>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// The order that an extrapolated reference assumes, of the linear elements.
constexpr double order_in_h = 2.0;

/// The mean of the two values at every inner node. There the error of an L² projection on P1disc
/// is an expansion in even powers of h, as extrapolation wants it.
VectorXd nodal_means(const DiscontinuousLinear& w) {
    const Index s = w.cols();
    VectorXd nodal(s + 1);
    nodal(0) = w(0, 0);
    nodal(s) = w(1, s - 1);
    nodal.segment(1, s - 1) =
        0.5 * (w.row(1).head(s - 1) + w.row(0).tail(s - 1)).matrix().transpose();
    return nodal;
}

/// The solution at the kept levels. As computed: Θ̃ continuous, w in P1disc, both piecewise linear.
/// Extrapolated: nodal values, with cubics between them, as linear ones would bring back the error
/// that was taken away.
class ReferenceSolution {
public:
    ReferenceSolution(const ReferenceBlock& block, const std::vector<Series>& measured,
                      const Needs& needs, const Execution& execution)
        : execution_(execution), block_(block), needs_(needs),
          levels_(kept_levels(block_, measured)), steps_(levels_.back()),
          dt_(longest_time(measured) / static_cast<double>(steps_)) {
        const auto count = static_cast<Index>(levels_.size());
        if (needs_.temperature)
            theta_.setZero(block_.elements + 1, count);
        if (needs_.curvature)
            curvature_.setZero(block_.richardson ? block_.elements + 1 : 2 * block_.elements,
                               count);
        stress_.setZero(count);
    }

    /// Empty, or why a run failed.
    std::string compute(const Scene& scene, const ProblemData& data, ReferenceResult& result) {
        for (const auto level : levels_)
            result.times.push_back(time_of(level));
        runs_ = &result.runs;
        if (!block_.richardson)
            return add_run(scene, data, 1, 1, 1.0);
        const auto [in_h, in_dt] = extrapolation_of(scene);
        std::string failure = add_run(scene, data, 1, 1, 1.0 + in_h + in_dt);
        if (failure.empty())
            failure = add_run(scene, data, 2, 1, -in_h);
        if (failure.empty())
            failure = add_run(scene, data, 1, 2, -in_dt);
        return failure;
    }

    [[nodiscard]] PiecewisePolynomial theta(double t) const {
        const VectorXd nodal = theta_.col(level_at(t));
        return block_.richardson ? PiecewisePolynomial::cubic(nodal)
                                 : PiecewisePolynomial::linear(nodal);
    }

    [[nodiscard]] PiecewisePolynomial curvature(double t) const {
        const VectorXd values = curvature_.col(level_at(t));
        return block_.richardson ? PiecewisePolynomial::cubic(values)
                                 : PiecewisePolynomial::linear(
                                       DiscontinuousLinear(values.reshaped(2, values.size() / 2)));
    }

    /// All amplitudes of a problem are evaluated together, also at t = 0 and at the stages inside a
    /// step, where no norm looks at the stress.
    [[nodiscard]] double stress(double t) const {
        const auto at = slot(t);
        return at ? stress_(*at) : 0.0;
    }

private:
    /// The place of a time among the levels; none where the solution is not known.
    [[nodiscard]] std::optional<Index> slot(double t) const {
        const double steps = t / dt_;
        const auto level = static_cast<std::int64_t>(std::llround(steps));
        const auto at = std::lower_bound(levels_.begin(), levels_.end(), level);
        // The time of a rung is the level's to the rounding of the steps in the scene, which divide
        // each other and the final time to 1e-9.
        if (at == levels_.end() || *at != level || std::abs(t - time_of(level)) > 1e-8 * t)
            return std::nullopt;
        return at - levels_.begin();
    }

    [[nodiscard]] double time_of(std::int64_t level) const {
        return dt_ * static_cast<double>(level);
    }

    [[nodiscard]] Index level_at(double t) const {
        if (const auto at = slot(t))
            return *at;
        throw std::domain_error(fmt::format("the reference solution is not known at t = {:g}", t));
    }

    /// Adds weight times the solution of a run, coarser by the given factors, to all kept levels.
    std::string add_run(const Scene& scene, const ProblemData& data, Index in_h, std::int64_t in_dt,
                        double weight) {
        const Mesh mesh = data.resolution->on(Mesh::uniform(block_.elements / in_h));
        const double dt = dt_ * static_cast<double>(in_dt);
        const std::int64_t steps = steps_ / in_dt;
        runs_->push_back({mesh.elements(), steps, dt});
        try {
            // Not iterated: to one tolerance with the runs it would hide what that does to them.
            Scheme scheme = scene.scheme;
            scheme.algorithm = Algorithm::direct;
            const auto solver = make_solver(scene.beam, data, mesh, scheme, dt, needs_);
            TimeLevels times(data, scheme.time, dt * static_cast<double>(steps), steps);
            auto next = levels_.begin();
            for (std::int64_t n = 1; next != levels_.end(); ++n) {
                const std::int64_t level = n * in_dt;
                if (const std::string reason = solver->step(times.at(n)); !reason.empty())
                    return fmt::format("{} at t = {:g} with {} elements, dt = {:g}", reason,
                                       times.time(n), mesh.elements(), dt);
                if (!execution_.advance(static_cast<double>(mesh.elements())))
                    return "it was interrupted";
                if (level == *next) {
                    add_level(next - levels_.begin(), *solver, mesh, scene.beam, weight);
                    ++next;
                }
            }
        } catch (const std::domain_error& error) {
            return error.what();
        }
        return {};
    }

    void add_level(Index at, const Solver& solver, const Mesh& mesh, const Beam& beam,
                   double weight) {
        if (needs_.temperature)
            theta_.col(at) +=
                weight * on_reference_nodes(solver.temperature() +
                                            beam.theta_A * (1.0 - mesh.nodes).matrix());
        if (needs_.curvature) {
            const DiscontinuousLinear w = solver.curvature();
            if (block_.richardson)
                curvature_.col(at) += weight * on_reference_nodes(nodal_means(w));
            else
                curvature_.col(at) += weight * w.reshaped().matrix();
        }
        if (needs_.deflection)
            stress_(at) += weight * solver.contact_stress();
    }

    [[nodiscard]] VectorXd on_reference_nodes(const VectorXd& nodal) const {
        if (nodal.size() == block_.elements + 1)
            return nodal;
        return PiecewisePolynomial::cubic(nodal)(Mesh::uniform(block_.elements).nodes).matrix();
    }

    const Execution execution_;
    ReferenceBlock block_;
    Needs needs_;
    std::vector<std::int64_t> levels_; // the last one ends at final_time
    std::int64_t steps_;
    double dt_;                 // to rounding that of the block
    Eigen::MatrixXd theta_;     // one column a level
    Eigen::MatrixXd curvature_; // one column a level: nodal values, or the two ends of each element
    VectorXd stress_;
    std::vector<Rung>* runs_ = nullptr;
};

Field rest(SpaceTimeFunction function) {
    Field field;
    field.rest = std::move(function);
    return field;
}

/// Fields that look a quantity up in the reference; zero where it is not kept.
ExactSolution looked_up(const std::shared_ptr<const ReferenceSolution>& reference, Index elements,
                        const Needs& kept = {true, true, true}) {
    ExactSolution exact;
    exact.elements = elements;
    if (kept.temperature) {
        exact.theta =
            rest([reference](const ArrayXd& x, double t) { return reference->theta(t)(x); });
        exact.theta_x = rest([reference](const ArrayXd& x, double t) {
            return reference->theta(t).derivative()(x);
        });
    }
    if (!kept.curvature)
        return exact;
    exact.u_xx =
        rest([reference](const ArrayXd& x, double t) { return reference->curvature(t)(x); });
    exact.u_x = rest(
        [reference](const ArrayXd& x, double t) { return reference->curvature(t).integral()(x); });
    exact.u = rest([reference](const ArrayXd& x, double t) {
        return reference->curvature(t).integral().integral()(x);
    });
    return exact;
}

/// The amplitudes of a problem with one more behind them.
Amplitudes with_one_more(const ProblemData& data, std::function<double(double t)> last) {
    return [count = data.amplitude_count, others = data.amplitudes,
            last = std::move(last)](const ArrayXd& t) {
        Eigen::ArrayXXd values(count + 1, t.size());
        if (count > 0)
            values.topRows(count) = others(t);
        for (Index n = 0; n < t.size(); ++n)
            values(count, n) = last(t(n));
        return values;
    };
}

} // namespace

Extrapolation extrapolation_of(const Scene& scene) {
    if (!scene.reference->richardson)
        return {};
    const double in_h = 1.0 / (std::exp2(order_in_h) - 1.0);
    const double in_dt = 1.0 / (std::exp2(scene.scheme.time.order) - 1.0);
    return {in_h, in_dt};
}

ReferenceResult measure_against_reference(const Scene& scene, ProblemData& data,
                                          const Execution& execution) {
    const auto start = std::chrono::steady_clock::now();
    const ReferenceBlock& block = *scene.reference;
    const auto measured = scene.measured_series();
    ReferenceResult result;
    if (!data.resolution)
        data.resolution = std::make_shared<const Resolution>(resolution_of(
            data, {scene.scheme.algorithm, Algorithm::direct}, {}, longest_time(measured)));
    std::shared_ptr<const ReferenceSolution> reference;
    ProblemData with_fields = data; // whose fields are not separable: what norms then need
    with_fields.exact = looked_up(nullptr, block.elements);
    const Needs needs = ErrorNorms::needs(with_fields, norms_of(scene.measures()));
    try {
        auto computed = std::make_shared<ReferenceSolution>(block, measured, needs, execution);
        result.failure = computed->compute(scene, data, result);
        reference = std::move(computed);
    } catch (const std::bad_alloc&) {
        result.failure = "not enough memory";
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    result.seconds = elapsed.count();

    if (result.failure.empty()) {
        data.exact = looked_up(reference, block.elements, needs);
        data.amplitudes =
            with_one_more(data, [reference](double t) { return reference->stress(t); });
    } else {
        data.exact = looked_up(nullptr, block.elements);
        // A run that cannot be measured ends in its first step, as one that cannot start.
        data.amplitudes = with_one_more(data, [why = result.failure](double) -> double {
            throw std::domain_error("the reference run failed: " + why);
        });
    }
    data.exact->stress = data.amplitude_count;
    ++data.amplitude_count;
    return result;
}

void expect_reference(TableReader& table, std::vector<Expectation>& expectations) {
    const auto of_runs = [](const auto& number) {
        return [number](const StudyResult& result) {
            std::vector<double> numbers;
            for (const auto& run : result.reference->runs)
                numbers.push_back(number(run));
            return numbers;
        };
    };
    expect_numbers(table, "elements", expectations,
                   of_runs([](const Rung& run) { return static_cast<double>(run.elements); }));
    expect_numbers(table, "dt", expectations, of_runs([](const Rung& run) { return run.dt; }));
    expect_numbers(table, "times", expectations, [](const StudyResult& result) {
        const auto& times = result.reference->times;
        return std::vector{times.front(), times.back()};
    });
    expect_band(table, "levels", expectations, [](const StudyResult& result) {
        return std::vector{
            Metric{"reference: levels", static_cast<double>(result.reference->times.size()), ""}};
    });
}

} // namespace tvbeam
