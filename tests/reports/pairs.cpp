// Every pair of blocks in one scene runs and is reported, unless one of them is known not to go
// with what is there; it is then refused with a reason before anything runs.

#include "mms/text/input_error.hpp"
#include "reports/document/text_document.hpp"
#include "reports/formats/report_format.hpp"
#include "studies/gates/check.hpp"
#include "studies/ladder/ladder.hpp"
#include "tests/sweep.hpp"
#include "tests/temporary_directory.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <ostream>
#include <set>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(pairs_of_blocks)

namespace {

/// A block, or a choice within one, as overrides of a scene.
struct Part {
    std::string name;
    std::vector<std::string> overrides;
    std::vector<std::string> needs = {};   ///< one of these beside it; empty: nothing
    std::vector<std::string> refuses = {}; ///< does not go with any of these
};

std::ostream& operator<<(std::ostream& stream, const Part& part) {
    return stream << part.name;
}

const std::vector<std::string> exact{"solution", "reference", "reference that is a level",
                                     "richardson"};
const std::vector<std::string> references(exact.begin() + 1, exact.end());

const std::vector<Part> parts{
    {"ladder",
     {"ladder={final_time=0.5, elements=[4, 8], dt=[0.05, 0.025], "
      "norms=['theta_L2L2', 'u_LinfH2semi_sq', 'sigma_L2']}"},
     exact},
    {"ladder without norms", {"ladder={final_time=0.5, elements=[4, 8], dt=[0.05, 0.025]}"}},
    {"printed",
     {"ladder={final_time=0.5, elements=[4, 8], dt=[0.05, 0.025], norms=['theta_L2L2'], "
      "printed={theta_L2L2=[1e-2, 2e-3]}}"},
     exact},
    {"orders",
     {"orders={final_time=1, elements=[2, 4, 8], dt=[0.1, 0.05, 0.025], "
      "norms=['theta_L2L2', 'corollary']}"},
     exact},
    {"work_precision",
     {"work_precision={final_time=0.5, norms=['u_L2H2'], runs=1, scheme=[{name='one', "
      "elements=[4, 8], dt=[0.05, 0.025]}, {name='two', time='bdf2', elements=[4], dt=[0.05]}]}"},
     {"solution"},
     references},
    {"evolution",
     {"evolution={final_time=0.7625, elements=8, dt=0.0125, "
      "probes=['theta@0.5', 'u@1', 'stress', 'energy']}"}},
    {"period",
     {"evolution={final_time=1, elements=4, dt=0.05, every=2, period=0.5, probes=['u@1']}"}},
    {"stress", {"stress.sweep.a={alpha=[0.0, 1.0], elements=[2, 4], steps=3}"}},
    {"contraction",
     {"stress.contraction={alpha={from=0.1, to=10, count=2}, dt={from=1e-3, to=0.1, count=2}, "
      "elements=4}"}},
    {"roundoff", {"stress.roundoff={elements=[4, 8]}"}},
    {"sensitivity",
     {"sensitivity={range=[0.1, 1], defect={zeta={moment_load='zeta*x*t'}, two={u0='h*x^2', "
      "heat_source='dt'}}}"},
     {"expect of a ladder", "expect of orders", "expect of an evolution", "expect of stress",
      "expect of work_precision"}},
    {"reference", {"reference={elements=16, dt=0.0125}"}},
    {"reference that is a level", {"reference={elements=8, dt=0.025}"}},
    {"richardson", {"reference={elements=16, dt=0.0125, richardson=true}"}},
    {"graded mesh", {"mesh.grading=1.5"}, {}, references},
    {"mesh nodes",
     {"mesh.nodes=[0, 0.3, 1]"},
     {},
     {"graded mesh", "reference", "reference that is a level", "richardson"}},
    {"defect",
     {"defect={heat_source='h*exp(x*t)', moment_load='dt*x', body_force='x^2', theta0='alpha*x', "
      "u0='zeta*x^2'}"}},
    {"penalty", {"beam.contact={law='penalty', epsilon=1e-6}"}},
    {"no stops", {"beam.stops=[-inf, inf]"}, {}, {"solution", "penalty"}},
    {"no coupling", {"beam.alpha=0"}},
    {"no viscosity", {"beam.zeta=0"}},
    {"end temperature", {"beam.theta_A=0.5"}, {}, {"solution"}},
    {"fixed point", {"scheme.algorithm=fixed-point", "scheme.tolerance=1e-9"}},
    {"bdf2", {"scheme.time=bdf2"}},
    {"sdirk2", {"scheme.time=sdirk2"}},
    {"lumped", {"scheme.thermal_mass=lumped"}},
    {"nodal", {"scheme.basis=nodal"}, {}, {"fixed point"}},
    {"short", {"short={beam={zeta=0.2}}"}},
    {"expect of a ladder",
     {"expect.ladder={theta_L2L2={orders=[0.1, 9], predicted=[0.1, 9]}}"},
     {"ladder", "printed"}},
    {"expect of orders", {"expect.orders={theta_L2L2={p=[0.1, 9]}}"}, {"orders"}},
    {"expect of an evolution",
     {"expect.evolution={onsets=[-1, 9], 'nothing'=[0, 1]}"},
     {"evolution", "period"}},
    {"expect of stress", {"expect.stress={failed=[-1, 1]}"}, {"stress", "contraction", "roundoff"}},
    {"expect of work_precision",
     {"expect.work_precision.one={u_L2H2={orders=[0.1, 9]}}"},
     {"work_precision"}},
    {"report", {"report.files=['json']"}},
};

const std::string beam = "[beam]\nalpha = 0.4\nzeta = 0.15\nstops = [-0.05, 0.1]\n";

/// What pairs are added to: a problem, with a study of its own.
struct Base {
    std::string problem; ///< "solution" or "data"
    std::vector<std::string> parts;
    std::string text;
};

const std::string data_block =
    "[data]\ntheta0 = 'sin(pi*x) + theta_A*(1 - x)'\nu0 = '0.02*x^2*(3 - x)'\n"
    "body_force = 'sin(9*t)'\n";
const std::vector<Base> bases{
    {"solution", {"ladder"}, "solution = 'pressed-on-g1'\n" + beam},
    {"data", {"ladder without norms"}, data_block + beam},
    {"data", {"ladder", "reference"}, data_block + beam},
};

const Part& named(const std::string& name) {
    return *std::find_if(parts.begin(), parts.end(),
                         [&](const Part& part) { return part.name == name; });
}

/// The key that a part sets, which a later one replaces: "ladder".
std::string key_of(const Part& part) {
    const std::string& first = part.overrides.front();
    return first.substr(0, first.find('='));
}

/// The parts of a scene, and what those that hold make it refuse.
struct Chosen {
    std::vector<std::string> overrides;
    bool fits = true;

