#include "core/sine/profiles.hpp"

#include "core/dense_kernels.hpp"
#include "core/space/cells.hpp"
#include "core/space/linear_elements.hpp"
#include "core/space/profile.hpp"
#include "core/space/quadrature.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace tvbeam {

namespace {

/// Of values of size 1, what is taken for round-off.
constexpr double round_off = 4.0 * std::numeric_limits<double>::epsilon();

/// Fewer functions than this are left as they are, and as many modes as are marched together.
constexpr Eigen::Index fewest_to_combine = 6;
constexpr Eigen::Index most_modes_together = packs_in_group * Pack::size;

/// One of the functions g_j.
struct Column {
    Eigen::VectorXd parts;    // φ_r° = Σ_j parts_j(r) g_j; empty: 1 − x or x
    Eigen::VectorXd nodal;    // g_j at the nodes of 1 − x and x
    Eigen::VectorXd hat_load; // (φ°, χ_i)
    Eigen::ArrayXd modes;     // (g_j, φ̂_k)
    Eigen::Index extent = 0;  // how many of them are not zero
    // For norms:
    Eigen::Index place = -1;  // among the φ°, and among their error profiles
    Eigen::VectorXd defect;   // (φ° − I_hφ°, χ_i)
    Eigen::ArrayXd deviation; // (φ° − I_hφ°, φ̂_k)

