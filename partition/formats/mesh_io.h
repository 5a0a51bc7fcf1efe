#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "partition/executor.h"
#include "partition/formats/file_fields.h"
#include "partition/formats/mesh_file.h"
#include "partition/formats/palette.h"
#include "partition/io/fault_log.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Reads OBJ, OFF, PLY, STL or glTF; the format follows from the extension (upper or lower case), the encoding from the
/// file itself. Coordinates are read in double precision, correctly rounded. Corners of STL facets with equal
/// coordinates become one vertex, numbered in order of appearance. Content besides the surface (texture coordinates,
/// normals, colours, materials, groups, points and lines) is skipped here, but write_mesh_like copies it. A file with
/// vertices but without faces is read. The file stays open (see MeshFile::source), but its content is not kept in
/// memory. A file compressed by gzip is unpacked, whatever its name; `.gz` may follow the extension. `-` is standard
/// input, whose format is recognised from its content. Only these two, and glTF files with buffers in other files or in
/// their text, are kept, unpacked, in memory.
/// @param exec runs the work on slices; seamflow::run_in_parallel uses all threads. Here and in the functions below,
///        the result never depends on it.
/// @throws InputError naming file, line or byte or element, reason and remedy; no part of the surface is skipped
///         silently. Among the reasons: an unknown extension, a file that cannot be opened, no vertices, a coordinate
///         that is not finite, a face of less than three corners or one that names a vertex twice.
/// @throws ComputationError naming the file, or std::bad_alloc, if there is not enough memory.
MeshFile read_mesh(const std::filesystem::path& path, const Executor& exec = run_serially);

/// Reads a mesh as far as possible, to find what is wrong with it: vertices whose coordinates are not finite are kept,
/// faces that cannot be used are left out, and `faults` reports both with line, byte or element. With
/// FaultLog::of_faces_alone, only faces of fewer than three corners or with a repeated vertex are left out, and excess
/// numbers in rows are skipped; all else is thrown as by read_mesh, and the result has a source, in which such faces
/// and numbers stay.
/// @throws InputError where reading cannot go on: as read_mesh for files that are no mesh or are cut off.
MeshFile read_faulty_mesh(const std::filesystem::path& path, FaultLog& faults, const Executor& exec = run_serially);

/// Writes a mesh. Text formats use the fewest digits (at most 17) that read back to the same double; binary PLY stores
/// doubles; binary STL stores floats, as its format demands. The file appears whole or not at all: it gets its name
/// only when it is complete (see OutputFile). It is compressed where `.gz` follows the extension. `-` is standard
/// output.
/// @param mesh valid (see require_valid), with vertices.
/// @throws OutputError naming the file; also for a mesh that is not valid or that the format cannot hold (STL: faces of
///         more than three sides, vertices without faces, and in binary files coordinates beyond single precision;
///         glTF: faces of more than three sides, no faces, coordinates beyond single precision, and more than 4 GiB).
/// @throws OptionError for an encoding that the format does not have.
/// @returns remarks for the user, in sentences: facets of STL that have become lines.
std::vector<std::string> write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh, const FileKind& kind,
                                    const Executor& exec = run_serially);

/// Writes the file that was read with the positions of `mesh` in place of its own: texture coordinates, materials,
/// groups, colours, comments, further elements and properties, their order, and the line ends stay byte for byte, as do
/// the digits of every coordinate that is bitwise equal. Normals are updated to the new surface where possible: normals
/// of the vertices of PLY and OFF files, and those of an OBJ file that belong to one vertex or to one face. Kind and
/// types are those of the file: floats in a binary file mean rounding; whole numbers become doubles. Buffers of a glTF
/// file that are in other files are written beside the result, to files of new names (see rewrite_gltf). Facets of STL
/// files that thereby become lines stay. The file may be written over itself.
/// @param mesh with as many vertices as the file and the same faces.
/// @param seam_distance across seams of this width (see weld), in length, shading that was continuous stays so.
/// @returns remarks for the user, in sentences: normals that could not be updated, rounding.
/// @throws OutputError naming the file; also if the mesh does not fit the file that was read.
/// @throws InputError if that file has been changed in place since. Replacing or removing it does not matter.
std::vector<std::string> write_mesh_like(const MeshSource& source, const std::filesystem::path& path,
                                         const PolygonMesh& mesh, const Executor& exec = run_serially,
                                         double seam_distance = 0.0);

