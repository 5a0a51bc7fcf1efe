#include "partition/formats/gltf_geometry.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace seamflow {

namespace {

/// The accessors of a primitive's attributes, each looked up once.
class Accessors {
  public:
    explicit Accessors(GltfContent& content)
        : content_(content)
    {
    }

    /// The elements of the accessor with a number; of a sparse accessor, those after replacement.
    const GltfSpan& operator()(const GltfValue& number)
    {
        const GltfValue accessor = content_.named_by(number, "accessors");
        const auto [known, is_new] = spans_.try_emplace(number.number());
        if (is_new && accessor["sparse"].is_there())
            known->second = sparse_.emplace_back(sparse_of_gltf(content_, number)).dense;
        else if (is_new)
            known->second = span_of_gltf(content_, accessor);
        return known->second;
    }

    /// The sparse accessors found so far.
    std::vector<GltfSparse>& sparse() { return sparse_; }

  private:
    GltfContent& content_;
    std::map<std::uint64_t, GltfSpan> spans_;
    std::vector<GltfSparse> sparse_;
};

/// Spans of vectors; spans that share elements are joined.
class SharedVectors {
  public:
    /// Adds a span.
    /// @returns its number among those added.
    std::size_t add(const GltfSpan& span, const std::string& name)
    {
        spans_.push_back(span);
        names_.push_back(name);
        return spans_.size() - 1;
    }

    /// Joins the spans. To be called when all have been added.
    /// @returns the number of elements. If it exceeds the largest Index, joining was broken off, and nothing else may
    ///          be called.
    std::int64_t join();

    [[nodiscard]] const std::vector<GltfVectors>& joined() const { return joined_; }
    /// The number of the first element of a span among all elements.
    [[nodiscard]] Index first_of(std::size_t span) const
    {
        const GltfVectors& all = joined_[of_span_[span]];
        return all.first + static_cast<Index>((spans_[span].offset - all.span.offset) / all.span.stride);
    }

  private:
    std::vector<GltfSpan> spans_;
    std::vector<std::string> names_;
    /// For each span, the index in joined_ of the vectors that contain it.
    std::vector<std::size_t> of_span_;
    std::vector<GltfVectors> joined_;
};

std::int64_t SharedVectors::join()
{
    // In this order, spans that can share elements follow each other.
    std::vector<std::size_t> order(spans_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) {
        const GltfSpan& span = spans_[i];
        return std::tuple(span.buffer, span.stride, span.offset % span.stride, span.offset, i);
    });
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<GltfSpan> lists;
    std::vector<std::size_t> list_of(spans_.size());
    for (const std::size_t i : order) {
        const GltfSpan& span = spans_[i];
        const bool shares = !lists.empty() && lists.back().buffer == span.buffer &&
                            lists.back().stride == span.stride && span.offset < lists.back().end() &&
                            (span.offset - lists.back().offset) % span.stride == 0;
        if (!shares)
            lists.push_back(span);
        GltfSpan& list = lists.back();
        list.count = std::max(list.count, (span.offset - list.offset) / span.stride + span.count);
        list_of[i] = lists.size() - 1;
    }
    // For each list its index in joined_: lists are in the order in which their first spans were added.
    std::vector<std::size_t> list_at(lists.size(), none);
    std::int64_t n = 0;
    for (std::size_t i = 0; i < spans_.size(); ++i) {
        std::size_t& there = list_at[list_of[i]];
        if (there == none) {
            there = joined_.size();
            joined_.push_back({lists[list_of[i]], names_[i], static_cast<Index>(n)});
            n += static_cast<std::int64_t>(joined_.back().span.count);
            if (n > std::numeric_limits<Index>::max())
                break;
        }
        of_span_.push_back(there);
    }
    return n;
}

/// Whether two spans have a byte in common.
bool share_bytes(const GltfSpan& a, const GltfSpan& b)
{
    if (a.buffer != b.buffer || a.end() <= b.offset || b.end() <= a.offset)
        return false;
    if (a.stride != b.stride)
        return true;
    // The distance of elements of b behind those of a, modulo the stride.
    const std::size_t behind = (b.offset % a.stride + a.stride - a.offset % a.stride) % a.stride;
    return behind < a.size || behind + b.size > a.stride;
}

/// A span of bytes that the surface occupies in a buffer.
struct OccupiedSpan {
    GltfSpan span;
    std::string name;
    bool is_written = false;
};

