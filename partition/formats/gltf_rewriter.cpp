#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/gltf.h"
#include "partition/formats/gltf_buffer_files.h"
#include "partition/formats/gltf_geometry.h"
#include "partition/formats/mesh_file.h"
#include "partition/formats/splicing.h"
#include "partition/formats/writing_checks.h"
#include "partition/io/byte_order.h"
#include "partition/text.h"

namespace seamflow {

namespace {

/// Writes the components of `after` that differ from `before`.
/// @returns whether any had to be rounded.
bool set_float_vector(std::string& bytes, const GltfSpan& span, std::size_t i, const Point& before, const Point& after)
{
    bool rounded = false;
    for (Index k = 0; k < 3; ++k) {
        if (!differ(before[k], after[k]))
            continue;
        const auto value = static_cast<float>(after[k]);
        rounded |= double{value} != after[k];
        const auto written = to_bytes(value, std::endian::little);
        std::ranges::copy(written, bytes.begin() + static_cast<std::ptrdiff_t>(span.offset + i * span.stride +
                                                                               usize(k) * sizeof(float)));
    }
    return rounded;
}

/// The new buffers of a file with another surface.
struct NewBuffers {
    /// One per buffer; nothing if the buffer does not change.
    std::vector<std::optional<std::string>> bytes;
    /// Whether a coordinate was rounded to single precision.
    bool rounded = false;
    /// The number of normals that several vertices share and that stay although the surface has moved.
    std::uint64_t n_staying_normals = 0;

