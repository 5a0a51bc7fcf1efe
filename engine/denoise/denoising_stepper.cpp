#include "engine/denoise/denoising_stepper.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/index_lists.h"
#include "solvers/denoising/mesh_piece.h"
#include "solvers/normals/feature_lines.h"

namespace seamflow {

namespace {

/// If the fraction of the surface without noise is smaller than this, it is not mentioned.
constexpr double small_fraction = 0.05;

/// The vertices of edges, ascending.
std::vector<Index> vertices_of(const std::vector<Edge>& edges)
{
    std::vector<Index> vertices;
    for (const Edge& edge : edges)
        vertices.insert(vertices.end(), edge.begin(), edge.end());
    sort_unique(vertices);
    return vertices;
}

/// The rounding that is looked for: none if vertices move along lines that are no axes, on which bounds of coordinates
/// could not hold.
Rounding rounding_for(const RemoveNoise& method, const MotionDirection& direction)
{
    return direction.is_oblique() ? Rounding{.kind = Rounding::Kind::Never} : method.rounding;
}

}  // namespace

std::unique_ptr<const DenoisingStepper::CutOpen> DenoisingStepper::cut_open(const PolygonMesh& mesh,
                                                                            const Topology& topology,
                                                                            const std::vector<Edge>& feature_edges,
                                                                            const Executor& exec)
{
    if (feature_edges.empty())
        return nullptr;
    auto open = std::make_unique<CutOpen>();
    open->mesh = FeatureLines(mesh, topology, feature_edges).cut_open(mesh, topology);
    open->topology = make_topology(open->mesh, exec);
    if (!topology.junctions.empty())
        free_junctions(open->mesh, open->topology, exec);
    const Index n = open->mesh.n_vertices();
    open->vertex_of.resize(usize(n));
    // Also vertices without faces are copies of themselves.
    std::iota(open->vertex_of.begin(), open->vertex_of.begin() + mesh.n_vertices(), Index{0});
    for (Index h = 0; h < mesh.n_corners(); ++h)
        open->vertex_of[open->mesh.face_vertices[h]] = mesh.face_vertices[h];
    open->mesh.vertices = mesh.vertices(open->vertex_of, Eigen::all);
    const std::vector<Index> on_feature_edges = vertices_of(feature_edges);
    for (Index copy = 0; copy < n; ++copy) {
        const Index v = open->vertex_of[copy];
        open->topology.fixed[copy] = topology.moves(v) && !std::ranges::binary_search(on_feature_edges, v) ? 0 : 1;
    }
    return open;
}

DenoisingStepper::DenoisingStepper(const PolygonMesh& mesh, const Topology& topology, const MotionOptions& motion,
                                   const RemoveNoise& method, Progress& progress)
    : mesh_(&mesh)
    , topology_(&topology)
    , rounding_(rounding_for(method, motion.direction))
    , edge_angle_(method.edge_angle)
    , direction_(motion.direction)
    , joins_copies_(motion.weld.has_value())
    , within_(motion.within)
    , on_feature_edges_(vertices_of(motion.feature_edges))
    , open_(cut_open(mesh, topology, motion.feature_edges, progress.exec()))
    , strengths_(motion.strength)
    , denoiser_(open_ ? open_->mesh : mesh, open_ ? open_->topology : topology, progress.exec(), method.edge_angle)
    , positions_(mesh.vertices)
    , loops_(1.0, progress)
{
    if (motion.direction.kind != MotionDirection::Kind::Any)
        denoiser_.keep_rims();
    if (open_ && !strengths_.empty()) {
        strengths_.clear();
        for (const Index v : open_->vertex_of)
            strengths_.push_back(motion.strength[v]);
    }
}

RoundedMotion DenoisingStepper::rounded_motion() const
{
    RoundedMotion motion;
    // The copies of vertices on the other sides of feature edges come after the vertices.
    if (!strengths_.empty())
        motion.strengths.assign(strengths_.begin(), strengths_.begin() + mesh_->n_vertices());
    if (!on_feature_edges_.empty()) {
        motion.strengths.resize(usize(mesh_->n_vertices()), 1.0);
        for (const Index v : on_feature_edges_)
            motion.strengths[v] = 0.0;
    }
    // Vertices that move along one axis keep their other coordinates.
    if (direction_.kind == MotionDirection::Kind::Vector)
        motion.axes = (direction_.vector.array() != 0.0).cast<double>();
    if (rounding_.kind == Rounding::Kind::Given)
        motion.given_steps = rounding_.steps;
    motion.joins_copies = joins_copies_;
    if (within_ && within_->along_axes)
        motion.within_along_axes =
            Point(within_->lengths[0].value, within_->lengths[1].value, within_->lengths[2].value);
    else if (within_)
        motion.within = within_->lengths[0].value;
    return motion;
}

bool DenoisingStepper::smooth_within_rounding(const Points& before, const Executor& exec)
{
    // After the first step there is nothing left to smooth within the bounds.
    if (rounding_.kind == Rounding::Kind::Never || noise_ || mesh_->n_faces() == 0)
        return false;
    std::optional<SmoothedWithinSteps> smoothed = smooth_rounded(*mesh_, *topology_, before, rounded_motion(), exec);
    if (!smoothed)
        return false;
    positions_ = std::move(smoothed->positions);
    noise_.emplace();
    spikes_ = std::move(smoothed->spikes);
    rounded_ = {smoothed->steps, smoothed->fairing.iterations, smoothed->fairing.last_motion};
    is_rounded_ = std::move(smoothed->is_smoothed);
    const std::vector<Index> faces = select(exec, mesh_->n_faces(), [&](Index f) { return is_rounded_[f] == 0; });
    if (!faces.empty())
        remove_noise_of(faces, smoothed->is_copy, before, exec);
    return true;
}

void DenoisingStepper::remove_noise_of(const std::vector<Index>& faces, const std::vector<std::uint8_t>& held,
                                       const Points& before, const Executor& exec)
{
    MeshPiece piece =
        cut_out(open_ ? open_->mesh : *mesh_, open_ ? open_->topology : *topology_, of_copies(before), faces, exec);
    std::vector<double> strengths;
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
        Index& v = piece.vertices[i];
        if (!strengths_.empty())
            strengths.push_back(strengths_[v]);
        if (open_)
            v = open_->vertex_of[v];
        if (!held.empty() && held[v] != 0)
            piece.topology.fixed[i] = 1;
    }
    MeshDenoiser denoiser(piece.mesh, piece.topology, exec, edge_angle_);
    if (direction_.kind != MotionDirection::Kind::Any)
        denoiser.keep_rims();
    positions_(piece.vertices, Eigen::all) = denoiser.denoise(piece.mesh.vertices, strengths, exec);
    noise_ = denoiser.noise();
    const std::vector<Index> with_faces =
        select(exec, mesh_->n_vertices(), [&](Index v) { return !topology_->corners_at(v).empty(); });
    // A vertex on a feature edge has a copy on each side of it.
    sort_unique(piece.vertices);
    noise_->part *= static_cast<double>(piece.vertices.size()) / static_cast<double>(with_faces.size());
}

