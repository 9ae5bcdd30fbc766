#pragma once

#include "reports/document/document.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// A formula of the problem, and the times that it holds for.
struct Formula {
    std::string symbol;
    std::string interval; ///< may be empty
    std::string text;     ///< as a solution file writes it
};

/// A picture as gnuplot draws it.
struct Figure {
    std::string name; ///< letters, digits and _; no two figures have the same
    std::string caption;
    std::string svg; ///< a whole file; empty where it could not be drawn
};

/// What a page says besides its document.
struct HtmlContents {
    Document document;
    bool failed = false;           ///< a run did
    bool interrupted = false;      ///< runs are missing
    std::vector<Formula> formulas; ///< of the problem; empty where each run has one of its own
    std::vector<Figure> figures;
    std::string no_figures; ///< why there are none, or not all; else empty
    std::string scene_text; ///< as its file has it
};

/// One page that needs nothing else, neither files nor a network nor scripts: what was run, what it
/// shows, the figures, the tables, the problem, where it comes from. It suits narrow screens, and
/// light and dark ones. Whatever comes from a scene is shown as text.
std::string html_report(const HtmlContents& contents);

/// A picture to be put into a page: without the head of the file, as wide as its place, its ids
/// begun with its name, so that no two pictures of a page share one.
std::string inline_svg(const Figure& figure);

} // namespace tvbeam
