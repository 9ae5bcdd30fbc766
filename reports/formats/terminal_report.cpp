#include "reports/formats/terminal_report.hpp"

#include "reports/document/result_document.hpp"
#include "reports/document/text_document.hpp"

namespace tvbeam {

std::string terminal_report(const StudyResult& result) {
    return text_document(result_document(result));
}

} // namespace tvbeam
