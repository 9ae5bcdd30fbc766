#pragma once

#include <map>
#include <string>
#include <vector>

namespace tvbeam {

/// What readers of a document asked for, by path: whether it was there, its path in the table of
/// keys, and of a choice what it was.
struct AskedKey {
    bool given = false;
    std::string entry = {};
    std::string chosen = {};
};
using AskedKeys = std::map<std::string, AskedKey>;

} // namespace tvbeam