    [[nodiscard]] bool is_linear() const { return parts.size() == 0; }
};

/// φ, which must outlive the result, without the linear function of these end values.
SpaceFunction without_ends(const SpaceFunction& phi, double left, double right) {
    return [&phi, left, right](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
        return phi(x) - (left * (1.0 - x) + right * x);
    };
}

/// Whether φ is linear, from its values at the nodes and one more in every cell. The place of that
/// one, a Gauss point, is irrational: a wave that the nodes alias to zero does not vanish there.
bool is_linear(const Mesh& mesh, const SpaceFunction& phi, const Eigen::ArrayXd& at_nodes,
               double bound) {
    const Eigen::Index s = mesh.elements();
    const double left = at_nodes(0);
    const double right = at_nodes(s);
    const auto vanishes = [&](const Eigen::ArrayXd& x, const Eigen::ArrayXd& values) {
        return ((values - (left * (1.0 - x) + right * x)).abs() <= bound).all();
    };
    if (!vanishes(mesh.nodes, at_nodes))
        return false;
    const Mesh& cells = integration_mesh(mesh);
    const Eigen::ArrayXd within =
        cells.nodes.head(cells.elements()) + element_rule().points(1) * cells.lengths;
    return vanishes(within, phi(within));
}

/// Cuts off the coefficients behind the last that is more than round-off, and what is at most
/// `rest`.
void cut_off(Column& column, double rest) {
    const double bound =
        column.modes.size() == 0 ? 0.0 : std::max(rest, round_off * column.modes.abs().maxCoeff());
    column.extent = column.modes.size();
    while (column.extent > 0 && !(std::abs(column.modes(column.extent - 1)) > bound))
        --column.extent;
    column.modes.tail(column.modes.size() - column.extent).setZero();
}

/// M_c v of nodal values that are zero at both ends.
Eigen::VectorXd mass_times(const Mesh& mesh, const Eigen::VectorXd& nodal) {
    DiscontinuousLinear p(2, mesh.elements());
    p.row(0) = nodal.head(mesh.elements()).transpose().array();
    p.row(1) = nodal.tail(mesh.elements()).transpose().array();
    return hat_loads(mesh, p);
}

/// 1 − x, and x where some profile ends in a value that is not zero.
std::vector<Column> linear_columns(const Mesh& mesh, const SineBasis& basis, bool right) {
    std::vector<Column> columns(right ? 2 : 1);
    columns[0].nodal = (1.0 - mesh.nodes).matrix();
    columns[0].modes = basis.left_hat();
    if (right) {
        columns[1].nodal = mesh.nodes.matrix();
        columns[1].modes = basis.right_hat();
    }
    return columns;
}

/// Reads the errors of interpolation into the columns, and their modes from them.
void read_defects(const Mesh& mesh, const SineBasis& basis, const ErrorProfiles& errors,
                  std::vector<Column>& columns) {
    for (Column& column : columns) {
        column.defect = errors.defect_load.col(column.place);
        column.deviation = basis.of_load(column.defect);
        Eigen::VectorXd nodal = errors.nodal.col(column.place);
        nodal(0) = 0.0;
        nodal(mesh.elements()) = 0.0;
        column.modes = basis.of_nodal(nodal) + column.deviation;
        column.hat_load = mass_times(mesh, nodal) + column.defect;
    }
}

/// (g_i − P_0g_i, g_j − P_0g_j). Of φ° only the error of interpolation counts, because I_hφ° lies
/// in S_0^h; so every entry is small where its functions are smooth.
double remainder_entry(const Column& i, const Column& j, const ErrorProfiles& errors) {
    if (i.is_linear() && j.is_linear()) {
        const double product = i.nodal(0) == j.nodal(0) ? 1.0 / 3.0 : 1.0 / 6.0;
        return product - (i.modes * j.modes).sum();
    }
    if (i.is_linear())
        return i.nodal.dot(j.defect) - (i.modes * j.deviation).sum();
    if (j.is_linear())
        return remainder_entry(j, i, errors);
    return errors.interpolation(i.place, j.place) - (i.deviation * j.deviation).sum();
}

/// The profiles without their linear parts.
struct Split {
    Eigen::MatrixXd at_ends;   // of the profiles, then the moment arm; shape: 2 × (R + 1)
    std::vector<Column> inner; // those of which anything is left
    std::vector<SpaceFunction> functions;
    bool peaks_at_node = false;
};

/// SineProfiles::peaks_at_node of one profile, from its values at the nodes, at the ends that were
/// taken from it, and the loads (φ°, χ_i) of what is left. These err by ε max|φ(x_i)| h, of which
/// the greatest load of |φ| is 1e-12 then.
bool peaks(const Mesh& mesh, const SpaceFunction& phi, const Eigen::ArrayXd& at_nodes,
           const Eigen::Vector2d& ends, const Eigen::VectorXd& hat_load) {
    constexpr double most = 4096.0;
    const Eigen::Index inner = mesh.elements() - 1;
    if (inner < 1)
        return false;
    const double bound = at_nodes.abs().maxCoeff() / most;
    const auto are_small = [&](const Eigen::ArrayXd& averages) {
        return averages.abs().maxCoeff() < bound;
    };
    const Eigen::ArrayXd x = mesh.nodes.segment(1, inner);
    if (!are_small(hat_load.segment(1, inner).array() / mesh.lengths(0) + ends(0) * (1.0 - x) +
                   ends(1) * x))
        return false;
    // On both sides of a node φ may take itself off.
    const SpaceFunction size = [&phi](const Eigen::ArrayXd& at) -> Eigen::ArrayXd {
        return phi(at).abs();
    };
    return are_small(hat_loads(mesh, size).segment(1, inner).array() / mesh.lengths(0));
}

/// used: the others keep zeros.
Split split(const Mesh& mesh, const std::vector<SpaceFunction>& profiles,
            const std::vector<bool>& used) {
    const auto arm = static_cast<Eigen::Index>(profiles.size());
    Split parts{Eigen::MatrixXd::Zero(2, arm + 1), {}, {}};
    parts.at_ends(0, arm) = 1.0;
    for (Eigen::Index r = 0; r < arm; ++r) {
        if (!used[static_cast<std::size_t>(r)])
            continue;
        const SpaceFunction& phi = profiles[static_cast<std::size_t>(r)];
        const Eigen::ArrayXd values = phi(mesh.nodes);
        const double scale = values.abs().maxCoeff();
        for (Eigen::Index end = 0; end < 2; ++end)
            if (const double value = values(end * mesh.elements());
                !(std::abs(value) <= round_off * scale))
                parts.at_ends(end, r) = value;
        if (is_linear(mesh, phi, values, round_off * scale))
            continue;
        SpaceFunction function = without_ends(phi, parts.at_ends(0, r), parts.at_ends(1, r));
        Column column;
        column.parts = Eigen::VectorXd::Unit(arm, r);
        column.place = static_cast<Eigen::Index>(parts.inner.size());
        column.hat_load = hat_loads(mesh, function);
        parts.peaks_at_node =
            parts.peaks_at_node || peaks(mesh, phi, values, parts.at_ends.col(r), column.hat_load);
        // Of a linear profile nothing is left but round-off.
        if (column.hat_load.cwiseAbs().maxCoeff() <= round_off * scale * mesh.lengths(0))
            continue;
        parts.inner.push_back(std::move(column));
        parts.functions.push_back(std::move(function));
    }
    return parts;
}

/// The orthogonal matrix V after which the columns of modes · V reach no further than they must: in
/// blocks from the highest modes down, what a block has of the columns that are still free goes to
/// as few of them as its rank.
Eigen::MatrixXd combinations_of(const Eigen::MatrixXd& modes) {
    constexpr Eigen::Index group = packs_in_group * Pack::size;
    const double bound = round_off * modes.cwiseAbs().maxCoeff();
    Eigen::MatrixXd all(modes.cols(), modes.cols());
    Eigen::MatrixXd free = Eigen::MatrixXd::Identity(modes.cols(), modes.cols());
    Eigen::Index groups = (modes.rows() + group - 1) / group;
    Eigen::Index end = modes.rows();
    while (end > 0 && free.cols() > 0) {
        groups -= std::max<Eigen::Index>(1, groups / 4);
        const Eigen::Index begin = groups * group;
        const Eigen::MatrixXd block =
            free.transpose() * modes.middleRows(begin, end - begin).transpose();
        end = begin;
        if (block.cwiseAbs().maxCoeff() <= bound)
            continue;
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(block);
        const auto pivots = qr.matrixQR().diagonal().cwiseAbs();
        Eigen::Index rank = 0;
        while (rank < pivots.size() && pivots(rank) > bound)
            ++rank;
        free = (free * qr.householderQ()).eval();
        all.middleCols(modes.cols() - free.cols(), rank) = free.leftCols(rank);
        free = free.rightCols(free.cols() - rank).eval();
    }
    all.rightCols(free.cols()) = free;
    return all;
}

/// Puts the combinations Σ_i g_i factors(i, j) in place of one vector of all columns.
template <typename Vector>
void combine(std::vector<Column>& columns, const Eigen::MatrixXd& factors, Vector Column::*member) {
    const Eigen::Index rows = (columns.front().*member).size();
    Eigen::MatrixXd before(rows, factors.rows());
    for (std::size_t j = 0; j < columns.size(); ++j)
        before.col(static_cast<Eigen::Index>(j)) = columns[j].*member;
    Eigen::MatrixXd after = Eigen::MatrixXd::Zero(rows, factors.cols());
    add_product(after, before, factors, rows);
    for (std::size_t j = 0; j < columns.size(); ++j)
        columns[j].*member = after.col(static_cast<Eigen::Index>(j));
}

/// Puts combinations of the columns in their place, each over its size first. What their modes have
/// of round-off then.
double combine(std::vector<Column>& columns, ErrorProfiles& errors) {
    const auto count = static_cast<Eigen::Index>(columns.size());
    Eigen::MatrixXd modes(columns.front().modes.size(), count);
    Eigen::VectorXd sizes(count);
    for (Eigen::Index j = 0; j < count; ++j) {
        const Column& column = columns[static_cast<std::size_t>(j)];
        sizes(j) = column.hat_load.cwiseAbs().maxCoeff() * static_cast<double>(modes.rows());
        if (!(sizes(j) > 0.0) || !std::isfinite(1.0 / sizes(j)))
            return 0.0;
        modes.col(j) = column.modes / sizes(j);
    }
    const Eigen::MatrixXd turn = combinations_of(modes);
    const Eigen::MatrixXd factors = sizes.cwiseInverse().asDiagonal() * turn;
    combine(columns, factors, &Column::hat_load);
    combine(columns, factors, &Column::modes);
    combine(columns, sizes.asDiagonal() * turn, &Column::parts);
    const double rest = round_off * modes.cwiseAbs().maxCoeff();
    if (errors.interpolation.size() == 0)
        return rest;
    combine(columns, factors, &Column::defect);
    combine(columns, factors, &Column::deviation);
    for (Eigen::MatrixXd* gram : {&errors.interpolation, &errors.projection})
        *gram = (factors.transpose() * *gram * factors).eval();
    return rest;
}

ModeArrays table_of(const std::vector<Column>& columns, Eigen::Index modes) {
    ModeArrays table(modes, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t j = 0; j < columns.size(); ++j)
        table[static_cast<Eigen::Index>(j)].head(modes) = columns[j].modes;
    return table;
}

/// How many columns each group of modes reads. The linear ones have all modes; the others are
/// sorted by their extent.
std::vector<std::int64_t> active_columns(const std::vector<Column>& columns, Eigen::Index groups,
                                         Eigen::Index linear) {
    std::vector<std::int64_t> active(static_cast<std::size_t>(groups), linear);
    constexpr Eigen::Index group = packs_in_group * Pack::size;
    for (std::size_t j = 0; j < columns.size(); ++j)
        for (Eigen::Index g = 0; g * group < columns[j].extent; ++g)
            active[static_cast<std::size_t>(g)] = static_cast<std::int64_t>(j) + 1;
    return active;
}

template <typename Entry>
Eigen::MatrixXd of_pairs(const std::vector<Column>& columns, const Entry& entry) {
    return Eigen::MatrixXd::NullaryExpr(static_cast<Eigen::Index>(columns.size()),
                                        static_cast<Eigen::Index>(columns.size()),
                                        [&](Eigen::Index i, Eigen::Index j) {
                                            return entry(columns[static_cast<std::size_t>(i)],
                                                         columns[static_cast<std::size_t>(j)]);
                                        });
}

/// The g_j.
std::vector<SpaceFunction> functions_of(const Split& parts, bool right) {
    std::vector<SpaceFunction> functions;
    functions.emplace_back([](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 1.0 - x; });
    if (right)
        functions.emplace_back([](const Eigen::ArrayXd& x) { return x; });
    for (const auto& column : parts.inner)
        functions.push_back(parts.functions[static_cast<std::size_t>(column.place)]);
    return functions;
}

} // namespace

