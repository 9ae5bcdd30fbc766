#include "core/space/mesh.hpp"

#include <stdexcept>
#include <string>

namespace tvbeam {

Mesh Mesh::uniform(Eigen::Index elements) {
    if (elements < 1)
        throw std::invalid_argument("a mesh needs at least one element, not " +
                                    std::to_string(elements));
    const auto s = static_cast<double>(elements);
    Mesh mesh;
    mesh.nodes.resize(elements + 1);
    for (Eigen::Index j = 0; j <= elements; ++j)
        mesh.nodes(j) = static_cast<double>(j) / s;
    // The nominal length, not a difference of rounded nodes: every element is exactly alike.
    mesh.lengths = Eigen::ArrayXd::Constant(elements, 1.0 / s);
    return mesh;
}

Mesh MeshFamily::with(Eigen::Index elements) const {
    Mesh mesh = Mesh::uniform(elements);
    if (is_uniform())
        return mesh;
    if (nodes.empty()) {
        mesh.nodes = mesh.nodes.pow(grading);
    } else {
        const auto intervals = static_cast<Eigen::Index>(nodes.size()) - 1;
        if (elements % intervals != 0)
            throw std::invalid_argument(std::to_string(elements) +
                                        " elements cannot be shared by " +
                                        std::to_string(intervals) + " intervals");
        const Eigen::Index parts = elements / intervals;
        for (Eigen::Index j = 0; j < elements; ++j) {
            const auto interval = static_cast<std::size_t>(j / parts);
            const double left = nodes[interval];
            mesh.nodes(j) = left + (nodes[interval + 1] - left) * static_cast<double>(j % parts) /
                                       static_cast<double>(parts);
        }
    }
    mesh.lengths = mesh.nodes.tail(elements) - mesh.nodes.head(elements);
    for (Eigen::Index j = 0; j < elements; ++j)
        if (!(mesh.lengths(j) > 0.0))
            throw std::invalid_argument("element " + std::to_string(j + 1) + " of " +
                                        std::to_string(elements) + " has no length");
    return mesh;
}

} // namespace tvbeam