    /// The new bytes of a buffer, at first a copy of the old ones.
    std::string& of(const GltfContent& content, std::size_t buffer)
    {
        if (!bytes[buffer])
            bytes[buffer].emplace(content.buffer(buffer));
        return *bytes[buffer];
    }
};

/// The buffers with the positions of `mesh`, and with normals of its surface.
NewBuffers with_surface(const GltfContent& content, const GltfGeometry& geometry, const PolygonMesh& mesh,
                        const Executor& exec, double seam_distance)
{
    NewBuffers now{.bytes = std::vector<std::optional<std::string>>(content.n_buffers())};
    for (const auto* const lists : {&geometry.positions, &geometry.normals})
        for (const GltfVectors& list : *lists)
            now.of(content, list.span.buffer);
    Points before(geometry.n_vertices, 3);
    std::atomic<bool> rounded = false;
    for_each_vector(geometry.positions, geometry.n_vertices, exec,
                    [&](const GltfVectors& list, std::size_t i, Index v) {
                        std::string& bytes = *now.bytes[list.span.buffer];
                        before.row(v) = float_vector(bytes, list.span, i);
                        if (set_float_vector(bytes, list.span, i, before.row(v), mesh.vertices.row(v)))
                            rounded = true;
                    });
    now.rounded = rounded;
    if (geometry.normals.empty())
        return now;
    const MovedNormals normals(mesh, std::move(before), exec, seam_distance);
    std::atomic<std::uint64_t> n_staying = 0;
    const auto n_normals = static_cast<Index>(geometry.vertex_of_normal.size());
    for_each_vector(geometry.normals, n_normals, exec, [&](const GltfVectors& list, std::size_t i, Index n) {
        const Index v = geometry.vertex_of_normal[usize(n)];
        if (v < 0) {
            ++n_staying;
            return;
        }
        std::string& bytes = *now.bytes[list.span.buffer];
        const Point given = float_vector(bytes, list.span, i);
        if (const auto normal = normals.around_vertex(v, given))
            set_float_vector(bytes, list.span, i, given, *normal);
    });
    if (normals.moved())
        now.n_staying_normals = n_staying;
    return now;
}

/// The least and the largest components of vectors.
struct Bounds {
    Point least = Point::Constant(std::numeric_limits<double>::infinity());
    Point largest = Point::Constant(-std::numeric_limits<double>::infinity());
};

/// The bounds of the vectors in a span.
/// @param bytes of the buffer.
Bounds bounds_in(std::string_view bytes, const GltfSpan& span, const Executor& exec)
{
    // Too many to count: with equal bounds before and after, edit_bound changes nothing.
    if (span.count > usize(std::numeric_limits<Index>::max()))
        return {};
    return reduce(
        exec, static_cast<Index>(span.count), Bounds{},
        [&](Bounds& bounds, Index i) {
            const Point vector = float_vector(bytes, span, usize(i));
            bounds.least = bounds.least.cwiseMin(vector);
            bounds.largest = bounds.largest.cwiseMax(vector);
        },
        [](Bounds& bounds, const Bounds& part) {
            bounds.least = bounds.least.cwiseMin(part.least);
            bounds.largest = bounds.largest.cwiseMax(part.largest);
        });
}

/// Updates the numbers of a list of bounds that have changed.
void edit_bound(JsonEdits& edits, const GltfValue& list, const Point& before, const Point& after)
{
    const std::vector<const JsonNode*> numbers = list.nodes();
    for (std::size_t k = 0; k < 3 && numbers.size() == 3; ++k) {
        const auto component = static_cast<Index>(k);
        if (before[component] == after[component])
            continue;
        OutputBuffer text;
        // Adding 0 turns -0 into 0.
        text.number(after[component] + 0.0);
        edits.emplace_back(numbers[k]->source, text.content());
    }
}

/// The vectors of an accessor in a changed buffer; nothing for all other accessors, whether valid or not.
std::optional<GltfSpan> changed_vectors(const GltfContent& content, const GltfGeometry& geometry, const NewBuffers& now,
                                        std::size_t accessor)
{
    const auto sparse = std::ranges::find(geometry.sparse, accessor, &GltfSparse::accessor);
    if (sparse != geometry.sparse.end() && now.bytes[sparse->dense.buffer])
        return sparse->dense;
    try {
        const GltfSpan span = span_of_gltf(content, content.root()["accessors"].at(accessor));
        if (span.component == gltf_float && span.n_components == 3 && now.bytes[span.buffer])
            return span;
    } catch (const InputError&) {
        // The accessor was not read.
    }
    return std::nullopt;
}

/// Updates the bounds of all accessors, including those that no primitive of triangles names.
void edit_bounds(JsonEdits& edits, const GltfContent& content, const GltfGeometry& geometry, const NewBuffers& now,
                 const Executor& exec)
{
    const GltfValue accessors = content.root()["accessors"];
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        const auto span = changed_vectors(content, geometry, now, i);
        if (!span)
            continue;
        const Bounds before = bounds_in(content.buffer(span->buffer), *span, exec);
        const Bounds after = bounds_in(*now.bytes[span->buffer], *span, exec);
        edit_bound(edits, accessors.at(i)["min"], before.least, after.least);
        edit_bound(edits, accessors.at(i)["max"], before.largest, after.largest);
    }
}

/// Replaces a sparse accessor by one whose elements are all in a view.
void edit_sparse(JsonEdits& edits, const GltfValue& accessor, std::size_t view)
{
    const std::vector<const JsonNode*> members = accessor.nodes();
    // Whether member i is removed.
    const auto goes = [&](std::size_t i) {
        const std::string key = text_of_json(members[i]->key);
        return key == "sparse" || key == "bufferView" || key == "byteOffset";
    };
    // The new bufferView stands before the first member, or in its place. Members after the first are removed together
    // with the comma before them.
    edits.emplace_back(members[0]->member().substr(0, goes(0) ? std::string_view::npos : 0),
                       fmt::format(R"("bufferView":{}{})", view, goes(0) ? "" : ","));
    for (std::size_t i = 1; i < members.size(); ++i)
        if (goes(i)) {
            const std::string_view before = members[i - 1]->member();
            const std::string_view all = members[i]->member();
            const char* const begin = before.data() + before.size();
            edits.emplace_back(std::string_view(begin, static_cast<std::size_t>(all.data() + all.size() - begin)), "");
        }
}

/// Appends the elements of changed sparse accessors to the buffers that have their values.
void edit_sparse_accessors(JsonEdits& edits, const GltfContent& content, const GltfGeometry& geometry, NewBuffers& now)
{
    const GltfValue root = content.root();
    const std::vector<const JsonNode*> views = root["bufferViews"].nodes();
    const auto bytes_now = [&](std::size_t i) {
        return now.bytes[i] ? std::string_view(*now.bytes[i]) : content.buffer(i);
    };
    std::string more_views;
    std::size_t n_views = views.size();
    std::set<std::size_t> grown;
    for (const GltfSparse& sparse : geometry.sparse) {
        // The elements without replacements may have changed, too.
        const std::string_view dense = bytes_now(sparse.dense.buffer);
        if (dense == dense_bytes(sparse, bytes_now))
            continue;
        std::string& buffer = now.of(content, sparse.values.buffer);
        // Floats must begin at a multiple of four bytes.
        buffer.resize((buffer.size() + 3) / 4 * 4);
        more_views += fmt::format(R"(,{{"buffer":{},"byteOffset":{},"byteLength":{}}})", sparse.values.buffer,
                                  buffer.size(), dense.size());
        buffer += dense;
        grown.insert(sparse.values.buffer);
        edit_sparse(edits, root["accessors"].at(sparse.accessor), n_views++);
    }
    if (grown.empty())
        return;
    // Replaces the empty text after the last view.
    edits.emplace_back(views.back()->source.substr(views.back()->source.size()), more_views);
    for (const std::size_t i : grown)
        edits.emplace_back(root["buffers"].at(i)["byteLength"].source(), fmt::format("{}", now.bytes[i]->size()));
}

/// Writes the buffers that are in other files, or in the text, and edits their URIs.
/// @returns a remark that names the files; none if there are no files.
std::vector<std::string> write_buffers(JsonEdits& edits, OutputFile& file, const GltfContent& content,
                                       const NewBuffers& now)
{
    std::vector<std::filesystem::path> paths;
    std::string names;
    const GltfValue buffers = content.root()["buffers"];
    std::size_t n = 0;
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const GltfValue uri = buffers.at(i)["uri"];
        if (!uri.is_there())
            continue;
        const std::string_view bytes = now.bytes[i] ? std::string_view(*now.bytes[i]) : content.buffer(i);
        const bool was_data = is_gltf_data(uri.text());
        if (was_data && !now.bytes[i])
            continue;
        if (was_data || file.is_stream()) {
            const std::string head =
                was_data ? uri.text().substr(0, uri.text().find(',')) : "data:application/octet-stream;base64";
            edits.emplace_back(uri.source(), json_of_text(gltf_data(head, bytes)));
            continue;
        }
        if (paths.empty())
            paths = paths_of_gltf_buffers(file.path(), content.path(), buffers.size());
        const std::string name = paths[n].filename().string();
        file.beside(paths[n++]).text(bytes);
        edits.emplace_back(uri.source(), json_of_text(gltf_uri_of(name)));
        names += (names.empty() ? "" : ", ") + name;
    }
    if (names.empty())
        return {};
    return {fmt::format("the binary data of {} are beside it, in {}", file.path().string(), names)};
}

