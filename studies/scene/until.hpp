/// `until` of a ladder or of a grid: what is to be known before no more is added, and the budget.
#pragma once

#include "studies/orders/order_engine.hpp"
#include "studies/runs/run.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

class TableReader;

/// Until when a ladder or a grid is refined beyond what it names. A bound that is absent is none;
/// seconds or most are there.
struct Until {
    std::optional<double> order; ///< half of the 95 % interval of the orders of every norm
    std::optional<double> limit; ///< the same of the limit of every value
    std::optional<double> seconds;
    std::optional<std::int64_t> most; ///< levels of a ladder, runs of a grid; all together
    bool adds = true;                 ///< false: in a short form, which has those that it names
};

/// With fewer levels of a ladder, or meshes or steps of a grid, nothing counts as known.
inline constexpr std::size_t least_known_levels = 4;

/// Why no more was added.
enum class RefiningEnd {
    known,    ///< all intervals are as narrow as was asked for
    levels,   ///< the budget of a ladder's levels is spent
    runs,     ///< a grid's next runs would not fit into the budget of runs
    seconds,  ///< the next runs would not fit into the budget of seconds
    finest,   ///< there is nothing finer that a run may have
    run_ended ///< a run failed or was interrupted
};

/// "known", "levels", "runs", "seconds", "finest", "run ended".
std::string name_of(RefiningEnd end);

/// How the refining of a ladder or a grid ended.
struct Refined {
    RefiningEnd end;
    std::vector<std::string> open = {}; ///< what is not known: of a ladder norms and values by
                                        ///< name, of a grid "q of L2", "limit of drag"
};

/// The key of Until::most, and what it is at least.
struct CountKey {
    const char* name;    ///< "levels"
    std::int64_t fewest; ///< with which something may be known, and what is named is there
    std::string reason;  ///< why, behind the message that says so
};

/// Reads order, limit, seconds and the count. Throws InputError where a value breaks its rule,
/// nothing is to be known, or there is no budget.
Until read_until(TableReader table, const CountKey& count);

/// Throws InputError where orders are to be known and there are no norms, or limits and no values.
/// block: as messages call what is refined, "the ladder".
void require_wanted(const TableReader& table, const Until& until,
                    const std::vector<Measure>& measures, const std::string& block);

/// Whether an interval is as narrow as is wanted, and its middle lies in the one that is found
/// without the finest line, however wide that may be: two intervals that agree.
bool is_known(double wanted, const OrderInterval& found, const OrderInterval& before);

/// The seconds of the runs, all of them.
double seconds_of(const std::vector<RungResult>& runs);

} // namespace tvbeam
