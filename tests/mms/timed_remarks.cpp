#include "mms/text/timed_remarks.hpp"

#include <boost/test/unit_test.hpp>

#include <string>
#include <vector>

using namespace tvbeam;

namespace {

/// At t = 1, 2, …, with jumps of t.
std::vector<TimedRemark> alike(const std::string& kind, int count) {
    std::vector<TimedRemark> remarks;
    for (int t = 1; t <= count; ++t)
        remarks.push_back({kind, std::to_string(t), kind + " at " + std::to_string(t), {1.0 * t}});
    return remarks;
}

} // namespace

BOOST_AUTO_TEST_SUITE(timed_remarks)

BOOST_AUTO_TEST_CASE(of_five_all_are_told_and_of_six_four_and_how_many_more) {
    BOOST_TEST(told(alike("a", 5)).size() == 5U);
    const std::vector<std::string> six = told(alike("a", 6));
    BOOST_REQUIRE(six.size() == 4U);
    BOOST_TEST(six[2] == "a at 3");
    BOOST_TEST(six[3] == "a at 4 The same holds at 2 other times, the last of them t = 6, with "
                         "jumps by up to 6.");
}

BOOST_AUTO_TEST_CASE(each_kind_is_counted_by_itself_and_what_has_none_is_told) {
    std::vector<TimedRemark> remarks = alike("a", 7);
    const std::vector<TimedRemark> others = alike("b", 5);
    const std::vector<TimedRemark> single = alike("", 9);
    remarks.insert(remarks.begin() + 5, others.begin(), others.end());
    remarks.insert(remarks.end(), single.begin(), single.end());
    const std::vector<std::string> texts = told(remarks);
    BOOST_REQUIRE(texts.size() == 4U + 5U + 9U);
    BOOST_TEST(texts[4] == "b at 1");
    BOOST_TEST(texts[8] == "b at 5");
    BOOST_TEST(texts[9] == " at 1");
}

BOOST_AUTO_TEST_CASE(the_greatest_jumps_are_those_of_the_other_times) {
    std::vector<TimedRemark> remarks = alike("a", 8);
    remarks[0].jumps = {100.0};
    remarks[5].jumps = {50.0};
    BOOST_TEST(told(remarks).back().ends_with("with jumps by up to 50."));
    for (auto& remark : remarks)
        remark.jumps.clear();
    BOOST_TEST(told(remarks).back().ends_with("4 other times, the last of them t = 8."));
}

BOOST_AUTO_TEST_SUITE_END()
