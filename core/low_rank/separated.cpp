#include "core/low_rank/separated.hpp"

#include "core/low_rank/chebyshev.hpp"
#include "core/low_rank/expansion.hpp"
#include "core/norms/norm_sums.hpp"

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
/// at t = 0 alone, and comes last.
struct Fields {
    std::vector<Field*> in_time;
    Field* initial = nullptr;

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
        if (!data.curvature_initial.is_separable())
            initial = &data.curvature_initial;
    }
    [[nodiscard]] bool none() const { return in_time.empty() && initial == nullptr; }
    [[nodiscard]] std::vector<SpaceTimeFunction> functions() const {
        std::vector<SpaceTimeFunction> all;
        for (const Field* field : in_time)
            all.push_back(field->rest);
        if (initial != nullptr)
            all.push_back(
                [rest = initial->rest](const ArrayXd& x, double) { return rest(x, 0.0); });
        return all;
    }
    [[nodiscard]] std::vector<Field*> all() const {
        std::vector<Field*> fields = in_time;
        if (initial != nullptr)
            fields.push_back(initial);
        return fields;
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
    const auto functions = static_cast<Index>(expansion.greatest.size());
    MatrixXd columns(first.rows(), static_cast<Index>(expansion.pieces.size()) * functions * each);
    Index column = 0;
    for (const auto& piece : expansion.pieces)
        for (Index f = 0; f < functions; ++f, column += each) {
            const double greatest = expansion.greatest[static_cast<std::size_t>(f)];
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
        MatrixXd values(pieces_.front().coefficients.rows(), times.size());
        for (Index first = 0; first < times.size();) {
            const Piece& piece = piece_of(times(first));
            Index count = 1;
            while (first + count < times.size() && &piece_of(times(first + count)) == &piece)
                ++count;
            const ArrayXd places = times.segment(first, count).unaryExpr([&](double t) {
                return place_in(piece.begin, piece.end, t);
            });
            values.middleCols(first, count).noalias() =
                piece.coefficients * chebyshev_values(piece.coefficients.cols(), places);
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

/// Where products are compared with what they stand for: at times without pattern, each time in
/// places that are 1/16 apart, 1/240 from those of other times.
class Comparison {
public:
    explicit Comparison(const MatrixXd& basis)
        : sequence_(gsl_qrng_alloc(gsl_qrng_halton, 1), &gsl_qrng_free) {
        if (!sequence_)
            throw std::bad_alloc();
        for (int shift = 0; shift < shifts; ++shift) {
            const double first = (0.5 + shift) / (shifts * places);
            x_.emplace_back(ArrayXd::LinSpaced(places, first, first + (places - 1.0) / places));
            profiles_.emplace_back(basis.transpose() *
                                   chebyshev_values(basis.rows(), 2.0 * x_.back() - 1.0));
        }
    }

    /// Times in (0, 1), which leave gaps of at most twice the mean: the sequence begins anew.
    ArrayXd times(Index count) {
        gsl_qrng_init(sequence_.get());
        ArrayXd times(count);
        for (double& time : times)
            gsl_qrng_get(sequence_.get(), &time);
        return times;
    }

    /// The places of the i-th time, and the profiles there; shape: rank × places.
    [[nodiscard]] const ArrayXd& x(Index i) const {
        return x_[static_cast<std::size_t>(i % shifts)];
    }
    [[nodiscard]] const MatrixXd& profiles(Index i) const {
        return profiles_[static_cast<std::size_t>(i % shifts)];
    }

private:
    static constexpr Index places = 16;
    static constexpr int shifts = 15; // no power of two, which the sequence of times goes by
    std::unique_ptr<gsl_qrng, decltype(&gsl_qrng_free)> sequence_;
    std::vector<ArrayXd> x_;
    std::vector<MatrixXd> profiles_;
};

/// The greatest difference between the functions and their products, over the greatest value of
/// each. A bump exp(−((x − x₀)/w)² − ((t − t₀)/d)²) is seen down to 2e-13 of its height, (5.4)² =
/// 29 in the exponent. In up to 524288 steps times are at most twice eight steps apart, and places
/// 1/16: from a bump of d = two steps and w = 1/100, with its middle 1/32 or more from both ends,
/// one is never further than 4² + (3.1)² = 26, so that it is found whenever it is.
double residual_of(const Expansion& expansion, const std::vector<SpaceTimeFunction>& functions,
                   const MatrixXd& basis, const PiecewiseAmplitudes& amplitudes,
                   std::int64_t steps) {
    const auto all_times = static_cast<double>(std::clamp<std::int64_t>(steps / 8, 512, 65536));
    constexpr Index at_least = 16;
    Comparison comparison(basis);
    const double final_time = expansion.pieces.back().end;
    std::vector<double> greatest = expansion.greatest;
    std::vector<double> differences(functions.size(), 0.0);
    for (const auto& piece : expansion.pieces) {
        const double length = piece.end - piece.begin;
        const auto count = at_least + static_cast<Index>(all_times * length / final_time);
        const ArrayXd t = piece.begin + length * comparison.times(count);
        const MatrixXd of_all = amplitudes.at(t);
        for (std::size_t f = 0; f < functions.size(); ++f) {
            const auto own = of_all.middleRows(static_cast<Index>(f) * basis.cols(), basis.cols());
            for (Index i = 0; i < count; ++i) {
                const ArrayXd exact = functions[f](comparison.x(i), t(i));
                if (!exact.isFinite().all())
                    return std::numeric_limits<double>::infinity();
                const ArrayXd sums = (comparison.profiles(i).transpose() * own.col(i)).array();
                greatest[f] = std::max(greatest[f], exact.abs().maxCoeff());
                differences[f] = std::max(differences[f], (exact - sums).abs().maxCoeff());
            }
        }
    }
    double residual = 0.0;
    for (std::size_t f = 0; f < functions.size(); ++f)
        if (greatest[f] > 0.0)
            residual = std::max(residual, differences[f] / greatest[f]);
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
    const auto functions = fields.functions();
    const Expansion expansion = expanded(functions, ends_of(data, final_time));
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
    Index amplitude = data.amplitude_count;
    for (Field* field : fields.all()) {
        field->rest = nullptr;
        field->gentle = false;
        for (Index k = 0; k < result.rank; ++k)
            field->terms.push_back({amplitude++, static_cast<Index>(data.profiles.size()) + k});
    }
    result.data.amplitudes = joined(data, amplitudes, amplitude - data.amplitude_count);
    result.data.amplitude_count = amplitude;
    add_profiles(result.data, basis);
    return result;
}

} // namespace tvbeam
