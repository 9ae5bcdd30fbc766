#pragma once

#include "studies/gates/expectation.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// Reads [[expect.commands]]: tvbeam with the words `run`, in a directory that is empty at first
/// and that all commands of the scene share, after the texts `files` were written there; it ends
/// with `exit` (0 where it is left out), and what it writes to standard output and error holds all
/// of `says`, wherever its lines break; lines of more than OutputLines::longest_line are passed
/// over. program: tvbeam's own file; empty: none can be run, and no expectation holds. What is
/// examined is what it wrote, without columns of seconds, and which files stand there then, with
/// the number of their lines and the column_sizes of data. Throws InputError as the other tables
/// do.
void expect_commands(TableReader& expect, const std::string& program,
                     std::vector<Expectation>& expectations);

} // namespace tvbeam
