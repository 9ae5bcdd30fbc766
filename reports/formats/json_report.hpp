#pragma once

#include "studies/study.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tvbeam {

/// The whole result as JSON, schema tvbeam-result/1: numbers read back to the same doubles, what is
/// undefined is null.
std::string json_report(const StudyResult& result);
nlohmann::ordered_json result_json(const StudyResult& result);

/// By what, from what and when a scene was run.
nlohmann::ordered_json provenance_json(const Scene& scene);

} // namespace tvbeam
