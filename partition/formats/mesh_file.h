#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "partition/polygon_mesh.h"

/// Kinds of mesh files.
namespace seamflow {

/// The file formats for reading and writing. All hold faces of any number of sides except STL and glTF (Glb, Gltf),
/// which hold triangles.
enum class FileFormat { Obj, Off, Ply, Stl, Glb, Gltf };

/// How the numbers of a file are stored. OBJ is always Ascii; so is OFF, except that write_mesh_like keeps binary OFF
/// binary; STL is Ascii or BinaryLittleEndian; glTF is always BinaryLittleEndian.
enum class Encoding { Ascii, BinaryLittleEndian, BinaryBigEndian };

/// Format and encoding of one file.
struct FileKind {
    FileFormat format = FileFormat::Obj;
    Encoding encoding = Encoding::Ascii;

    friend bool operator==(const FileKind&, const FileKind&) = default;
};

/// The properties of a format.
struct FormatTraits {
    FileFormat format;
    /// The name in messages.
    std::string_view name;
    /// The extension, in lower case.
    std::string_view extension;
    /// The first and the last encoding of the format, which also has those between them.
    Encoding first_encoding;
    Encoding last_encoding;
    /// Whether faces may have more than three sides.
    bool holds_polygons;
};

/// One for each FileFormat, in its order.
inline constexpr std::array<FormatTraits, 6> format_traits = {{
    {FileFormat::Obj, "OBJ", ".obj", Encoding::Ascii, Encoding::Ascii, true},
    {FileFormat::Off, "OFF", ".off", Encoding::Ascii, Encoding::Ascii, true},
    {FileFormat::Ply, "PLY", ".ply", Encoding::Ascii, Encoding::BinaryBigEndian, true},
    {FileFormat::Stl, "STL", ".stl", Encoding::Ascii, Encoding::BinaryLittleEndian, false},
    {FileFormat::Glb, "glTF", ".glb", Encoding::BinaryLittleEndian, Encoding::BinaryLittleEndian, false},
    {FileFormat::Gltf, "glTF", ".gltf", Encoding::BinaryLittleEndian, Encoding::BinaryLittleEndian, false},
}};

const FormatTraits& traits_of(FileFormat format);

/// A group of formats, for messages.
enum class FormatGroup {
    All,
    /// The formats whose faces may have any number of sides.
    Polygons,
    /// The formats that are always written as text.
    Text,
};

/// The extensions of the formats, for help and messages: ".obj, .off, .ply, .stl, .glb or .gltf".
std::string extensions_of(FormatGroup group = FormatGroup::All);

/// The format that the extension of a path names, in upper or lower case, perhaps followed by `.gz`; nothing if it
/// names none.
std::optional<FileFormat> format_of(const std::filesystem::path& path);

/// The extension of a format, such as ".obj".
std::string extension_of(FileFormat format);

/// A path without the extension of its format, and without `.gz` behind that.
std::filesystem::path before_extension(const std::filesystem::path& path);

/// The kind in which `path` is to be written: the format of its extension, in the encoding of `source` if that has the
/// same format, else binary little-endian where the format has it. For `-`, standard output, the kind of the source.
/// @throws OptionError for an extension that names no format.
FileKind kind_for_writing(const std::filesystem::path& path, const FileKind& source);

/// The format that the extension of a path to read names; nothing for a stream (see is_input_stream), whose content
/// tells.
/// @throws InputError naming the file if the extension names none.
std::optional<FileFormat> format_of_input(const std::filesystem::path& path);

/// "a, b or c".
std::string choice_of(const std::vector<std::string_view>& words);

/// A mesh file that was read, as the template for other files; see write_mesh_like.
class MeshSource;

/// A mesh together with the file it came from.
struct MeshFile {
    PolygonMesh mesh;
    FileKind kind;
    /// The file, which stays open, but not in memory, as long as a copy of this pointer exists.
    std::shared_ptr<const MeshSource> source = {};
};

/// A named number for each vertex of a mesh.
struct VertexValues {
    /// Letters, digits and underscores.
    std::string name;
    /// #V.
    std::vector<double> values;
};

/// A named whole number for each face of a mesh.
struct FaceNumbers {
    /// Letters, digits and underscores.
    std::string name;
    /// #F.
    std::vector<Index> values;
};

}  // namespace seamflow
