#include "tests/fuzz/targets.hpp"

#include "mms/text/input_error.hpp"
#include "reports/files/baseline.hpp"
#include "reports/files/finished_work.hpp"
#include "reports/files/run_identity.hpp"
#include "studies/data/data_analysis.hpp"
#include "studies/data/data_file.hpp"
#include "studies/predicted_work.hpp"
#include "studies/stress/stress_case.hpp"
#include "tests/temporary_directory.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>
#include <string_view>

namespace tvbeam::fuzz {

namespace {

/// The name of a file that holds the bytes until the next call.
std::string file_of(std::span<const std::uint8_t> data, const std::string& name) {
    static const TemporaryDirectory directory;
    return directory.write(name, std::string(text_of(data)));
}

const Scene& kept_scene() {
    static const Scene scene = [] {
        constexpr std::string_view text =
            "solution = \"copetti-fernandez-2011\"\n"
            "[beam]\nalpha = 0.017\nzeta = 0.1\nstops = [-0.02, 0.1]\n"
            "[ladder]\nfinal_time = 1.0\nelements = [4, 8]\n"
            "dt = [0.5, 0.25]\nnorms = [\"theta_L2L2\", "
            "\"u_LinfH2semi\"]\n"
            "[stress.sweep.a]\nalpha = [0.1, 1.0, 10.0]\n";
        return read_scene(file_of({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                                  "kept.toml"));
    }();
    return scene;
}

/// The first line of a file of kept_scene().
const std::string& first_line() {
    static const std::string line = [] {
        const TemporaryDirectory directory;
        FinishedWork work(kept_scene(), {});
        work.keep_in(directory.path() / "unfinished.jsonl");
        work.add_part("stress", 0, StressCase());
        work.write();
        const std::string text = directory.read("unfinished.jsonl");
        return text.substr(0, text.find('\n') + 1);
    }();
    return line;
}

void require_fitting(FinishedWork& work) {
    static const Series ladder = kept_scene().series().front();
    static const Series grid = [] {
        Series series = ladder;
        series.study = "orders";
        return series;
    }();
    for (std::size_t index = 0; index < 2; ++index)
        if (const auto run = work.find(ladder, index)) {
            const bool failed = run->status != RungStatus::ok;
            require(run->errors.size() == (failed ? 0 : 2), "errors of another number of norms");
            require(run->rung.elements == (index == 0 ? 4 : 8), "a run of other elements");
            require(run->uncertainties.empty() || run->uncertainties.size() == run->errors.size(),
                    "uncertainties of another number of norms");
            for (const double error : run->errors)
                require(std::isfinite(error) && error >= 0.0, "an error that is no norm");
            for (const auto& count : run->counters)
                require(count.value >= 0, "a negative count");
        }
    for (std::size_t index = 0; index < 3; ++index)
        if (const std::any found = work.find_part("stress", index); found.has_value()) {
            const auto& one = std::any_cast<const StressCase&>(found);
            require(one.checks.has_value() ==
                        (one.outcome == Outcome::certified || one.outcome == Outcome::failed),
                    "checks that do not belong to the outcome");
        }
    require(!work.find(ladder, 2) && !work.find(grid, 0) &&
                !work.find_part("stress", 3).has_value(),
            "a run that the scene does not have");
}

} // namespace

bool scene(std::span<const std::uint8_t> data) {
    try {
        const Scene read = read_scene(file_of(data, "fuzz.toml"), {}, {.expectations = true});
        const PredictedWork predicted = predicted_work(read);
        require(predicted.seconds >= 0.0 && predicted.bytes >= 0.0, "a prediction below zero");
        require(!run_identity(read).empty(), "a scene without identity");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

bool table(std::span<const std::uint8_t> data) {
    const std::uint8_t choice = taken(data);
    DataChoice chosen;
    if ((choice & 1U) != 0U)
        chosen.dimension = 2.0;
    if ((choice & 2U) != 0U)
        chosen.errors = {"L2"};
    if ((choice & 4U) != 0U)
        chosen.values = {"drag"};
    if ((choice & 8U) != 0U)
        chosen.sizes = {"ndofs"};
    if ((choice & 16U) != 0U)
        chosen.sigma = "sigma";
    try {
        const DataFile read = read_data(file_of(data, "fuzz.csv"), chosen);
        const std::size_t rows = read.widths.front().numbers.size();
        for (const auto& columns : {read.widths, read.errors, read.values})
            for (const auto& column : columns)
                require(column.numbers.size() == rows, "columns of several lengths");
        constexpr std::size_t short_table = 8;
        if (rows <= short_table && read.errors.size() + read.values.size() == 1)
            analyse(read);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// Lines that the reader takes for whole: what is to be tried lies behind the checksum.
std::string with_seals(std::span<const std::uint8_t> data) {
    std::istringstream lines{std::string(text_of(data))};
    std::string text;
    for (std::string line; std::getline(lines, line);)
        text += (line.starts_with('{') ? sealed(line) : line) + "\n";
    return text;
}

bool kept(std::span<const std::uint8_t> data) {
    const std::uint8_t kind = taken(data);
    const Scene& scene = kept_scene();
    const std::string& first = first_line();
    try {
        if (kind % 4 == 0) {
            const Baseline baseline(file_of(data, "baseline.json"));
            const auto checked =
                baseline.check({"table1", {"fuzz"}, {{"a", 1.0}, {"b", 2.0}}}, 1e-6);
            require(!checked.empty(), "a baseline that nothing is held against");
        } else {
            static const TemporaryDirectory directory;
            directory.write("unfinished.jsonl",
                            kind % 4 == 1 ? std::string(text_of(data)) : first + with_seals(data));
            FinishedWork work(scene, {});
            work.read(directory.path() / "unfinished.jsonl");
            require_fitting(work);
        }
        return true;
    } catch (const InputError&) {
        return false;
    }
}

} // namespace tvbeam::fuzz
