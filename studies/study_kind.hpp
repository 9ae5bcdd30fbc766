#pragma once

#include "studies/gates/expectation.hpp"
#include "studies/runs/execution.hpp"
#include "studies/runs/studied_solver.hpp"
#include "studies/scene/study_keys.hpp"
#include "studies/scene/until.hpp"
#include "studies/table_rows.hpp"

#include <any>
#include <functional>
#include <map>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

namespace tvbeam {

class Defects;
class TableReader;
struct Needs;
struct ProblemData;
struct Scene;
struct StudyResult;

/// What a study runs on.
struct StudyContext {
    const Scene& scene;
    const ProblemData& data;     ///< the scene's problem
    const StudiedSolver& solver; ///< measured against the exact solution, or the reference
    const Method& method;        ///< the scene's own
    const Execution& execution;
    const Defects& defects; ///< that runs add to the problem
};

/// How a study ended.
struct Ending {
    bool failed = false;
    bool interrupted = false;
    int failures = 0;   ///< runs
    std::string reason; ///< of the first run that failed, or else was interrupted
};

/// A kind of study: what is to be known of its block before anything runs, its run, and what can be
/// asked of its record. Blocks and records are plain structs; where the kind does not matter they
/// go by std::any. A kind derives from KindOf.
class StudyKind {
public:
    using Runs = std::vector<const std::vector<RungResult>*>;

    virtual ~StudyKind() = default;

    /// Of its block in a scene, and of its record in reports.
    [[nodiscard]] virtual std::string name() const = 0;

    /// Whether its block or its record has the type.
    [[nodiscard]] virtual bool has(std::type_index type) const = 0;

    /// Whether it runs the scene's problem; otherwise it brings its own.
    [[nodiscard]] virtual bool poses_problem() const { return true; }
    /// Whether its runs are measured, against the exact solution or a reference.
    [[nodiscard]] virtual bool measures() const { return false; }
    /// Whether it is about the scene's expectations, which must then be there.
    [[nodiscard]] virtual bool judges_expectations() const { return false; }
    /// Whether it is run after all others, alone, and against the exact solution only.
    [[nodiscard]] virtual bool timed() const { return false; }

    /// Reads its block; throws InputError.
    [[nodiscard]] virtual std::any read(TableReader& table, const SolverKeys& keys) const = 0;

    /// The runs of the scene's problem that the block asks for, by the scene's own method where it
    /// names none.
    [[nodiscard]] virtual std::vector<Series> series(const std::any& block,
                                                     const Method& own) const;

    /// Until when its block adds runs to the series that it names; null where it adds none.
    [[nodiscard]] virtual Until* until(std::any& block) const;
    [[nodiscard]] const Until* until(const std::any& block) const;

    /// Every run that `until` may add, in an order by which they are kept: behind those of the
    /// series. And of all that it may add together what costs most.
    [[nodiscard]] virtual std::vector<Rung> addable(const std::any& block) const;
    [[nodiscard]] virtual std::vector<Rung>
    dearest_addition(const std::any& block, const std::function<double(const Rung&)>& cost) const;

    /// And how many of them together it adds at most before it looks again.
    [[nodiscard]] virtual std::size_t most_at_a_time(const std::any& /*block*/) const { return 1; }

    /// Its work besides, where that can be done in parts. The block must outlive them.
    [[nodiscard]] virtual std::vector<Parts> parts(const std::any& block) const;

    /// What it costs, in the unit of work_of.
    [[nodiscard]] virtual double work(const std::any& block, const Method& own) const;

    /// What of the beam it looks at; of a study that measures, what its measures need.
    [[nodiscard]] virtual Needs needs(const std::any& block, const StudyContext& context) const;

    [[nodiscard]] virtual std::any run(const std::any& block,
                                       const StudyContext& context) const = 0;

    /// What the record says in the light of the others, when all have run.
    virtual void conclude(const std::any& block, std::any& record, const StudyResult& all,
                          const StudyContext& context) const;

    /// The results of its series, in their order, if it measures.
    [[nodiscard]] virtual Runs runs(const std::any& record) const;
    [[nodiscard]] virtual Ending ending(const std::any& record) const;

    /// Metrics of the record by name.
    [[nodiscard]] virtual std::map<std::string, double> figures(const std::any& record) const;

    /// Reads its table of [expect], by default a band for any of the figures; throws InputError.
    virtual void expect(TableReader& table, const std::any& block,
                        std::vector<Expectation>& expectations) const;
};

/// A kind whose block and record have these types.
template <typename Block, typename Record>
struct KindOf : StudyKind {
    static const Block& block_in(const std::any& block) {
        return std::any_cast<const Block&>(block);
    }
    static Until* until_in(std::any& block) {
        auto& until = std::any_cast<Block&>(block).until;
        return until ? &*until : nullptr;
    }
    static const Record& record_in(const std::any& record) {
        return std::any_cast<const Record&>(record);
    }
    bool has(std::type_index type) const final {
        for (const std::type_index mine :
             {std::type_index(typeid(Block)), std::type_index(typeid(Record))})
            if (type == mine)
                return true;
        return false;
    }
};

/// Every kind, in the order in which results show them.
const RowsOf<StudyKind>& study_kinds();

/// At most one value for each kind of study: the blocks of a scene, or the records of a result.
class ByKind {
public:
    struct Entry {
        const StudyKind* kind;
        std::any value;
    };

    /// The value of a type; null where there is none.
    template <typename T>
    [[nodiscard]] const T* get() const {
        for (const auto& entry : entries_)
            if (const auto* value = std::any_cast<T>(&entry.value))
                return value;
        return nullptr;
    }
    template <typename T>
    [[nodiscard]] T* get() {
        return const_cast<T*>(std::as_const(*this).template get<T>());
    }

    /// The value of a kind; null where there is none.
    [[nodiscard]] const std::any* find(const StudyKind& kind) const;

    /// Sets the value of a type. Throws std::logic_error where no kind of study has that type.
    template <typename T>
    T& set(T value) {
        return std::any_cast<T&>(set(kind_with(typeid(T)), std::move(value)));
    }
    std::any& set(const StudyKind& kind, std::any value);

    template <typename T>
    void remove() {
        std::erase_if(entries_, [](const Entry& entry) { return entry.value.type() == typeid(T); });
    }

    /// In the order of study_kinds().
    [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
    [[nodiscard]] std::vector<Entry>& entries() { return entries_; }

private:
    static const StudyKind& kind_with(std::type_index type);

    std::vector<Entry> entries_;
};

} // namespace tvbeam
