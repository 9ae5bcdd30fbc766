#pragma once

#include "core/run.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam::bench {

inline constexpr double final_time = 2.0;

/// One march to the final time.
struct March {
    Eigen::Index elements;
    std::int64_t steps;
};

/// What is marched: all of a run but its mesh and steps.
struct Setting {
    Beam beam;
    std::shared_ptr<const ProblemData> data;
    Scheme scheme;
    std::vector<Norm> norms;
};

/// The scene `table1`: stops, coupling, sources, both norms, a lumped mass, Euler.
Setting full();

// The same with one thing changed.
Setting without_coupling(); ///< alpha = 0, with the data that the solution demands then
Setting without_stops();    ///< the same data, and nothing that holds the tip
Setting without_norms();
Setting with_all_norms();
Setting with_general_sources(); ///< their separation hidden, as if there were none
Setting by_fixed_point();       ///< the paper's algorithm

/// Solutions on the beam of Table 1 whose sources do not separate, by the number of products that
/// stand for them (core/low_rank/separated.hpp), which the names have.
std::vector<std::pair<std::string, Setting>> of_low_rank();

Setting in_nodal_basis(Setting setting);
Setting with_time(Setting setting, const std::string& name);
Setting with_mass(Setting setting, ThermalMass mass);

RunRequest request(const Setting& setting, const March& march);

} // namespace tvbeam::bench
