#include "core/certify/stated_scheme.hpp"

#include <numbers>
#include <stdexcept>

namespace tvbeam {

double StatedStep::fraction(Eigen::Index i) const {
    return two_step ? 1.0 : a.row(i).sum();
}

double StatedStep::leading(Eigen::Index i) const {
    return two_step ? 1.5 : 1.0 / a(i, i);
}

Eigen::MatrixXd StatedStep::algebraic_stability() const {
    const Eigen::VectorXd b = a.row(a.rows() - 1).transpose();
    const Eigen::MatrixXd weighted = b.asDiagonal() * a;
    return weighted + weighted.transpose() - b * b.transpose();
}

StatedStep stated_step(const std::string& scheme, std::int64_t n) {
    if (scheme == "euler")
        return {Eigen::MatrixXd::Ones(1, 1)};
    if (scheme == "bdf2" && n > 1)
        return {Eigen::MatrixXd::Ones(1, 1), true};
    if (scheme == "bdf2" || scheme == "sdirk2") {
        const double gamma = 1.0 - 1.0 / std::numbers::sqrt2;
        Eigen::Matrix2d a;
        a << gamma, 0.0, 1.0 - gamma, gamma;
        return {a};
    }
    throw std::domain_error("the time scheme " + scheme +
                            " is not stated apart from the one that runs, and not certified");
}

std::vector<std::string> stated_schemes() {
    return {"euler", "bdf2", "sdirk2"};
}

int stated_order(const std::string& scheme) {
    return scheme == "euler" ? 1 : 2;
}

} // namespace tvbeam
