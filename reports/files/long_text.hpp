#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace tvbeam {

/// A text, or what tells it piece by piece where it may be too long to hold.
class LongText {
public:
    using Sink = std::function<void(std::string_view piece)>;

    LongText(std::string text) // NOLINT(google-explicit-constructor)
        : tell_([text = std::move(text)](const Sink& sink) { sink(text); }) {}
    LongText(const char* text)
        : LongText(std::string(text)) {} // NOLINT(google-explicit-constructor)
    explicit LongText(std::function<void(const Sink&)> tell) : tell_(std::move(tell)) {}

    void tell(const Sink& sink) const { tell_(sink); }
    [[nodiscard]] std::string whole() const {
        std::string text;
        tell([&text](std::string_view piece) { text += piece; });
        return text;
    }

private:
    std::function<void(const Sink&)> tell_;
};

} // namespace tvbeam
