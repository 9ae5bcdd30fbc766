#include "studies/study_kind.hpp"

#include "core/norms/error_norms.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/runs/beam_runs.hpp"

#include <algorithm>
#include <stdexcept>

namespace tvbeam {

std::vector<Series> StudyKind::series(const std::any& /*block*/, const Method& /*own*/) const {
    return {};
}

Until* StudyKind::until(std::any& /*block*/) const {
    return nullptr;
}

const Until* StudyKind::until(const std::any& block) const {
    return until(const_cast<std::any&>(block));
}

std::vector<Rung> StudyKind::addable(const std::any& /*block*/) const {
    return {};
}

std::vector<Rung>
StudyKind::dearest_addition(const std::any& block,
                            const std::function<double(const Rung&)>& /*cost*/) const {
    return addable(block);
}

std::vector<Parts> StudyKind::parts(const std::any& /*block*/) const {
    return {};
}

double StudyKind::work(const std::any& block, const Method& own) const {
    double work = 0.0;
    for (const auto& one : series(block, own))
        for (const auto& rung : one.rungs)
            work += work_of(one.method, rung);
    return work;
}

void StudyKind::conclude(const std::any& /*block*/, std::any& /*record*/,
                         const StudyResult& /*all*/, const StudyContext& /*context*/) const {}

StudyKind::Runs StudyKind::runs(const std::any& /*record*/) const {
    return {};
}

Ending StudyKind::ending(const std::any& record) const {
    Ending ending;
    for (const auto* results : runs(record))
        for (const auto& run : *results) {
            if (run.status == RungStatus::ok)
                continue;
            const bool has_failed = run.status == RungStatus::failed;
            if (!ending.failed || (has_failed && ending.failures == 0))
                ending.reason = run.rung.name(message_text) + ": " + run.reason;
            ending.failed = true;
            ending.interrupted = ending.interrupted || !has_failed;
            ending.failures += has_failed ? 1 : 0;
        }
    return ending;
}

std::map<std::string, double> StudyKind::figures(const std::any& /*record*/) const {
    return {};
}

void StudyKind::expect(TableReader& table, const std::any& /*block*/,
                       std::vector<Expectation>& expectations) const {
    expect_figures(table, name(), expectations);
}

Needs StudyKind::needs(const std::any& block, const StudyContext& context) const {
    if (timed()) // the whole problem
        return {};
    Needs needs{false, false, false};
    for (const auto& one : series(block, context.method))
        needs = needs.with(ErrorNorms::needs(context.data, norms_of(one.measures)));
    return needs;
}

const std::any* ByKind::find(const StudyKind& kind) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& entry) { return entry.kind == &kind; });
    return found == entries_.end() ? nullptr : &found->value;
}

std::any& ByKind::set(const StudyKind& kind, std::any value) {
    // The entries and the table have one order.
    auto at = entries_.begin();
    for (const auto& one : study_kinds()) {
        const bool here = at != entries_.end() && at->kind == one.get();
        if (one.get() == &kind)
            break;
        at += here ? 1 : 0;
    }
    if (at == entries_.end() || at->kind != &kind)
        at = entries_.insert(at, {&kind, {}});
    return at->value = std::move(value);
}

const StudyKind& ByKind::kind_with(std::type_index type) {
    for (const auto& kind : study_kinds())
        if (kind->has(type))
            return *kind;
    throw std::logic_error(std::string("no kind of study has the type ") + type.name());
}

} // namespace tvbeam
