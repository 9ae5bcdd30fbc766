#include "studies/external/digest.hpp"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>

#include <cstddef>
#include <fstream>

namespace tvbeam {

std::string digest(const std::string& text) {
    const boost::uuids::name_generator_sha1 name(boost::uuids::ns::oid());
    return to_string(name(text));
}

std::string digest(const std::filesystem::path& file) {
    constexpr std::size_t largest_piece = std::size_t{1} << 20U;
    std::ifstream stream(file, std::ios::binary);
    std::string piece(largest_piece, '\0');
    boost::uuids::uuid id = boost::uuids::ns::oid();
    do { // each piece is named within the one before
        stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        const boost::uuids::name_generator_sha1 name(id);
        id = name(piece.data(), static_cast<std::size_t>(stream.gcount()));
    } while (stream);
    return to_string(id);
}

} // namespace tvbeam
