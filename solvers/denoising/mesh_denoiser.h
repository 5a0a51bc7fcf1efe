#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/metrics/spikes.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/denoised_normals.h"
#include "solvers/denoising/noisy_places.h"
#include "solvers/denoising/place_statistics.h"
#include "solvers/denoising/rim_filter.h"
#include "solvers/denoising/vertex_averages.h"

namespace seamflow {

/// What looked like noise at first, but has structure: it was put back.
struct KeptStructure {
    /// How many vertices have it.
    double vertices = 0.0;
    /// How far they would have gone at most, and where it looks most like structure: in units of length.
    double height = 0.0;
    Point place = Point::Zero();
};

/// The noise of a surface.
struct SurfaceNoise {
    /// The standard deviation of the vertices along the normals, where there is noise: in units of length.
    double deviation = 0.0;
    /// The root mean square length of edges there, in the result.
    double edge = 0.0;
    /// The fraction of vertices that have noise.
    double part = 0.0;
    /// The number of vertices of the boundary that leave noise or stairs of their rim (see RimFilter).
    double rim_vertices = 0.0;
    KeptStructure kept;
};

/// Removes noise: face normals are estimated, and the vertices move to fit them, along the normals unless a face would
/// fold; each as far as there is noise (see denoise_normals, NoisyPlaces, along_normals). Rims lose theirs within the
/// surface. No face turns over. Noise that is alike at neighbours looks like shape. Where there is other noise as well,
/// local fits take it first (see AlikeNoise); elsewhere it is looked for on thinned meshes, where few vertices are
/// left, far from each other, and removed there (as Zhou and others, When AWGN-Based Denoiser Meets Real Noises, 2020,
/// do with pictures); then what is left of it is removed as above. Polygons count as the triangles into which their
/// diagonals cut them (see triangulate): estimates of normals are trained on triangles. Bits do not depend on how loops
/// are run.
class MeshDenoiser {
  public:
    /// @param mesh, topology must outlive the object; the twins of the topology are not needed later.
    /// @param edge_angle between the normals of faces, in degrees: the edges that stay where noise is small (see
    /// take_smoother_places), if that is to be used. @param as_one whether all components have noise or none.
    /// @param n_thinned how often the mesh has been thinned out. @param least_evidence see NoisyPlaces.
    MeshDenoiser(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially,
                 std::optional<double> edge_angle = default_edge_angle, bool as_one = false, int n_thinned = 0,
                 float least_evidence = 0.0F);

    static constexpr double default_edge_angle = 30.0;

    /// Rims keep their noise: what moves them within the surface is no use where vertices move in given directions.
    void keep_rims() { keeps_rims_ = true; }

    /// @param before #V by 3. @param strengths #V: the part of each displacement that vertices go; empty: 1.
    /// @returns #V by 3.
    Points denoise(const Points& before, std::span<const double> strengths = {}, const Executor& exec = run_serially);

    /// What is taken away around some places, of which noise is told from shape: for the training of this decision.
    /// @param most how many at most, spread over the mesh in its positions.
    [[nodiscard]] std::vector<PlaceStatistics> measure_places(Index most, const Executor& exec = run_serially) const;

    /// That was found by the last call of denoise.
    [[nodiscard]] const SurfaceNoise& noise() const { return noise_; }

    /// The vertices that stayed then as spikes, ascending (see find_spikes).
    [[nodiscard]] const std::vector<Spike>& spikes() const { return spikes_; }

  private:
    struct Triangles {
        PolygonMesh mesh;
        Topology topology;
    };

    /// What is found in some positions.
    struct Findings {
        DenoisedNormals normals;
        /// #V by 3: where vertices would go.
        Points fitted;
        /// #V.
        std::vector<std::uint8_t> is_flat;
        NoisyPlaces::Found places;
    };

    /// @param before #V by 3, without spikes.
    [[nodiscard]] Findings examine(const Points& before, const Executor& exec) const;
    [[nodiscard]] NoisyPlaces::Denoised denoised(const Points& before, const Findings& found) const;
    /// @param strengths #V, or empty.
    Points without_noise(const Points& before, std::span<const double> strengths, const Executor& exec);
    /// Removes noise that is alike at neighbours: by local fits where there is other noise as well, which tells it from
    /// shape, and on thinned meshes elsewhere. @returns #V by 3; nothing if there is no such noise.
    [[nodiscard]] std::optional<Points> without_alike_noise(const Points& before, const NoisyPlaces::Found& places,
                                                            const Executor& exec) const;
    /// @param alike #V. @param which vertices are wanted. @param result #V by 3: where noise is found on thinned
    /// meshes, positions without it.
    void remove_on_thinned(const Points& before, std::span<const NoisyPlaces::Alikeness> alike,
                           NoisyPlaces::Alikeness which, Points& result, const Executor& exec) const;
    /// Fits vertices to normals again where one fit was not enough. @param normals #F by 3. @param fitted #V by 3.
    void fit_further(const Points& normals, Points& fitted, const Executor& exec) const;
    /// Puts back what was taken where it has structure: there nothing has begun, nor will any part go.
    /// @param begun #V by 3: without noise that is alike at neighbours.
    [[nodiscard]] KeptStructure put_back_structure(const Points& before, Points& begun, Findings& found,
                                                   const Executor& exec) const;
    /// See keep_facing.
    void keep_all_facing(const Points& before, Points wanted, Points& positions, const Executor& exec) const;
    /// @param motions #V by 3, to the positions after. @param parts #V: 0 where there is no noise, nor where is_flat.
    /// @param normals #F by 3.
    void measure_noise(const Points& motions, std::span<const double> parts, std::span<const std::uint8_t> is_flat,
                       const Points& normals, const Points& after, const Executor& exec);

    /// Null if the mesh itself has no other faces.
    static std::unique_ptr<const Triangles> cut_polygons(const PolygonMesh& mesh, const Topology& topology,
                                                         const Executor& exec);

    std::unique_ptr<const Triangles> triangles_;
    const PolygonMesh* polygons_;
    const Topology* polygon_topology_;
    /// The triangles that polygons are cut into, or the mesh itself if it has no others.
    const PolygonMesh* mesh_;
    const Topology* topology_;
    /// #F: -1 for the faces that are turned round in oriented_, so that all look to the same side; both empty: none is.
    std::vector<std::int8_t> signs_;
    PolygonMesh oriented_;
    VertexAverages averages_;
    NoisyPlaces places_;
    RimFilter rims_;
    bool keeps_rims_ = false;
    std::optional<double> edge_angle_;
    bool as_one_;
    int n_thinned_;
    SurfaceNoise noise_;
    std::vector<Spike> spikes_;
};

/// The noise of a mesh, or of patches spread all over it if it is large (see take_filter_sample).
/// @param topology with twins.
SurfaceNoise measure_noise(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

}  // namespace seamflow
