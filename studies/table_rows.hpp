#pragma once

#include <memory>
#include <vector>

namespace tvbeam {

/// A row of a table of things that implement Base. The table needs the row's name alone, for its
/// source instantiates it (table_row.hpp):
///
///     constexpr RowMaker<StudyKind> rows[] = {make_row<StudyKind, struct LadderStudy>, …};
template <typename Base, typename Row>
std::unique_ptr<const Base> make_row();

template <typename Base>
using RowMaker = std::unique_ptr<const Base> (*)();

template <typename Base>
using RowsOf = std::vector<std::unique_ptr<const Base>>;

template <typename Base, std::size_t count>
RowsOf<Base> made_of(const RowMaker<Base> (&rows)[count]) {
    RowsOf<Base> made;
    for (const auto row : rows)
        made.push_back(row());
    return made;
}

} // namespace tvbeam
