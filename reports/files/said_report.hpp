#pragma once

#include "studies/study.hpp"

#include <nlohmann/json_fwd.hpp>

namespace tvbeam {

/// The tables of a result as its reports show them, without the columns of seconds: captions,
/// headings, and rows as texts, some of them where there are many.
nlohmann::ordered_json tables_said_by(const StudyResult& result);

/// By name, the files that a result is reported in, each by the number of its lines, of those alike
/// side by side one, and a checksum of them: without numbers, which the tables have, and without
/// what the next run, another folder or another build changes. Which line is another, a comparison
/// of the files says (`--out`), not this.
nlohmann::ordered_json files_said_by(const StudyResult& result);

} // namespace tvbeam