/// Checks that no bytes that are written belong to two spans.
void require_apart(const GltfContent& content, std::vector<OccupiedSpan> spans)
{
    std::ranges::sort(spans, {}, [](const OccupiedSpan& one) { return std::pair(one.span.buffer, one.span.offset); });
    // The earlier spans that reach beyond the beginning of the present one.
    std::vector<const OccupiedSpan*> reaching;
    for (const OccupiedSpan& one : spans) {
        std::erase_if(reaching, [&](const OccupiedSpan* other) {
            return other->span.buffer != one.span.buffer || other->span.end() <= one.span.offset;
        });
        for (const OccupiedSpan* const other : reaching)
            if ((one.is_written || other->is_written) && share_bytes(one.span, other->span))
                GltfValue(content.path(), nullptr, one.name)
                    .fail("shares bytes with " + other->name + ", which would change with it; export the mesh again");
        // Of equal spans that are only read, one is kept.
        if (one.is_written || std::ranges::none_of(reaching, [&](const OccupiedSpan* other) {
                return !other->is_written && other->span.end() >= one.span.end() && other->span == one.span;
            }))
            reaching.push_back(&one);
    }
}

/// Collects the surface while the primitives are visited.
class GeometryFinder {
  public:
    explicit GeometryFinder(GltfContent& content)
        : content_(content)
        , accessors_(content)
    {
    }

    void add(const GltfValue& primitive);
    GltfGeometry finish();

  private:
    /// A primitive, and the numbers of its spans in positions_ and normals_.
    struct Found {
        GltfPrimitive primitive;
        std::size_t positions;
        std::optional<std::size_t> normals;
    };

    const GltfSpan& positions_of(const GltfValue& primitive);
    std::optional<std::size_t> normals_of(const GltfValue& attributes, const GltfSpan& positions);
    void relate_normals(const Found& found);

    const GltfContent& content_;
    Accessors accessors_;
    SharedVectors positions_;
    SharedVectors normals_;
    std::vector<OccupiedSpan> occupied_;
    std::vector<Found> found_;
    GltfGeometry geometry_;
};

/// The positions that a primitive names: three floats each.
/// @throws InputError for others.
const GltfSpan& GeometryFinder::positions_of(const GltfValue& primitive)
{
    if (primitive["extensions"]["KHR_draco_mesh_compression"].is_there())
        primitive.fail("is compressed by Draco (KHR_draco_mesh_compression); export the mesh without compression");
    const GltfValue number = primitive["attributes"]["POSITION"];
    const GltfSpan& span = accessors_(number);
    if (span.component != gltf_float)
        number.fail("the positions are quantised (KHR_mesh_quantization) and cannot hold smooth ones; export the mesh "
                    "without quantisation, or undo it (gltf-transform dequantize)");
    if (span.n_components != 3)
        number.fail("the positions are not three numbers each (VEC3); export the mesh again");
    return span;
}

/// The number in normals_ of the normals of a primitive; nothing if it has none that are floats, one for each vertex.
/// Sets has_tangents and has_other_normals of the surface.
std::optional<std::size_t> GeometryFinder::normals_of(const GltfValue& attributes, const GltfSpan& positions)
{
    geometry_.has_tangents |= attributes["TANGENT"].is_there();
    const GltfValue number = attributes["NORMAL"];
    if (!number.is_there())
        return std::nullopt;
    const GltfValue accessor = content_.named_by(number, "accessors");
    if (accessor["sparse"].is_there() || accessor["bufferView"].is_there())
        if (const GltfSpan& span = accessors_(number); span.component == gltf_float && span.n_components == 3 &&
                                                       span.count == positions.count && span != positions)
            return normals_.add(span, number.name());
    geometry_.has_other_normals = true;
    return std::nullopt;
}

