#include "reports/formats/junit_report.hpp"

#include "mms/text/visible_text.hpp"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace tvbeam {

namespace {

using boost::property_tree::ptree;

std::int64_t violations(const CheckedScene& scene) {
    return std::count_if(scene.expectations.begin(), scene.expectations.end(),
                         [](const CheckedExpectation& checked) { return !checked.holds; });
}

ptree suite_of(const CheckedScene& scene) {
    const bool failed = !scene.error.empty();
    ptree suite;
    suite.put("<xmlattr>.name", visible(scene.name));
    suite.put("<xmlattr>.tests", scene.expectations.size() + (failed ? 1 : 0));
    suite.put("<xmlattr>.failures", violations(scene));
    suite.put("<xmlattr>.errors", failed ? 1 : 0);
    suite.put("<xmlattr>.time", fmt::format("{:.3f}", scene.seconds));
    const auto test_case = [&](const std::string& name) {
        ptree entry;
        entry.put("<xmlattr>.classname", visible(scene.name));
        entry.put("<xmlattr>.name", visible(name));
        return entry;
    };
    if (failed) {
        ptree entry = test_case("runs");
        entry.put("error.<xmlattr>.message", visible(scene.error));
        suite.add_child("testcase", entry);
    }
    for (const auto& checked : scene.expectations) {
        ptree entry = test_case(checked.what);
        if (!checked.holds) {
            // Where the scene says so: what reads JUnit marks that line.
            if (checked.place.line > 0) {
                entry.put("<xmlattr>.file", visible(checked.place.file));
                entry.put("<xmlattr>.line", checked.place.line);
            }
            const std::string message =
                visible(fmt::format("expected {}, found {}", checked.expected, checked.found));
            entry.put("failure.<xmlattr>.message", message);
            const std::string at =
                checked.place.line > 0
                    ? fmt::format(":{}:{}", checked.place.line, checked.place.column)
                    : std::string();
            entry.put("failure", fmt::format("{}{}: {}", visible(checked.place.file), at, message));
        }
        suite.add_child("testcase", entry);
    }
    return suite;
}

} // namespace

bool CheckedScene::passed() const {
    return error.empty() && violations(*this) == 0;
}

std::string junit_report(const std::vector<CheckedScene>& scenes) {
    ptree suites;
    for (const auto& scene : scenes)
        suites.add_child("testsuite", suite_of(scene));
    ptree root;
    root.add_child("testsuites", suites);
    std::ostringstream text;
    boost::property_tree::write_xml(
        text, root, boost::property_tree::xml_writer_make_settings<std::string>(' ', 2));
    return text.str();
}

} // namespace tvbeam
