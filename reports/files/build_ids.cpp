#include "reports/files/build_ids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string_view>

#include <link.h>

namespace tvbeam {

namespace {

/// Elementary functions, transforms and rules, formulas. Others (one that counts allocations, say)
/// change no number.
constexpr std::array<std::string_view, 4> counted{"libm.so", "libgsl.so", "libginac.so",
                                                  "libcln.so"};

/// The build id among the notes of a segment; empty where there is none.
std::string build_id(const char* notes, std::size_t size, std::size_t alignment) {
    const auto padded = [alignment](std::size_t length) {
        return (length + alignment - 1) / alignment * alignment;
    };
    for (std::size_t at = 0; at + sizeof(ElfW(Nhdr)) <= size;) {
        ElfW(Nhdr) note;
        std::memcpy(&note, notes + at, sizeof note);
        const std::size_t name = at + sizeof note;
        const std::size_t content = name + padded(note.n_namesz);
        at = content + padded(note.n_descsz);
        if (at > size)
            break;
        if (note.n_type != NT_GNU_BUILD_ID ||
            std::string_view(notes + name, note.n_namesz) != std::string_view("GNU\0", 4))
            continue;
        std::string id;
        for (std::size_t i = 0; i < note.n_descsz; ++i)
            id += fmt::format("{:02x}", static_cast<unsigned char>(notes[content + i]));
        return id;
    }
    return {};
}

using Ids = std::vector<std::pair<std::string, std::string>>;

void add_object(const dl_phdr_info* object, Ids& ids) {
    // The program comes first, and without a name.
    const std::string name =
        ids.empty() ? "tvbeam" : std::filesystem::path(object->dlpi_name).filename().string();
    if (!ids.empty() && std::none_of(counted.begin(), counted.end(), [&](std::string_view library) {
            return name.starts_with(library);
        }))
        return;
    std::string id;
    for (int i = 0; i < object->dlpi_phnum && id.empty(); ++i)
        if (const auto& segment = object->dlpi_phdr[i]; segment.p_type == PT_NOTE)
            // NOLINTNEXTLINE(performance-no-int-to-ptr): that is how the loader says where it is
            id = build_id(reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr),
                          segment.p_memsz, std::max<std::size_t>(segment.p_align, 4));
    ids.emplace_back(name, id.empty() ? "unknown" : id);
}

struct Found {
    Ids ids;
    std::exception_ptr failure; ///< no exception passes through the C library
};

int visit(dl_phdr_info* object, std::size_t /*size*/, void* result) {
    auto& found = *static_cast<Found*>(result);
    try {
        add_object(object, found.ids);
    } catch (...) {
        found.failure = std::current_exception();
    }
    return found.failure ? 1 : 0;
}

} // namespace

std::vector<std::pair<std::string, std::string>> build_ids() {
    Found found;
    dl_iterate_phdr(&visit, &found);
    if (found.failure)
        std::rethrow_exception(found.failure);
    return found.ids;
}

} // namespace tvbeam
