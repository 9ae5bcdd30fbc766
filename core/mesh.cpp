#include "core/mesh.hpp"

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

} // namespace tvbeam
