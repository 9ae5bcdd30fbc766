#include "core/low_rank/separated.hpp"

#include "core/dense_kernels.hpp"
#include "core/joint_functions.hpp"
#include "core/low_rank/chebyshev.hpp"
#include "core/low_rank/expansion.hpp"
#include "core/norms/norm_sums.hpp"
#include "core/point_grid.hpp"

#include <Eigen/QR>
#include <fmt/format.h>
#include <gsl/gsl_qrng.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace tvbeam {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double ulp = std::numeric_limits<double>::epsilon();
// Where more profiles are needed, a step in the sine basis costs a fifth of one that evaluates the
// functions at every point: measured with Table 1's mesh of 160 elements.
constexpr Index most_profiles = 40;
// What the comparison allows, over max |g|.
constexpr double most_residual = 1000.0 * ulp;

/// The fields of a problem that runs read and that do not separate. The initial curvature is read
/// at t = 0 alone; it comes last, where it is not one of the others.
struct Fields {
    std::vector<Field*> in_time;
    Field* initial = nullptr;
    Index function_of_initial = 0;

    Fields(ProblemData& data, const std::vector<Norm>& norms) {
        const auto add = [&](Field& field) {
            if (!field.is_separable())
                in_time.push_back(&field);
        };
        add(data.heat_source);
        add(data.moment_load);
        if (data.exact && data.exact->elements == 0) {
            ExactSolution& exact = *data.exact;
            const QuantitySet needed = quantities_of(norms);
            Field* const fields[] = {&exact.theta, &exact.theta_x, &exact.u, &exact.u_x,
                                     &exact.u_xx};
            for (std::size_t q = 0; q < std::size(fields); ++q)
                if (needed[q])
                    add(*fields[q]);
        }
        if (data.curvature_initial.is_separable())
            return;
        initial = &data.curvature_initial;
        const auto same = std::find_if(in_time.begin(), in_time.end(), [&](const Field* field) {
            return are_same(field->rest, initial->rest);
        });
        function_of_initial = same - in_time.begin();
    }
    [[nodiscard]] bool none() const { return in_time.empty() && initial == nullptr; }
    [[nodiscard]] Index count() const {
        const auto others = static_cast<Index>(in_time.size());
        return initial == nullptr ? others : std::max(others, function_of_initial + 1);
    }
    [[nodiscard]] JointFunctions functions() const {
        std::vector<SpaceTimeFunction> all;
        for (const Field* field : in_time)
            all.push_back(field->rest);
        const auto others = static_cast<Index>(all.size());
        JointFunctions together = in_one(all);
        if (count() == others)
            return together;
        return [together = std::move(together), others,
                at_start = in_one({initial->rest})](const ArrayXd& x, const ArrayXd& t) {
            Eigen::ArrayXXd values(others + 1, x.size());
            if (others > 0)
                values.topRows(others) = together(x, t);
            values.bottomRows(1) = at_start(x, ArrayXd::Zero(x.size()));
            return values;
        };
    }
    /// Calls visit(field, number of its function) for all of them.
    template <typename Visit>
    void for_each(const Visit& visit) const {
        for (std::size_t f = 0; f < in_time.size(); ++f)
            visit(*in_time[f], static_cast<Index>(f));
        if (initial != nullptr)
            visit(*initial, function_of_initial);
    }
};

/// 0, the ends of phases within, T.
std::vector<double> ends_of(const ProblemData& data, double final_time) {
    std::vector<double> ends{0.0};
    for (const double end : data.phase_ends)
        if (end < final_time)
            ends.push_back(end);
    ends.push_back(final_time);
    return ends;
}

/// An orthonormal basis of all the columns, each over the greatest value of its function, to
/// round-off; shape: rows × rank.
MatrixXd basis_of(const Expansion& expansion) {
    const MatrixXd& first = expansion.pieces.front().coefficients.front();
    const Index each = first.cols();
    const Index functions = expansion.greatest.size();
    MatrixXd columns(first.rows(), static_cast<Index>(expansion.pieces.size()) * functions * each);
    Index column = 0;
    for (const auto& piece : expansion.pieces)
        for (Index f = 0; f < functions; ++f, column += each) {
            const double greatest = expansion.greatest(f);
            columns.middleCols(column, each) = piece.coefficients[static_cast<std::size_t>(f)] *
                                               (greatest > 0.0 ? 1.0 / greatest : 0.0);
        }
    Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
    const auto diagonal = qr.matrixQR().diagonal().cwiseAbs();
    Index rank = 0;
    while (rank < diagonal.size() && diagonal(rank) > 16.0 * ulp)
        ++rank;
    return qr.householderQ() * MatrixXd::Identity(columns.rows(), rank);
}

