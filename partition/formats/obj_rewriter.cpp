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
#include "partition/formats/splicing.h"
#include "partition/formats/text_colours.h"
#include "partition/io/mesh_builder.h"

namespace seamflow {

namespace {

constexpr Index none = -1;

/// The number that a text begins with, counted from 0; `none` if there is no such number.
/// @param n how many precede; negative numbers count back from there.
Index index_at_start(std::string_view text, Index n)
{
    if (text.starts_with('+'))
        text.remove_prefix(1);
    Index number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number > 0 ? number - 1 : number < 0 ? number + n : none;
}

/// The normal that a corner such as 7//2 or 7/1/-2 refers to, counted from 0; it need not exist.
/// @param n number of normals before this line.
Index normal_of(std::string_view corner, Index n)
{
    const auto first = corner.find('/');
    const auto second = first == std::string_view::npos ? first : corner.find('/', first + 1);
    if (second == std::string_view::npos)
        return none;
    return index_at_start(corner.substr(second + 1), n);
}

/// How many normals stay although the surface has moved.
struct StayingNormals {
    Index n_shared = 0;
    Index n_unused = 0;
};

/// The normals of a file for the current surface.
class NormalUpdate {
  public:
    /// @param normals see corners_of_obj_normals. @param before #V by 3, where the vertices were.
    NormalUpdate(IndexLists normals, const PolygonMesh& mesh, Points before, const Executor& exec, double seam_distance)
        : normals_(std::move(normals))
        , mesh_(mesh)
        , moved_(mesh, std::move(before), exec, seam_distance)
    {
    }

    /// The new normal; nothing if it stays.
    std::optional<Point> operator()(Index normal, const Point& given, StayingNormals& staying) const;

    /// A sentence about those that would have to change, but cannot.
    /// @param staying of each slice.
    [[nodiscard]] std::vector<std::string> remarks(const std::filesystem::path& path,
                                                   std::span<const StayingNormals> staying) const;

  private:
    IndexLists normals_;
    const PolygonMesh& mesh_;
    MovedNormals moved_;
};

std::optional<Point> NormalUpdate::operator()(Index normal, const Point& given, StayingNormals& staying) const
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
                        counted(at(normals_.size()), "normal", "normals"), path.string(), all.n_shared + all.n_unused,
                        reasons)};
}

/// The normal that each corner of a slice refers to, or `none`; without the faces that are left out of the mesh.
/// @param counts of what precedes the slice.
std::vector<Index> normals_of_corners(TextScanner scanner, TextCounts counts)
{
    std::vector<Index> normals;
    std::vector<Index> vertices;
    std::vector<Index> distinct;
    std::vector<Index> sorted;
    while (scanner.next_line()) {
        const std::string_view keyword = scanner.token();
        counts.n_vertices += keyword == "v" ? 1 : 0;
        counts.n_normals += keyword == "vn" ? 1 : 0;
        if (!is_obj_face(keyword))
            continue;
        vertices.clear();
        while (scanner.has_token()) {
            const std::string_view corner = scanner.token();
            vertices.push_back(index_at_start(corner, static_cast<Index>(counts.n_vertices)));
            normals.push_back(normal_of(corner, static_cast<Index>(counts.n_normals)));
        }
        if (are_corners_of_face(vertices, sorted))
            continue;
        // As in MeshBuilder::add_face.
        find_distinct_corners(vertices, distinct);
        const std::size_t first = normals.size() - vertices.size();
        std::size_t n_left = 0;
        for (const Index k : distinct) {
            normals[first + n_left] = normals[first + at(k)];
            vertices[n_left++] = vertices[at(k)];
        }
        vertices.resize(n_left);
        normals.resize(first + (are_corners_of_face(vertices, sorted) ? n_left : 0));
    }
    return normals;
}

/// Rewrites a slice.
/// @param counts of what precedes it. @param end of what precedes the next one.
StayingNormals rewrite_slice(TextScanner scanner, Splicer splicer, TextCounts counts, const TextCounts& end,
                             const NewVertices<NormalUpdate>& now, const NewColours& colours = {})
{
    StayingNormals staying;
    while (counts != end && scanner.next_line()) {
        const std::string_view keyword = scanner.token();
        if (keyword == "v") {
            exchange_position(scanner, splicer, now.position(counts.n_vertices));
            colours.exchange(scanner, splicer, static_cast<Index>(counts.n_vertices++));
        }
        if (keyword != "vn")
            continue;
        const auto normal = static_cast<Index>(counts.n_normals++);
        if (now.normals == nullptr)
            continue;
        const WrittenNormal given = read_normal(scanner);
        if (const auto moved = (*now.normals)(normal, given.value, staying))
            exchange_normal(splicer, given, *moved);
    }
    splicer.finish();
    return staying;
}

}  // namespace

IndexLists corners_of_obj_normals(const std::filesystem::path& path, std::string_view text, const Slicing& slicing)
{
    const TextScanner whole(path, text, obj_syntax);
    const std::vector<std::string_view> slices = whole.slices(slicing.bytes);
    const std::vector<TextCounts> counts = count_obj(whole, slices, slicing.exec);
    std::vector<std::vector<Index>> of_slice(slices.size());
    for_each(slicing.exec, static_cast<Index>(slices.size()),
             [&](Index i) { of_slice[i] = normals_of_corners(TextScanner(whole, slices[i]), counts[i]); });
    const auto n = static_cast<Index>(counts.back().n_normals);
    return make_lists(n, [&](auto&& add) {
        Index corner = 0;
        for (const std::vector<Index>& normals : of_slice)
            for (const Index normal : normals) {
                if (normal >= 0 && normal < n)
                    add(normal, corner);
                ++corner;
            }
    });
}

std::vector<std::string> rewrite_obj(OutputFile& file, const std::filesystem::path& path, std::string_view text,
                                     const PolygonMesh& mesh, const Slicing& slicing, const FileFields& fields,
                                     double seam_distance)
{
    const TextScanner whole(path, text, obj_syntax);
    const std::vector<std::string_view> slices = whole.slices(slicing.bytes);
    const std::vector<TextCounts> counts = count_obj(whole, slices, slicing.exec);
    const NewColours colours(file.path(), fields, [&](Index n) { return read_obj_colours(path, text, n, slicing); });
    std::optional<NormalUpdate> normals;
    FaultLog known_faults{.of_faces_alone = true};
    if (counts.back().n_normals > 0)
        normals.emplace(corners_of_obj_normals(path, text, slicing), mesh,
                        read_obj(path, text, slicing, &known_faults).vertices, slicing.exec, seam_distance);
    std::vector<StayingNormals> staying(slices.size());
    file.text(text.substr(0, text.size() - whole.rest().size()));
    file.slices(static_cast<Index>(slices.size()), slicing.exec, [&](Index i, OutputBuffer& slice) {
        staying[i] = rewrite_slice(TextScanner(whole, slices[i]), Splicer(slice, slices[i]), counts[i], counts[i + 1],
                                   {mesh.vertices, 0, normals ? &*normals : nullptr}, colours);
    });
    std::vector<std::string> remarks = colours.remarks();
    if (normals)
        for (std::string& remark : normals->remarks(path, staying))
            remarks.push_back(std::move(remark));
    return remarks;
}

}  // namespace seamflow
