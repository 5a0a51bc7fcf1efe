#pragma once

#include <array>
#include <span>
#include <vector>

#include "partition/connected_components.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Takes noise from the boundary of a surface, within the surface: a rim is a curve, whose directions are averaged
/// where they are alike (the bilateral filter), and whose vertices then move to fit them, at right angles to the rim.
/// So corners stay, and nothing shrinks. As on the surface (see NoisyPlaces), the rim has noise if most vertices would
/// move, and neighbours hardly alike; else nothing moves.
class RimFilter {
  public:
    /// @param topology with twins; not needed later.
    RimFilter(const PolygonMesh& mesh, const Topology& topology);

    /// Moves the vertices of rims that have noise.
    /// @param normals #F by 3: of the surface, of length 1 or 0.
    /// @param parts #V: how much of its motion each vertex makes. @param positions #V by 3; replaced.
    void apply(const Topology& topology, const Points& normals, const std::vector<double>& parts,
               Points& positions) const;

  private:
    /// An edge of one face.
    struct Segment {
        /// Places in vertices_.
        std::array<Index, 2> ends;
        Index face;
        /// The segments that share an end with this one, or -1.
        std::array<Index, 2> neighbours{-1, -1};
        /// -1 where they run the other way.
        std::array<double, 2> signs{1.0, 1.0};
    };

    /// Per segment, of length 1 or 0: at right angles to it, within the surface, after smoothing.
    /// @param positions of vertices_.
    [[nodiscard]] Points smooth_normals(const Points& normals, const Points& positions) const;
    [[nodiscard]] bool is_noisy(std::span<const Index> rim, const Points& across, const Points& before,
                                const Points& after) const;

    /// The vertices of all rims, ascending.
    std::vector<Index> vertices_;
    std::vector<Segment> segments_;
    /// The connected components of segments; each is a rim.
    Components rims_;
};

}  // namespace seamflow
