#include "reports/document/ending_text.hpp"

#include "studies/scene/study_keys.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace tvbeam {

namespace {

/// "order to ± 0.05 and limit to ± 2e-3".
std::string wanted_text(const Until& until) {
    std::string text;
    for (const auto& [what, half] : {std::pair("order", until.order), {"limit", until.limit}})
        if (half)
            text += fmt::format("{}{} to ± {}", text.empty() ? "" : " and ", what, shortest(*half));
    return text;
}

} // namespace

std::string ending_text(const Refined& refined, const Until& until, const std::string& size) {
    const std::string text = fmt::format("Refined to {}: ", size);
    const std::string open =
        fmt::format("not known ({}): {}.", wanted_text(until), fmt::join(refined.open, ", "));
    switch (refined.end) {
    case RefiningEnd::known:
        return text + "known as was asked: " + wanted_text(until) + ".";
    case RefiningEnd::levels:
        return text +
               (until.adds ? "the budget of levels is spent; " : "the short form adds none; ") +
               open;
    case RefiningEnd::runs:
        return text +
               (until.adds ? fmt::format("the next would not fit into the budget of {} runs; ",
                                         until.most.value_or(most_levels))
                           : "the short form adds none; ") +
               open;
    case RefiningEnd::seconds:
        return text +
               fmt::format("another would not fit into the budget of {} s; ",
                           shortest(*until.seconds)) +
               open;
    case RefiningEnd::finest:
        return text + "no run may be finer; " + open;
    default:
        return text + "a run did not end well.";
    }
}

} // namespace tvbeam
