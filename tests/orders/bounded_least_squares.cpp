#include "studies/orders/least_squares.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(bounded_least_squares)

namespace {

/// y = a x + ρ z; x and z are nearly one another.
const Eigen::MatrixXd& columns() {
    static const Eigen::MatrixXd both{{1.0, 1.1}, {2.0, 1.9}, {3.0, 3.2}, {4.0, 3.9}};
    return both;
}

LeastSquares fitted(double a, double rho, const Eigen::Vector2d& start) {
    const Eigen::VectorXd y = columns() * Eigen::Vector2d(a, rho);
    const ModelFunction model = [](const Eigen::VectorXd& theta, Eigen::VectorXd& values,
                                   Eigen::MatrixXd* jacobian) {
        values = columns() * theta;
        if (jacobian != nullptr)
            *jacobian = columns();
    };
    const auto fit =
        least_squares(model, y, Eigen::VectorXd::Ones(4), std::vector<Eigen::VectorXd>{start}, 0.0,
                      std::vector<Eigen::Index>{1});
    BOOST_REQUIRE(fit.has_value());
    return *fit;
}

} // namespace

// Of y = 3 z the best ρ that is admissible is 1, and beside it a is what is left on x: by the
// normal equation a = x·(2 z)/x·x. From ρ = 1 the step of both, of which one is cut off, has a = 0.
BOOST_AUTO_TEST_CASE(at_a_bound_the_others_have_their_least_squares) {
    const Eigen::VectorXd x = columns().col(0);
    const Eigen::VectorXd z = columns().col(1);
    const double by_hand = x.dot(2 * z) / x.squaredNorm();
    for (const double sign : {1.0, -1.0})
        for (const double start : {0.0, 1.0, -1.0}) {
            const auto fit = fitted(0.0, 3 * sign, {0.0, start});
            BOOST_TEST(fit.theta[1] == sign);
            BOOST_TEST(fit.theta[0] == sign * by_hand, boost::test_tools::tolerance(1e-8));
        }
}

BOOST_AUTO_TEST_CASE(from_a_bound_the_search_comes_back_to_what_is_within) {
    for (const double rho : {-0.9, -0.3, 0.0, 0.4, 0.99})
        for (const double start : {-1.0, 1.0}) {
            const auto fit = fitted(2.0, rho, {0.0, start});
            BOOST_TEST(std::abs(fit.theta[0] - 2.0) < 1e-7);
            BOOST_TEST(std::abs(fit.theta[1] - rho) < 1e-7);
        }
}

BOOST_AUTO_TEST_SUITE_END()
