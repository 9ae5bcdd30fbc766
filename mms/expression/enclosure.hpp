#pragma once

namespace tvbeam {

/// Numbers that lie between two others, both of which belong to it; infinite: no bound known.
struct Range {
    double lower;
    double upper;
};

/// What a function of time does between two times: all its values, and all its derivatives.
struct Enclosure {
    Range value;
    Range slope;
};

} // namespace tvbeam