    Chosen(const Base& base, const Part& first, const Part& second) {
        std::vector<const Part*> last; // of each key
        const auto add = [&](const Part& part) {
            overrides.insert(overrides.end(), part.overrides.begin(), part.overrides.end());
            std::erase_if(last, [&](const Part* one) { return key_of(*one) == key_of(part); });
            last.push_back(&part);
        };
        for (const auto& name : base.parts)
            add(named(name));
        add(first);
        add(second);
        std::set<std::string> there{base.problem};
        for (const Part* part : last)
            there.insert(part->name);
        const auto is_there = [&](const std::string& name) { return there.contains(name); };
        for (const Part* part : last)
            fits = fits &&
                   (part->needs.empty() ||
                    std::any_of(part->needs.begin(), part->needs.end(), is_there)) &&
                   std::none_of(part->refuses.begin(), part->refuses.end(), is_there);
    }
};

/// Hears whether anything has begun to run.
struct Listener : Progress {
    bool begun = false;
    void expect(double /*work*/) override {}
    bool advance(double /*work*/) override { return begun = true; }
};

/// "ran", or why it was refused before anything ran.
std::string outcome_of(const std::string& problem, const std::vector<std::string>& overrides) {
    const TemporaryDirectory directory;
    Listener listener;
    try {
        const Scene scene = read_scene(
            directory.write("s.toml", problem), overrides,
            {.short_form = true, .expectations = true, .report_files = report_format_names()});
        const StudyResult result = run_study(scene, {.progress = &listener});
        BOOST_TEST(!result.failed(), result.ending().reason);
        check(result);
        const Reported all = reported(result);
        BOOST_TEST(!text_document(all.document).empty());
        const auto plots = all.plots();
        const DrawnPlots none{std::vector<DrawnPlot>(plots.size()), "not drawn"};
        for (const auto& format : report_formats())
            format->write({all, plots, none});
        return "ran";
    } catch (const InputError& error) {
        const std::string reason = error.what();
        BOOST_TEST(reason.find('\n') == std::string::npos, reason);
        BOOST_TEST(!listener.begun, "refused after something ran: " << reason);
        return reason;
    }
}

} // namespace

