#pragma once

#include <memory>

namespace tvbeam {

/// For the source of a row, which has
/// `template std::unique_ptr<const StudyKind> make_row<StudyKind, LadderStudy>();`.
template <typename Base, typename Row>
std::unique_ptr<const Base> make_row() {
    return std::make_unique<const Row>();
}

} // namespace tvbeam
