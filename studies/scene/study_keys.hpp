#pragma once

#include "mms/text/input_error.hpp"
#include "studies/runs/run.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

class TableReader;

/// What the blocks of studies may name: the measures and methods of the solver under study.
struct SolverKeys {
    std::vector<Measure> measures; ///< all, squares behind the norms themselves
    /// Errors, and values, may have other names as well.
    bool any_error = false;
    bool any_value = false;
    /// elements, or dt, and final_time may be absent: a solver without a mesh, or a steady one.
    bool any_widths = false;
    /// Reads the keys of a method from a table that may hold others; what is absent is as in the
    /// scene's own.
    std::function<Method(TableReader&)> read_method;
};

/// Why a number of a solver cannot have this name beside others: tables have such a column already.
std::optional<std::string> column_of_tables(const std::string& name,
                                            const std::vector<Measure>& others);

/// What a run may have.
inline constexpr std::int64_t most_elements = 10'000'000;
inline constexpr double most_steps = 1e12;
inline constexpr std::size_t most_levels = 10'000; ///< of a ladder, or meshes of a grid

/// Readers of the keys that the blocks of the studies share. Each throws InputError where a value
/// is missing or breaks its rule.

/// final_time > 0; 0 where it may be absent, and is.
double read_final_time(TableReader& table, const SolverKeys& keys);

/// elements: a list that is not empty, each from 1 to most_elements.
std::vector<std::int64_t> read_elements(TableReader& table);

/// The number of steps of length dt > 0 in final_time; they must fill it to 1e-9 of itself. index:
/// of dt in its list, for the place of a message. 0 without a final time.
std::int64_t steps_of(const TableReader& table, std::size_t index, double final_time, double dt);

/// The rungs of a ladder, from coarse to fine: elements, and dt as a list of one number a rung or
/// as one expression in s.
std::vector<Rung> read_rungs(TableReader& table, double final_time, const SolverKeys& keys);

/// norms: known names, none twice; may be absent.
std::vector<Measure> read_norms(TableReader& table, const SolverKeys& keys);
/// values, if the solver has any, likewise; added to the measures.
void read_values(TableReader& table, const SolverKeys& keys, std::vector<Measure>& measures);

/// A list of numbers for each measure that the table names. Lists may stand there for measures that
/// are not wanted, e.g. after --set ladder.norms=…; `check` is told of every list, and those of the
/// others are dropped. Throws InputError where that leaves none and the norms, which stand
/// at that place, are those of the file.
std::map<std::string, std::vector<double>> read_by_measure(
    TableReader& table, const SolverKeys& keys, const std::vector<Measure>& wanted,
    const Place& norms,
    const std::function<void(const std::string& name, const std::vector<double>&)>& check);

} // namespace tvbeam
