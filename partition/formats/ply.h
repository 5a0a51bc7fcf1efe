#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partition/formats/file_fields.h"
#include "partition/formats/mesh_file.h"
#include "partition/formats/palette.h"
#include "partition/formats/ply_header.h"
#include "partition/io/fault_log.h"
#include "partition/io/output_file.h"
#include "partition/io/slices.h"

namespace seamflow {

/// Reads PLY in any of its three encodings: x, y and z of the element `vertex`, of any types and in any order, and the
/// list `vertex_indices` or `vertex_index` of the elements `face`, or of triangle strips in the element `tristrips`.
/// Other properties and other elements, edges among them, are passed over. In a text file each element stands on a line
/// of its own; if the number of lines is another, line ends count as blanks. After the last element of a binary file
/// only padding (zeros, blanks, line ends) is accepted.
/// @param path for messages only. @param faults if not null, collects faults instead of throwing.
/// @throws InputError naming the line, or the element and its byte.
MeshFile read_ply(const std::filesystem::path& path, std::string_view file, const Slicing& slicing,
                  FaultLog* faults = nullptr);

/// A number for each vertex, with a name. The numbers are owned elsewhere.
struct NamedColumn {
    std::string_view name;
    /// #V.
    std::span<const double> values;
};

/// Content of a PLY file besides the mesh; an empty member is not written.
struct PlyExtras {
    /// #F; each face also gets the properties red, green, blue (uchar) and label (int).
    std::span<const Index> face_labels = {};
    /// #F numbers each; each face gets a property (int) for each of them.
    std::span<const FaceNumbers> face_numbers = {};
    /// #V; each vertex also gets the properties red, green, blue (uchar).
    std::span<const Colour> vertex_colours = {};
    /// Each vertex gets a property (double) for each of them.
    std::span<const NamedColumn> vertex_values = {};
};

/// Writes PLY: coordinates as double, faces as `list uchar int`, or `list int int` if one has more than 255 sides.
/// @throws OutputError
void write_ply(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, const Slicing& slicing,
               const PlyExtras& extras = {});

/// Writes PLY with fields: fields that were read as colours become red, green and blue (uchar), others double.
void write_ply(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, const Slicing& slicing,
               const FileFields& fields);

/// The precision in which a property of the vertices holds numbers. Double for whole numbers, whose precision does not
/// matter.
Decimals decimals_of(PlyType type, Encoding encoding);

/// Reads properties of the vertices of a file read by `read_ply`; see read_fields.
/// @param path for messages only.
/// @throws InputError naming the line, or the element and its byte.
FileFields read_ply_fields(const std::filesystem::path& path, std::string_view content,
                           std::span<const std::string> names, const Slicing& slicing);

/// Rewrites a file read by `read_ply`, with the positions of `mesh` and with fields in place of the properties of their
/// names, or as new properties; see write_mesh_like. The properties nx, ny, nz of the vertices, if they are float or
/// double and no fields, become the normals of the surface; everything else stays byte for byte, as do bitwise equal
/// numbers in text. Coordinates keep their type, which may mean rounding to float; where it cannot hold the results
/// (whole numbers, or beyond single precision) it becomes double.
/// @param path of the content, for messages only. @param mesh with the faces of the file.
/// @param seam_distance across seams of this width (see weld), in length, shading that was continuous stays so.
/// @returns remarks for the user, in sentences.
/// @throws OutputError
std::vector<std::string> rewrite_ply(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh, const Slicing& slicing, const FileFields& fields = {},
                                     double seam_distance = 0.0);

}  // namespace seamflow
