#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/metrics/edge_measures.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/denoised_normals.h"
#include "solvers/denoising/noisy_places.h"
#include "solvers/denoising/place_statistics.h"
#include "solvers/denoising/rim_filter.h"
#include "solvers/denoising/vertex_averages.h"

namespace seamflow {

/// Structure that looked like noise at first. It was put back into the surface.
struct KeptStructure {
    /// The number of vertices that have structure.
    double vertices = 0.0;
    /// The largest displacement that would have been removed there, in units of length; and the position of the vertex
    /// that looks most like structure, in the last of the components with structure.
    double height = 0.0;
    Point place = Point::Zero();
};

/// The noise of a surface.
struct SurfaceNoise {
    /// The standard deviation of the noise along the normals, over the vertices that have noise, in units of length.
    double deviation = 0.0;
    /// The root mean square length of the edges at these vertices, after the vertices were fitted to the estimated
    /// normals.
    double edge = 0.0;
    /// The fraction of the vertices with faces that have noise.
    double part = 0.0;
    /// The number of vertices of the boundary that leave noise or stairs of their rim (see RimFilter).
    double rim_vertices = 0.0;
    KeptStructure kept;
};

/// Removes noise: face normals are estimated, and the vertices move to fit them, along the normals unless a face would
/// fold; each vertex moves as far as there is noise (see denoise_normals, NoisyPlaces, along_normals). Rims lose their
/// noise within the surface (see RimFilter). No face turns over. Correlated noise looks like shape. Where there is
/// other noise as well, local fits remove it first (see CorrelatedNoise). Elsewhere it is sought and removed on thinned
/// meshes, whose vertices are few and far from each other (as Zhou and others, When AWGN-Based Denoiser Meets Real
/// Noises, 2020, do with pictures); then the rest of the noise is removed as above. Polygons are cut into triangles by
/// diagonals (see triangulate), because the estimates of normals are trained on triangles. Bits do not depend on how
/// loops are run.
class MeshDenoiser {
  public:
    /// @param mesh, topology must outlive the object; the twins of the topology are not needed later.
    /// @param edge_angle between the normals of faces, in degrees: the angle of the edges that take_smoother_places
    /// keeps; empty: that is not called. @param as_one whether all components together have noise or none.
    /// @param n_thinned how often the mesh has been thinned. @param least_evidence the evidence of noise that a
    /// component needs (see NoisyPlaces).
    MeshDenoiser(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially,
                 std::optional<double> edge_angle = default_edge_angle, bool as_one = false, int n_thinned = 0,
                 float least_evidence = 0.0F);

    static constexpr double default_edge_angle = 30.0;

    /// From now on, `denoise` leaves the noise of rims as it is: for flows in which vertices move only in given
    /// directions.
    void keep_rims() { keeps_rims_ = true; }

    /// @param before #V by 3. @param strengths #V: the fraction of its displacement that each vertex moves by; empty:
    /// 1.
    /// @returns #V by 3: the positions without noise. Spikes keep their positions (see spikes()).
    Points denoise(const Points& before, std::span<const double> strengths = {}, const Executor& exec = run_serially);

    /// Measures the displacements around some places, by which noise and shape are distinguished: for the training of
    /// this decision.
    /// @param most the largest number of places; they are spread over the mesh.
    [[nodiscard]] std::vector<PlaceStatistics> measure_places(Index most, const Executor& exec = run_serially) const;

    /// The noise that the last call of denoise found.
    [[nodiscard]] const SurfaceNoise& noise() const { return noise_; }

    /// The vertices that the last call of denoise left unchanged as spikes, ascending (see find_spikes).
    [[nodiscard]] const std::vector<Spike>& spikes() const { return spikes_; }

  private:
    /// A mesh of triangles, with its topology.
    struct Triangles {
        PolygonMesh mesh;
        Topology topology;
    };

