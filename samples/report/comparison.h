#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "partition/executor.h"
#include "partition/metrics/displacement.h"
#include "partition/metrics/length_statistics.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The direction of H_: from the vertices of one mesh to the surface of the other.
enum class Direction {
    /// The paper's.
    ReferenceToCandidate,
    CandidateToReference,
    /// One after the other.
    Both,
    /// The larger of the two, number by number.
    Symmetric,
};

/// Its name on the command line.
std::string_view name_of(Direction direction);

/// The results of `compare`.
struct Comparison {
    /// Names of the files.
    std::string reference;
    std::string candidate;
    /// Of the reference.
    Index vertices = 0;
    Index faces = 0;
    /// Mean edge length of the reference, over its half-edges, in units of length; 0 without faces.
    double mean_edge = 0.0;
    /// V_, where the vertices correspond.
    std::optional<VertexDistance> vertex_distance;
    Direction direction = Direction::ReferenceToCandidate;
    /// H_ in this direction (Both: from the reference to the candidate), where both meshes have faces.
    std::optional<LengthStatistics> surface_distance;
    /// With Direction::Both: H_ from the candidate to the reference.
    std::optional<LengthStatistics> surface_distance_back;
    /// From the reference to the candidate, where the vertices correspond.
    std::optional<DisplacementStatistics> displacement;
    /// The number of faces whose normal has turned by more than 90° (see flipped_faces), where the vertices correspond.
    std::optional<Index> flipped_faces;
    /// Numbers of pairs of faces that cross each other in the reference, and in the candidate (see self_intersections).
    Index self_intersections = 0;
    Index candidate_self_intersections = 0;
    /// Sentences for the user: what was left out, and why.
    std::vector<std::string> remarks;
};

/// Why the vertices of two meshes do not correspond; empty if they do: the same number of vertices and the same faces.
std::string why_not_corresponding(const PolygonMesh& reference, const PolygonMesh& candidate);

/// Measures everything that can be measured for two meshes; the caller sets the names of the files.
/// @throws InputError if nothing can be measured.
Comparison compare_meshes(const PolygonMesh& reference, const PolygonMesh& candidate, Direction direction,
                          const Executor& exec = run_serially);

}  // namespace seamflow
