#pragma once

#include <optional>
#include <string>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/rounding/bounded_fairing.h"
#include "solvers/rounding/coordinate_bounds.h"

namespace seamflow {

/// A surface that is as smooth as rounded coordinates allow.
struct SmoothedWithinSteps {
    /// #V by 3.
    Points positions;
    /// The steps of x, y and z, in units of length; 0: not rounded.
    Point steps = Point::Zero();
    /// The last motion is in smallest steps. Nothing for marching cubes of equal steps.
    FairingReport fairing = {};
    /// Whether rounding explains the roughness of any component: within half a step it bends much less, and only few
    /// vertices would have to go further. On noise, which goes beyond half a step, and on shapes with edges at whole
    /// numbers, such as a box of blocks, either does not hold. Components of fewer than 200 faces are judged together.
    bool explains_roughness = false;
    /// #V by 3: `positions` on these components, those before on the others.
    Points where_explained = Points(0, 3);
};

/// Finds a smooth surface within bounds. First comes the fairest surface in the boxes (see fair_in_boxes), but for
/// marching cubes of equal steps: there edges are about as long as steps, and the umbrella would pull vertices along
/// the surface rather than smooth it. Then normals are averaged again and again, and vertices fitted to them within
/// the bounds, in two ways: over all neighbours, and over those on the same side of an edge. Of the two surfaces, the
/// one that bends less is the result, and the first if both bend alike. Normals are not averaged over other sheets.
/// Where components touch, copies of a vertex move as one (see join_copies), and no faces cross beside lines and sharp
/// edges that did not (see uncross_faces).
/// @pre bounds.kind is not None. @param topology with twins. Vertices that it fixes do not move. @param positions #V
/// by 3.
/// @param strengths #V: the fraction of its bounds that a vertex gets, 0 to 1; empty: 1.
SmoothedWithinSteps smooth_within(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                  CoordinateBounds bounds, const std::vector<double>& strengths,
                                  const Executor& exec = run_serially);

/// The bounds of a surface (see bounds_of).
CoordinateBounds bounds_of(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                           const Executor& exec = run_serially);

/// The bounds of a surface whose steps are known (see bounds_of).
CoordinateBounds bounds_of(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                           const Point& steps, const Executor& exec = run_serially);

/// Finds the steps of the coordinates, and the smooth surface within half a step. Spikes (see find_spikes), such as
/// heights for missing data, stay.
/// @param mesh, topology, positions, strengths as for smooth_within.
/// @returns the surface in which only components move whose roughness the steps explain; nothing if there are none, or
/// no steps.
std::optional<SmoothedWithinSteps> smooth_rounded(const PolygonMesh& mesh, const Topology& topology,
                                                  const Points& positions, const std::vector<double>& strengths,
                                                  const Executor& exec = run_serially);

/// "1 in x, y and z" if all steps are equal; otherwise "0.5 in x, 0.5 in y, 2.5 in z", without those that are 0.
std::string steps_in_words(const Point& steps);

}  // namespace seamflow
