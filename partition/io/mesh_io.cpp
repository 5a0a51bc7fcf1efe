#include "partition/io/mesh_io.h"

#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "partition/errors.h"
#include "partition/io/extras.h"
#include "partition/io/input_file.h"
#include "partition/io/mesh_source.h"
#include "partition/io/obj.h"
#include "partition/io/off.h"
#include "partition/io/output_file.h"
#include "partition/io/ply.h"
#include "partition/io/stl.h"

namespace seamflow {

namespace {

std::optional<FileFormat> format_of(const std::filesystem::path& path)
{
    using Entry = std::pair<std::string_view, FileFormat>;
    constexpr std::array<Entry, 4> formats = {Entry{".obj", FileFormat::Obj}, Entry{".off", FileFormat::Off},
                                              Entry{".ply", FileFormat::Ply}, Entry{".stl", FileFormat::Stl}};
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    for (const auto& [name, format] : formats)
        if (name == extension)
            return format;
    return std::nullopt;
}

std::string unknown_extension(const std::filesystem::path& path)
{
    return path.string() + ": the extension '" + path.extension().string() +
           "' is none of .obj, .off, .ply, .stl; give the file the extension of its format";
}

MeshFile parse(const std::filesystem::path& path, std::string_view content, FileFormat format, FaultLog* faults)
{
    switch (format) {
    case FileFormat::Obj:
        return {read_obj(path, content, faults), {format, Encoding::Ascii}};
    case FileFormat::Off:
        return {read_off(path, content, faults), {format, Encoding::Ascii}};
    case FileFormat::Ply:
        return read_ply(path, content, faults);
    case FileFormat::Stl:
        break;
    }
    const Encoding encoding = stl_encoding(content);
    return {read_stl(path, content, encoding, faults), {FileFormat::Stl, encoding}};
}

MeshFile read_known(const std::filesystem::path& path, FileFormat format)
{
    OpenFile open(path);
    const InputFile input(open);
    MeshFile file = parse(path, input.content(), format, nullptr);
    file.source = std::make_shared<MeshSource>(std::move(open), input.content(), file.mesh, file.kind);
    return file;
}

/// Finds the format and reads; a lack of memory comes out with the name of the file.
template <class Read>
MeshFile read_with(const std::filesystem::path& path, Read&& read)
{
    const auto format = format_of(path);
    if (!format)
        throw InputError(unknown_extension(path));
    try {
        return read(*format);
    } catch (const std::bad_alloc&) {
        throw ComputationError(path.string() +
                               ": there is not enough memory for this mesh; close other programs, raise "
                               "the limit of this one (ulimit -v), or use a machine with more");
    }
}

void require_kind_exists(const FileKind& kind)
{
    const bool text_only = kind.format == FileFormat::Obj || kind.format == FileFormat::Off;
    if (text_only && kind.encoding != Encoding::Ascii)
        throw OptionError("encoding must be Ascii for OBJ and OFF files");
    if (kind.format == FileFormat::Stl && kind.encoding == Encoding::BinaryBigEndian)
        throw OptionError("encoding must be Ascii or BinaryLittleEndian for STL files");
}

/// Whatever is written can be read again.
void require_readable(const std::filesystem::path& path, const PolygonMesh& mesh)
{
    if (mesh.n_vertices() == 0)
        throw OutputError(path.string() + ": cannot be written: the mesh has no vertices; write one that has");
    try {
        require_valid(mesh);
    } catch (const InputError& error) {
        throw OutputError(path.string() + ": cannot be written: " + error.what());
    }
}

}  // namespace

MeshFile read_mesh(const std::filesystem::path& path)
{
    return read_with(path, [&](FileFormat format) { return read_known(path, format); });
}

MeshFile read_faulty_mesh(const std::filesystem::path& path, FaultLog& faults)
{
    return read_with(
        path, [&](FileFormat format) { return parse(path, InputFile(OpenFile(path)).content(), format, &faults); });
}

FileKind kind_for_writing(const std::filesystem::path& path, const FileKind& source)
{
    const auto format = format_of(path);
    if (!format)
        throw OptionError(unknown_extension(path));
    if (*format == source.format)
        return source;
    const bool text_only = *format == FileFormat::Obj || *format == FileFormat::Off;
    return {*format, text_only ? Encoding::Ascii : Encoding::BinaryLittleEndian};
}

void write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh, const FileKind& kind)
{
    require_kind_exists(kind);
    require_readable(path, mesh);
    if (kind.format == FileFormat::Stl)
        require_fits_stl(path, mesh, kind.encoding);
    OutputFile file(path);
    switch (kind.format) {
    case FileFormat::Obj:
        write_obj(file, mesh);
        break;
    case FileFormat::Off:
        write_off(file, mesh);
        break;
    case FileFormat::Ply:
        write_ply(file, mesh, kind.encoding);
        break;
    case FileFormat::Stl:
        write_stl(file, mesh, kind.encoding);
        break;
    }
    file.commit();
}

std::vector<std::string> write_mesh_like(const MeshSource& source, const std::filesystem::path& path,
                                         const PolygonMesh& mesh)
{
    require_readable(path, mesh);
    source.require_same_faces(path, mesh);
    if (source.kind().format == FileFormat::Stl) {
        write_mesh(path, mesh, source.kind());
        return {};
    }
    const InputFile input = source.read_again();
    OutputFile file(path);
    std::vector<std::string> remarks;
    if (source.kind().format == FileFormat::Obj)
        remarks = rewrite_obj(file, source.path(), input.content(), mesh);
    else if (source.kind().format == FileFormat::Off)
        remarks = rewrite_off(file, source.path(), input.content(), mesh);
    else
        remarks = rewrite_ply(file, source.path(), input.content(), mesh);
    file.commit();
    return remarks;
}

std::vector<std::string> extras_of(const MeshSource& source)
{
    const InputFile input = source.read_again();
    switch (source.kind().format) {
    case FileFormat::Obj:
        return extras_of_obj(source.path(), input.content());
    case FileFormat::Off:
        return extras_of_off(source.path(), input.content());
    case FileFormat::Ply:
        return extras_of_ply(source.path(), input.content());
    case FileFormat::Stl:
        break;
    }
    return {};
}

void write_labelled_ply(const std::filesystem::path& path, const PolygonMesh& mesh, std::span<const Index> labels)
{
    require_readable(path, mesh);
    if (labels.size() != static_cast<std::size_t>(mesh.n_faces()))
        throw OutputError(path.string() + ": cannot be written: there are " + std::to_string(labels.size()) +
                          " labels for " + std::to_string(mesh.n_faces()) + " faces; give one label for each face");
    OutputFile file(path);
    write_ply(file, mesh, Encoding::BinaryLittleEndian, {.face_labels = labels});
    file.commit();
}

void write_valued_ply(const std::filesystem::path& path, const PolygonMesh& mesh, std::span<const Colour> colours,
                      std::span<const VertexValues> values)
{
    require_readable(path, mesh);
    const auto require_each = [&](std::size_t count, const std::string& what) {
        if (count != at(mesh.n_vertices()))
            throw OutputError(path.string() + ": cannot be written: there are " + std::to_string(count) + " " + what +
                              " for " + std::to_string(mesh.n_vertices()) + " vertices; give one for each vertex");
    };
    require_each(colours.size(), "colours");
    for (const VertexValues& list : values)
        require_each(list.values.size(), "values of '" + list.name + "'");
    OutputFile file(path);
    write_ply(file, mesh, Encoding::BinaryLittleEndian, {.vertex_colours = colours, .vertex_values = values});
    file.commit();
}

}  // namespace seamflow
