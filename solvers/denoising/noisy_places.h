#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/connected_components.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/denoised_normals.h"

namespace seamflow {

/// 1 for the vertices whose faces lie in one plane up to rounding, such as those of a lake. They have no noise.
/// @returns #V.
std::vector<std::uint8_t> flat_vertices(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                        const Executor& exec = run_serially);

/// What a component has.
enum class NoiseKind {
    None,
    /// Independent, or nearly, from vertex to vertex.
    White,
    /// Also alike at neighbours, so that a denoiser cannot tell all of it from shape.
    Alike,
};

/// Tells noise from shape by what a denoiser would take away.
///
/// Noise moves most vertices of a component, and neighbours hardly alike (its residual is white); a detail that the
/// denoiser takes for noise is somewhere, and moves neighbours alike. So a component has noise if the median of the
/// lengths along the normals by which its vertices would move is not tiny, and the motions of neighbours are hardly
/// correlated, apart from flat places; or if the noise is so large that there is no doubt. Within a component, places
/// where vertices would hardly move have no noise. No other component matters, and no single vertex does.
class NoisyPlaces {
  public:
    /// @param topology with twins; not needed later. @param as_one whether all components are judged as one.
    /// @param is_thinned whether the surface bends more from edge to edge than it was made to: less counts as noise.
    NoisyPlaces(const PolygonMesh& mesh, const Topology& topology, bool as_one = false, bool is_thinned = false);

    struct Found {
        /// #V: how much of its motion each vertex should make, from 0 to 1.
        std::vector<double> parts;
        /// Per component.
        std::vector<NoiseKind> kinds;
    };

    /// @param before, after #V by 3. @param found of the positions before. @param is_flat #V: see flat_vertices.
    [[nodiscard]] Found find(const PolygonMesh& mesh, const Topology& topology, const Points& before,
                             const Points& after, const DenoisedNormals& found, std::span<const std::uint8_t> is_flat,
                             const Executor& exec = run_serially) const;

    /// Of faces.
    [[nodiscard]] const Components& components() const { return components_; }

  private:
    /// The components of the mesh, by faces: each is judged by itself.
    Components components_;
    bool is_thinned_;
};

}  // namespace seamflow
