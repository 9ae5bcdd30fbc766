#pragma once

#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <clocale>
#include <cstdlib>
#include <locale>
#include <string>

namespace tvbeam {

/// While it lives, decimals have a comma and thousands a point: for C++, and for C by a German
/// locale that is made for the test. Where it cannot be made (Debian's package locales is missing),
/// the test's log says that C goes on as it was.
class CommaLocale {
public:
    CommaLocale() {
        struct Comma : std::numpunct<char> {
            char do_decimal_point() const override { return ','; }
            char do_thousands_sep() const override { return '.'; }
            std::string do_grouping() const override { return "\3"; }
        };
        before_ = std::locale::global(std::locale(std::locale::classic(), new Comma));
        const std::string name = (directory_.path() / "de_DE.UTF-8").string();
        const bool made =
            std::system(("localedef -i de_DE -f UTF-8 " + name + " 2>/dev/null").c_str()) == 0;
        ::setenv("LOCPATH", directory_.path().c_str(), 1);
        if (!made || std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr)
            BOOST_TEST_MESSAGE("skipped for C: localedef cannot make de_DE.UTF-8");
        else
            BOOST_TEST(std::localeconv()->decimal_point == std::string(","));
    }
    ~CommaLocale() {
        std::setlocale(LC_ALL, "C");
        ::unsetenv("LOCPATH");
        std::locale::global(before_);
    }
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;
    CommaLocale(CommaLocale&&) = delete;
    CommaLocale& operator=(CommaLocale&&) = delete;

private:
    TemporaryDirectory directory_;
    std::locale before_;
};

} // namespace tvbeam
