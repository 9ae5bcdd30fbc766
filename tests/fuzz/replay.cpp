// Puts every file of the corpora through its target: replay CORPUS, with a folder for each target.

#include "tests/fuzz/targets.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

int main(int argc, char** argv) {
    using namespace tvbeam::fuzz;
    if (argc != 2) {
        std::cerr << "usage: replay CORPUS\n";
        return 2;
    }
    using Target = bool (*)(std::span<const std::uint8_t>);
    const std::vector<std::pair<std::string, Target>> targets = {
        {"solution", solution}, {"scene", scene},     {"table", table},
        {"kept", kept},         {"grammar", grammar}, {"equations", equations}};
    for (const auto& [name, target] : targets) {
        std::vector<std::filesystem::path> files;
        for (const auto& entry :
             std::filesystem::directory_iterator(std::filesystem::path(argv[1]) / name))
            files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        std::size_t accepted = 0;
        for (const auto& file : files) {
            // Named before it runs: what ends the program is the last one.
            std::cout << name << ' ' << file.filename().string() << std::endl;
            std::ifstream stream(file, std::ios::binary);
            const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
            if (target({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}))
                ++accepted;
        }
        // A target that refuses everything tries nothing.
        if (5 * accepted < files.size() || files.empty()) {
            std::cerr << name << " accepts " << accepted << " of " << files.size() << " files\n";
            return 1;
        }
    }
    return 0;
}
