#include "core/low_rank/expansion.hpp"

#include "core/low_rank/chebyshev.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

namespace tvbeam {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index first_degree_of_x = 24;
constexpr Index most_of_x = 192; // beyond, a layer of a width below 1e-3 or so: no rank is small
constexpr Index degree_of_t = 20;
constexpr std::size_t most_pieces = 64;
// The last coefficients of a function that is resolved are its round-off. That of a moment load,
// a difference of greater terms, was found up to eight times this.
constexpr double last_coefficients = 64.0 * std::numeric_limits<double>::epsilon();

/// Whether the last eighth of the rows is round-off.
bool has_ended(const MatrixXd& coefficients, double greatest) {
    const Index last = std::max<Index>(3, coefficients.rows() / 8);
    return coefficients.bottomRows(last).cwiseAbs().maxCoeff() <= last_coefficients * greatest;
}

class Expander {
public:
    Expander(const std::vector<SpaceTimeFunction>& functions, const std::vector<double>& ends)
        : functions_(functions) {
        result_.greatest.assign(functions.size(), 0.0);
        for (std::size_t i = ends.size() - 1; i > 0; --i)
            waiting_.emplace_back(ends[i - 1], ends[i]);
    }

    Expansion result() && {
        while (!waiting_.empty() && result_.reason.empty()) {
            const auto [begin, end] = waiting_.back();
            waiting_.pop_back();
            expand(begin, end);
        }
        if (!result_.reason.empty())
            result_.pieces.clear();
        for (auto& piece : result_.pieces)
            for (auto& matrix : piece.coefficients)
                matrix.conservativeResizeLike(MatrixXd::Zero(rows_, matrix.cols()));
        return std::move(result_);
    }

private:
    void expand(double begin, double end) {
        ExpandedPiece piece{begin, end, {}};
        bool ends_in_t = true;
        for (std::size_t f = 0; f < functions_.size() && ends_in_t; ++f) {
            const auto coefficients = of_function(f, begin, end);
            if (!coefficients)
                return;
            ends_in_t = has_ended(coefficients->transpose(), result_.greatest[f]);
            piece.coefficients.push_back(*coefficients);
        }
        if (ends_in_t) {
            result_.pieces.push_back(std::move(piece));
            return;
        }
        const double middle = 0.5 * (begin + end);
        waiting_.emplace_back(middle, end);
        waiting_.emplace_back(begin, middle);
        if (waiting_.size() + result_.pieces.size() > most_pieces)
            result_.reason =
                fmt::format("it takes more than {} pieces in time, each a polynomial of degree {}",
                            most_pieces, degree_of_t - 1);
    }

    /// With so many rows that x is resolved; none, and a reason, where that cannot be.
    std::optional<MatrixXd> of_function(std::size_t f, double begin, double end) {
        static const MatrixXd of_t = chebyshev_transform(degree_of_t).transpose();
        static const Eigen::ArrayXd times = chebyshev_points(degree_of_t);
        for (;; rows_ *= 2) {
            const Eigen::ArrayXd x = 0.5 * (1.0 + chebyshev_points(rows_));
            MatrixXd values(rows_, degree_of_t);
            for (Index j = 0; j < degree_of_t; ++j)
                values.col(j) =
                    functions_[f](x, begin + 0.5 * (1.0 + times(j)) * (end - begin)).matrix();
            if (!values.allFinite()) {
                result_.reason = "it is not finite everywhere";
                return std::nullopt;
            }
            result_.greatest[f] = std::max(result_.greatest[f], values.cwiseAbs().maxCoeff());
            MatrixXd coefficients = chebyshev_transform(rows_) * values * of_t;
            if (has_ended(coefficients, result_.greatest[f]))
                return coefficients;
            if (2 * rows_ > most_of_x) {
                result_.reason = fmt::format(
                    "no polynomial of x of degree {} follows it to round-off", rows_ - 1);
                return std::nullopt;
            }
        }
    }

    const std::vector<SpaceTimeFunction>& functions_;
    Index rows_ = first_degree_of_x;
    std::vector<std::pair<double, double>> waiting_; // the next interval comes last
    Expansion result_;
};

} // namespace

Expansion expanded(const std::vector<SpaceTimeFunction>& functions,
                   const std::vector<double>& ends) {
    return Expander(functions, ends).result();
}

} // namespace tvbeam
