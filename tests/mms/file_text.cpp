#include "mms/text/file_text.hpp"

#include "mms/text/error_text.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <string>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(file_texts)

namespace {

std::string refusal_of(const std::string& file, std::size_t most) {
    try {
        file_text(file, most);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

} // namespace

// 70 000 bytes are more than what is read at a time.
BOOST_AUTO_TEST_CASE(a_file_of_just_as_many_bytes_as_may_be_is_read_and_one_more_is_refused) {
    const TemporaryDirectory directory;
    for (const std::size_t size : {0u, 1u, 70'000u}) {
        const std::string text(size, 'x');
        const std::string file = directory.write("file", text);
        BOOST_TEST(file_text(file, size) == text);
        if (size > 0)
            BOOST_TEST(refusal_of(file, size - 1)
                           .ends_with("has " + std::to_string(size) + " bytes; at most are read " +
                                      std::to_string(size - 1)),
                       refusal_of(file, size - 1));
    }
}

BOOST_AUTO_TEST_CASE(what_is_no_file_is_refused_with_what_it_is) {
    const TemporaryDirectory directory;
    const std::string folder = directory.path().string();
    BOOST_TEST(refusal_of(folder, 10).ends_with("is a directory; give the file in it"),
               refusal_of(folder, 10));
    BOOST_TEST(refusal_of(folder + "/nothing", 10)
                   .ends_with("check the path and its permissions (No such file or directory)"),
               refusal_of(folder + "/nothing", 10));
    BOOST_TEST(refusal_of("/dev/zero", 10)
                   .ends_with("gives more than the 10 bytes that are read at most; name a file"),
               refusal_of("/dev/zero", 10));
}

BOOST_AUTO_TEST_SUITE_END()
