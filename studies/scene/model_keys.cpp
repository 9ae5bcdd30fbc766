#include "studies/scene/model_keys.hpp"

#include "mms/text/toml_reader.hpp"

#include <string>

namespace tvbeam {

namespace {

/// A number that must not be below the limit; the rule is put in words by the caller.
double at_least_zero(TableReader& table, std::string_view key) {
    const auto value = table.number(key);
    if (!value)
        throw table.error(key, " is missing; it must be given and be >= 0");
    if (*value < 0.0)
        throw table.error(key, " is " + message_text(*value) + "; it must be >= 0");
    return *value;
}

/// The ε of the contact law.
double read_contact(TableReader table, const Stops& stops) {
    const bool penalty = table.choice("law", {"rigid", "penalty"}).value_or(0) == 1;
    const auto epsilon = table.number("epsilon");
    if (penalty && !stops.exist())
        throw table.error("law", " is 'penalty', but there are no stops; give "
                                 "beam.stops = [g1, g2], or remove it");
    if (penalty && !(epsilon && *epsilon > 0.0))
        throw table.error("epsilon",
                          (epsilon ? " is " + message_text(*epsilon) : std::string(" is missing")) +
                              "; it must be > 0, by how much the stop yields to a unit force");
    if (!penalty && epsilon)
        throw table.error("epsilon", " belongs to law = \"penalty\"; rigid stops "
                                     "do not yield: remove it");
    table.finish();
    return penalty ? *epsilon : 0.0;
}

/// What [data] and defects share.
GivenData read_given(TableReader& table) {
    GivenData data;
    data.theta0 = table.expression("theta0");
    data.u0 = table.expression("u0");
    data.heat_source = table.expression("heat_source");
    data.body_force = table.expression("body_force");
    return data;
}

} // namespace

Beam read_beam(TableReader table) {
    Beam beam;
    beam.alpha = at_least_zero(table, "alpha");
    beam.zeta = at_least_zero(table, "zeta");
    beam.theta_A = table.number("theta_A").value_or(0.0);
    if (const auto stops = table.numbers("stops", TableReader::Infinity::allowed)) {
        if (stops->size() != 2)
            throw table.error("stops", " has " + std::to_string(stops->size()) +
                                           " values; it must be [g1, g2]");
        beam.stops.lower = (*stops)[0];
        beam.stops.upper = (*stops)[1];
        if (beam.stops.lower >= beam.stops.upper)
            throw table.error("stops", " is [" + message_text(beam.stops.lower) + ", " +
                                           message_text(beam.stops.upper) +
                                           "]; g1 must be below g2: are they swapped?");
        if (!(beam.stops.lower < 0.0))
            throw InputError(table.place("stops", 0), "g1, the first of " + table.full("stops") +
                                                          ", is " + message_text(beam.stops.lower) +
                                                          "; it must be < 0 (-inf: no stop below)");
        if (!(beam.stops.upper > 0.0))
            throw InputError(table.place("stops", 1), "g2, the second of " + table.full("stops") +
                                                          ", is " + message_text(beam.stops.upper) +
                                                          "; it must be > 0 (inf: no stop above)");
    }
    if (auto contact = table.table("contact"))
        beam.stops.epsilon = read_contact(*std::move(contact), beam.stops);
    table.finish();
    return beam;
}

MeshFamily read_mesh(TableReader table) {
    MeshFamily family;
    if (const auto grading = table.number("grading")) {
        if (!(*grading > 0.0))
            throw table.error("grading",
                              " is " + message_text(*grading) +
                                  "; it must be > 0: 1 is uniform, 2 has nodes at (j/s)^2");
        family.grading = *grading;
    }
    if (const auto nodes = table.numbers("nodes")) {
        if (table.has("grading"))
            throw InputError(table.place("nodes"), "the block has both " + table.full("grading") +
                                                       " and " + table.full("nodes") +
                                                       "; remove one");
        bool increasing = nodes->size() >= 2 && nodes->front() == 0.0 && nodes->back() == 1.0;
        for (std::size_t i = 1; i < nodes->size(); ++i)
            increasing = increasing && (*nodes)[i - 1] < (*nodes)[i];
        if (!increasing)
            throw table.error("nodes", " must begin with 0, end with 1 and increase between them");
        family.nodes = *nodes;
    }
    table.finish();
    return family;
}

GivenData read_data(TableReader table) {
    GivenData data = read_given(table);
    table.finish();
    return data;
}

GivenData read_defect(TableReader table) {
    const bool empty = table.unread().empty();
    GivenData defect = read_given(table);
    defect.moment_load = table.expression("moment_load");
    table.finish();
    if (empty)
        throw InputError(table.place(), "a defect is empty; give what it adds to the problem: "
                                        "heat_source, moment_load, body_force, theta0 or u0; or "
                                        "remove it");
    return defect;
}

} // namespace tvbeam
