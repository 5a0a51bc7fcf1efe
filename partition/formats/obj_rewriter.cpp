#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "partition/formats/obj.h"
#include "partition/formats/obj_scan.h"
#include "partition/formats/splicing.h"
#include "partition/formats/text_colours.h"
#include "partition/io/mesh_builder.h"
#include "partition/text.h"

namespace seamflow {

namespace {

constexpr Index none = -1;

/// Converts a number as written to one counted from 0; `none` if it is 0.
/// @param n the number of elements before it, from which negative numbers count back.
Index counted_from_0(std::int64_t number, std::int64_t n)
{
    return static_cast<Index>(number > 0 ? number - 1 : number < 0 ? number + n : none);
}

/// The normal that the attributes of a corner such as //2 or /1/-2 refer to, counted from 0; it need not exist. `none`
/// if they refer to no normal.
/// @param n number of normals before this line.
Index normal_of(std::string_view attributes, std::int64_t n)
{
    const auto second = attributes.find('/', 1);
    if (second == std::string_view::npos)
        return none;
    attributes.remove_prefix(second + 1);
    if (attributes.starts_with('+'))
        attributes.remove_prefix(1);
    Index number = 0;
    std::from_chars(attributes.data(), attributes.data() + attributes.size(), number);
    return counted_from_0(number, n);
}

/// The number of normals that stay although the surface has moved, by reason.
struct StayingNormals {
    /// Normals of several vertices and several faces.
    Index n_shared = 0;
    /// Normals that no corner names.
    Index n_unused = 0;
};

/// The normals of a file for the current surface.
class NormalUpdate {
  public:
    /// @param normals for each normal of the file, the corners that name it. @param before #V by 3: the positions in
    /// the file.
    NormalUpdate(IndexLists normals, const PolygonMesh& mesh, Points before, const Executor& exec, double seam_distance)
        : normals_(std::move(normals))
        , mesh_(mesh)
        , moved_(mesh, std::move(before), exec, seam_distance)
    {
    }

    /// The new normal; nothing if the normal does not change.
    std::optional<Point> operator()(Index normal, const Point& given, StayingNormals& staying) const
    {
        const auto corners = normals_[normal];
        if (corners.empty()) {
            ++staying.n_unused;
            return std::nullopt;
        }
        const auto all_alike = [&](auto&& property) {
            return std::ranges::all_of(corners, [&](Index c) { return property(c) == property(corners[0]); });
        };
        if (all_alike([&](Index c) { return mesh_.face_vertices[c]; }))
            return moved_.around_vertex(corners, given);
        if (all_alike([&](Index c) { return moved_.face_of(c); }))
            return moved_.of_face(moved_.face_of(corners[0]), given);
        ++staying.n_shared;
        return std::nullopt;
    }

    /// A sentence about the normals that should change but cannot.
    /// @param staying one per slice.
    [[nodiscard]] std::vector<std::string> remarks(const std::filesystem::path& path,
                                                   std::span<const StayingNormals> staying) const;

  private:
    IndexLists normals_;
    const PolygonMesh& mesh_;
    MovedNormals moved_;
};

std::vector<std::string> NormalUpdate::remarks(const std::filesystem::path& path,
                                               std::span<const StayingNormals> staying) const
{
    StayingNormals all;
    for (const StayingNormals& of_slice : staying) {
        all.n_shared += of_slice.n_shared;
        all.n_unused += of_slice.n_unused;
    }
    if (all.n_shared + all.n_unused == 0 || !moved_.moved())
        return {};
    std::string reasons;
    if (all.n_shared > 0)
        reasons = fmt::format("{} belong to several vertices of several faces", all.n_shared);
    if (all.n_unused > 0)
        reasons += fmt::format("{}{} to no face", all.n_shared > 0 ? ", " : "", all.n_unused);
    return {fmt::format("of the {} (vn) of {}, {} could not be recomputed and stay as they were: {}",
                        counted(usize(normals_.size()), "normal", "normals"), path.string(),
                        all.n_shared + all.n_unused, reasons)};
}

/// A visitor for scan_obj that collects the normal that each corner of a slice names, or `none`, without faces that are
/// left out of the mesh.
struct CornerNormals {
    std::vector<Index> normals = {};

    void face(TextScanner& scanner, const ObjCounts& before);

