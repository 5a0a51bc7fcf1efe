#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "partition/executor.h"
#include "partition/metrics/edge_measures.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/rounding/bounded_fairing.h"

namespace seamflow {

/// How vertices may move within the rounding of their coordinates.
struct RoundedMotion {
    /// #V: the fraction of its bounds that a vertex gets, 0 to 1; empty: 1.
    std::vector<double> strengths = {};
    /// 1 for the axes along which vertices move, and 0 for the others.
    Point axes = Point::Ones();
    /// The steps of x, y and z, in units of length; 0: not rounded. Nothing: they are found, and count only where they
    /// explain what is rough.
    std::optional<Point> given_steps = std::nullopt;
    /// Whether copies of a vertex where components touch move as one (see join_copies).
    bool joins_copies = true;
    /// The largest distance of a vertex from where it was, in units of length, and that along each axis; without them,
    /// half a step alone bounds it.
    std::optional<double> within = std::nullopt;
    std::optional<Point> within_along_axes = std::nullopt;
};

/// A surface that is as smooth as rounded coordinates allow.
struct SmoothedWithinSteps {
    /// #V by 3.
    Points positions = Points(0, 3);
    /// The steps of x, y and z, in units of length; 0: not rounded.
    Point steps = Point::Zero();
    /// The last motion is in smallest steps. Nothing for marching cubes of equal steps.
    FairingReport fairing = {};
    /// #F: 1 in components that were smoothed, 0 in those whose roughness rounding does not explain: their vertices
    /// stayed, also those that they share with others.
    std::vector<std::uint8_t> is_smoothed = {};
    /// #V: 1 at vertices where components touch, which are copies of each other; empty: there are none.
    std::vector<std::uint8_t> is_copy = {};
    /// Vertices such as heights for missing data, which stayed.
    std::vector<Spike> spikes = {};
};

/// Finds the steps of the coordinates, and a smooth surface within half a step of them. First comes the fairest surface
/// in the boxes (see fair_in_boxes), but for marching cubes of equal steps: there edges are about as long as steps, and
/// the umbrella would pull vertices along the surface rather than smooth it. Then normals are averaged again and again,
/// and vertices fitted to them within the bounds, in two ways: over all neighbours, and over those on the same side of
/// an edge; not over other sheets. Of the two surfaces, the one that bends less is the result, and the first if both
/// bend alike. Where components touch, copies of a vertex move as one (see join_copies), and no faces cross beside
/// lines and sharp edges that did not (see uncross_faces). What is flat stays flat where no sheets meet (see
/// flat_facets).
///
/// Steps that are found explain the roughness of a component if within half a step it bends much less, and only few
/// vertices would have to go further. On noise, which goes beyond half a step, and on shapes with edges at whole
/// numbers, such as a box of blocks, either does not hold: these components stay. Components of fewer than 200 faces
/// are judged together, all others one by one, also where they touch. A wall between two components stays if one of
/// them stays. Steps that are given count on all components. Spikes (see find_spikes) stay, and count in nothing, and
/// so do vertices without data (see vertices_without_data) with their faces.
/// @param topology with twins. Vertices that it fixes do not move. @param positions #V by 3.
/// @returns nothing if there are no steps, or if they explain the roughness of no component.
std::optional<SmoothedWithinSteps> smooth_rounded(const PolygonMesh& mesh, const Topology& topology,
                                                  const Points& positions, const RoundedMotion& motion,
                                                  const Executor& exec = run_serially);

/// "1 in x, y and z" if all steps are equal; otherwise "0.5 in x, 0.5 in y, 2.5 in z", without those that are 0.
std::string steps_in_words(const Point& steps);

}  // namespace seamflow
