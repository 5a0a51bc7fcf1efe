#include "partition/formats/mesh_io.h"

#include <algorithm>
#include <array>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/gltf.h"
#include "partition/formats/mesh_source.h"
#include "partition/formats/obj.h"
#include "partition/formats/off.h"
#include "partition/formats/ply.h"
#include "partition/formats/stl.h"
#include "partition/io/input_file.h"
#include "partition/io/output_file.h"
#include "partition/io/slices.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

namespace {

/// The functions that read and write a format.
struct Format {
    MeshFile (*read)(const std::filesystem::path& path, std::string_view content, const Slicing& slicing,
                     FaultLog* faults);
    /// Throws OutputError for a mesh that the format cannot hold, and returns remarks for the user; null if the format
    /// can hold every mesh.
    std::vector<std::string> (*require_fits)(const std::filesystem::path& path, const PolygonMesh& mesh,
                                             Encoding encoding);
    void (*write)(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, const Slicing& slicing);
    /// Writes the file that was read with other positions and fields (see write_mesh_like), and returns remarks for the
    /// user.
    std::vector<std::string> (*rewrite)(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                        const PolygonMesh& mesh, const Slicing& slicing, const FileFields& fields,
                                        double seam_distance);
    /// Reads numbers of the vertices besides positions (see mesh_io.h); null if the format has no fields.
    FileFields (*read_fields)(const std::filesystem::path& path, std::string_view content,
                              std::span<const std::string> names, const Slicing& slicing);
    /// Names the content besides the surface (see extras_of).
    std::vector<std::string> (*extras)(const std::filesystem::path& path, std::string_view content,
                                       const Slicing& slicing);
    /// The file together with other files that belong to it, or nothing if there are none; null if the format has no
    /// such files.
    std::optional<OpenFile> (*with_others)(const OpenFile& file, std::string_view content) = nullptr;
};

/// @tparam Kind Glb or Gltf.
template <FileFormat Kind>
constexpr Format gltf_functions = {
    .read = [](const std::filesystem::path& path, std::string_view content, const Slicing& slicing,
               FaultLog* faults) -> MeshFile {
        return {read_gltf(path, content, slicing, faults), {Kind, Encoding::BinaryLittleEndian}};
    },
    .require_fits =
        [](const std::filesystem::path& path, const PolygonMesh& mesh, Encoding) {
            require_fits_gltf(path, mesh);
            return std::vector<std::string>();
        },
    .write = [](OutputFile& file, const PolygonMesh& mesh, Encoding,
                const Slicing& slicing) { write_gltf(file, mesh, Kind, slicing); },
    .rewrite = [](OutputFile& file, const std::filesystem::path& path, std::string_view content,
                  const PolygonMesh& mesh, const Slicing& slicing, const FileFields&,
                  double seam_distance) { return rewrite_gltf(file, path, content, mesh, slicing, seam_distance); },
    .read_fields = nullptr,
    .extras = [](const std::filesystem::path& path, std::string_view content,
                 const Slicing&) { return extras_of_gltf(path, content); },
    .with_others = with_gltf_buffers,
};

/// One for each FileFormat, in its order.
constexpr std::array<Format, 6> all_formats = {{
    {.read = [](const std::filesystem::path& path, std::string_view content, const Slicing& slicing,
                FaultLog* faults) -> MeshFile {
         return {read_obj(path, content, slicing, faults), {FileFormat::Obj, Encoding::Ascii}};
     },
     .require_fits = nullptr,
     .write = [](OutputFile& file, const PolygonMesh& mesh, Encoding,
                 const Slicing& slicing) { write_obj(file, mesh, slicing); },
     .rewrite = rewrite_obj,
     .read_fields = read_obj_fields,
     .extras = extras_of_obj},
    {.read = [](const std::filesystem::path& path, std::string_view content, const Slicing& slicing,
                FaultLog* faults) -> MeshFile {
         return {read_off(path, content, slicing, faults), {FileFormat::Off, Encoding::Ascii}};
     },
     .require_fits = nullptr,
     .write = [](OutputFile& file, const PolygonMesh& mesh, Encoding,
                 const Slicing& slicing) { write_off(file, mesh, slicing); },
     .rewrite = rewrite_off,
     .read_fields = read_off_fields,
     .extras = [](const std::filesystem::path& path, std::string_view content,
                  const Slicing&) { return extras_of_off(path, content); }},
    {.read = read_ply,
     .require_fits = nullptr,
     .write = [](OutputFile& file, const PolygonMesh& mesh, Encoding encoding,
                 const Slicing& slicing) { write_ply(file, mesh, encoding, slicing); },
     .rewrite = rewrite_ply,
     .read_fields = read_ply_fields,
     .extras = [](const std::filesystem::path& path, std::string_view content,
                  const Slicing&) { return extras_of_ply(path, content); }},
    {.read = read_stl,
     .require_fits = require_fits_stl,
     .write = write_stl,
     .rewrite = [](OutputFile& file, const std::filesystem::path& path, std::string_view content,
                   const PolygonMesh& mesh, const Slicing& slicing, const FileFields&,
                   double) { return rewrite_stl(file, path, content, mesh, slicing); },
     .read_fields = nullptr,
     .extras = extras_of_stl},
    gltf_functions<FileFormat::Glb>,
    gltf_functions<FileFormat::Gltf>,
}};

/// Recognises the format of content without a file name. OBJ has no signature.
FileFormat recognised_format(std::string_view content)
{
    if (content.starts_with("glTF"))
        return FileFormat::Glb;
    constexpr std::size_t head = 4096;
    TextScanner scanner({}, content.substr(0, head));
    const std::string_view word = scanner.next_line() ? scanner.token() : std::string_view();
    if (word == "ply")
        return FileFormat::Ply;
    if (is_stl(content))
        return FileFormat::Stl;
    if (word.starts_with('{'))
        return FileFormat::Gltf;
    return word.ends_with("OFF") ? FileFormat::Off : FileFormat::Obj;
}

/// Says of content that cannot be read, and has the signature of another format than its file's extension names, that
/// it has this format. OBJ has no signature, and .glb and .gltf may hold either form of glTF.
/// @param found see recognised_format.
void require_content_of(FileFormat format, FileFormat found, const std::filesystem::path& path)
{
    if (found == FileFormat::Obj || traits_of(found).name == traits_of(format).name)
        return;
    const char* const packed = path.extension() == ".gz" ? ".gz" : "";
    throw InputError(fmt::format("{}: this is no {} file, but has the format {}; give it the extension {}{}",
                                 path.string(), traits_of(format).name, traits_of(found).name, extension_of(found),
                                 packed));
}

const Format& functions_of(FileFormat format)
{
    return all_formats[static_cast<std::size_t>(format)];
}

/// Reads the mesh from the content of a file.
/// @param open the file, with all files that belong to it. @param input its content.
/// @param faults null: faults are thrown. With faults other than those of faces, the file is not a source for others.
MeshFile read_whole(OpenFile open, const InputFile& input, FileFormat format, const Executor& exec, FaultLog* faults)
{
    MeshFile file = functions_of(format).read(open.path(), input.content(), {exec}, faults);
    if (faults == nullptr || faults->of_faces_alone)
        file.source = std::make_shared<MeshSource>(std::move(open), input.content(), file.mesh, file.kind, exec);
    return file;
}

/// Reads a file that is open, of this format.
MeshFile read_open(OpenFile open, const InputFile& input, FileFormat format, const Executor& exec, FaultLog* faults)
{
    if (const auto with_others = functions_of(format).with_others; with_others != nullptr)
        if (auto all = with_others(open, input.content())) {
            const InputFile content(*all);
            return read_whole(std::move(*all), content, format, exec, faults);
        }
    return read_whole(std::move(open), input, format, exec, faults);
}

/// Finds the format and reads; a lack of memory is reported with the name of the file.
MeshFile read(const std::filesystem::path& path, const Executor& exec, FaultLog* faults)
{
    const std::optional<FileFormat> named = format_of_input(path);
    try {
        OpenFile open(path);
        const InputFile input(open);
        const FileFormat found = recognised_format(input.content());
        try {
            return read_open(std::move(open), input, named.value_or(found), exec, faults);
        } catch (const InputError&) {
            if (named)
                require_content_of(*named, found, path);
            throw;
        }
    } catch (const std::bad_alloc&) {
        throw ComputationError(path.string() +
                               ": there is not enough memory for this mesh; close other programs, raise "
                               "the limit of this one (ulimit -v), or use a machine with more");
    }
}

void require_encoding(const FileKind& kind)
{
    const FormatTraits& format = traits_of(kind.format);
    if (kind.encoding >= format.first_encoding && kind.encoding <= format.last_encoding)
        return;
    std::vector<std::string_view> names{"Ascii", "BinaryLittleEndian", "BinaryBigEndian"};
    names.resize(static_cast<std::size_t>(format.last_encoding) + 1);
    names.erase(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(format.first_encoding));
    throw OptionError(fmt::format("encoding must be {} for {} files", choice_of(names), format.name));
}

/// Checks that the written file can be read again.
void require_readable(const std::filesystem::path& path, const PolygonMesh& mesh, const Executor& exec)
{
    if (mesh.n_vertices() == 0)
        throw OutputError(path.string() + ": cannot be written: the mesh has no vertices; write one that has");
    try {
        require_valid(mesh, exec);
    } catch (const InputError& error) {
        throw OutputError(path.string() + ": cannot be written: " + error.what());
    }
}

/// Checks that a mesh and its fields can be written.
/// @param holds_fields whether files of this format, written in this way, have fields.
void require_mesh_and_fields(const std::filesystem::path& path, const PolygonMesh& mesh, const FileFields& fields,
                             FileFormat format, bool holds_fields, const Executor& exec)
{
    require_readable(path, mesh, exec);
    require_writable(path, fields, mesh.n_vertices(), exec);
    if (!holds_fields && !fields.names.empty())
        throw OutputError(fmt::format("{}: cannot be written: {} files made here hold no fields of vertices; write a "
                                      ".ply file, which holds any",
                                      path.string(), traits_of(format).name));
}

/// @param element the name of an element. @param n the number of elements.
void require_one_for_each(const std::filesystem::path& path, std::size_t count, const std::string& what, Index n,
                          const char* element, const char* elements)
{
    if (std::cmp_not_equal(count, n))
        throw OutputError(fmt::format("{}: cannot be written: there are {} {} for {} {}; give one for each {}",
                                      path.string(), count, what, n, elements, element));
}

/// Writes a file, which appears when it is complete, or not at all.
void write_whole(const std::filesystem::path& path, const std::function<void(OutputFile& file)>& write)
{
    OutputFile file(path);
    write(file);
    file.commit();
}

void write_with_extras(const std::filesystem::path& path, const PolygonMesh& mesh, const PlyExtras& extras,
                       const Executor& exec)
{
    write_whole(path, [&](OutputFile& file) { write_ply(file, mesh, Encoding::BinaryLittleEndian, {exec}, extras); });
}

}  // namespace

