#include "studies/data/name_words.hpp"

#include <cctype>

namespace tvbeam {

std::set<std::string> words_in(const std::string& name) {
    std::set<std::string> words;
    std::string whole;
    std::string part;
    bool was_small = false;
    const auto end = [&words](std::string& word) {
        if (!word.empty())
            words.insert(word);
        word.clear();
    };
    for (const char c : name) {
        const auto letter = static_cast<unsigned char>(c);
        const bool is_of_a_word = std::isalnum(letter) != 0 || letter >= 0x80U;
        if (!is_of_a_word)
            end(whole);
        if (!is_of_a_word || (was_small && std::isupper(letter) != 0))
            end(part);
        if (is_of_a_word) {
            whole += static_cast<char>(std::tolower(letter));
            part += static_cast<char>(std::tolower(letter));
        }
        was_small = std::islower(letter) != 0;
    }
    end(whole);
    end(part);
    return words;
}

} // namespace tvbeam
