#include "mms/text/input_error.hpp"

namespace tvbeam {

namespace {

std::string located(const Place& place, const std::string& message) {
    std::string text = place.file;
    if (place.line > 0) {
        text.append(":").append(std::to_string(place.line));
        if (place.column > 0)
            text.append(":").append(std::to_string(place.column));
    }
    return text.empty() ? message : text + ": " + message;
}

} // namespace

InputError::InputError(const Place& place, const std::string& message)
    : std::runtime_error(located(place, message)) {}

} // namespace tvbeam
