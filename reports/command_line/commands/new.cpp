#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/new_solution.hpp"
#include "reports/files/output_file.hpp"

#include <memory>
#include <string>

namespace tvbeam {

namespace {

int new_command(const std::string& name) {
    const auto files = starter_files(name);
    write_starter_files(files, ".");
    write_standard_output("wrote " + files[0].name + " (the solution) and " + files[1].name +
                          " (the scene); now\n  tvbeam run " + files[1].name +
                          "\n  tvbeam derive " + files[0].name + "\n");
    return done;
}

int new_solver_command(const std::string& name) {
    const auto files = solver_starter_files(name);
    write_starter_files(files, ".");
    write_standard_output("wrote " + files[0].name +
                          " (a solver to put your own in place of) and " + files[1].name +
                          " (the scene); now\n  tvbeam run " + files[1].name + "\n  tvbeam check " +
                          files[1].name + "\n");
    return done;
}

} // namespace

Command add_new(CLI::App& app) {
    auto* make = app.add_subcommand(
        "new", "Write a solution to start from, NAME.toml, and a scene that runs it, "
               "NAME-scene.toml, into the current directory.\nExample: tvbeam new my-solution");
    const auto solver = std::make_shared<bool>(false);
    make->add_flag(
        "--solver", *solver,
        "a small solver in Python, NAME.py, and a scene that runs it, NAME.toml: to study "
        "a solver of your own");
    const auto name = std::make_shared<std::string>();
    make->add_option("name", *name, "letters, digits, - and _")->required()->type_name("NAME");
    return {make,
            [name, solver] { return *solver ? new_solver_command(*name) : new_command(*name); }};
}

} // namespace tvbeam