/// The amplitudes of all functions, piece by piece in time.
class PiecewiseAmplitudes {
public:
    PiecewiseAmplitudes(const Expansion& expansion, const MatrixXd& basis) {
        for (const auto& piece : expansion.pieces) {
            const Index each = piece.coefficients.front().cols();
            const auto functions = static_cast<Index>(piece.coefficients.size());
            MatrixXd of_piece(functions * basis.cols(), each);
            for (Index f = 0; f < functions; ++f)
                of_piece.middleRows(f * basis.cols(), basis.cols()) =
                    basis.transpose() * piece.coefficients[static_cast<std::size_t>(f)];
            pieces_.push_back({piece.begin, piece.end, std::move(of_piece)});
        }
    }

    /// Shape: functions · rank × times. A time that ends a piece belongs to it.
    [[nodiscard]] MatrixXd at(const ArrayXd& times) const {
        MatrixXd values = MatrixXd::Zero(pieces_.front().coefficients.rows(), times.size());
        for (Index first = 0; first < times.size();) {
            const Piece& piece = piece_of(times(first));
            Index count = 1;
            while (first + count < times.size() && &piece_of(times(first + count)) == &piece)
                ++count;
            const ArrayXd places = times.segment(first, count).unaryExpr([&](double t) {
                return place_in(piece.begin, piece.end, t);
            });
            add_product(values.middleCols(first, count), piece.coefficients,
                        chebyshev_values(piece.coefficients.cols(), places), values.rows());
            first += count;
        }
        return values;
    }

private:
    struct Piece {
        double begin;
        double end;
        MatrixXd coefficients; // shape: functions · rank × degrees of t
    };

    [[nodiscard]] const Piece& piece_of(double t) const {
        const auto found =
            std::lower_bound(pieces_.begin(), pieces_.end(), t,
                             [](const Piece& piece, double at) { return piece.end < at; });
        return found == pieces_.end() ? pieces_.back() : *found;
    }

    std::vector<Piece> pieces_;
};

/// Those of the problem, then the new ones.
Amplitudes joined(const ProblemData& data, std::shared_ptr<const PiecewiseAmplitudes> added,
                  Index count) {
    return [before = data.amplitudes, known = data.amplitude_count, added = std::move(added),
            count](const ArrayXd& t) {
        Eigen::ArrayXXd values(known + count, t.size());
        if (known > 0)
            values.topRows(known) = before(t);
        values.bottomRows(count) = added->at(t).array();
        return values;
    };
}

void add_profiles(ProblemData& data, const MatrixXd& basis) {
    data.gentle_profiles.resize(data.profiles.size(), false);
    for (Index k = 0; k < basis.cols(); ++k) {
        data.profiles.push_back(
            [coefficients = VectorXd(basis.col(k))](const ArrayXd& x) -> ArrayXd {
                return chebyshev_sum(coefficients, 2.0 * x - 1.0);
            });
        data.gentle_profiles.push_back(true);
    }
}

/// Times in (0, 1), without pattern: gaps of at most twice the mean.
ArrayXd scattered_times(Index count) {
    const std::unique_ptr<gsl_qrng, decltype(&gsl_qrng_free)> sequence(
        gsl_qrng_alloc(gsl_qrng_halton, 1), &gsl_qrng_free);
    if (!sequence)
        throw std::bad_alloc();
    ArrayXd times(count);
    for (double& time : times)
        gsl_qrng_get(sequence.get(), &time);
    return times;
}

/// Where products are compared with what they stand for: each time in places that are 1/16 apart,
/// 1/240 from those of other times.
constexpr Index places = 16;
constexpr Index shifts = 15; // no power of two, which the sequence of times goes by

