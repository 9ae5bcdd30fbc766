// The one table of the keys of a scene: what readers ask for, and what is said of other keys.

#include "studies/scene/scene_keys.hpp"

#include "mms/text/toml_reader.hpp"
#include "studies/scene/scene.hpp"
#include "studies/scene/shipped.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <fstream>
#include <set>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(keys_of_scenes)

// A reader that asks for a key that is not in the table is stopped by it, so that the shipped
// scenes could not be read.
BOOST_AUTO_TEST_CASE(every_key_of_the_table_is_asked_for_by_the_readers) {
    std::set<std::string> asked_for;
    for (const auto& file : shipped_files(Shipped::scene)) {
        AskedKeys asked;
        read_scene(file.path.string(), {"report={}"},
                   {.short_form = true, .expectations = true, .asked = &asked});
        for (const auto& [path, key] : asked)
            asked_for.insert(key.entry);
    }
    for (const auto& entry : scene_keys().entries())
        BOOST_TEST(asked_for.contains(entry.path), entry.path);
}

BOOST_AUTO_TEST_CASE(every_key_has_a_meaning_and_every_choice_its_words) {
    for (const auto& entry : scene_keys().entries()) {
        BOOST_TEST(!entry.meaning.empty(), entry.path);
        const bool chooses = entry.type == KeyType::choice || entry.type == KeyType::words;
        BOOST_TEST(entry.words.empty() != chooses, entry.path);
    }
}

BOOST_AUTO_TEST_CASE(a_key_that_stands_below_none_is_refused) {
    BOOST_CHECK_THROW(KeyTable({{"a.b", KeyType::number, "", "no table a"}}), std::logic_error);
    BOOST_CHECK_THROW(KeyTable({{"a", KeyType::table, "", "like none", {}, "b"}}),
                      std::logic_error);
}

// Who reads other keys, or other types and choices, than the table says is stopped.
BOOST_AUTO_TEST_CASE(a_reader_asks_for_what_the_table_says) {
    const KeyTable keys({{"a", KeyType::number, "", "a number"},
                         {"b", KeyType::choice, "", "a choice", {"one", "two"}}});
    const TomlDocument document = parse_toml("a = 1\nb = 'one'\n", "file.toml");
    TableReader reader(document, document.table, "", &keys.root());
    BOOST_TEST(*reader.number("a") == 1.0);
    BOOST_TEST(*reader.choice("b", {"one", "two"}) == 0U);
    BOOST_CHECK_THROW(reader.integer("a"), std::logic_error);
    BOOST_CHECK_THROW(reader.number("c"), std::logic_error);
    BOOST_CHECK_THROW(reader.choice("b", {"one", "three"}), std::logic_error);
}

namespace {

struct Mistake {
    std::string text;
    std::vector<std::string> overrides;
    std::string said;
};

std::ostream& operator<<(std::ostream& stream, const Mistake& mistake) {
    return stream << mistake.text << (mistake.overrides.empty() ? "" : mistake.overrides[0]);
}

const std::string beam = "solution = 'copetti-fernandez-2011'\n[beam]\nalpha = 1\nzeta = 1\n";
const std::string ladder =
    "[ladder]\nfinal_time = 2\nelements = [4, 8]\ndt = '1/s'\nnorms = ['theta_L2L2']\n";

const std::vector<Mistake> mistakes = {
    {beam + "[laddder]\nfinal_time = 2\n",
     {},
     ":5:2: unknown block [laddder]; did you mean [ladder]?"},
    {beam + "[ladder]\nelement = [4]\n",
     {},
     ":6:1: unknown key 'ladder.element'; did you mean 'elements'?"},
    {beam + ladder + "stops = [-1, 1]\n",
     {},
     ":10:1: unknown key 'ladder.stops'; did you mean 'beam.stops'?"},
    {beam + ladder, {"alpha=1"}, "--set alpha=1: unknown key 'alpha'; did you mean 'beam.alpha'?"},
    {beam + ladder,
     {"bean.alpha=1"},
     "--set bean.alpha=1: unknown block [bean]; did you mean [beam]?"},
    // Also where only `tvbeam check` looks.
    {beam + ladder + "[expect.ladder.theta_L2L2]\nordrs = [1, 2]\n", {}, "did you mean 'orders'?"},
    {beam + ladder + "[short.ladder]\nelemets = [4]\n",
     {},
     ":11:1: unknown key 'short.ladder.elemets'; did you mean 'elements'?"},
    {beam + ladder + "[short.short.ladder]\nelements = [4]\n",
     {},
     ":10:8: unknown block [short.short]; did you mean [short]?"},
    {"theta = '0'\nu = '0'\n", {}, "is a solution, not a scene"},
    // What there is, but not in this scene; with the place of what came by --set.
    {beam + ladder + "values = ['drag']\n",
     {},
     ":10:1: ladder.values does not apply here; it is for: names of [solver.values]"},
    {beam + ladder + "[expect.ladder]\nended_by = ['known']\n",
     {},
     ":11:1: expect.ladder.ended_by does not apply here; it is for: what ended a ladder with "
     "`until`"},
    {beam + ladder + "[expect.ladder.theta_L2L2]\norder = [1, 2]\n",
     {},
     ":11:1: expect.ladder.theta_L2L2.order does not apply here; it is for: the order along the "
     "ladder, of the norm, not its square, where it has [solver] or `until`; did you mean "
     "'orders'?"},
    {beam + ladder,
     {"expect.ladder.theta_L2L2.gci.limit=[0,1]"},
     "--set expect.ladder.theta_L2L2.gci.limit=[0,1]: expect.ladder.theta_L2L2.gci does not apply "
     "here; it is for: what the grid convergence index says of a value"},
    {beam + ladder,
     {"expect.ladder.foo.orders=[1,2]"},
     "--set expect.ladder.foo.orders=[1,2]: expect.ladder.foo expects something of what the study "
     "does not measure"},
};

} // namespace

BOOST_DATA_TEST_CASE(a_key_that_cannot_be_is_named, data::make(mistakes)) {
    const TemporaryDirectory directory;
    const auto file = directory.path() / "scene.toml";
    std::ofstream(file) << sample.text;
    std::string message;
    try {
        read_scene(file.string(), sample.overrides, {.expectations = true});
    } catch (const InputError& error) {
        message = error.what();
    }
    BOOST_TEST(message.find(sample.said) != std::string::npos, message);
}

BOOST_AUTO_TEST_SUITE_END()
