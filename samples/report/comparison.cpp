#include "samples/report/comparison.h"

#include <algorithm>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/metrics/flipped_faces.h"
#include "partition/metrics/self_intersections.h"
#include "partition/metrics/surface_distance.h"

namespace seamflow {

namespace {

std::string difference(const char* what, Index reference, Index candidate)
{
    return fmt::format("REFERENCE has {} {}, CANDIDATE {}", reference, what, candidate);
}

void measure_surfaces(const PolygonMesh& reference, const PolygonMesh& candidate, Comparison& comparison,
                      const Executor& exec)
{
    switch (comparison.direction) {
    case Direction::ReferenceToCandidate:
        comparison.surface_distance = surface_distance(reference, candidate, exec);
        break;
    case Direction::CandidateToReference:
        comparison.surface_distance = surface_distance(candidate, reference, exec);
        break;
    case Direction::Both:
        comparison.surface_distance = surface_distance(reference, candidate, exec);
        comparison.surface_distance_back = surface_distance(candidate, reference, exec);
        break;
    case Direction::Symmetric:
        comparison.surface_distance =
            larger_of(surface_distance(reference, candidate, exec), surface_distance(candidate, reference, exec));
        break;
    }
}

void measure_vertices(const PolygonMesh& reference, const PolygonMesh& candidate, Comparison& comparison,
                      const Executor& exec)
{
    comparison.vertex_distance = vertex_distance(reference, reference.vertices, candidate.vertices);
    comparison.displacement =
        displacement_statistics(displacement_field(reference, reference.vertices, candidate.vertices));
    comparison.flipped_faces =
        static_cast<Index>(flipped_faces(reference, reference.vertices, candidate.vertices, exec).size());
}

Index n_crossing(const PolygonMesh& mesh, const Executor& exec)
{
    return static_cast<Index>(self_intersections(mesh, mesh.vertices, exec).size());
}

}  // namespace

std::string_view name_of(Direction direction)
{
    switch (direction) {
    case Direction::ReferenceToCandidate:
        return "reference-to-candidate";
    case Direction::CandidateToReference:
        return "candidate-to-reference";
    case Direction::Both:
        return "both";
    case Direction::Symmetric:
        return "symmetric";
    }
    return "";
}

std::string why_not_corresponding(const PolygonMesh& reference, const PolygonMesh& candidate)
{
    if (reference.n_vertices() != candidate.n_vertices())
        return difference("vertices", reference.n_vertices(), candidate.n_vertices());
    if (reference.n_faces() != candidate.n_faces())
        return difference("faces", reference.n_faces(), candidate.n_faces());
    for (Index f = 0; f < reference.n_faces(); ++f)
        if (!std::ranges::equal(reference.face(f), candidate.face(f)))
            return fmt::format("face {} (counted from 0) has different vertices, or the same in another order", f);
    return {};
}

Comparison compare_meshes(const PolygonMesh& reference, const PolygonMesh& candidate, Direction direction,
                          const Executor& exec)
{
    Comparison comparison;
    comparison.vertices = reference.n_vertices();
    comparison.faces = reference.n_faces();
    comparison.mean_edge = mean_edge_length(reference);
    comparison.direction = direction;
    const std::string mismatch = why_not_corresponding(reference, candidate);
    if (mismatch.empty())
        measure_vertices(reference, candidate, comparison, exec);
    else
        comparison.remarks.push_back(
            "V_ and displacements are left out, because the vertices do not correspond: " + mismatch + ".");
    if (reference.n_faces() > 0 && candidate.n_faces() > 0)
        measure_surfaces(reference, candidate, comparison, exec);
    else if (mismatch.empty())
        comparison.remarks.push_back("H_ is left out, because without faces there is no surface.");
    else
        throw InputError("the meshes have nothing to compare: without faces there is no surface, and their vertices do "
                         "not correspond: " +
                         mismatch);
    comparison.self_intersections = n_crossing(reference, exec);
    comparison.candidate_self_intersections = n_crossing(candidate, exec);
    return comparison;
}

}  // namespace seamflow
