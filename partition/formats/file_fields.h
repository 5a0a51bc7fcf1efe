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

/// The ends of the whole numbers that a field of a file can hold.
struct WholeRange {
    double least = 0.0;
    double largest = 0.0;
};

/// How a file holds numbers that need not be whole.
enum class Decimals {
    Double,
    /// In four bytes.
    Single,
    /// As the shortest text that reads back to the same number in single precision.
    SingleText
};

/// Numbers of the vertices of a file besides their positions, such as colours, normals or measurements.
struct FileFields {
    /// One for each column, each once.
    std::vector<std::string> names = {};
    /// #V by names. NaN means that a vertex has no data.
    Eigen::MatrixXd values = {};
    /// Of fields that were read, one for each column: nothing where its numbers need not be whole.
    std::vector<std::optional<WholeRange>> whole = {};
    /// The same where they need not be.
    std::vector<Decimals> decimals = {};

    /// The column of that name; -1 if there is none.
    [[nodiscard]] Index column(std::string_view name) const;
};

/// Rounds the values of fields that were read as write_mesh_like does: whole numbers to the nearest within their range,
/// others to single precision where the file has them in that. Reading the result gives these numbers.
/// @param extremes n by columns: among them the least and the largest of each column in the whole file. Where single
///        precision cannot hold them, they are written as doubles.
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
