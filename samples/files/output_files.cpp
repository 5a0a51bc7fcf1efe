#include "samples/files/output_files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "partition/errors.h"
#include "partition/io/gzip.h"
#include "partition/io/input_file.h"
#include "partition/io/output_file.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, std::string_view reason)
{
    throw OutputError(path.string() + ": cannot be written: " + std::string(reason));
}

fs::path directory_of(const fs::path& path)
{
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

bool has_isolated_vertices(const PolygonMesh& mesh)
{
    std::vector<bool> used(static_cast<std::size_t>(mesh.n_vertices()), false);
    for (const Index v : mesh.face_vertices)
        used[static_cast<std::size_t>(v)] = true;
    return std::find(used.begin(), used.end(), false) != used.end();
}

}  // namespace

void require_writable(const fs::path& path)
{
    if (is_standard_stream(path))
        return;
    std::error_code ignored;
    const fs::path directory = directory_of(file_behind(path));
    if (path.empty() || fs::is_directory(path, ignored))
        refuse(path, "it is a directory");
    if (!fs::is_directory(directory, ignored))
        refuse(path, "there is no directory " + directory.string());
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
        refuse(path, "it is a device or a pipe");
    if (access(directory.c_str(), W_OK | X_OK) != 0)
        refuse(path, "its directory is not writable: " + std::string(std::strerror(errno)));
}

void require_different(const std::vector<fs::path>& paths)
{
    std::set<fs::path> places;
    for (const fs::path& path : paths) {
        std::error_code error;
        // Made absolute first: a relative path of which nothing exists yet would only be compared as text.
        fs::path place = fs::weakly_canonical(fs::absolute(path), error);
        if (!places.insert(error ? fs::absolute(path).lexically_normal() : place).second)
            throw OptionError(path.string() + " is named for two different files: give each a name of its own");
    }
}

void require_files(const std::vector<fs::path>& paths)
{
    for (const fs::path& path : paths)
        if (is_standard_stream(path))
            throw OptionError("- means standard input or output, for one mesh to read and one to write only: name "
                              "files for the others");
}

void require_storable(const PolygonMesh& mesh, const fs::path& path, const FileKind& kind)
{
    const FormatTraits& format = traits_of(kind.format);
    if (format.holds_polygons)
        return;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (mesh.face(f).size() > 3)
            refuse(path, fmt::format("{} holds triangles only, and face {} has {} sides; choose {}", format.name, f,
                                     mesh.face(f).size(), extensions_of(FormatGroup::Polygons)));
    if (kind.format == FileFormat::Stl && has_isolated_vertices(mesh))
        refuse(path, "STL cannot hold vertices without faces; choose " + extensions_of(FormatGroup::Polygons));
}

namespace {

/// The bytes of a result: as many as the input has, if it is of the same kind, else what the shortest of formats takes.
std::size_t expected_bytes(const fs::path& path, const MeshFile& file, const fs::path& input)
{
    std::error_code error;
    if (!is_input_stream(input) && is_gzip_name(path) == is_gzip_name(input) &&
        kind_for_writing(path, file.kind).format == file.kind.format)
        if (const std::uintmax_t of_input = fs::file_size(input, error); !error)
            return static_cast<std::size_t>(of_input);
    constexpr std::size_t of_vertex = 12;
    constexpr std::size_t of_corner = 2;
    const std::size_t plain = of_vertex * static_cast<std::size_t>(file.mesh.n_vertices()) +
                              of_corner * static_cast<std::size_t>(file.mesh.n_corners());
    constexpr std::size_t most_packed = 10;
    return is_gzip_name(path) ? plain / most_packed : plain;
}

}  // namespace

ReservedRoom::ReservedRoom(const fs::path& path, const MeshFile& file, const fs::path& input)
{
    const auto bytes = static_cast<off_t>(expected_bytes(path, file, input));
    if (is_standard_stream(path) || bytes == 0)
        return;
    descriptor_ = ::open(directory_of(file_behind(path)).c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0600);
    if (descriptor_ < 0 || ::fallocate(descriptor_, 0, 0, bytes) == 0)
        return;
    const int reason = errno;
    give_back();
    if (reason == ENOSPC || reason == EDQUOT)
        fail_to_write(path, reason);
}

void ReservedRoom::give_back()
{
    if (descriptor_ >= 0)
        ::close(std::exchange(descriptor_, -1));
}

void write_text(const fs::path& path, const std::string& text)
{
    OutputFile file(path);
    file.text(text);
    file.commit();
}

}  // namespace seamflow
