#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace seamflow {

/// Whether these bytes begin like a gzip file.
inline bool is_gzip(std::string_view bytes)
{
    return bytes.starts_with("\x1f\x8b");
}

/// Whether a file of this name is to be packed: its extension is `.gz`, in upper or lower case.
bool is_gzip_name(const std::filesystem::path& path);

/// Unpacks a gzip file of one or several members.
/// @param path for messages only. @param take called with unpacked data, piece by piece.
/// @throws InputError if the file is damaged or cut off, or if the result is implausibly large.
void unpack_gzip(const std::filesystem::path& path, std::string_view packed,
                 const std::function<void(std::string_view piece)>& take);

/// A piece of a gzip file, packed independently of other pieces.
struct PackedPiece {
    std::string bytes;
    /// The checksum and the number of the unpacked bytes.
    std::uint32_t checksum = 0;
    std::size_t size = 0;
};

PackedPiece pack_piece(std::string_view bytes);

/// The single member of a gzip file assembled from pieces.
class GzipMember {
  public:
    /// The bytes before the first piece.
    [[nodiscard]] static std::string_view head();

    /// To be called with every piece, in order.
    void add(const PackedPiece& piece);

    /// The bytes after the last piece.
    [[nodiscard]] std::string tail() const;

  private:
    std::uint32_t checksum_ = 0;
    std::size_t size_ = 0;
};

}  // namespace seamflow