void DenoisingStepper::step(const Points& before)
{
    assert(&before != &positions_);
    const Executor exec = loops_.begin();
    if (rounded_)
        positions_ = before;
    else if (!smooth_within_rounding(before, exec))
        remove_noise(before, exec);
    loops_.end();
    if (!positions_.allFinite())
        throw ComputationError("the result is not finite: scale the mesh to a size nearer to 1");
}

Points DenoisingStepper::of_copies(const Points& positions) const
{
    return open_ ? Points(positions(open_->vertex_of, Eigen::all)) : positions;
}

void DenoisingStepper::remove_noise(const Points& before, const Executor& exec)
{
    if (open_)
        positions_ = denoiser_.denoise(of_copies(before), strengths_, exec).topRows(before.rows());
    else
        positions_ = denoiser_.denoise(before, strengths_, exec);
    if (noise_)
        return;
    noise_ = denoiser_.noise();
    spikes_ = denoiser_.spikes();
}

void DenoisingStepper::save(StepMemory& memory) const
{
    memory.positions = positions_;
    if (!noise_)
        return;
    memory.numbers = {noise_->deviation,      noise_->edge,           noise_->part,
                      noise_->rim_vertices,   noise_->kept.vertices,  noise_->kept.height,
                      noise_->kept.place.x(), noise_->kept.place.y(), noise_->kept.place.z()};
    memory.numbers.push_back(static_cast<double>(spikes_.size()));
    for (const Spike& spike : spikes_)
        memory.numbers.insert(memory.numbers.end(), {static_cast<double>(spike.vertex), spike.distance});
    memory.numbers.push_back(rounded_ ? 1.0 : 0.0);
    if (!rounded_)
        return;
    memory.numbers.insert(memory.numbers.end(), {rounded_->steps.x(), rounded_->steps.y(), rounded_->steps.z(),
                                                 static_cast<double>(rounded_->iterations), rounded_->last_motion});
    memory.arrays.emplace_back(Points::Zero(mesh_->n_faces(), 3));
    for (Index f = 0; f < mesh_->n_faces(); ++f)
        memory.arrays.back()(f, 0) = is_rounded_[f];
}

