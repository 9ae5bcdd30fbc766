#include "reports/command_line/progress_line.hpp"

#include <boost/test/unit_test.hpp>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(durations)

BOOST_AUTO_TEST_CASE(are_rounded_up_to_seconds_and_cut_to_minutes_from_an_hour_on) {
    for (const auto& [seconds, text] :
         {std::pair(0.2, "1 s"), std::pair(59.0, "59 s"), std::pair(59.2, "1 min 0 s"),
          std::pair(754.0, "12 min 34 s"), std::pair(5400.0, "1 h 30 min"),
          std::pair(7215.0, "2 h 0 min"), std::pair(360061.0, "100 h 1 min")})
        BOOST_TEST(duration_text(seconds) == text, seconds);
}

BOOST_AUTO_TEST_SUITE_END()
