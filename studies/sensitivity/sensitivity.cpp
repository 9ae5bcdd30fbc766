#include "studies/sensitivity/sensitivity.hpp"

#include "studies/gates/check.hpp"
#include "studies/runs/defects.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace tvbeam {

namespace {

constexpr double close_enough = 1.05; ///< of two factors, between which the least one lies

/// What an expectation is of, without the rung.
std::string group_of(const CheckedExpectation& one) {
    return one.what.substr(0, one.what.find(" at s = "));
}

std::string study_of(const CheckedExpectation& one) {
    return one.what.substr(0, one.what.find('.'));
}

/// Whether a study is run again with each defect.
bool is_repeated(const ByKind::Entry& entry) {
    return entry.kind->poses_problem() && !entry.kind->timed();
}

/// Whether an expectation is of a study that is run again.
bool is_of_repeated(const CheckedExpectation& one, const Scene& scene) {
    const auto& entries = scene.blocks.entries();
    return std::any_of(entries.begin(), entries.end(), [&](const ByKind::Entry& entry) {
        return is_repeated(entry) && entry.kind->name() == study_of(one);
    });
}

/// The scene with those of its studies, and what is expected of them.
Scene repeated_scene(const StudyResult& all) {
    Scene scene = all.scene;
    std::erase_if(scene.blocks.entries(),
                  [](const ByKind::Entry& entry) { return !is_repeated(entry); });
    std::erase_if(scene.expectations, [&](const Expectation& expectation) {
        const auto checked = expectation(all);
        return checked.empty() || !is_of_repeated(checked.front(), all.scene);
    });
    return scene;
}

/// One defect at all factors that were tried.
class Trials {
public:
    Trials(const Scene& scene, const GivenData& defect, const StudyContext& context)
        : scene_(scene), defects_(defect, context.scene),
          context_(context), execution_{.jobs = context.execution.jobs,
                                        .progress = context.execution.progress} {}

    [[nodiscard]] bool interrupted() const { return interrupted_; }

    /// The least factor at which the expectation is violated.
    std::optional<double> least(const std::string& expectation, const SensitivityBlock& block) {
        double before = 0.0;
        for (double factor = block.smallest;; factor = std::min(10.0 * factor, block.largest)) {
            if (!held_at(factor).contains(expectation))
                return before == 0.0 ? factor : between(before, factor, expectation);
            if (factor >= block.largest || interrupted_)
                return std::nullopt;
            before = factor;
        }
    }

private:
    double between(double below, double above, const std::string& expectation) {
        while (above > close_enough * below && !interrupted_) {
            const double middle = std::sqrt(below * above);
            (held_at(middle).contains(expectation) ? below : above) = middle;
        }
        return above;
    }

    /// The expectations that are there and hold: one that a defect takes away does not.
    const std::set<std::string>& held_at(double factor) {
        const auto [at, is_new] = held_.try_emplace(factor);
        if (!is_new || interrupted_)
            return at->second;
        const StudyResult result =
            run_study(scene_, context_.data, context_.defects.with(defects_, factor), execution_);
        interrupted_ = result.interrupted();
        const auto checked = check(result);
        for (const auto& one : checked)
            at->second.insert(group_of(one));
        for (const auto& one : checked)
            if (!one.holds)
                at->second.erase(group_of(one));
        return at->second;
    }

    const Scene& scene_;
    Defects defects_;
    const StudyContext& context_;
    Execution execution_;
    bool interrupted_ = false;
    std::map<double, std::set<std::string>> held_; ///< by factor
};

} // namespace

std::optional<double> CaughtDefect::least_of_all() const {
    std::optional<double> best;
    for (const auto& one : least)
        if (one && (!best || *one < *best))
            best = one;
    return best;
}

SensitivityResult find_sensitivity(const SensitivityBlock& block, const StudyResult& all,
                                   const StudyContext& context) {
    std::vector<CheckedExpectation> checked = check(all);
    std::erase_if(checked,
                  [&](const CheckedExpectation& one) { return !is_of_repeated(one, all.scene); });
    const Scene scene = repeated_scene(all);
    SensitivityResult result;
    result.smallest = block.smallest;
    const auto has = [](const std::vector<std::string>& list, const std::string& name) {
        return std::find(list.begin(), list.end(), name) != list.end();
    };
    for (const auto& one : checked)
        if (!one.holds && !has(result.violated, group_of(one)))
            result.violated.push_back(group_of(one));
    for (const auto& one : checked)
        if (!has(result.violated, group_of(one)) && !has(result.expectations, group_of(one)))
            result.expectations.push_back(group_of(one));
    for (const auto& [name, adds] : block.defects) {
        Trials trials(scene, adds, context);
        CaughtDefect caught{name, {}};
        for (const auto& expectation : result.expectations)
            caught.least.push_back(trials.least(expectation, block));
        result.interrupted = result.interrupted || trials.interrupted();
        if (result.interrupted)
            break;
        result.defects.push_back(std::move(caught));
    }
    return result;
}

} // namespace tvbeam