MeshFile read_mesh(const std::filesystem::path& path, const Executor& exec)
{
    return read(path, exec, nullptr);
}

MeshFile read_faulty_mesh(const std::filesystem::path& path, FaultLog& faults, const Executor& exec)
{
    return read(path, exec, &faults);
}

std::vector<std::string> write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh, const FileKind& kind,
                                    const Executor& exec)
{
    return write_mesh(path, mesh, kind, {}, exec);
}

std::vector<std::string> write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh, const FileKind& kind,
                                    const FileFields& fields, const Executor& exec)
{
    const Format& format = functions_of(kind.format);
    require_encoding(kind);
    require_mesh_and_fields(path, mesh, fields, kind.format, kind.format == FileFormat::Ply, exec);
    std::vector<std::string> remarks;
    if (format.require_fits != nullptr)
        remarks = format.require_fits(path, mesh, kind.encoding);
    write_whole(path, [&](OutputFile& file) {
        if (fields.names.empty())
            format.write(file, mesh, kind.encoding, {exec});
        else
            write_ply(file, mesh, kind.encoding, {exec}, fields);
    });
    return remarks;
}

std::vector<std::string> write_mesh_like(const MeshSource& source, const std::filesystem::path& path,
                                         const PolygonMesh& mesh, const Executor& exec, double seam_distance)
{
    return write_mesh_like(source, path, mesh, {}, exec, seam_distance);
}