/// Reads numbers of the vertices besides positions from a file that was read.
///
/// - PLY: any property of the vertices that is one number, of any type. NaN means that a vertex has no data. `normal`
///   stands for nx, ny and nz, and `colour` or `color` for red, green and blue.
/// - OBJ: the three or four numbers behind the coordinates: red, green, blue, alpha.
/// - OFF: the same names, in text whose keyword announces colours (COFF, CNOFF, …).
///
/// @param names of the fields; the result has each once, in this order.
/// @throws InputError naming file and line or element: no field of that name, a vertex without it, an infinite number;
///         also for x, y and z, for other formats, and if the file has been changed since it was read.
FileFields read_fields(const MeshSource& source, std::span<const std::string> names,
                       const Executor& exec = run_serially);

/// Writes the file that was read with other positions, as above, and with other numbers of the vertices. A field
/// replaces that of its name; every number that is equal, and all else, stays byte for byte.
///
/// - In a PLY file types stay. Whole numbers are rounded to the nearest, and those beyond the range of their type
///   become its least or largest number. Only floats that single precision cannot hold become doubles. Fields that the
///   file lacks are added as properties (double), last in each vertex. Normals nx, ny, nz that are fields are not
///   updated to the surface.
/// - Colours in OBJ and OFF files are written as whole numbers from 0 to 255 (or to the largest of the file) if all
///   those of the file are whole and one exceeds 1, else in single precision.
///
/// @param fields finite, except that floats and new properties may be NaN.
/// @returns remarks; also for numbers beyond the range of their type.
/// @throws OutputError also for a field that the format cannot hold, with a remedy.
/// @throws InputError also naming the line where a colour is missing.
std::vector<std::string> write_mesh_like(const MeshSource& source, const std::filesystem::path& path,
                                         const PolygonMesh& mesh, const FileFields& fields,
                                         const Executor& exec = run_serially, double seam_distance = 0.0);

/// As write_mesh, with numbers of the vertices as properties (double) of a PLY file. Colours that were read from an OBJ
/// or OFF file become red, green and blue (uchar).
/// @param fields not infinite.
/// @throws OutputError also for other formats if there are fields.
std::vector<std::string> write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh, const FileKind& kind,
                                    const FileFields& fields, const Executor& exec = run_serially);

/// File content besides the surface, which write_mesh does not write, in a few words each: "normals", "groups".
/// Comments do not count.
/// @throws InputError if the file has been changed since it was read.
std::vector<std::string> extras_of(const MeshSource& source, const Executor& exec = run_serially);

/// As write_mesh, with one colour and one label per face, for viewing a cut. Each face gets the properties red, green,
/// blue (uchar) and label (int). The colours of labels 0, 1, 2, … go round the circle of hues in steps of the golden
/// section, so that they differ clearly; negative labels are grey. The file is binary little-endian.
/// @param labels #F; the label of every face.
/// @throws OutputError naming the file.
void write_labelled_ply(const std::filesystem::path& path, const PolygonMesh& mesh, std::span<const Index> labels,
                        const Executor& exec = run_serially);

/// As write_mesh, with whole numbers for each face, one property (int) for each of `numbers`, under its name. The file
/// is binary little-endian.
/// @throws OutputError naming the file; also if there are not as many numbers as faces.
void write_numbered_ply(const std::filesystem::path& path, const PolygonMesh& mesh,
                        std::span<const FaceNumbers> numbers, const Executor& exec = run_serially);

/// As write_mesh, with one colour and any numbers per vertex, for viewing measurements. Each vertex gets the properties
/// red, green, blue (uchar) and one property (double) for each of `values`, under its name. The file is binary
/// little-endian.
/// @param colours #V.
/// @throws OutputError naming the file; also if there are not as many colours or values as vertices.
void write_valued_ply(const std::filesystem::path& path, const PolygonMesh& mesh, std::span<const Colour> colours,
                      std::span<const VertexValues> values, const Executor& exec = run_serially);

}  // namespace seamflow