/// Writes a .glb file.
/// @param text its JSON text.
void write_binary_gltf(OutputFile& file, const GltfContent& content, std::string text, const NewBuffers& now)
{
    constexpr std::size_t unit = 4;
    // A changed text is filled up with blanks to a multiple of four bytes.
    if (text != content.text()) {
        text.resize(text.find_last_not_of(std::string_view(" \0", 2)) + 1);
        text.resize((text.size() + unit - 1) / unit * unit, ' ');
    }
    // The rest of the file, from the header of the binary chunk on.
    std::string_view behind = content.file().substr(glb_header_bytes + glb_chunk_header_bytes + content.text().size());
    const auto length =
        from_bytes<std::uint32_t>(content.file().data() + 2 * sizeof(std::uint32_t), std::endian::little);
    // Bytes after the length that the header announces.
    const std::size_t n_padding = content.file().size() - length;
    const bool has_changed = !now.bytes.empty() && now.bytes[0] && content.buffer(0).data() == content.chunk().data();
    const std::size_t n_more = has_changed ? now.bytes[0]->size() - content.chunk().size() : 0;
    if (glb_header_bytes + glb_chunk_header_bytes + text.size() + behind.size() + n_more >
        std::numeric_limits<std::uint32_t>::max())
        throw OutputError(file.path().string() +
                          ": cannot be written: it would have more than the 4 GiB of a binary glTF file");
    write_glb_head(file, text, behind.size() - n_padding + n_more);
    if (has_changed) {
        file.binary(static_cast<std::uint32_t>(now.bytes[0]->size()), std::endian::little);
        behind.remove_prefix(sizeof(std::uint32_t));
        file.text(behind.substr(0, glb_chunk_header_bytes - sizeof(std::uint32_t)));
        file.text(*now.bytes[0]);
        behind.remove_prefix(glb_chunk_header_bytes - sizeof(std::uint32_t) + content.chunk().size());
    }
    file.text(behind);
}