std::vector<std::string> write_mesh_like(const MeshSource& source, const std::filesystem::path& path,
                                         const PolygonMesh& mesh, const FileFields& fields, const Executor& exec,
                                         double seam_distance)
{
    const Format& format = functions_of(source.kind().format);
    require_mesh_and_fields(path, mesh, fields, source.kind().format, format.read_fields != nullptr, exec);
    source.require_same_faces(path, mesh, exec);
    const InputFile input = source.read_again(exec);
    std::vector<std::string> remarks;
    write_whole(path, [&](OutputFile& file) {
        remarks = format.rewrite(file, source.path(), input.content(), mesh, {exec}, fields, seam_distance);
    });
    return remarks;
}

FileFields read_fields(const MeshSource& source, std::span<const std::string> names, const Executor& exec)
{
    const FileFormat kind = source.kind().format;
    const Format& format = functions_of(kind);
    if (format.read_fields == nullptr)
        throw InputError(
            fmt::format("{}: no numbers of vertices besides positions are read from {} files; convert the mesh "
                        "and its data to PLY",
                        source.path().string(), traits_of(kind).name));
    const InputFile input = source.read_again(exec);
    return format.read_fields(source.path(), input.content(), names, {exec});
}

std::vector<std::string> extras_of(const MeshSource& source, const Executor& exec)
{
    const Format& format = functions_of(source.kind().format);
    const InputFile input = source.read_again(exec);
    return format.extras(source.path(), input.content(), {exec});
}

