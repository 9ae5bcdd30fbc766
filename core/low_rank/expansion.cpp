#include "core/low_rank/expansion.hpp"

#include "core/low_rank/chebyshev.hpp"
#include "core/point_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace tvbeam {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index first_degree_of_x = 24;
constexpr Index most_of_x = 192; // beyond, a layer of a width below 1e-3 or so: no rank is small
constexpr Index degree_of_t = 20;
constexpr std::size_t most_pieces = 64;
// The last coefficients of a function that is resolved are its round-off. That of a moment load,
// a difference of greater terms, was found up to eight times this.
constexpr double last_coefficients = 64.0 * std::numeric_limits<double>::epsilon();

/// Whether the last eighth of the rows, three at least, is round-off.
bool has_ended(const MatrixXd& coefficients, double greatest) {
    const Index last = std::max<Index>(3, coefficients.rows() / 8);
    return coefficients.bottomRows(last).cwiseAbs().maxCoeff() <= last_coefficients * greatest;
}

class Expander {
public:
    Expander(const JointFunctions& functions, Index count, const std::vector<double>& ends)
        : functions_(functions), count_(count) {
        result_.greatest = ArrayXd::Zero(count);
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
        const ArrayXd times = begin + 0.5 * (1.0 + chebyshev_points(degree_of_t)) * (end - begin);
        // A few times tell how many rows it takes, a few places most of what is to be halved.
        while (result_.reason.empty() && !end_in_x(times(few_times)))
            more_rows();
        bool ends_in_t = result_.reason.empty() && end_in_t(times);
        ExpandedPiece piece{begin, end, {}};
        while (ends_in_t) {
            piece.coefficients = values_at(chebyshev_points(rows_), times);
            for (MatrixXd& of_function : piece.coefficients)
                of_function = of_x_ * of_function * of_t_.transpose();
            if (all_have_ended(piece.coefficients)) {
                ends_in_t = all_have_ended(transposed(piece.coefficients));
                break;
            }
            more_rows();
            ends_in_t = result_.reason.empty();
        }
        if (!result_.reason.empty())
            return;
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

    /// The functions at the places y in [−1, 1] of x and these times; shape of each: places ×
    /// times. A reason where they are not finite.
    std::vector<MatrixXd> values_at(const ArrayXd& y, const ArrayXd& times) {
        const auto [x, t] = point_grid(0.5 * (1.0 + y), times);
        const Eigen::ArrayXXd all = functions_(x, t);
        if (!all.isFinite().all())
            result_.reason = "it is not finite everywhere";
        else
            result_.greatest = result_.greatest.max(all.abs().rowwise().maxCoeff());
        std::vector<MatrixXd> values;
        for (Index f = 0; f < count_; ++f)
            values.emplace_back(all.row(f).reshaped(y.size(), times.size()).matrix());
        return values;
    }

    bool end_in_x(const ArrayXd& times) {
        std::vector<MatrixXd> coefficients = values_at(chebyshev_points(rows_), times);
        for (MatrixXd& of_function : coefficients)
            of_function = of_x_ * of_function;
        return all_have_ended(coefficients);
    }

    bool end_in_t(const ArrayXd& times) {
        std::vector<MatrixXd> coefficients = values_at(chebyshev_points(few_places), times);
        for (MatrixXd& of_function : coefficients)
            of_function = of_t_ * of_function.transpose();
        return all_have_ended(coefficients);
    }

    [[nodiscard]] bool all_have_ended(const std::vector<MatrixXd>& coefficients) const {
        for (Index f = 0; f < count_; ++f)
            if (!has_ended(coefficients[static_cast<std::size_t>(f)], result_.greatest(f)))
                return false;
        return true;
    }

    static std::vector<MatrixXd> transposed(std::vector<MatrixXd> matrices) {
        for (MatrixXd& matrix : matrices)
            matrix.transposeInPlace();
        return matrices;
    }

    void more_rows() {
        if (!result_.reason.empty())
            return;
        if (2 * rows_ > most_of_x) {
            result_.reason =
                fmt::format("no polynomial of x of degree {} follows it to round-off", rows_ - 1);
            return;
        }
        rows_ *= 2;
        of_x_ = chebyshev_transform(rows_);
    }

    static constexpr std::array<Index, 3> few_times{0, degree_of_t / 2, degree_of_t - 1};
    static constexpr Index few_places = 5;

    const JointFunctions& functions_;
    Index count_;
    Index rows_ = first_degree_of_x;
    MatrixXd of_x_ = chebyshev_transform(rows_);
    MatrixXd of_t_ = chebyshev_transform(degree_of_t);
    std::vector<std::pair<double, double>> waiting_; // the next interval comes last
    Expansion result_;
};

} // namespace

Expansion expanded(const JointFunctions& functions, Eigen::Index count,
                   const std::vector<double>& ends) {
    return Expander(functions, count, ends).result();
}

} // namespace tvbeam
