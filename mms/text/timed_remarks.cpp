#include "mms/text/timed_remarks.hpp"

#include "mms/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>

namespace tvbeam {

namespace {

constexpr std::size_t most_told = 4;

/// Of those from the fifth on.
std::string summary(const std::vector<const TimedRemark*>& alike) {
    std::vector<double> greatest = alike[most_told]->jumps;
    for (std::size_t i = most_told; i < alike.size(); ++i)
        for (std::size_t k = 0; k < greatest.size(); ++k)
            greatest[k] = std::max(greatest[k], alike[i]->jumps[k]);
    std::string jumps;
    for (const double jump : greatest)
        jumps += (jumps.empty() ? ", with jumps by up to " : " and ") + number_text(jump, 2);
    return fmt::format("The same holds at {} other times, the last of them t = {}{}.",
                       alike.size() - most_told, alike.back()->time, jumps);
}

} // namespace

std::vector<std::string> told(const std::vector<TimedRemark>& remarks) {
    std::map<std::string, std::vector<const TimedRemark*>> kinds;
    for (const TimedRemark& remark : remarks)
        if (!remark.kind.empty())
            kinds[remark.kind].push_back(&remark);
    std::map<std::string, std::size_t> seen;
    std::vector<std::string> texts;
    for (const TimedRemark& remark : remarks) {
        const auto found = kinds.find(remark.kind);
        const bool is_cut = found != kinds.end() && found->second.size() > most_told + 1;
        const std::size_t place = is_cut ? ++seen[remark.kind] : 1;
        if (place <= most_told)
            texts.push_back(remark.text);
        if (is_cut && place == most_told)
            texts.back() += " " + summary(found->second);
    }
    return texts;
}

} // namespace tvbeam
