#include "samples/report/surface_change.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include <xxhash.h>

#include "partition/index_lists.h"
#include "partition/metrics/cells.h"
#include "partition/metrics/flipped_faces.h"
#include "partition/metrics/self_intersections.h"
#include "partition/metrics/volume.h"
#include "partition/surface_components.h"
#include "partition/vector_area.h"
#include "partition/with_faces.h"

namespace seamflow {

namespace {

/// The faces around so many vertices give the roughness of all within about a hundredth.
constexpr Index enough_vertices = 4000;

/// Whether the faces around a vertex are in the sample from which the roughness of large meshes is estimated: those
/// around some thousands of vertices, spread over the mesh without a pattern. The sample of small meshes has all faces.
bool is_sampled(Index v, Index n_vertices)
{
    return n_vertices <= enough_vertices ||
           XXH3_64bits(&v, sizeof v) % static_cast<XXH64_hash_t>(n_vertices) < enough_vertices;
}

/// The mesh, and some of its faces, as its vertices move.
class Surface {
  public:
    Surface(const PolygonMesh& mesh, const Executor& exec)
        : mesh_(mesh)
        , exec_(exec)
        , bodies_(surface_components_if_several(mesh, exec))
        , has_volume_(encloses_volume(mesh, exec))
    {
        for (Index c = 0; c < bodies_.count() && bodies_.count() > 1; ++c)
            is_closed_.push_back(has_volume_ || encloses_volume(mesh, bodies_.faces[c]) ? 1 : 0);

        std::vector<char> is_in_sample(usize(mesh.n_vertices()));
        for_each(exec, mesh.n_vertices(), [&](Index v) { is_in_sample[v] = is_sampled(v, mesh.n_vertices()) ? 1 : 0; });
        const std::vector<Index> faces = select(exec, mesh.n_faces(), [&](Index f) {
            return std::ranges::any_of(mesh.face(f), [&](Index v) { return is_in_sample[v] != 0; });
        });
        for (const Index f : faces)
            sampled_vertices_.insert(sampled_vertices_.end(), mesh.face(f).begin(), mesh.face(f).end());
        sort_unique(sampled_vertices_);
        std::vector<Index> corners;
        for (const Index f : faces) {
            corners.clear();
            for (const Index v : mesh.face(f))
                corners.push_back(place_in(sampled_vertices_, v));
            sample_.add_face(corners);
        }
    }

    /// From now on, looks have the cells that the sheets enclose at these positions, unless sheets overlap.
    void find_cells(const Points& positions, SurfaceChange& change)
    {
        EnclosedCells cells = seamflow::find_cells(mesh_, positions, exec_);
        change.overlaps = usize(cells.n_overlaps);
        change.surfaces = usize(cells.n_surfaces);
        if (change.overlaps == 0)
            cells_ = std::move(cells);
    }

    [[nodiscard]] SurfaceLook look(const Points& positions) const
    {
        Points sampled(static_cast<Eigen::Index>(sampled_vertices_.size()), 3);
        for (std::size_t i = 0; i < sampled_vertices_.size(); ++i)
            sampled.row(static_cast<Eigen::Index>(i)) = positions.row(sampled_vertices_[i]);
        SurfaceLook look{
            .area = sum(exec_, mesh_.n_faces(), [&](Index f) { return vector_area(mesh_.face(f), positions).norm(); }),
            .volume = std::nullopt,
            .roughness = roughness(sample_, sampled)};
        if (cells_)
            look.cell_volumes = volumes_of(*cells_, mesh_, positions, exec_);
        if (has_volume_)
            look.volume = std::abs(volume_of_cones(mesh_, positions, positions.row(mesh_.face(0).front()), exec_));
        for (Index c = 0; c < std::ssize(is_closed_); ++c)
            look.bodies.push_back(size_of(c, positions));
        return look;
    }

    /// This look, and those to come, have no volume where this one has none above rounding.
    void leave_out_rounding(SurfaceLook& look)
    {
        const auto leave_out = [](std::optional<double>& volume, double area) {
            if (volume && !(*volume > 1e-12 * area * std::sqrt(area)))
                volume.reset();
            return !volume.has_value();
        };
        has_volume_ = !leave_out(look.volume, look.area);
        for (std::size_t c = 0; c < look.bodies.size(); ++c)
            is_closed_[c] = leave_out(look.bodies[c].volume, look.bodies[c].area) ? 0 : 1;
    }