void write_labelled_ply(const std::filesystem::path& path, const PolygonMesh& mesh, std::span<const Index> labels,
                        const Executor& exec)
{
    require_readable(path, mesh, exec);
    require_one_for_each(path, labels.size(), "labels", mesh.n_faces(), "face", "faces");
    write_with_extras(path, mesh, {.face_labels = labels}, exec);
}

void write_numbered_ply(const std::filesystem::path& path, const PolygonMesh& mesh,
                        std::span<const FaceNumbers> numbers, const Executor& exec)
{
    require_readable(path, mesh, exec);
    for (const FaceNumbers& list : numbers)
        require_one_for_each(path, list.values.size(), "values of '" + list.name + "'", mesh.n_faces(), "face",
                             "faces");
    write_with_extras(path, mesh, {.face_numbers = numbers}, exec);
}

void write_valued_ply(const std::filesystem::path& path, const PolygonMesh& mesh, std::span<const Colour> colours,
                      std::span<const VertexValues> values, const Executor& exec)
{
    require_readable(path, mesh, exec);
    const auto require_each = [&](std::size_t count, const std::string& what) {
        require_one_for_each(path, count, what, mesh.n_vertices(), "vertex", "vertices");
    };
    require_each(colours.size(), "colours");
    std::vector<NamedColumn> columns;
    for (const VertexValues& list : values) {
        require_each(list.values.size(), "values of '" + list.name + "'");
        columns.push_back({list.name, list.values});
    }
    write_with_extras(path, mesh, {.vertex_colours = colours, .vertex_values = columns}, exec);
}

}  // namespace seamflow
