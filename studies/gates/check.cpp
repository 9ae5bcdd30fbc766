#include "studies/gates/check.hpp"

namespace tvbeam {

std::vector<CheckedExpectation> check(const StudyResult& result) {
    std::vector<CheckedExpectation> checked;
    for (const auto& expectation : result.scene.expectations)
        for (auto& one : expectation(result))
            checked.push_back(std::move(one));
    return checked;
}

} // namespace tvbeam
