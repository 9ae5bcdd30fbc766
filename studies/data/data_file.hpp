/// A table of errors or values of any solver, as people have it.
///
/// One record a line, a name a column. Fields are separated by commas, tabs, semicolons (then a
/// comma may be a decimal point), blanks, or the bars of a Markdown table, as the line of names has
/// it. The names stand in the first line, or, as NumPy writes them, in the comment (#) just above
/// the first line of numbers. Empty lines and other comments are passed over. Numbers are read
/// alike in every locale, also with Fortran's exponents (1.5D-03, 1.5-103); an empty field, nan or
/// NA is a failed run. What is too large or too small for a double is refused.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// What the columns mean; in lists of names one text may be several, with commas between them.
/// Without a choice: h (or elements) and dt are widths, error or, where there is none, value is
/// what was found.
struct DataChoice {
    std::vector<std::string> sizes = {}; ///< widths of meshes, or numbers of cells, unknowns, …
    std::optional<double> dimension =
        {}; ///< sizes are numbers n of things that fill it: h = n^(-1/d)
    std::optional<std::string> step = {};
    std::vector<std::string> errors = {};
    std::vector<std::string> values = {};
    std::optional<std::string> sigma = {}; ///< standard deviations of the figures
    /// COLUMN=TEXT: only rows whose column has this text, or is the same number; COLUMN=*: rows
    /// that the column tells apart are of one series all the same.
    std::vector<std::string> where = {};
};

struct DataColumn {
    std::string name;
    std::vector<double> numbers; ///< one a record; NaN: failed
    /// Of the last digits printed, one a record; empty: exact, as widths are whose ratios are
    /// (printed_units_of_widths).
    std::vector<double> units = {};
    /// Whether nothing was there, so that no run is said to have failed, one a record; empty:
    /// everywhere there was.
    std::vector<bool> missing = {};
};

struct DataFile {
    std::string name;
    std::vector<DataColumn> widths; ///< what was refined; positive
    std::vector<DataColumn> errors;
    std::vector<DataColumn> values;
    std::vector<double> sigma;        ///< empty: not known
    std::vector<std::string> remarks; ///< what was assumed
    /// By which rows of the file these are told from others of it, COLUMN=TEXT, by the names of the
    /// columns; numbers as they are written shortest. Empty: all rows.
    std::vector<std::string> chosen = {};
};

/// Reads a file, or standard input where it is called "-". Throws InputError at file:line:column.
DataFile read_data(const std::string& file, const DataChoice& choice = {});

} // namespace tvbeam
