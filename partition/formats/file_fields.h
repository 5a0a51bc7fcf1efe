#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/index.h"

namespace seamflow {

/// The smallest and the largest whole number that a field of a file can hold.
struct WholeRange {
    double least = 0.0;
    double largest = 0.0;
};

/// The precision in which a file holds numbers that need not be whole.
enum class Decimals {
    Double,
    /// Four bytes.
    Single,
    /// The shortest text that reads back to the same number in single precision.
    SingleText
};

/// Numbers of the vertices of a file besides their positions, such as colours, normals or measurements.
struct FileFields {
    /// The name of each column; no name occurs twice.
    std::vector<std::string> names = {};
    /// #V by names. NaN means that a vertex has no data.
    Eigen::MatrixXd values = {};
    /// Only for fields that were read, one per column: the range of its numbers if they must be whole; otherwise
    /// nothing.
    std::vector<std::optional<WholeRange>> whole = {};
    /// Only for fields that were read, one per column: the precision of its numbers if they need not be whole.
    std::vector<Decimals> decimals = {};

    /// The column of a name; -1 if there is none.
    [[nodiscard]] Index column(std::string_view name) const;
};

/// Rounds the values of fields that were read as write_mesh_like does: whole numbers to the nearest within their range,
/// others to single precision if the file has them in that precision. Reading the written file gives these numbers.
/// @param extremes n by columns: the least and the largest value of each column in the whole file are among the rows.
///        If single precision cannot hold them, values are written as doubles.
void round_as_written(FileFields& fields, const Eigen::MatrixXd& extremes, const Executor& exec);

/// The names of fields, each once, with nx, ny, nz for `normal`, and red, green, blue for `colour` or `color`.
/// @param is_there whether the file itself has a field of that name, which then is meant.
/// @throws InputError naming the file for x, y and z, which are no fields.
std::vector<std::string> names_of_fields(const std::filesystem::path& path, std::span<const std::string> names,
                                         const std::function<bool(std::string_view name)>& is_there);

/// Checks that fields can be written: one number for each vertex, none infinite; names that are one word each in any
/// characters, all different, and none a coordinate.
/// @param path of the file to write.
/// @throws OutputError
void require_writable(const std::filesystem::path& path, const FileFields& fields, Index n_vertices,
                      const Executor& exec);

}  // namespace seamflow
