#include "reports/terminal_report.hpp"

#include "reports/result_document.hpp"
#include "reports/text_document.hpp"

namespace tvbeam {

std::string terminal_report(const StudyResult& result) {
    return text_document(result_document(result));
}

} // namespace tvbeam
