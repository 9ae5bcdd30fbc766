#include "studies/scene/until.hpp"

#include "mms/text/toml_reader.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tvbeam {

std::string name_of(RefiningEnd end) {
    switch (end) {
    case RefiningEnd::known:
        return "known";
    case RefiningEnd::levels:
        return "levels";
    case RefiningEnd::runs:
        return "runs";
    case RefiningEnd::seconds:
        return "seconds";
    case RefiningEnd::finest:
        return "finest";
    default:
        return "run ended";
    }
}

Until read_until(TableReader table, const CountKey& count) {
    Until until;
    const auto above = [&](double bound, const char* key, const char* why = ";") {
        const auto number = table.number(key);
        if (number && !(*number > bound))
            throw table.error(key, " is " + message_text(*number) + why + " it must be > " +
                                       message_text(bound));
        return number;
    };
    until.order = above(OrderTuning().narrowest, "order", "; no interval is that narrow:");
    until.limit = above(0.0, "limit");
    until.seconds = above(0.0, "seconds");
    until.most = table.integer(count.name);
    if (until.most && *until.most < count.fewest)
        throw table.error(count.name, " is " + std::to_string(*until.most) +
                                          "; it must be >= " + std::to_string(count.fewest) +
                                          ", all " + count.name + " together: " + count.reason);
    table.finish();
    if (!until.order && !until.limit)
        throw table.error("", " says nothing of what is to be known; give order = 0.05, half of "
                              "the 95 % interval of the order, or limit, the same of a value");
    if (!until.seconds && !until.most)
        throw table.error("",
                          std::string(" has no end; give it a budget: seconds, or ") + count.name);
    return until;
}

void require_wanted(const TableReader& table, const Until& until,
                    const std::vector<Measure>& measures, const std::string& block) {
    const auto has = [&](bool value) {
        return std::any_of(measures.begin(), measures.end(),
                           [&](const Measure& measure) { return measure.is_value == value; });
    };
    for (const auto& [key, wanted, is_value] :
         {std::tuple("order", until.order, false), {"limit", until.limit, true}})
        if (wanted && !has(is_value))
            throw table.error("until", std::string(" asks for a known ") + key + ", and " + block +
                                           " names no " + (is_value ? "values" : "norms"));
}

bool is_known(double wanted, const OrderInterval& found, const OrderInterval& before) {
    return found.determined && found.half_width() <= wanted && std::isfinite(before.low) &&
           std::isfinite(before.high) && before.low <= found.value && found.value <= before.high;
}

double seconds_of(const std::vector<RungResult>& runs) {
    double seconds = 0.0;
    for (const auto& run : runs)
        seconds += run.seconds_taken();
    return seconds;
}

} // namespace tvbeam
