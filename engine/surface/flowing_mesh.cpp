#include "engine/surface/flowing_mesh.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "engine/measure/remarks.h"
#include "engine/surface/origin_offset.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/repeated_faces.h"
#include "partition/weld.h"

namespace seamflow {

FlowingMesh::FlowingMesh(PolygonMesh& given)
    : given_(&given)
    , offset_(origin_offset(given))
{
    if (!is_shifted())
        return;
    isolated_ = unused_vertices();
    of_isolated_ = given.vertices(isolated_, Eigen::all);
    copy_ = given;
    copy_->vertices.rowwise() -= offset_;
}

std::vector<Index> FlowingMesh::unused_vertices() const
{
    const std::vector<std::uint8_t> is_used = used_by_faces(*given_, run_in_parallel);
    return select(run_in_parallel, given_->n_vertices(), [&](Index v) { return is_used[v] == 0; });
}

void FlowingMesh::weld_seams(Topology& topology, MotionOptions& motion, const Executor& exec)
{
    if (!motion.weld)
        return;
    std::optional<Weld> welded = weld(mesh(), topology, motion.weld->value, exec);
    if (!welded) {
        remark_on_seams_ = remark_on_seams(0, 0, given_->n_vertices(), motion.weld->value, 0.0);
        return;
    }
    representative_ = std::move(welded->representative);
    const Points& joined = welded->mesh.vertices;
    const Points& own = mesh().vertices;
    for (Index v = 0; v < given_->n_vertices(); ++v) {
        if (representative_[v] != v)
            copies_.push_back(v);
        // Compared byte by byte, because zeros of different sign differ.
        if (std::memcmp(own.row(v).data(), joined.row(representative_[v]).data(), sizeof(Point)) != 0)
            apart_.push_back({v, own.row(v), joined.row(representative_[v])});
    }
    double furthest = 0.0;
    for (const Apart& one : apart_)
        furthest = std::max(furthest, (one.joined - one.own).norm());
    remark_on_seams_ = remark_on_seams(welded->n_vertices, welded->n_edges, given_->n_vertices(), motion.weld->value,
                                       furthest > 0.0 ? furthest / mean_edge_length(mesh()) : 0.0);
    const auto join = [&](Index& v) {
        if (v >= 0 && v < given_->n_vertices())
            v = representative_[v];
    };
    for (Index& v : motion.fixed_vertices)
        join(v);
    for (Edge& edge : motion.feature_edges)
        std::ranges::for_each(edge, join);
    if (motion.attachment_weights.size() == representative_.size())
        for (const Index v : copies_) {
            double& weight = motion.attachment_weights[representative_[v]];
            weight = std::max(weight, motion.attachment_weights[v]);
        }
    if (motion.strength.size() == representative_.size())
        for (const Index v : copies_) {
            double& strength = motion.strength[representative_[v]];
            strength = std::min(strength, motion.strength[v]);
        }
    topology = std::move(welded->topology);
    copy_ = std::move(welded->mesh);
}

void FlowingMesh::set_isolated_positions(std::span<const Index> vertices, const Points& to)
{
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (const auto found = std::ranges::lower_bound(isolated_, vertices[i]);
            found != isolated_.end() && *found == vertices[i])
            of_isolated_.row(found - isolated_.begin()) = to.row(static_cast<Eigen::Index>(i));
}

bool FlowingMesh::leave_out_still_faces(std::span<const double> strength, Reach reach)
{
    const PolygonMesh& all = mesh();
    const auto select_faces = [&](const std::vector<std::uint8_t>& has) {
        return select(run_in_parallel, all.n_faces(),
                      [&](Index f) { return std::ranges::any_of(all.face(f), [&](Index v) { return has[v] != 0; }); });
    };
    std::vector<std::uint8_t> is_near(strength.size());
    for_each(run_in_parallel, all.n_vertices(),
             [&](Index v) { is_near[v] = strength[v] >= MotionOptions::least_strength ? 1 : 0; });
    std::vector<Index> faces = select_faces(is_near);
    const auto mark_corners = [&] {
        for (const Index f : faces)
            for (const Index v : all.face(f))
                is_near[v] = 1;
    };
    mark_corners();
    if (reach == Reach::TwoRings) {
        faces = select_faces(is_near);
        mark_corners();
    }
    if (std::ssize(faces) == all.n_faces())
        return false;
    std::vector<Index> number(usize(all.n_faces()), -1);
    PolygonMesh left;
    for (const Index f : faces) {
        number[f] = left.n_faces();
        left.add_face(all.face(f));
    }
    left.vertices = all.vertices;
    renumber(std::move(number));
    copy_ = std::move(left);
    return true;
}

/// Renumbers the faces.
/// @param number per face of mesh(): its number among the remaining faces; -1: the face does not move.
void FlowingMesh::renumber(std::vector<Index> number)
{
    if (number_.empty())
        number_ = std::move(number);
    else
        for (Index& of_face : number_)
            of_face = of_face < 0 ? -1 : number[of_face];
}

bool FlowingMesh::leave_out_repeated_faces(const Topology& topology)
{
    // A repeated face has vertices on edges of three faces or more. With junctions, some of these count as boundary.
    const auto is_suspicious = [&](Index v) {
        const VertexKind kind = topology.kind[v];
        return kind == VertexKind::NonManifold || kind == VertexKind::Junction ||
               (kind == VertexKind::Boundary && !topology.junctions.empty());
    };
    if (topology.junctions.empty() && std::ranges::find(topology.kind, VertexKind::NonManifold) == topology.kind.end())
        return false;
    const auto candidates = select(run_in_parallel, mesh().n_faces(),
                                   [&](Index f) { return std::ranges::any_of(mesh().face(f), is_suspicious); });
    const std::vector<RepeatedFace> repeated = find_repeated_faces(mesh(), candidates);
    if (repeated.empty())
        return false;
    std::vector<Index> number(usize(mesh().n_faces()), -1);
    PolygonMesh left;
    auto next = repeated.begin();
    for (Index f = 0; f < mesh().n_faces(); ++f) {
        if (next != repeated.end() && next->face == f) {
            number[f] = number[next++->first];
            continue;
        }
        number[f] = left.n_faces();
        left.add_face(mesh().face(f));
    }
    left.vertices = mesh().vertices;
    renumber(std::move(number));
    copy_ = std::move(left);
    return true;
}

void FlowingMesh::replace_faces(PolygonMesh triangles, std::span<const Index> face_of)
{
    std::vector<Index> number(usize(mesh().n_faces()));
    for (std::size_t t = face_of.size(); t-- > 0;)
        number[face_of[t]] = static_cast<Index>(t);
    renumber(std::move(number));
    copy_ = std::move(triangles);
}

std::vector<Index> FlowingMesh::of_faces_left(const std::vector<Index>& labels) const
{
    if (number_.empty() || labels.size() != number_.size())
        return labels;
    std::vector<Index> left;
    // number_ has the first triangle of each polygon; the polygon's further triangles, up to the next first one, get
    // its label, too.
    for (std::size_t f = 0; f < labels.size(); ++f)
        if (number_[f] >= std::ssize(left)) {
            left.resize(usize(number_[f]), left.empty() ? 0 : left.back());
            left.push_back(labels[f]);
        }
    left.resize(usize(mesh().n_faces()), left.empty() ? 0 : left.back());
    return left;
}

/// The faces of the given mesh that repeat others: they have the numbers of earlier faces.
std::vector<Index> FlowingMesh::repeated_faces() const
{
    std::vector<Index> repeated;
    Index n_left = 0;
    for (Index f = 0; f < static_cast<Index>(number_.size()); ++f)
        if (number_[f] >= n_left)
            n_left = number_[f] + 1;
        else if (number_[f] >= 0)
            repeated.push_back(f);
    return repeated;
}

void FlowingMesh::move_to(const Points& positions)
{
    copy(run_in_parallel, positions, given_->vertices);
    if (copy_) {
        copy_->vertices = positions;
        take_along(copy_->vertices);
    }
    bring_back(given_->vertices);
}

void FlowingMesh::bring_back(Points& positions) const
{
    take_along(positions);
    // Vertices that have not moved get their own positions back. This is decided before any representative is moved
    // back.
    std::vector<const Apart*> unmoved;
    for (const Apart& one : apart_)
        if (positions.row(one.vertex) == one.joined)
            unmoved.push_back(&one);
    for (const Apart* one : unmoved)
        positions.row(one->vertex) = one->own;
    if (is_shifted())
        shift_back(positions);
}

/// The first vertices of `separated` are those of mesh(): its faces get back their vertices in the given mesh. Corners
/// have the same numbers in both, because no face is left out (ReportOptions::keep_gaps).
void FlowingMesh::bring_back(PolygonMesh& separated) const
{
    if (!copies_.empty())
        for (std::size_t corner = 0; corner < separated.face_vertices.size(); ++corner)
            if (separated.face_vertices[corner] < given_->n_vertices())
                separated.face_vertices[corner] = given_->face_vertices[corner];
    bring_back(separated.vertices);
}

/// Moves positions near the origin back. For vertices without faces, this may not be exact.
void FlowingMesh::shift_back(Points& positions) const
{
    positions.rowwise() += offset_;
    for (std::size_t i = 0; i < isolated_.size(); ++i)
        positions.row(isolated_[i]) = of_isolated_.row(static_cast<Eigen::Index>(i));
}

void FlowingMesh::complete(RunReport& report) const
{
    if (!copies_.empty())
        report.mesh.moved_with = representative_;
    if (remark_on_seams_)
        report.remarks.push_back(*remark_on_seams_);
    if (number_.empty())
        return;
    report.mesh.faces += given_->n_faces() - mesh().n_faces();
    report.mesh.repeated_faces = repeated_faces();
    if (!report.mesh.repeated_faces.empty())
        report.remarks.push_back(remark_on_repeated_faces(std::ssize(report.mesh.repeated_faces)));
}

std::vector<Index> FlowingMesh::labels_of_given(std::vector<Index> labels, Index of_still) const
{
    if (number_.empty())
        return labels;
    std::vector<Index> of_given(number_.size());
    std::ranges::transform(number_, of_given.begin(),
                           [&](Index number) { return number < 0 ? of_still : labels[number]; });
    return of_given;
}

}  // namespace seamflow
