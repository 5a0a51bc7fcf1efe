#include "partition/io/gzip.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "partition/errors.h"
#include "partition/io/byte_order.h"
#include "partition/text.h"

namespace seamflow {

namespace {

/// The largest ratio of unpacked to packed size that is accepted: deflate packs to a thousandth at most, meshes in text
/// to about a twentieth. Small files are unpacked in any case.
constexpr std::size_t plausible_ratio = 250;
constexpr std::size_t always_plausible = std::size_t{1} << 26;

/// The state of zlib, freed on destruction.
using OpenStream = std::unique_ptr<z_stream, int (*)(z_streamp)>;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& complaint)
{
    throw InputError(fmt::format("{}: {}", path.string(), complaint));
}

/// Unpacks one member.
/// @returns the number of its bytes in `packed`.
std::size_t unpack_member(const std::filesystem::path& path, std::string_view packed,
                          const std::function<void(std::string_view piece)>& take)
{
    constexpr int gzip_format = 16;
    z_stream stream = {};
    if (::inflateInit2(&stream, MAX_WBITS + gzip_format) != Z_OK)
        throw std::bad_alloc();
    const OpenStream open(&stream, ::inflateEnd);
    std::vector<char> piece(std::size_t{1} << 18);
    std::size_t n_fed = 0;
    for (int status = Z_OK; status != Z_STREAM_END;) {
        if (stream.avail_in == 0) {
            const std::size_t n = std::min<std::size_t>(packed.size() - n_fed, std::numeric_limits<uInt>::max());
            if (n == 0)
                refuse(path, "the compressed data end too early; the file has been cut off: copy it again");
            stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data())) + n_fed;
            stream.avail_in = static_cast<uInt>(n);
            n_fed += n;
        }
        stream.next_out = reinterpret_cast<Bytef*>(piece.data());
        stream.avail_out = static_cast<uInt>(piece.size());
        status = ::inflate(&stream, Z_NO_FLUSH);
        if (status == Z_MEM_ERROR)
            throw std::bad_alloc();
        if (status != Z_OK && status != Z_STREAM_END)
            refuse(path, fmt::format("the compressed data are damaged ({}); copy or compress the file again",
                                     stream.msg != nullptr ? stream.msg : "no gzip data"));
        take({piece.data(), piece.size() - stream.avail_out});
    }
    return n_fed - stream.avail_in;
}

}  // namespace

bool is_gzip_name(const std::filesystem::path& path)
{
    return lower_case(path.extension().string()) == ".gz";
}

void unpack_gzip(const std::filesystem::path& path, std::string_view packed,
                 const std::function<void(std::string_view piece)>& take)
{
    const std::size_t most = std::max(always_plausible, plausible_ratio * packed.size());
    std::size_t n_unpacked = 0;
    const auto take_plausible = [&](std::string_view piece) {
        n_unpacked += piece.size();
        if (n_unpacked > most)
            refuse(path, fmt::format("the compressed data grow to more than {} times their size, as no mesh does; if "
                                     "they are one, unpack them with gunzip",
                                     most / packed.size()));
        take(piece);
    };
    do
        packed.remove_prefix(unpack_member(path, packed, take_plausible));
    while (is_gzip(packed));
    if (packed.find_first_not_of('\0') != std::string_view::npos)
        refuse(path, "something else follows the compressed data; copy or compress the file again");
}

PackedPiece pack_piece(std::string_view bytes)
{
    constexpr int level = 4;
    constexpr int without_header = -MAX_WBITS;
    constexpr int memory = 8;
    z_stream stream = {};
    if (::deflateInit2(&stream, level, Z_DEFLATED, without_header, memory, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    const OpenStream open(&stream, ::deflateEnd);
    PackedPiece piece{.bytes = {}, .checksum = 0, .size = bytes.size()};
    piece.checksum =
        static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
    // A flush adds at most 6 bytes.
    piece.bytes.resize(::deflateBound(&stream, bytes.size()) + 6);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(piece.bytes.data());
    stream.avail_out = static_cast<uInt>(piece.bytes.size());
    // The piece is flushed to whole bytes, without an end, because other pieces follow.
    ::deflate(&stream, Z_FULL_FLUSH);
    piece.bytes.resize(piece.bytes.size() - stream.avail_out);
    return piece;
}

std::string_view GzipMember::head()
{
    // The header: deflate, no name, no time, made on Unix.
    constexpr std::string_view bytes("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03", 10);
    return bytes;
}

void GzipMember::add(const PackedPiece& piece)
{
    checksum_ =
        static_cast<std::uint32_t>(::crc32_combine(checksum_, piece.checksum, static_cast<z_off_t>(piece.size)));
    size_ += piece.size;
}

std::string GzipMember::tail() const
{
    // The tail: an empty final block, the checksum, and the size modulo 2^32.
    std::string bytes("\x03\x00", 2);
    for (const std::uint32_t number : {checksum_, static_cast<std::uint32_t>(size_)}) {
        const auto of_number = to_bytes(number, std::endian::little);
        bytes.append(of_number.data(), of_number.size());
    }
    return bytes;
}

}  // namespace seamflow
