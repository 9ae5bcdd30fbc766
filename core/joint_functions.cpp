#include "core/joint_functions.hpp"

namespace tvbeam {

bool are_same(const SpaceTimeFunction& one, const SpaceTimeFunction& other) {
    const auto* first = one.target<FamilyMember>();
    const auto* second = other.target<FamilyMember>();
    return first != nullptr && second != nullptr && first->family == second->family &&
           first->number == second->number;
}

namespace {

/// Empty: they are not of one family, or not to be had together.
JointFunctions of_one_family(const std::vector<SpaceTimeFunction>& functions) {
    std::shared_ptr<const FunctionFamily> family;
    std::vector<Eigen::Index> numbers;
    for (const auto& function : functions) {
        const auto* member = function.target<FamilyMember>();
        if (member == nullptr || (family && member->family != family))
            return {};
        family = member->family;
        numbers.push_back(member->number);
    }
    return family && *family ? (*family)(numbers) : JointFunctions{};
}

} // namespace

JointFunctions in_one(const std::vector<SpaceTimeFunction>& functions) {
    if (auto together = of_one_family(functions))
        return together;
    return [functions](const Eigen::ArrayXd& x, const Eigen::ArrayXd& t) {
        Eigen::ArrayXXd values(static_cast<Eigen::Index>(functions.size()), x.size());
        // Points mostly come time by time.
        for (Eigen::Index begin = 0, end = 0; begin < x.size(); begin = end) {
            while (end < x.size() && t(end) == t(begin))
                ++end;
            for (std::size_t f = 0; f < functions.size(); ++f)
                values.row(static_cast<Eigen::Index>(f)).segment(begin, end - begin) =
                    functions[f](x.segment(begin, end - begin), t(begin)).transpose();
        }
        return values;
    };
}

} // namespace tvbeam