/// Remarks on pictures and other files that are not copied, if the result is in another folder.
std::vector<std::string> remarks_on_other_files(const OutputFile& file, const GltfContent& content)
{
    std::error_code ignored;
    const auto folder_of = [](const std::filesystem::path& path) {
        return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    };
    if (std::filesystem::equivalent(folder_of(file.path()), folder_of(content.path()), ignored))
        return {};
    std::uint64_t n = 0;
    std::string first;
    const GltfValue images = content.root()["images"];
    for (std::size_t i = 0; i < images.size(); ++i)
        if (const GltfValue uri = images.at(i)["uri"]; uri.is_there() && !is_gltf_data(uri.text())) {
            first = n++ == 0 ? uri.text() : first;
        }
    if (n == 0)
        return {};
    return {fmt::format("{} names {} beside it ({}): copy {} there from the folder of {}", file.path().string(),
                        counted(n, "picture", "pictures"), in_quotes(first), n == 1 ? "it" : "them",
                        content.path().string())};
}

/// Remarks on normals and other data that belong to the old surface but stay, and on rounding.
std::vector<std::string> remarks_on_old_data(const GltfContent& content, const GltfGeometry& geometry,
                                             const NewBuffers& now)
{
    std::vector<std::string> remarks;
    const auto remark = [&](bool holds, const char* what) {
        if (holds)
            remarks.push_back(fmt::format("the {} of {} stay as they were", what, content.path().string()));
    };
    remark(geometry.has_other_normals, "normals that are not in single precision, once for each vertex,");
    remark(now.n_staying_normals > 0, "normals that belong to several vertices");
    remark(geometry.has_tangents, "tangents");
    remark(geometry.has_morph_targets, "morph targets (differences from the positions)");
    remark(!content.root()["skins"].nodes().empty(), "skins (joints and weights)");
    if (now.rounded)
        remarks.push_back(rounding_remark(content.path()));
    return remarks;
}

}  // namespace

std::vector<std::string> rewrite_gltf(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                      const PolygonMesh& mesh, const Slicing& slicing, double seam_distance)
{
    GltfContent gltf(path, content);
    const GltfGeometry geometry = geometry_of(gltf);
    require_floats(file.path(), mesh.vertices, slicing.exec, "glTF");
    NewBuffers now = with_surface(gltf, geometry, mesh, slicing.exec, seam_distance);
    JsonEdits edits;
    edit_bounds(edits, gltf, geometry, now, slicing.exec);
    edit_sparse_accessors(edits, gltf, geometry, now);
    std::vector<std::string> remarks = write_buffers(edits, file, gltf, now);
    std::string text = edited_json(gltf.text(), std::move(edits));
    if (gltf.is_binary())
        write_binary_gltf(file, gltf, std::move(text), now);
    else
        file.text(text);
    for (const auto& more : {remarks_on_other_files(file, gltf), remarks_on_old_data(gltf, geometry, now)})
        remarks.insert(remarks.end(), more.begin(), more.end());
    return remarks;
}

std::vector<std::string> extras_of_gltf(const std::filesystem::path& path, std::string_view content)
{
    const GltfContent gltf(path, content);
    std::vector<std::string> extras;
    const GltfValue root = gltf.root();
    for (std::size_t m = 0; m < root["meshes"].size(); ++m) {
        const GltfValue primitives = root["meshes"].at(m)["primitives"];
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const GltfValue primitive = primitives.at(p);
            for (const std::string& key : primitive["attributes"].keys())
                if (key == "NORMAL")
                    add_once(extras, "normals");
                else if (key.starts_with("TEXCOORD"))
                    add_once(extras, "texture coordinates");
                else if (key.starts_with("COLOR"))
                    add_once(extras, "colours");
                else if (key != "POSITION")
                    add_once(extras, "attributes " + printable(key));
            if (primitive["targets"].size() > 0)
                add_once(extras, "morph targets");
            if (primitive["mode"].number_or(4) < 4)
                add_once(extras, "points and lines");
        }
    }
    // What is not used is not checked: it may have any type.
    for (const char* const list : {"materials", "textures", "animations", "skins", "cameras"})
        if (!root[list].nodes().empty())
            extras.emplace_back(list);
    const std::array transforms{"matrix", "translation", "rotation", "scale"};
    for (const JsonNode* const node : root["nodes"].nodes())
        for (const JsonNode* const member : node->children)
            if (!member->key.empty() && std::ranges::find(transforms, text_of_json(member->key)) != transforms.end())
                add_once(extras, "transforms of nodes");
    return extras;
}

}  // namespace seamflow
