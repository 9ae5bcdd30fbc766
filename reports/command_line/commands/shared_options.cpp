#include "reports/command_line/commands/shared_options.hpp"

#include "studies/gates/expectation.hpp"

namespace tvbeam {

namespace {

/// Refuses the empty name that an unset variable of a shell makes.
const CLI::Validator named(
    [](std::string& name) {
        return name.empty() ? std::string("its name is empty; name a file or a directory") : "";
    },
    "", "named");
const CLI::Validator no_stream(
    [](std::string& name) {
        return name == "-" ? std::string("a directory is wanted, and - is none") : "";
    },
    "", "no stream");

const CLI::Validator narrow(
    [](std::string& text) {
        double part = 0.0;
        const bool holds =
            CLI::detail::lexical_cast(text, part) && part > 0.0 && part <= widest_part;
        return holds ? std::string() : text + " is no part > 0 and at most 0.5 of a figure";
    },
    "", "narrow");

} // namespace

void add_really_long(CLI::App& command, bool& really_long) {
    command.add_flag("--yes-really-long", really_long,
                     "also what is predicted to take more than 6 h or 4 GB");
}

void add_jobs(CLI::App& command, int& jobs) {
    constexpr int most = 1024;
    command
        .add_option(
            "--jobs", jobs,
            "runs at a time: of a ladder, of the grid of [orders], of the cases of [stress]; the "
            "results do not depend on it. [work_precision] times one run after the other all the "
            "same")
        ->check(CLI::Range(1, most))
        ->type_name("N")
        ->capture_default_str();
}

void add_overrides(CLI::App& command, std::vector<std::string>& overrides,
                   const std::string& description) {
    command.add_option("--set", overrides, description)
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all();
}

void add_file(CLI::App& command, const std::string& option, std::string& file,
              const std::string& description) {
    command.add_option(option, file, description)->check(named)->type_name("FILE|-");
}

void add_directory(CLI::App& command, std::string& directory, const std::string& description) {
    command.add_option("--out", directory, description)
        ->check(named)
        ->check(no_stream)
        ->type_name("DIR");
}

void add_baseline(CLI::App& command, std::string& file, double& tolerance,
                  const std::string& figure) {
    auto* const baseline =
        command
            .add_option("--baseline", file, "hold every " + figure + " against a recorded baseline")
            ->type_name("FILE");
    command.add_option("--tolerance", tolerance, "relative, both sides, for --baseline")
        ->check(narrow)
        ->needs(baseline)
        ->capture_default_str();
}

} // namespace tvbeam
