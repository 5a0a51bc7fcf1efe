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

/// How far apart places are, in rings of vertices.
inline constexpr int rings_between_places = 8;

/// 1 for the vertices whose faces lie in one plane up to rounding, such as those of a lake. They have no noise.
/// @returns #V.
std::vector<std::uint8_t> flat_vertices(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                        const Executor& exec = run_serially);

/// Tells noise from shape by what would be taken away.
///
/// Places are spread over the surface. The displacements around each of them, by a denoiser and by a low-pass filter,
/// are measured (see PlaceStatistics), and give evidence for noise or against it (see evidence_of_noise). A component
/// most of whose places have evidence for noise has noise, unless at places where the evidence is strong against it;
/// any other has noise only where it is strong for it. So places where nothing is certain follow the others, and no
/// other component matters. Where vertices would hardly move there is no noise.
class NoisyPlaces {
  public:
    /// The evidence that components and places need where little is certain otherwise.
    static constexpr float clear_evidence = 1.65F;

    /// @param topology with twins; not needed later. @param as_one whether all components are judged as one.
    /// @param n_thinned how often the mesh has been thinned out.
    /// @param least_evidence that a component needs.
    NoisyPlaces(const PolygonMesh& mesh, const Topology& topology, bool as_one = false, int n_thinned = 0,
                float least_evidence = 0.0F);

    /// A denoiser's result, and what it is judged by. All members refer to the same mesh.
    struct Denoised {
        const PolygonMesh& mesh;
        const Topology& topology;
        const VertexAverages& averages;
        /// #V by 3.
        const Points& before;
        const Points& after;
        const DenoisedNormals& found;
        /// #V: see flat_vertices.
        std::span<const std::uint8_t> is_flat;
    };

    /// Whether there is noise that is alike at neighbours.
    enum class Alikeness : std::uint8_t {
        None,
        /// It looks like it, but has to be proven on a thinned mesh.
        Possible,
        /// There is other noise besides, and fits have to show that it is clear of shape.
        Doubtful,
        Found
    };

    struct Found {
        /// #V: how much of its displacement each vertex should make, from 0 to 1.
        std::vector<double> parts;
        /// #V: where there is noise that is alike at neighbours, of which a denoiser cannot tell all from shape.
        std::vector<Alikeness> alike;
    };

    [[nodiscard]] Found find(const Denoised& denoised, const Executor& exec = run_serially) const;

    /// What was taken from a component, if it looks like a pattern rather than noise.
    struct Structure {
        Index component;
        /// A vertex, where it looks most like one.
        Index place;
    };

    /// Looks again at what was taken away: noise cannot be predicted, a pattern comes back (see TakenStatistics).
    /// Noise that is independent at neighbours is averaged out first, so that a pattern beneath it is seen.
    /// @param taken its positions after are those that would result. @returns by component.
    [[nodiscard]] std::vector<Structure> find_structure(const Denoised& taken,
                                                        const Executor& exec = run_serially) const;

    /// Of faces.
    [[nodiscard]] const Components& components() const { return components_; }

  private:
    /// Per place: 1 where there is noise.
    /// @param evidence per place. @param sizes per component: the number of faces that are not in flat places.
    /// @param least_evidence of the lower quartile of the places of a component.
    /// @param finds_single_places whether there may be noise at places of a component that has none as a whole.
    [[nodiscard]] std::vector<std::uint8_t> decide(std::span<const Index> component_of_place,
                                                   std::span<const float> evidence, std::span<const Index> sizes,
                                                   float least_evidence, bool finds_single_places) const;

    /// The components of the mesh, by faces: each is judged by itself.
    Components components_;
    int n_thinned_;
    float least_evidence_;
};

/// What is taken away around each of some places, for the training of the decision.
/// @param places vertices.
std::vector<PlaceStatistics> measure_places(const NoisyPlaces::Denoised& denoised, std::span<const Index> places,
                                            const Executor& exec = run_serially);

}  // namespace seamflow
