#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "partition/formats/moved_normals.h"
#include "partition/formats/obj.h"
#include "partition/formats/obj_normals.h"
#include "partition/formats/splicer.h"

namespace seamflow {

namespace {

/// The normals of a file, one after another, on the surface as it is now.
class NormalUpdate {
  public:
    /// @param before #V by 3, where the vertices were.
    NormalUpdate(ObjNormals normals, const PolygonMesh& mesh, Points before)
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
    ObjNormals normals_;
    const PolygonMesh& mesh_;
    MovedNormals moved_;
    Index next_ = 0;
    Index n_shared_ = 0;
    Index n_unused_ = 0;
};

std::optional<Point> NormalUpdate::next(const Point& given)
{
    const auto corners = normals_.corners_of(next_++);
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
        reasons = std::to_string(n_shared_) + " belong to several vertices of several faces";
    if (n_unused_ > 0)
        reasons += (n_shared_ > 0 ? ", " : "") + std::to_string(n_unused_) + " to no face";
    return {"of the " + counted(at(next_), "normal", "normals") + " (vn) of " + path.string() + ", " +
            std::to_string(n_shared_ + n_unused_) + " could not be made new and stay as they were: " + reasons};
}

}  // namespace

std::vector<std::string> rewrite_obj(OutputFile& file, const std::filesystem::path& path, std::string_view text,
                                     const PolygonMesh& mesh)
{
    std::optional<NormalUpdate> normals;
    if (ObjNormals named = read_obj_normals(path, text); named.size() > 0)
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
