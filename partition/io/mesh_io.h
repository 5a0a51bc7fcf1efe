#pragma once

#include <filesystem>

#include "partition/polygon_mesh.h"

namespace seamflow
{

/// The file formats that can be read and written. All hold faces of any number of sides but STL, which holds triangles.
enum class FileFormat { Obj, Off, Ply, Stl };

/// How the numbers of a file are stored. OBJ and OFF are always Ascii; STL is Ascii or BinaryLittleEndian.
enum class Encoding { Ascii, BinaryLittleEndian, BinaryBigEndian };

/// Format and encoding of one file.
struct FileKind {
    FileFormat format = FileFormat::Obj;
    Encoding encoding = Encoding::Ascii;

    friend bool operator==(const FileKind&, const FileKind&) = default;
};

/// A mesh together with the kind of file it came from.
struct MeshFile {
    PolygonMesh mesh;
    FileKind kind;
};

/// Reads OBJ, OFF, PLY or STL; the format follows from the extension (upper or lower case), the encoding from the file
/// itself. Coordinates are read in double precision, correctly rounded. Corners of STL facets with equal coordinates
/// become one vertex, numbered in order of appearance.
/// @throws InputError naming file, line or byte or element, reason and remedy; nothing is skipped in silence.
MeshFile read_mesh(const std::filesystem::path& path);

/// The kind in which `path` is to be written: the format of its extension, in the encoding of `source` if that has the
/// same format, else binary little-endian where the format has it.
/// @throws OptionError for an extension that is none of .obj, .off, .ply, .stl.
FileKind kind_for_writing(const std::filesystem::path& path, const FileKind& source);

/// Writes a mesh. Text formats use the fewest digits (at most 17) that read back to the same double; binary PLY stores
/// doubles; binary STL stores floats, as its format demands. The file appears whole or not at all: it is written under
/// a temporary name beside `path` and renamed.
/// @throws OutputError naming the file; also for a mesh that the format cannot hold (STL: faces of more than three
///         sides, vertices without faces).
void write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh, const FileKind& kind);

/// As above, with one colour and one label per face, for looking at a cut. Each face gets the properties red, green,
/// blue (uchar) and label (int).
/// @param labels #F; the label of every face.
/// @throws OutputError naming the file.
void write_labelled_ply(const std::filesystem::path& path, const PolygonMesh& mesh, std::span<const Index> labels);

}  // namespace seamflow
