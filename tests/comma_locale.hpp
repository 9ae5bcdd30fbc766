#pragma once

#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <clocale>
#include <cstdlib>
#include <locale>
#include <string>

namespace tvbeam {

/// A directory with a German locale, made once in a program; empty where it cannot be made.
inline const TemporaryDirectory& german_locale() {
    static const TemporaryDirectory directory;
    static const int status =
        std::system(("localedef -i de_DE -f UTF-8 " + (directory.path() / "de_DE.UTF-8").string() +
                     " 2>/dev/null")
                        .c_str());
    static_cast<void>(status); // setlocale says whether it is there
    return directory;
}

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
        ::setenv("LOCPATH", german_locale().path().c_str(), 1);
        if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr)
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
    std::locale before_;
};

} // namespace tvbeam
