#include "samples/report/surface_change.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "partition/index_lists.h"
#include "partition/metrics/cells.h"
#include "partition/metrics/flipped_faces.h"
#include "partition/metrics/self_intersections.h"
#include "partition/metrics/volume.h"
#include "partition/vector_area.h"
#include "samples/meshes/surface_sample.h"

namespace seamflow {

namespace {

/// The mesh, and some of its faces, as its vertices move.
class Surface {
  public:
    Surface(const PolygonMesh& mesh, const Executor& exec)
        : mesh_(mesh)
        , exec_(exec)
        , has_volume_(encloses_volume(mesh, exec))
    {
        std::vector<char> is_in_sample(at(mesh.n_vertices()));
        for_each(exec, mesh.n_vertices(), [&](Index v) { is_in_sample[v] = is_sampled(v, mesh.n_vertices()) ? 1 : 0; });
        const std::vector<Index> faces = select(exec, mesh.n_faces(), [&](Index f) {
            return std::ranges::any_of(mesh.face(f), [&](Index v) { return is_in_sample[v] != 0; });
        });
        IndexLists corners;
        for (const Index f : faces) {
            corners.values.insert(corners.values.end(), mesh.face(f).begin(), mesh.face(f).end());
            corners.close();
        }
        sampled_vertices_ = corners.values;
        sort_unique(sampled_vertices_);
        sample_ = extract(corners, sampled_vertices_);
    }

    /// From now on, looks have the cells that the sheets enclose at these positions, unless sheets overlap.
    void find_cells(const Points& positions, SurfaceChange& change)
    {
        EnclosedCells cells = seamflow::find_cells(mesh_, positions, exec_);
        change.overlaps = at(cells.n_overlaps);
        change.surfaces = at(cells.n_surfaces);
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
        return look;
    }

  private:
    const PolygonMesh& mesh_;
    const Executor& exec_;
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
    : positions_(mesh.n_vertices(), 3)
{
    copy(exec, mesh.vertices, positions_);
}

SurfaceChange SurfaceChangeMeter::measure(const PolygonMesh& mesh, const MeshReport& report, bool finds_crossings,
                                          const Executor& exec) const
{
    std::vector<LengthSums> of_block(at(mesh.n_vertices() / block_size) + 1);
    for_each_block(exec, mesh.n_vertices(), [&](Index block, Index begin, Index end) {
        for (Index v = begin; v < end; ++v)
            if (!std::ranges::binary_search(report.unused_vertices, v))
                of_block[block].add((mesh.vertices.row(v) - positions_.row(v)).norm());
    });
    LengthSums moved;
    for (const LengthSums& sums : of_block)
        moved.add(sums);
    std::optional<PolygonMesh> welded;
    if (!report.moved_with.empty())
        welded = joined(mesh, report.moved_with, exec);
    const PolygonMesh& faces = welded ? *welded : mesh;
    Surface surface(faces, exec);
    const bool has_sheets = report.junction_vertices + report.non_manifold_vertices > 0;
    SurfaceChange change;
    if (has_sheets)
        surface.find_cells(positions_, change);
    change.before = surface.look(positions_);
    change.after = surface.look(mesh.vertices);
    change.moved = moved.statistics();
    const std::vector<Index> flipped = flipped_faces(faces, positions_, mesh.vertices, exec);
    change.flipped_faces = flipped.size();
    change.folded_faces = flipped.empty() ? 0 : folded_faces(faces, positions_, mesh.vertices, flipped).size();
    if (finds_crossings)
        find_crossings(mesh, positions_, change, exec);
    return change;
}

}  // namespace seamflow
