#pragma once

#include <map>
#include <string>
#include <vector>

namespace tvbeam {

/// What readers of a document asked for, by path: whether it was there, and of a choice all that it
/// may be and what it was.
struct AskedKey {
    bool given = false;
    std::vector<std::string> choices = {};
    std::string chosen = {};
};
using AskedKeys = std::map<std::string, AskedKey>;

} // namespace tvbeam
