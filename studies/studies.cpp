#include "studies/study_kind.hpp"

namespace tvbeam {

/// In the order in which results show them.
constexpr RowMaker<StudyKind> kinds[] = {
    make_row<StudyKind, struct LadderStudy>,        make_row<StudyKind, struct OrdersStudy>,
    make_row<StudyKind, struct WorkPrecisionStudy>, make_row<StudyKind, struct EvolutionStudy>,
    make_row<StudyKind, struct StressStudy>,        make_row<StudyKind, struct SensitivityStudy>,
};

const RowsOf<StudyKind>& study_kinds() {
    static const auto all = made_of(kinds);
    return all;
}

} // namespace tvbeam
