#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "partition/io/fault_log.h"
#include "partition/io/output_file.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Reads what follows the line `OFF BINARY`: 32-bit integers and floats. Geomview writes them most significant byte
/// first and a number of colour components after each face, others the other way round or without: whichever of the
/// four fits the length of the file is taken.
/// @param path for messages only. @param faults see read_off.
/// @param file the whole file.
/// @param offset where the binary data begin.
/// @throws InputError naming the byte.
PolygonMesh read_binary_off(const std::filesystem::path& path, std::string_view file, std::size_t offset,
                            FaultLog* faults);

/// Writes such a file again, with the positions of `mesh`, rounded to floats; every other byte stays.
/// @param mesh with the faces of the file.
/// @returns whether rounding changed any coordinate.
/// @throws OutputError; also for coordinates beyond single precision.
bool rewrite_binary_off(OutputFile& output, std::string_view file, std::size_t offset, const PolygonMesh& mesh);

}  // namespace seamflow