namespace {

std::size_t position_of(const Part& part) {
    std::size_t found = 0;
    while (parts[found].name != part.name)
        ++found;
    return found;
}

} // namespace

// In either order: of two parts that set one key, the last counts.
BOOST_DATA_TEST_CASE(run_if_nothing_speaks_against_it_or_are_refused_before_anything_runs,
                     data::make(parts), first) {
    for (const auto& base : bases)
        for (const auto& second : parts) {
            if (second.name < first.name ||
                (short_tests && !is_swept(position_of(first) + position_of(second), 3)))
                continue;
            const Chosen chosen(base, first, second);
            const std::string outcome = outcome_of(base.text, chosen.overrides);
            BOOST_TEST((outcome == "ran") == chosen.fits,
                       base.problem << ", " << base.parts.back() << ", " << first << ", " << second
                                    << ": " << outcome);
        }
}

// By themselves, without a ladder beside them: a file without any study is refused, too.
BOOST_DATA_TEST_CASE(run_or_are_refused_without_a_ladder_beside_them, data::make(parts), first) {
    if (short_tests)
        return;
    for (const auto& base : bases)
        for (const auto& second : parts)
            if (first.name < second.name) {
                const Chosen chosen({base.problem, {}, base.text}, first, second);
                outcome_of(base.text, chosen.overrides);
            }
}

// A result with a defect cannot be taken for one without, whatever it is written as.
BOOST_AUTO_TEST_CASE(with_a_defect_say_so_in_the_first_line_of_the_result) {
    const TemporaryDirectory directory;
    std::vector<std::string> overrides = named("ladder").overrides;
    for (const bool with : {false, true}) {
        if (with)
            overrides.emplace_back("defect={heat_source='h'}");
        const StudyResult result =
            run_study(read_scene(directory.write("s.toml", bases[0].text), overrides));
        const Reported all = reported(result);
        for (const auto& format : report_formats())
            for (const auto& file : format->write({all, {}, {}})) {
                const auto said = file.text.whole().find("WITH A DELIBERATE DEFECT, not the");
                BOOST_TEST((said != std::string::npos) == (with && !file.name.ends_with(".csv")),
                           file.name);
                if (with && file.name.ends_with(".json"))
                    BOOST_TEST(said < 40u);
            }
        const auto text = text_document(all.document);
        BOOST_TEST((text.find("DELIBERATE DEFECT") < text.find('\n')) == with);
    }
}

BOOST_AUTO_TEST_CASE(hold_every_kind_of_study) {
    for (const auto& kind : study_kinds())
        BOOST_TEST(std::any_of(parts.begin(), parts.end(),
                               [&](const Part& part) {
                                   const std::string key = key_of(part);
                                   return key.substr(0, key.find('.')) == kind->name();
                               }),
                   kind->name() << " is in no pair");
}

BOOST_AUTO_TEST_SUITE_END()