ModeArrays::ModeArrays(Eigen::Index modes, Eigen::Index arrays) {
    const Eigen::Index group = packs_in_group * Pack::size;
    groups_ = (modes + group - 1) / group;
    stride_ = (groups_ + (groups_ + 1) % 2) * packs_in_group;
    packs_.resize(static_cast<std::size_t>(stride_ * arrays));
}

ModeArrays::Array ModeArrays::operator[](Eigen::Index array) {
    if (packs_.empty()) // a single element has no modes
        return {nullptr, 0};
    // Packs have no gaps; a pointer into one would end with it.
    auto* doubles = reinterpret_cast<double*>(packs_.data());
    return {doubles + array * stride_ * Pack::size, stride_ * Pack::size};
}

std::int64_t ModeArrays::size() const {
    return static_cast<std::int64_t>(packs_.size()) * Pack::size;
}

SineProfiles::SineProfiles(const Mesh& mesh, const SineBasis& basis,
                           const std::vector<SpaceFunction>& profiles,
                           const std::vector<bool>& used, const Wanted& wanted) {
    Split parts = split(mesh, profiles, used);
    peaks_at_node = parts.peaks_at_node;
    ErrorProfiles errors;
    if (wanted.norms) {
        errors = error_profiles(mesh, parts.functions);
        read_defects(mesh, basis, errors, parts.inner);
    } else if (wanted.modes) {
        for (auto& column : parts.inner)
            column.modes = basis.of_load(column.hat_load);
    }
    double rest = 0.0;
    if (wanted.modes && !wanted.functions && basis.size() > most_modes_together &&
        static_cast<Eigen::Index>(parts.inner.size()) >= fewest_to_combine)
        rest = combine(parts.inner, errors);
    for (auto& column : parts.inner)
        cut_off(column, rest);
    // Those that reach far come first, so that every group of modes reads a head of them.
    std::stable_sort(
        parts.inner.begin(), parts.inner.end(),
        [](const Column& left, const Column& right) { return left.extent > right.extent; });

    const bool right = (parts.at_ends.row(1).array() != 0.0).any();
    std::vector<Column> columns = linear_columns(mesh, basis, right);
    linear = static_cast<Eigen::Index>(columns.size());
    if (wanted.functions)
        functions = functions_of(parts, right);
    std::move(parts.inner.begin(), parts.inner.end(), std::back_inserter(columns));

    const auto count = static_cast<Eigen::Index>(columns.size());
    expansion = Eigen::MatrixXd::Zero(count, parts.at_ends.cols());
    expansion.topRows(linear) = parts.at_ends.topRows(linear);
    tip_moments = (parts.at_ends.row(0) / 3.0 + parts.at_ends.row(1) / 6.0).transpose();
    for (Eigen::Index j = linear; j < count; ++j) {
        const Column& column = columns[static_cast<std::size_t>(j)];
        expansion.row(j).head(column.parts.size()) = column.parts.transpose();
        tip_moments.head(column.parts.size()) +=
            column.hat_load.dot(columns.front().nodal) * column.parts;
    }
    if (wanted.modes) {
        table = table_of(columns, basis.size());
        active = active_columns(columns, table.groups(), linear);
    }
    if (wanted.norms) {
        remainder = of_pairs(columns, [&](const Column& i, const Column& j) {
            return remainder_entry(i, j, errors);
        });
        modes_gram = of_pairs(
            columns, [](const Column& i, const Column& j) { return (i.modes * j.modes).sum(); });
        projection = of_pairs(columns, [&](const Column& i, const Column& j) {
            return i.is_linear() || j.is_linear() ? 0.0 : errors.projection(i.place, j.place);
        });
    }
}

} // namespace tvbeam