    /// The analysis of the noise at some positions.
    struct Findings {
        DenoisedNormals normals;
        /// #V by 3: the denoised positions.
        Points fitted;
        /// #V: 1 for vertices whose faces lie in one plane up to rounding, which have no noise (see flat_vertices).
        std::vector<std::uint8_t> is_flat;
        NoisyPlaces::Found places;
    };

    /// Analyses the noise.
    /// @param before #V by 3, without spikes.
    [[nodiscard]] Findings examine(const Points& before, const Executor& exec) const;
    /// The findings in the form that NoisyPlaces takes; refers to the arguments.
    [[nodiscard]] NoisyPlaces::Denoised denoised(const Points& before, const Findings& found) const;
    /// Removes noise.
    /// @param before #V by 3, without spikes. @param strengths #V, or empty.
    Points without_noise(const Points& before, std::span<const double> strengths, const Executor& exec);
    /// Removes correlated noise: where there is other noise as well, which shows that it is not shape, by local fits,
    /// and on thinned meshes elsewhere. @returns #V by 3; nothing if there is no correlated noise.
    [[nodiscard]] std::optional<Points> without_correlated_noise(const Points& before, const NoisyPlaces::Found& places,
                                                                 const Executor& exec) const;
    /// Removes correlated noise on thinned meshes.
    /// @param correlated #V. @param which only vertices with this value of `correlated` move. @param result #V by 3:
    /// receives positions without noise where thinned meshes have noise.
    void remove_on_thinned(const Points& before, std::span<const NoisyPlaces::Correlation> correlated,
                           NoisyPlaces::Correlation which, Points& result, const Executor& exec) const;
    /// Moves vertices to fit normals.
    /// @param normals #F by 3. @param chord the mean chord between these normals and the normals of the faces.
    /// @param positions #V by 3.
    void fit(const Points& normals, double chord, Points& positions, const Executor& exec) const;
    /// Takes flatter normals where they are nearer to the truth (see take_flatter_normals), and fits vertices again:
    /// from `before` if there are such normals, and further where one fit is not enough.
    /// @param before #V by 3.
    void improve_fit(const Points& before, Findings& found, const Executor& exec) const;
    /// Puts back structure: at its vertices, `begun` becomes `before` again, and the shares of the further
    /// displacements become 0.
    /// @param begun #V by 3: the positions without correlated noise. @returns what was put back.
    [[nodiscard]] KeptStructure put_back_structure(const Points& before, Points& begun, Findings& found,
                                                   const Executor& exec) const;
    /// Applies keep_facing, with faces oriented to one side.
    /// @param before #V by 3. @param wanted #F by 3: the normals that the faces should have; 0: any. @param positions
    /// #V by 3; replaced.
    void keep_all_facing(const Points& before, Points wanted, Points& positions, const Executor& exec) const;
    /// Measures the noise for noise().
    /// @param motions #V by 3. @param shares #V: 0 for vertices without noise. @param is_flat #V: 1 for vertices whose
    /// faces lie in one plane, which have no noise. @param normals #F by 3. @param after #V by 3: the positions after
    /// the motions, at which edges are measured.
    void measure_noise(const Points& motions, std::span<const double> shares, std::span<const std::uint8_t> is_flat,
                       const Points& normals, const Points& after, const Executor& exec);

    /// Cuts polygons into triangles. Null if all faces of the mesh are triangles.
    static std::unique_ptr<const Triangles> cut_polygons(const PolygonMesh& mesh, const Topology& topology,
                                                         const Executor& exec);

    std::unique_ptr<const Triangles> triangles_;
    const PolygonMesh* polygons_;
    const Topology* polygon_topology_;
    /// The triangles that polygons are cut into, or the mesh itself if all its faces are triangles.
    const PolygonMesh* mesh_;
    const Topology* topology_;
    /// #F: -1 for faces that are reversed in oriented_, so that all faces look to the same side. Both members are empty
    /// if no face is reversed.
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

/// The noise of a mesh; for a large mesh, the noise of patches spread all over it (see take_filter_sample).
/// @param topology with twins.
SurfaceNoise measure_noise(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

}  // namespace seamflow
