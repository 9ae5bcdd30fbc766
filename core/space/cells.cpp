#include "core/space/cells.hpp"

#include <utility>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;

namespace {

/// The element of each cell of elements first …, counted from first: visit(element, cell).
template <typename Visit>
void for_each_cell(const Cells& cells, Index first, Index count, Visit visit) {
    for (Index j = first; j < first + count; ++j)
        for (Index c = cells.first[static_cast<std::size_t>(j)];
             c < cells.first[static_cast<std::size_t>(j) + 1]; ++c)
            visit(j - first, c);
}

} // namespace

Mesh with_cells(Mesh mesh, const std::vector<std::vector<Interval>>& parts) {
    auto cells = std::make_shared<Cells>();
    Index count = 0;
    for (const auto& element : parts) {
        cells->first.push_back(count);
        count += static_cast<Index>(element.size());
    }
    cells->first.push_back(count);
    cells->left.resize(count);
    cells->share.resize(count);
    cells->mesh.nodes.resize(count + 1);
    cells->mesh.lengths.resize(count);
    for_each_cell(*cells, 0, mesh.elements(), [&](Index j, Index c) {
        const auto& element = parts[static_cast<std::size_t>(j)];
        const Interval& part =
            element[static_cast<std::size_t>(c - cells->first[static_cast<std::size_t>(j)])];
        cells->left(c) = part.left;
        cells->share(c) = part.length;
        cells->mesh.nodes(c) = mesh.nodes(j) + mesh.lengths(j) * part.left;
        cells->mesh.lengths(c) = mesh.lengths(j) * part.length;
    });
    cells->mesh.nodes(count) = mesh.nodes(mesh.elements());
    mesh.cells = std::move(cells);
    return mesh;
}

Mesh with_equal_cells(Mesh mesh, Index parts) {
    const auto count = static_cast<double>(parts);
    std::vector<Interval> element;
    for (Index part = 0; part < parts; ++part)
        element.push_back({static_cast<double>(part) / count, 1.0 / count});
    const std::vector<std::vector<Interval>> all(static_cast<std::size_t>(mesh.elements()),
                                                 element);
    return with_cells(std::move(mesh), all);
}

const Mesh& integration_mesh(const Mesh& mesh) {
    return mesh.cells ? mesh.cells->mesh : mesh;
}

CellRange cells_of(const Mesh& mesh, Index first, Index count) {
    if (!mesh.cells)
        return {first, count};
    const auto& starts = mesh.cells->first;
    const Index begin = starts[static_cast<std::size_t>(first)];
    return {begin, starts[static_cast<std::size_t>(first + count)] - begin};
}

double in_element(const Mesh& mesh, Index cell, double eta) {
    return mesh.cells ? mesh.cells->left(cell) + mesh.cells->share(cell) * eta : eta;
}

Eigen::Array2Xd at_cell_ends(const Mesh& mesh, Index first, const Eigen::Array2Xd& ends) {
    if (!mesh.cells)
        return ends;
    const Cells& cells = *mesh.cells;
    const CellRange range = cells_of(mesh, first, ends.cols());
    Eigen::Array2Xd result(2, range.count);
    for_each_cell(cells, first, ends.cols(), [&](Index j, Index c) {
        const double right = cells.left(c) + cells.share(c);
        result(0, c - range.first) =
            (1.0 - cells.left(c)) * ends(0, j) + cells.left(c) * ends(1, j);
        result(1, c - range.first) = (1.0 - right) * ends(0, j) + right * ends(1, j);
    });
    return result;
}

Eigen::Array2Xd of_elements(const Mesh& mesh, Index first, Index count, Eigen::Array2Xd moments) {
    if (!mesh.cells)
        return moments;
    const Cells& cells = *mesh.cells;
    const Index begin = cells_of(mesh, first, count).first;
    Eigen::Array2Xd result = Eigen::Array2Xd::Zero(2, count);
    for_each_cell(cells, first, count, [&](Index j, Index c) {
        const double left = cells.left(c);
        const double right = left + cells.share(c);
        const auto moment = moments.col(c - begin);
        result(0, j) += (1.0 - left) * moment(0) + (1.0 - right) * moment(1);
        result(1, j) += left * moment(0) + right * moment(1);
    });
    return result;
}

} // namespace tvbeam
