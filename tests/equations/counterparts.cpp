#include "tests/equations/counterparts.hpp"

namespace tvbeam::testing {

namespace {

using Sources = std::map<std::string, Function>;
constexpr std::size_t X = 0, Y = 1, Z = 2, T = 3;

Real pi() {
    return boost::math::constants::pi<Real>();
}

template <typename Body>
Function field(const Body& body) {
    return [body](const Point& p) { return Real(body(p[X], p[Y], p[Z], p[T])); };
}

#define FIELD(expression)                                                                          \
    field([](const Real& x, const Real& y, const Real& z, const Real& t) -> Real {                 \
        static_cast<void>(x), static_cast<void>(y), static_cast<void>(z), static_cast<void>(t);    \
        return expression;                                                                         \
    })

Function sum(const Vector& terms) {
    Function total = terms.front();
    for (std::size_t i = 1; i < terms.size(); ++i)
        total = total + terms[i];
    return total;
}

/// Σ_j ∂_j v_j
Function divergence(const Vector& v) {
    Vector terms;
    for (std::size_t j = 0; j < v.size(); ++j)
        terms.push_back(d(v[j], j));
    return sum(terms);
}

Sources heat() {
    const Function u = FIELD(sin(pi() * x) * sin(pi() * y) * cos(t));
    return {{"f", d(u, T) - (d(u, X, X) + d(u, Y, Y))}};
}

Sources heat_rod() {
    const Function u = FIELD(sin(pi() * x) * cos(t) + x * x * exp(-t));
    const Function k = FIELD((1 + x) / 2);
    return {{"f", d(u, T) - k * d(u, X, X) - Real("0.5") * d(u, X)}};
}

Sources advection_diffusion() {
    const Function c = FIELD(exp(-t) * sin(2 * x + y) * cos(y - 1) + x * y);
    const Function b1 = FIELD(-y);
    const Function b2 = FIELD(x);
    const Function k = FIELD(Real("0.05") * (1 + x * x));
    return {{"f", d(c, T) + b1 * d(c, X) + b2 * d(c, Y) - d(k * d(c, X), X) - d(k * d(c, Y), Y)}};
}

Sources elasticity() {
    const Real mu("0.4");
    const Real lambda("0.6");
    const Vector u = {FIELD(sin(pi() * x) * cos(pi() * y)), FIELD(x * x * sin(pi() * y) + x * y)};
    // Navier's form: −f = μ Δu + (λ + μ) ∇ div u.
    Sources sources;
    for (std::size_t i = 0; i < 2; ++i)
        sources["f" + std::to_string(i + 1)] =
            Real(-mu) * (d(u[i], X, X) + d(u[i], Y, Y)) - Real(lambda + mu) * d(divergence(u), i);
    return sources;
}

Sources navier_stokes() {
    // v1 = ψ_y, v2 = −ψ_x with ψ = sin²(πx) sin²(πy) cos t, differentiated on paper.
    const Vector v = {
        FIELD(2 * pi() * sin(pi() * x) * sin(pi() * x) * sin(pi() * y) * cos(pi() * y) * cos(t)),
        FIELD(-2 * pi() * sin(pi() * x) * cos(pi() * x) * sin(pi() * y) * sin(pi() * y) * cos(t))};
    const Function p = FIELD(cos(pi() * x) * sin(pi() * y) * exp(-t));
    Sources sources;
    for (std::size_t i = 0; i < 2; ++i)
        sources["f" + std::to_string(i + 1)] = d(v[i], T) + v[0] * d(v[i], X) + v[1] * d(v[i], Y) +
                                               d(p, i) -
                                               Real("0.01") * (d(v[i], X, X) + d(v[i], Y, Y));
    sources["continuity"] = FIELD(Real(0));
    return sources;
}

/// τ_ij = μ (∂_j v_i + ∂_i v_j − 2/3 δ_ij div v)
Function viscous_stress(const Vector& v, std::size_t i, std::size_t j) {
    const Real mu("0.1");
    Function stress = d(v[i], j) + d(v[j], i);
    if (i == j)
        stress = stress - Real(Real(2) / 3) * divergence(v);
    return mu * stress;
}

Sources compressible_navier_stokes() {
    const Real R = 287;
    const Function rho = FIELD(1 + Real("0.15") * sin(pi() * x) + Real("0.1") * cos(pi() * y / 2) +
                               Real("0.12") * sin(pi() * z) + Real("0.05") * sin(t));
    const Vector v = {FIELD(2 + Real("0.3") * sin(pi() * x / 2) * cos(pi() * y) +
                            Real("0.2") * cos(pi() * (x + z)) * cos(t)),
                      FIELD(Real("1.5") + Real("0.2") * cos(pi() * x) * sin(pi() * y / 2) +
                            Real("0.1") * sin(pi() * (y + z)) * sin(t)),
                      FIELD(1 + Real("0.25") * sin(pi() * x) * sin(pi() * y) * cos(pi() * z / 2) +
                            Real("0.1") * sin(2 * t))};
    const Function p = FIELD(1000 * (1 + Real("0.2") * cos(pi() * x) * cos(pi() * y / 2) +
                                     Real("0.1") * sin(pi() * z) * cos(t)));
    const Function temperature = p / (R * rho);
    const Function energy =
        Real(1 / Real("0.4")) * p + Real("0.5") * (rho * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    Sources sources;
    sources["mass"] = d(rho, T) + divergence({rho * v[0], rho * v[1], rho * v[2]});
    Vector energy_flux;
    for (std::size_t i = 0; i < 3; ++i) {
        // ρ (v_t + v·∇v) + v (ρ_t + div ρv) = (ρv)_t + div(ρ v⊗v)
        Vector flux;
        Function work = FIELD(Real(0));
        for (std::size_t j = 0; j < 3; ++j) {
            flux.push_back(rho * v[i] * v[j] - viscous_stress(v, i, j));
            work = work + viscous_stress(v, j, i) * v[j];
        }
        sources["momentum" + std::to_string(i + 1)] = d(rho * v[i], T) + divergence(flux) + d(p, i);
        energy_flux.push_back((energy + p) * v[i] - work - Real("0.3") * d(temperature, i));
    }
    sources["energy"] = d(energy, T) + divergence(energy_flux);
    return sources;
}

Sources maxwell() {
    const Vector e = {FIELD(sin(pi() * y) * sin(pi() * z) * cos(t)),
                      FIELD(sin(pi() * z) * cos(pi() * x) * exp(-t)),
                      FIELD(x * y * cos(2 * t) + sin(pi() * x))};
    const Vector h = {FIELD(cos(pi() * y) * z * sin(t)), FIELD(x * cos(pi() * z) * cos(t)),
                      FIELD(sin(x + y) * exp(-z) * cos(t))};
    Sources sources;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        const std::string component = std::to_string(i + 1);
        sources["current" + component] =
            d(h[k], j) - d(h[j], k) - Real(2) * d(e[i], T) - Real("0.3") * e[i];
        sources["faraday" + component] = Real("1.5") * d(h[i], T) + d(e[k], j) - d(e[j], k);
    }
    sources["charge"] = Real(2) * divergence(e);
    sources["magnetic"] = Real("1.5") * divergence(h);
    return sources;
}

Sources rod() {
    const Function u = FIELD(x * x * (3 - x) * sin(t) / 10);
    const Function theta = FIELD(exp(-t) * sin(pi() * x) + x * (1 - x));
    return {{"force", Real("1.2") * d(u, T, T) - Real(3) * d(u, X, X) -
                          Real("0.2") * d(d(u, X, X), T) + Real("0.4") * d(theta, X)},
            {"heat",
             Real("1.1") * d(theta, T) - Real("0.7") * d(theta, X, X) + Real("0.4") * d(u, X, T)}};
}

Sources beam() {
    const Real alpha("0.3");
    const Real zeta("0.1");
    const Function theta = FIELD(cos(t) * sin(pi() * x));
    const Function u = FIELD(x * x * (3 - x) * sin(t) / 100);
    const Function u_xxx = d(d(u, X, X), X);
    return {{"f", d(theta, T) - d(theta, X, X) - alpha * d(d(u, X, X), T)},
            {"G", u_xxx + zeta * d(u_xxx, T) + alpha * d(theta, X)}};
}

Sources wave() {
    const Function u =
        FIELD(sin(pi() * x) * sin(2 * pi() * y) * cos(pi() * z / 2) * exp(-t / 2) * cos(3 * t));
    const Function c = FIELD(exp(-x * y) / (1 + z * z));
    return {{"f", d(u, T, T) + Real("0.2") * d(u, T) - d(c * d(u, X), X) - d(c * d(u, Y), Y) -
                      d(c * d(u, Z), Z)}};
}

} // namespace

const std::map<std::string, Sources>& counterparts() {
    static const std::map<std::string, Sources> all = {
        {"heat-2d", heat()},
        {"heat-rod", heat_rod()},
        {"advection-diffusion", advection_diffusion()},
        {"elasticity", elasticity()},
        {"navier-stokes", navier_stokes()},
        {"compressible-navier-stokes", compressible_navier_stokes()},
        {"maxwell", maxwell()},
        {"thermoviscoelastic-rod", rod()},
        {"beam", beam()},
        {"wave-3d", wave()},
    };
    return all;
}

} // namespace tvbeam::testing
