#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/connected_components.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/denoised_normals.h"
#include "solvers/denoising/place_statistics.h"
#include "solvers/denoising/vertex_averages.h"

namespace seamflow {

/// The distance between neighbouring places, in rings of vertices.
inline constexpr int rings_between_places = 8;

/// #V: 1 for vertices whose faces lie in one plane up to rounding, such as those of a lake. They have no noise.
std::vector<std::uint8_t> flat_vertices(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                        const Executor& exec = run_serially);

/// Distinguishes noise from shape by the displacements that a denoiser would remove.
///
/// Places are vertices spread over the surface, each with the vertices around it. The displacements around each place,
/// by a denoiser and by a low-pass filter, are measured (see PlaceStatistics), and give evidence for noise or against
/// it (see evidence_of_noise). A component has noise if most of its places have evidence for it, except at places with
/// strong evidence against it. Any other component has noise only at places with strong evidence for it. Uncertain
/// places thus follow the rest of their component, and no other component matters. Vertices that would hardly move have
/// no noise.
class NoisyPlaces {
  public:
    /// The evidence that is required of components and places that are hard to judge.
    static constexpr float clear_evidence = 1.65F;

    /// @param topology with twins; not needed later. @param as_one whether all components are judged as one.
    /// @param n_thinned how often the mesh has been thinned.
    /// @param least_evidence the evidence that a component needs.
    NoisyPlaces(const PolygonMesh& mesh, const Topology& topology, bool as_one, int n_thinned, float least_evidence);

    /// The result of a denoiser, and the data by which it is judged. All members refer to the same mesh.
    struct Denoised {
        const PolygonMesh& mesh;
        const Topology& topology;
        const VertexAverages& averages;
        /// #V by 3: the positions before the denoiser, and after it.
        const Points& before;
        const Points& after;
        /// The estimated normals and noise.
        const DenoisedNormals& found;
        /// #V: 1 for vertices whose faces lie in one plane up to rounding, which have no noise (see flat_vertices).
        std::span<const std::uint8_t> is_flat;
    };

    /// Whether a vertex has correlated noise.
    enum class Correlation : std::uint8_t {
        /// It has none.
        None,
        /// The surface looks as if it had correlated noise; a thinned mesh must prove it.
        Possible,
        /// There is other noise besides; local fits have to show that the correlated noise is not shape.
        Doubtful,
        /// It has correlated noise, which is to be removed.
        Found
    };

    /// The result of `find`.
    struct Found {
        /// #V: the share of its displacement that each vertex moves by, from 0 to 1.
        std::vector<double> shares;
        /// #V: whether there is correlated noise (see Correlation), which a denoiser alone cannot completely
        /// distinguish from shape.
        std::vector<Correlation> correlated;
    };

    /// Decides at which vertices the removed displacements are noise.
    [[nodiscard]] Found find(const Denoised& denoised, const Executor& exec = run_serially) const;

    /// Displacements removed from a component that look like a pattern, not like noise.
    struct Structure {
        Index component;
        /// The vertex around which the displacements look most like a pattern.
        Index place;
    };

    /// Judges the removed displacements once more: noise cannot be predicted, a pattern comes back (see
    /// RemovalStatistics). Independent noise is averaged out first, so that a pattern beneath it is seen.
    /// @param taken with the positions that would result. @returns at most one per component, ascending by component.
    [[nodiscard]] std::vector<Structure> find_structure(const Denoised& taken,
                                                        const Executor& exec = run_serially) const;

    /// The components of the mesh, by faces.
    [[nodiscard]] const Components& components() const { return components_; }

  private:
    /// Per place: 1 if it has noise.
    /// @param evidence per place. @param sizes per component: the number of faces that are not at flat places.
    /// @param least_evidence the least lower quartile of the evidence at the places of a component with noise.
    /// @param finds_single_places whether single places can have noise in a component that has none as a whole.
    [[nodiscard]] std::vector<std::uint8_t> decide(std::span<const Index> component_of_place,
                                                   std::span<const float> evidence, std::span<const Index> sizes,
                                                   float least_evidence, bool finds_single_places) const;

    /// The components of the mesh, by faces. Each is judged by itself.
    Components components_;
    int n_thinned_;
    float least_evidence_;
};

/// The statistics of some places, for the training of the decision.
/// @param places vertices.
std::vector<PlaceStatistics> measure_places(const NoisyPlaces::Denoised& denoised, std::span<const Index> places,
                                            const Executor& exec = run_serially);

}  // namespace seamflow
