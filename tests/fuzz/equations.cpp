#include "mms/equations/code.hpp"
#include "mms/equations/system_checks.hpp"
#include "mms/equations/system_text.hpp"
#include "mms/text/input_error.hpp"
#include "tests/fuzz/targets.hpp"

namespace tvbeam::fuzz {

bool equations(std::span<const std::uint8_t> data) {
    const auto& languages = code_language_names();
    const std::string language = languages[taken(data) % languages.size()];
    try {
        DerivedSystem derived = derive_system(parse_equation_system(text_of(data), "fuzz.toml"));
        for (const auto& remark : checked_system(derived))
            require(!remark.text.empty(), "a remark that says nothing");
        require(!system_text(derived).empty() && !system_latex(derived).empty(),
                "equations without a text");
        require(!system_code(derived, *code_language(language)).empty(), "equations without code");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

} // namespace tvbeam::fuzz