/// Adds a primitive; points and lines are skipped.
void GeometryFinder::add(const GltfValue& primitive)
{
    const std::uint64_t mode = primitive["mode"].number_or(4);
    // Points and lines.
    if (mode < 4)
        return;
    if (mode > 6)
        primitive["mode"].fail("is not known to glTF 2.0; export the mesh again");
    const GltfValue attributes = primitive["attributes"];
    const GltfSpan& positions = positions_of(primitive);
    GltfPrimitive one;
    one.mode = static_cast<GltfPrimitive::Mode>(mode);
    one.name = attributes["POSITION"].name();
    std::size_t n_corners = positions.count;
    if (const GltfValue number = primitive["indices"]; number.is_there()) {
        one.indices = accessors_(number);
        one.name = number.name();
        n_corners = one.indices->count;
        require_gltf_indices(*one.indices, number);
    }
    if (one.mode == GltfPrimitive::Mode::Triangles && n_corners % 3 != 0)
        GltfValue(content_.path(), nullptr, one.name)
            .fail(
                fmt::format("has {} corners, which are not three for each triangle; export the mesh again", n_corners));
    geometry_.has_morph_targets |= primitive["targets"].size() > 0;
    const auto normals = normals_of(attributes, positions);
    one.n_vertices = static_cast<Index>(std::min<std::size_t>(positions.count, std::numeric_limits<Index>::max()));
    one.n_faces = one.mode == GltfPrimitive::Mode::Triangles ? static_cast<std::int64_t>(n_corners / 3)
                                                             : std::max(static_cast<std::int64_t>(n_corners) - 2, {});
    if (one.indices)
        occupied_.push_back({*one.indices, one.name, false});
    found_.push_back({std::move(one), positions_.add(positions, attributes["POSITION"].name()), normals});
}

/// Relates each normal to the vertex of the same number in the primitive.
void GeometryFinder::relate_normals(const Found& found)
{
    constexpr Index unknown = -2;
    constexpr Index several = -1;
    const Index first = normals_.first_of(*found.normals);
    for (Index i = 0; i < found.primitive.n_vertices; ++i) {
        Index& vertex = geometry_.vertex_of_normal[usize(first + i)];
        const Index here = found.primitive.first_vertex + i;
        vertex = vertex == unknown || vertex == here ? here : several;
    }
}

/// Numbers the vertices and faces and moves out the surface.
GltfGeometry GeometryFinder::finish()
{
    const auto checked_index = [&](std::int64_t n, const char* what) {
        if (n > std::numeric_limits<Index>::max())
            content_.root().fail(fmt::format("the file has more than {} {}; divide the mesh into several files",
                                             std::numeric_limits<Index>::max(), what));
        return static_cast<Index>(n);
    };
    if (found_.empty())
        content_.root().fail("has no triangles, strips or fans in its meshes; export a mesh with its surface");
    geometry_.n_vertices = checked_index(positions_.join(), "vertices");
    // -2: not known yet, see relate_normals.
    geometry_.vertex_of_normal.assign(usize(checked_index(normals_.join(), "normals")), -2);
    // The key of a primitive: its vertices and mode, and buffer, offset, stride, count and type of its indices.
    std::set<std::tuple<Index, Index, GltfPrimitive::Mode, std::array<std::uint64_t, 5>>> known;
    for (Found& found : found_) {
        found.primitive.first_vertex = positions_.first_of(found.positions);
        if (found.normals)
            relate_normals(found);
        const GltfSpan indices = found.primitive.indices.value_or(GltfSpan{});
        if (found.primitive.n_faces == 0 ||
            !known
                 .emplace(found.primitive.first_vertex, found.primitive.n_vertices, found.primitive.mode,
                          std::array<std::uint64_t, 5>{indices.buffer, indices.offset, indices.stride, indices.count,
                                                       indices.component})
                 .second)
            continue;
        found.primitive.first_face = geometry_.n_faces;
        geometry_.n_faces += found.primitive.n_faces;
        geometry_.primitives.push_back(std::move(found.primitive));
    }
    checked_index(3 * geometry_.n_faces, "corners of triangles");
    geometry_.positions = positions_.joined();
    geometry_.normals = normals_.joined();
    for (const GltfVectors& list : geometry_.positions)
        occupied_.push_back({list.span, list.name, true});
    for (const GltfVectors& list : geometry_.normals)
        occupied_.push_back({list.span, list.name, true});
    geometry_.sparse = std::move(accessors_.sparse());
    require_apart(content_, std::move(occupied_));
    return std::move(geometry_);
}

}  // namespace

GltfGeometry geometry_of(GltfContent& content)
{
    GeometryFinder finder(content);
    const GltfValue meshes = content.root()["meshes"];
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const GltfValue primitives = meshes.at(m)["primitives"];
        for (std::size_t p = 0; p < primitives.size(); ++p)
            finder.add(primitives.at(p));
    }
    return finder.finish();
}

}  // namespace seamflow
