#include "engine/surface/surface.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "engine/measure/remarks.h"
#include "engine/surface/constraints.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/cracks.h"

namespace seamflow {

namespace {

/// Makes a surface, step by step.
class SurfaceMaker {
  public:
    SurfaceMaker(FlowingMesh mesh, MotionOptions motion, const SurfaceRequest& request, Progress& progress)
        : surface_{.mesh = std::move(mesh)}
        , motion_(std::move(motion))
        , request_(request)
        , exec_(progress.exec())
    {
    }

    std::pair<Surface, MotionOptions> make()
    {
        leave_out_still_faces();
        measure_mesh();
        // Repeated faces are left out before seams are looked for along edges with one face: an edge of a face that is
        // repeated has two. With all faces in the result, none are left out; a strict flow refuses them (see
        // constrain).
        if (!request_.keeps_all_faces && !motion_.strict && mesh_.leave_out_repeated_faces(surface_.topology))
            measure_mesh();
        if (std::ranges::find(surface_.topology.kind, VertexKind::Isolated) != surface_.topology.kind.end())
            surface_.unused_vertices = mesh_.unused_vertices();
        mesh_.weld_seams(surface_.topology, motion_, exec_);
        constrain_vertices();
        std::optional<Cracks> cracks;
        if (motion_.weld && !request_.keeps_all_faces)
            cracks = find_cracks(mesh_.mesh(), surface_.topology, exec_);
        // Some faces repeat others only after vertices were joined.
        if (!request_.keeps_all_faces && mesh_.leave_out_repeated_faces(surface_.topology)) {
            measure_mesh();
            constrain_vertices();
        }
        if (request_.replace_faces && request_.replace_faces(surface_)) {
            measure_mesh();
            constrain_vertices();
        }
        // Where there are cracks, the remark must not advise a free boundary, which would open them.
        const std::vector<std::uint8_t>& fixed = surface_.topology.fixed;
        if (std::ranges::find(fixed, 0) == fixed.end() && mesh_.mesh().n_faces() > 0)
            surface_.remarks.push_back(remark_on_unmoving_mesh(cracks ? Boundary::Free : motion_.boundary));
        if (cracks)
            surface_.remarks.push_back(remark_on_cracks(*cracks));
        return {std::move(surface_), std::move(motion_)};
    }

  private:
    /// Leaves out the faces that the strengths hold, if this is requested.
    void leave_out_still_faces()
    {
        std::vector<double>& strength = motion_.strength;
        // Strengths of 1 everywhere change nothing.
        if (std::ranges::all_of(strength, [](double s) { return s == 1.0; }))
            strength.clear();
        if (request_.leaves_out_still_faces && !strength.empty() &&
            strength.size() == usize(mesh_.mesh().n_vertices()) &&
            mesh_.leave_out_still_faces(strength, traits_of(request_.laplacian).reach))
            surface_.choices.push_back(
                {"region alone",
                 {{"faces", mesh_.mesh().n_faces()}},
                 {fmt::format("Only the {} faces around the region flow, and are measured.", mesh_.mesh().n_faces())}});
    }

    /// Makes the topology and the sizes of the present mesh.
    void measure_mesh()
    {
        // One thread makes part of the topology: another one measures the mesh meanwhile.
        run_both([&] { surface_.topology = make_topology(mesh_.mesh(), exec_); },
                 [&] { surface_.size = size_of(mesh_.mesh()); });
    }

    /// Decides which vertices of the present mesh move, after measure_mesh().
    void constrain_vertices()
    {
        // Remarks on the mesh before its faces were changed no longer hold.
        surface_.remarks.clear();
        Topology& topology = surface_.topology;
        // Vertices that are joined may have edges without length.
        const bool has_lengths = surface_.size.has_lengths && mesh_.n_copies() == 0;
        constrain(topology, mesh_.mesh(), motion_, request_.laplacian, has_lengths, exec_, surface_.remarks);
        surface_.size.vertices -= static_cast<Index>(std::ranges::count(topology.kind, VertexKind::Isolated));
    }

    Surface surface_;
    FlowingMesh& mesh_ = surface_.mesh;
    MotionOptions motion_;
    const SurfaceRequest& request_;
    Executor exec_;
};

}  // namespace

std::pair<Surface, MotionOptions> make_surface(FlowingMesh mesh, MotionOptions motion, const SurfaceRequest& request,
                                               Progress& progress)
{
    return SurfaceMaker(std::move(mesh), std::move(motion), request, progress).make();
}

MeshReport report_on(const Surface& surface, const std::vector<double>& strength)
{
    const FlowingMesh& mesh = surface.mesh;
    const Topology& topology = surface.topology;
    MeshReport report;
    report.vertices = mesh.mesh().n_vertices();
    report.faces = mesh.mesh().n_faces();
    // Faces that were left out at the rim of a region are not reported.
    const auto count_in_region = [&](VertexKind kind) {
        Index n = 0;
        for (Index v = 0; v < mesh.mesh().n_vertices(); ++v)
            n += topology.kind[v] == kind && (strength.empty() || strength[v] >= MotionOptions::least_strength) ? 1 : 0;
        return n;
    };
    report.unused_vertices = surface.unused_vertices;
    report.non_manifold_vertices = count_in_region(VertexKind::NonManifold);
    report.junction_vertices = count_in_region(VertexKind::Junction);
    for (Index v = 0; v < mesh.mesh().n_vertices(); ++v)
        report.fixed_vertices += topology.moves(mesh.moves_with(v)) ? 0 : 1;
    return report;
}

}  // namespace seamflow