/// The greatest difference between the functions and their products, over the greatest value of
/// each. A bump exp(−((x − x₀)/w)² − ((t − t₀)/d)²) is seen down to 2e-13 of its height, (5.4)² =
/// 29 in the exponent. In up to 524288 steps times are at most twice eight steps apart, and places
/// 1/16: from a bump of d = two steps and w = 1/100, with its middle 1/32 or more from both ends,
/// one is never further than 4² + (3.1)² = 26, so that it is found whenever it is.
double residual_of(const Expansion& expansion, const JointFunctions& functions,
                   const MatrixXd& basis, const PiecewiseAmplitudes& amplitudes,
                   std::int64_t steps) {
    const auto all_times = static_cast<double>(std::clamp<std::int64_t>(steps / 8, 512, 65536));
    constexpr Index at_least = 16;
    constexpr Index most_at_once = 64; // what is evaluated stays in the cache
    const double final_time = expansion.pieces.back().end;
    const Index rank = basis.cols();
    ArrayXd greatest = expansion.greatest;
    ArrayXd differences = ArrayXd::Zero(greatest.size());
    std::vector<ArrayXd> x;
    std::vector<MatrixXd> profiles; // shape of each: places × rank
    for (Index shift = 0; shift < shifts; ++shift) {
        const double first =
            (0.5 + static_cast<double>(shift)) / static_cast<double>(shifts * places);
        x.emplace_back(ArrayXd::LinSpaced(places, first, first + (places - 1.0) / places));
        profiles.emplace_back(chebyshev_values(basis.rows(), 2.0 * x.back() - 1.0).transpose() *
                              basis);
    }
    for (const auto& piece : expansion.pieces) {
        const double length = piece.end - piece.begin;
        const auto count = at_least + static_cast<Index>(all_times * length / final_time);
        const ArrayXd t = piece.begin + length * scattered_times(count);
        for (Index first = 0; first < count; first += most_at_once * shifts)
            for (Index shift = 0; shift < std::min(shifts, count - first); ++shift) {
                const Index rest = count - first - shift;
                const Index n = std::min(most_at_once, (rest + shifts - 1) / shifts);
                const ArrayXd times = t(Eigen::seqN(first + shift, n, shifts));
                const auto at = static_cast<std::size_t>(shift);
                const Points points = point_grid(x[at], times);
                const Eigen::ArrayXXd exact = functions(points.x, points.t);
                if (!exact.isFinite().all())
                    return std::numeric_limits<double>::infinity();
                const MatrixXd of_all = amplitudes.at(times);
                for (Index f = 0; f < greatest.size(); ++f) {
                    const ArrayXd sums =
                        (profiles[at] * of_all.middleRows(f * rank, rank)).reshaped().array();
                    const ArrayXd of_function = exact.row(f).transpose();
                    greatest(f) = std::max(greatest(f), of_function.abs().maxCoeff());
                    differences(f) =
                        std::max(differences(f), (of_function - sums).abs().maxCoeff());
                }
            }
    }
    double residual = 0.0;
    for (Index f = 0; f < greatest.size(); ++f)
        if (greatest(f) > 0.0)
            residual = std::max(residual, differences(f) / greatest(f));
    return residual;
}

SeparatedProblem unchanged(const ProblemData& data, const std::string& reason) {
    return {.data = data, .reason = reason};
}

} // namespace

SeparatedProblem separated(const ProblemData& data, const std::vector<Norm>& norms,
                           double final_time, std::int64_t steps) {
    SeparatedProblem result{.data = data};
    const Fields fields(result.data, norms);
    if (fields.none())
        return result;
    const JointFunctions functions = fields.functions();
    const Expansion expansion = expanded(functions, fields.count(), ends_of(data, final_time));
    if (!expansion.reason.empty())
        return unchanged(data, expansion.reason);
    const MatrixXd basis = basis_of(expansion);
    if (basis.cols() > most_profiles)
        return unchanged(data, fmt::format("it takes {} products, more than the {} that pay",
                                           basis.cols(), most_profiles));
    const auto amplitudes = std::make_shared<const PiecewiseAmplitudes>(expansion, basis);
    result.rank = basis.cols();
    result.residual = residual_of(expansion, functions, basis, *amplitudes, steps);
    if (!(result.residual <= most_residual))
        return unchanged(data,
                         fmt::format("{} products differ from it by {:.1e} of its greatest value",
                                     result.rank, result.residual));
    const Index first_amplitude = data.amplitude_count;
    const auto first_profile = static_cast<Index>(data.profiles.size());
    fields.for_each([&](Field& field, Index function) {
        field.rest = nullptr;
        field.gentle = false;
        for (Index k = 0; k < result.rank; ++k)
            field.terms.push_back(
                {first_amplitude + function * result.rank + k, first_profile + k});
    });
    result.data.amplitudes = joined(data, amplitudes, fields.count() * result.rank);
    result.data.amplitude_count += fields.count() * result.rank;
    add_profiles(result.data, basis);
    return result;
}

} // namespace tvbeam