  private:
    [[nodiscard]] BodySize size_of(Index body, const Points& positions) const
    {
        const std::span<const Index> faces = bodies_.faces[body];
        const Point origin = positions.row(mesh_.face(faces.front()).front());
        const auto n = static_cast<Index>(faces.size());
        BodySize size{
            .area = sum(run_serially, n, [&](Index i) { return vector_area(mesh_.face(faces[i]), positions).norm(); }),
            .volume = std::nullopt};
        if (is_closed_[usize(body)] != 0)
            size.volume = std::abs(
                sum(run_serially, n, [&](Index i) { return cone_volume(mesh_.face(faces[i]), positions, origin); }));
        return size;
    }

    const PolygonMesh& mesh_;
    const Executor& exec_;
    /// None where all vertices are in one.
    SurfaceComponents bodies_;
    /// Per body, if there are several: whether it encloses a volume.
    std::vector<std::uint8_t> is_closed_;
    /// Some of the faces, and their vertices in the mesh.
    PolygonMesh sample_;
    std::vector<Index> sampled_vertices_;
    bool has_volume_;
    std::optional<EnclosedCells> cells_;
};

/// The faces alone.
/// @param moved_with see MeshReport; not empty.
PolygonMesh joined(const PolygonMesh& mesh, const std::vector<Index>& moved_with, const Executor& exec)
{
    PolygonMesh faces{.vertices = Points(mesh.n_vertices(), 3),
                      .face_offsets = mesh.face_offsets,
                      .face_vertices = std::vector<Index>(mesh.face_vertices.size())};
    for_each(exec, mesh.n_corners(),
             [&](Index corner) { faces.face_vertices[corner] = moved_with[mesh.face_vertices[corner]]; });
    return faces;
}

void find_crossings(const PolygonMesh& mesh, const Points& before, SurfaceChange& change, const Executor& exec)
{
    const std::vector<FacePair> old_pairs = self_intersections(mesh, before, exec);
    const std::vector<FacePair> pairs = self_intersections(mesh, mesh.vertices, exec);
    change.before.self_intersections = old_pairs.size();
    change.after.self_intersections = pairs.size();
    change.new_self_intersections = static_cast<std::size_t>(std::ranges::count_if(
        pairs, [&](const FacePair& pair) { return !std::ranges::binary_search(old_pairs, pair); }));
}

}  // namespace

SurfaceChangeMeter::SurfaceChangeMeter(const PolygonMesh& mesh, const Executor& exec)
{
    copy(exec, mesh.vertices, positions_);
}

SurfaceChange SurfaceChangeMeter::measure(const PolygonMesh& mesh, const MeshReport& report, bool finds_crossings,
                                          const Executor& exec) const
{
    std::vector<LengthSums> of_block(usize(mesh.n_vertices() / block_size) + 1);
    for_each_block(exec, mesh.n_vertices(), [&](Index block, Index begin, Index end) {
        for (Index v = begin; v < end; ++v)
            if (!std::ranges::binary_search(report.unused_vertices, v))
                of_block[block].add((mesh.vertices.row(v) - positions_.row(v)).norm());
    });
    LengthSums moved;
    for (const LengthSums& sums : of_block)
        moved.add(sums);
    std::optional<PolygonMesh> single;
    if (!report.repeated_faces.empty())
        single = with_faces(mesh, [&](Index f) { return !std::ranges::binary_search(report.repeated_faces, f); });
    const PolygonMesh& flowing = single ? *single : mesh;
    std::optional<PolygonMesh> welded;
    if (!report.moved_with.empty())
        welded = joined(flowing, report.moved_with, exec);
    const PolygonMesh& faces = welded ? *welded : flowing;
    Surface surface(faces, exec);
    const bool has_sheets = report.junction_vertices + report.non_manifold_vertices > 0;
    SurfaceChange change;
    if (has_sheets)
        surface.find_cells(positions_, change);
    change.before = surface.look(positions_);
    surface.leave_out_rounding(change.before);
    change.after = surface.look(mesh.vertices);
    change.moved = moved.statistics();
    const std::vector<Index> flipped = flipped_faces(faces, positions_, mesh.vertices, exec);
    change.flipped_faces = flipped.size();
    change.folded_faces = flipped.empty() ? 0 : folded_faces(faces, positions_, mesh.vertices, flipped).size();
    if (finds_crossings)
        find_crossings(flowing, positions_, change, exec);
    return change;
}

}  // namespace seamflow
