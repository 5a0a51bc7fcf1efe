#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "partition/formats/obj.h"
#include "partition/formats/splicing.h"

namespace seamflow {

namespace {

constexpr Index none = -1;

/// The normal that a corner such as 7//2 or 7/1/-2 names, counted from 0; it need not be there.
/// @param n number of normals before this line.
Index normal_of(std::string_view corner, Index n)
{
    const auto first = corner.find('/');
    const auto second = first == std::string_view::npos ? first : corner.find('/', first + 1);
    if (second == std::string_view::npos)
        return none;
    corner.remove_prefix(second + 1);
    if (corner.starts_with('+'))
        corner.remove_prefix(1);
    Index number = 0;
    std::from_chars(corner.data(), corner.data() + corner.size(), number);
    return number > 0 ? number - 1 : number < 0 ? number + n : none;
}

/// The normals of a file, one after another, on the surface as it is now.
class NormalUpdate {
  public:
    /// @param normals see corners_of_obj_normals. @param before #V by 3, where the vertices were.
    NormalUpdate(IndexLists normals, const PolygonMesh& mesh, Points before)
        : normals_(std::move(normals))
        , mesh_(mesh)
        , moved_(mesh, std::move(before))
    {
    }

    /// The next normal; nothing if it stays.
    std::optional<Point> next(const Point& given);

    /// A sentence about those that would have to change, but cannot.
    [[nodiscard]] std::vector<std::string> remarks(const std::filesystem::path& path) const;

  private:
    IndexLists normals_;
    const PolygonMesh& mesh_;
    MovedNormals moved_;
    Index next_ = 0;
    Index n_shared_ = 0;
    Index n_unused_ = 0;
};

std::optional<Point> NormalUpdate::next(const Point& given)
{
    const auto corners = normals_[next_++];
    if (corners.empty()) {
        ++n_unused_;
        return std::nullopt;
    }
    const auto all_alike = [&](auto&& property) {
        return std::ranges::all_of(corners, [&](Index c) { return property(c) == property(corners[0]); });
    };
    if (all_alike([&](Index c) { return mesh_.face_vertices[c]; }))
        return moved_.around_vertex(corners, given);
    if (all_alike([&](Index c) { return moved_.face_of(c); }))
        return moved_.of_face(moved_.face_of(corners[0]), given);
    ++n_shared_;
    return std::nullopt;
}

std::vector<std::string> NormalUpdate::remarks(const std::filesystem::path& path) const
{
    if (n_shared_ + n_unused_ == 0 || !moved_.moved())
        return {};
    std::string reasons;
    if (n_shared_ > 0)
        reasons = fmt::format("{} belong to several vertices of several faces", n_shared_);
    if (n_unused_ > 0)
        reasons += fmt::format("{}{} to no face", n_shared_ > 0 ? ", " : "", n_unused_);
    return {fmt::format("of the {} (vn) of {}, {} could not be made new and stay as they were: {}",
                        counted(at(next_), "normal", "normals"), path.string(), n_shared_ + n_unused_, reasons)};
}

}  // namespace

IndexLists corners_of_obj_normals(const std::filesystem::path& path, std::string_view text)
{
    TextScanner scanner(path, text, obj_syntax);
    std::vector<Index> normals;
    Index n = 0;
    while (scanner.next_line()) {
        const std::string_view keyword = scanner.token();
        n += keyword == "vn" ? 1 : 0;
        if (is_obj_face(keyword))
            while (scanner.has_token())
                normals.push_back(normal_of(scanner.token(), n));
    }
    return make_lists(n, [&](auto&& add) {
        for (std::size_t corner = 0; corner < normals.size(); ++corner)
            if (normals[corner] >= 0 && normals[corner] < n)
                add(normals[corner], static_cast<Index>(corner));
    });
}

std::vector<std::string> rewrite_obj(OutputFile& file, const std::filesystem::path& path, std::string_view text,
                                     const PolygonMesh& mesh)
{
    std::optional<NormalUpdate> normals;
    if (IndexLists named = corners_of_obj_normals(path, text); named.size() > 0)
        normals.emplace(std::move(named), mesh, read_obj(path, text).vertices);
    TextScanner scanner(path, text, obj_syntax);
    Splicer splicer(file, text);
    for (Index v = 0; scanner.next_line();) {
        const std::string_view keyword = scanner.token();
        if (keyword == "v")
            exchange_position(scanner, splicer, mesh.vertices.row(v++));
        if (keyword != "vn" || !normals)
            continue;
        const WrittenNormal given = read_normal(scanner);
        if (const auto now = normals->next(given.value))
            exchange_normal(splicer, given, *now);
    }
    splicer.finish();
    return normals ? normals->remarks(path) : std::vector<std::string>{};
}

}  // namespace seamflow