    /// Scratch, for one face: its vertices, its normals, and two lists for find_distinct_corners and
    /// are_corners_of_face.
    std::vector<Index> vertices = {};
    std::vector<Index> normals_of_face = {};
    std::vector<Index> distinct = {};
    std::vector<Index> sorted = {};
};

void CornerNormals::face(TextScanner& scanner, const ObjCounts& before)
{
    vertices.clear();
    normals_of_face.clear();
    while (scanner.has_token()) {
        const auto [vertex, attributes] = read_obj_corner(scanner, "a vertex number");
        vertices.push_back(counted_from_0(vertex, before.n_vertices));
        normals_of_face.push_back(normal_of(attributes, before.n_normals));
    }
    // As in MeshBuilder::add_face.
    find_distinct_corners(vertices, distinct);
    for (std::size_t i = 0; i < distinct.size(); ++i)
        vertices[i] = vertices[usize(distinct[i])];
    if (are_corners_of_face(std::span(vertices).first(distinct.size()), sorted))
        for (const Index k : distinct)
            normals.push_back(normals_of_face[usize(k)]);
}

/// The colours of the vertices.
/// @param n_components 4: all colours must have alpha; 3: alpha may be missing.
TextColours read_obj_colours(const std::filesystem::path& path, std::string_view text, Index n_components,
                             const Slicing& slicing)
{
    const TextScanner whole(path, text, obj_syntax);
    return read_text_colours(whole, slicing, [&](const std::vector<std::string_view>& slices, const Executor& exec) {
        const std::vector<ObjCounts> counts = count_obj(whole, slices, exec);
        TextColours colours(static_cast<Index>(counts.back().n_vertices), 4);
        ColourReader reader{colours, n_components};
        for_each(exec, static_cast<Index>(slices.size()),
                 [&](Index i) { scan_obj(TextScanner(whole, slices[i]), reader, counts[i], counts[i + 1]); });
        return colours;
    });
}

}  // namespace

IndexLists corners_of_obj_normals(const std::filesystem::path& path, std::string_view text, const Slicing& slicing)
{
    const TextScanner whole(path, text, obj_syntax);
    const std::vector<std::string_view> slices = whole.slices(slicing.bytes);
    const std::vector<ObjCounts> counts = count_obj(whole, slices, slicing.exec);
    std::vector<CornerNormals> of_slice(slices.size());
    for_each(slicing.exec, static_cast<Index>(slices.size()),
             [&](Index i) { scan_obj(TextScanner(whole, slices[i]), of_slice[i], counts[i]); });
    const auto n = static_cast<Index>(counts.back().n_normals);
    return make_lists(n, [&](auto&& add) {
        Index corner = 0;
        for (const CornerNormals& corners : of_slice)
            for (const Index normal : corners.normals) {
                if (normal >= 0 && normal < n)
                    add(normal, corner);
                ++corner;
            }
    });
}

FileFields read_obj_fields(const std::filesystem::path& path, std::string_view text, std::span<const std::string> names,
                           const Slicing& slicing)
{
    return fields_of_colours(path, names, [&](Index n) { return read_obj_colours(path, text, n, slicing); });
}

std::vector<std::string> rewrite_obj(OutputFile& file, const std::filesystem::path& path, std::string_view text,
                                     const PolygonMesh& mesh, const Slicing& slicing, const FileFields& fields,
                                     double seam_distance)
{
    const TextScanner whole(path, text, obj_syntax);
    const std::vector<std::string_view> slices = whole.slices(slicing.bytes);
    const std::vector<ObjCounts> counts = count_obj(whole, slices, slicing.exec);
    const NewColours colours(file.path(), fields, [&](Index n) { return read_obj_colours(path, text, n, slicing); });
    std::optional<NormalUpdate> normals;
    // The file has been read: the faults of faces that were accepted then are not reported again.
    FaultLog known_faults{.of_faces_alone = true};
    if (counts.back().n_normals > 0)
        normals.emplace(corners_of_obj_normals(path, text, slicing), mesh,
                        read_obj(path, text, slicing, &known_faults).vertices, slicing.exec, seam_distance);
    std::vector<StayingNormals> staying(slices.size());
    file.text(text.substr(0, text.size() - whole.rest().size()));
    file.slices(static_cast<Index>(slices.size()), slicing.exec, [&](Index i, OutputBuffer& slice) {
        VertexRewriter rewriter{Splicer(slice, slices[i]), mesh.vertices, colours,
                                [&](Index n, const Point& given) { return (*normals)(n, given, staying[i]); }};
        scan_obj(TextScanner(whole, slices[i]), rewriter, counts[i], counts[i + 1]);
        rewriter.splicer.finish();
    });
    std::vector<std::string> remarks = colours.remarks();
    if (normals)
        for (std::string& remark : normals->remarks(path, staying))
            remarks.push_back(std::move(remark));
    return remarks;
}

}  // namespace seamflow