void DenoisingStepper::restore(const StepMemory& memory)
{
    positions_ = memory.positions;
    StepMemoryReader reader(memory);
    noise_.emplace();
    KeptStructure& kept = noise_->kept;
    for (double* number : {&noise_->deviation, &noise_->edge, &noise_->part, &noise_->rim_vertices, &kept.vertices,
                           &kept.height, &kept.place.x(), &kept.place.y(), &kept.place.z()})
        *number = reader.number();
    spikes_.clear();
    for (int n = reader.count(); n > 0; --n) {
        const Index vertex = reader.index(mesh_->n_vertices());
        spikes_.push_back({vertex, reader.number()});
    }
    if (reader.count() != 0) {
        rounded_.emplace();
        for (double& step : rounded_->steps)
            step = reader.number();
        rounded_->iterations = reader.count();
        rounded_->last_motion = reader.number();
        const Points& flags = reader.array(mesh_->n_faces());
        is_rounded_.resize(usize(mesh_->n_faces()));
        for (Index f = 0; f < mesh_->n_faces(); ++f)
            is_rounded_[f] = flags(f, 0) != 0.0 ? 1 : 0;
    }
    reader.require_end();
}

void DenoisingStepper::report_to(DenoiseReport& report) const
{
    if (mesh_->n_faces() == 0 || !noise_)
        return;
    const bool has_noise = noise_->part > 0.0;
    if (has_noise || !rounded_)
        report.noise = {noise_->edge > 0.0 ? noise_->deviation / noise_->edge : 0.0, noise_->part};
    if (!spikes_.empty())
        report.remarks.push_back(remark_on_spikes(spikes_));
    const KeptStructure& kept = noise_->kept;
    if (kept.vertices > 0.0)
        report.remarks.push_back(
            {"pattern kept",
             {{"vertices", kept.vertices},
              {"height", kept.height},
              {"x", kept.place.x()},
              {"y", kept.place.y()},
              {"z", kept.place.z()}},
             {fmt::format("What looked like noise comes back like a pattern, so it stays as it is: {:.0f} vertices, "
                          "which would have moved by up to {:.3g}, most clearly at {:.6g}, {:.6g}, {:.6g}. Use "
                          "<radius> to smooth it all the same.",
                          kept.vertices, kept.height, kept.place.x(), kept.place.y(), kept.place.z())}});
    if (rounded_) {
        const Point& steps = rounded_->steps;
        report.rounding = rounded_;
        const double part = static_cast<double>(std::ranges::count(is_rounded_, 1)) /
                            static_cast<double>(std::max(is_rounded_.size(), std::size_t{1}));
        const std::string where =
            part < 1.0 - small_fraction ? fmt::format(" on {:.0f}% of the faces", 100.0 * part) : std::string();
        report.choices.push_back(
            {"rounded coordinates",
             {{"x", steps.x()}, {"y", steps.y()}, {"z", steps.z()}, {"part", part}},
             {fmt::format("coordinates{} are rounded to {}: the smoothest surface within half a step{}{}", where,
                          steps_in_words(steps), within_ ? " and <within>" : "",
                          has_noise || noise_->rim_vertices > 0.0 ? ";" : "")}});
    }
    if (noise_->rim_vertices > 0.0)
        report.choices.push_back(
            {"smooth rims",
             {{"vertices", noise_->rim_vertices}},
             {fmt::format("noise or stairs of rims of {:.0f} vertices: removed; they became smooth curves{}",
                          noise_->rim_vertices, has_noise ? ";" : "")}});
    if (!has_noise) {
        if (noise_->rim_vertices == 0.0 && kept.vertices == 0.0 && !rounded_)
            report.remarks.push_back(
                {"no noise", {}, {"No noise was found: nothing is smoothed. Use <radius> to smooth anyway."}});
        return;
    }
    std::string where;
    if (noise_->part < 1.0 - small_fraction)
        where = fmt::format(" on {:.0f}% of the vertices, none on the others", 100.0 * noise_->part);
    report.choices.push_back(
        {"noise",
         {{"edge lengths", report.noise->deviation}, {"part", noise_->part}},
         {fmt::format(
             "noise of {:.2g} edge lengths ({:.2g}){}: removed; edges and details that it does not explain were "
             "kept",
             report.noise->deviation, noise_->deviation, where)}});
}

}  // namespace seamflow
