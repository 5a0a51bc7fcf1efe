#include <cmath>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/metrics/vertex_normals.h"
#include "samples/meshes/meshes.h"
#include "solvers/denoising/mesh_denoiser.h"
#include "tests/support/denoising.h"
#include "tests/support/reliefs.h"

using namespace seamflow;

namespace {

constexpr Index few_vertices = 3844;

Points cleaned(const PolygonMesh& mesh)
{
    const Topology topology = make_topology(mesh);
    return MeshDenoiser(mesh, topology).denoise(mesh.vertices);
}

/// The part of the height that is left, by regression: noise does not matter.
double height_kept(const test::ReliefSurface& truth, const Points& positions)
{
    const Eigen::Map<const Eigen::ArrayXd> heights(truth.heights.data(), static_cast<Index>(truth.heights.size()));
    const Eigen::ArrayXd relief = heights - heights.mean();
    const Eigen::ArrayXd motion = (positions - truth.mesh.vertices).cwiseProduct(truth.normals).rowwise().sum();
    return (relief * (relief + motion)).sum() / relief.square().sum();
}

/// The root mean square distance from the truth along its normals, in mean edges.
double error_of(const PolygonMesh& truth, const Points& positions)
{
    const Topology topology = make_topology(truth);
    const VertexNormals normals(truth, topology);
    double sum = 0.0;
    for (Index v = 0; v < truth.n_vertices(); ++v) {
        const double off = (positions.row(v) - truth.vertices.row(v)).dot(normals(v, truth.vertices));
        sum += off * off;
    }
    return std::sqrt(sum / truth.n_vertices()) / mean_edge_length(truth);
}

}  // namespace

TEST_CASE("a clean relief stays bit for bit: patterns that come back and irregular ones, fine and coarse, on any body")
{
    struct Case {
        test::ReliefKind kind;
        Index vertices;
        /// How far vertices move at most, in mean edges.
        double motion;
    };
    std::vector<Case> cases;
    for (const test::ReliefKind& kind : test::relief_kinds())
        cases.push_back({kind, few_vertices, 0.0});
    REQUIRE(cases.size() == 72);
    // On larger bodies more is to be seen of a pattern.
    for (std::size_t i = 0; i < 72; i += 6)
        cases.push_back({cases[i].kind, 10'000, 0.0});
    for_each(run_in_parallel, static_cast<Index>(cases.size()), [&](Index i) {
        Case& c = cases[usize(i)];
        const PolygonMesh mesh = test::make_relief(c.kind, c.vertices).mesh;
        c.motion = (cleaned(mesh) - mesh.vertices).rowwise().norm().maxCoeff() / mean_edge_length(mesh);
    });
    for (const Case& c : cases) {
        CAPTURE(c.kind.name);
        CAPTURE(c.kind.wavelength);
        CAPTURE(c.vertices);
        CHECK(c.motion == 0.0);
    }
}

TEST_CASE(
    "of a relief of eight edges and more nine tenths of the height stay under a little noise, and much noise goes")
{
    struct Outcome {
        double kept;
        double before;
        double after;
    };
    std::vector<test::ReliefKind> kinds;
    for (const test::ReliefKind& kind : test::relief_kinds())
        if (kind.wavelength >= 8.0 && kind.height >= 1.0 && kind.share == 1.0)
            kinds.push_back(kind);
    for (const double sigma : {0.1, 0.3}) {
        CAPTURE(sigma);
        std::vector<Outcome> outcomes(kinds.size());
        for_each(run_in_parallel, static_cast<Index>(kinds.size()), [&](Index i) {
            const test::ReliefSurface truth = test::make_relief(kinds[usize(i)], few_vertices);
            const PolygonMesh noisy = test::with_gaussian_noise(truth.mesh, sigma, 3);
            const Points result = cleaned(noisy);
            outcomes[usize(i)] = {height_kept(truth, result), error_of(truth.mesh, noisy.vertices),
                                  error_of(truth.mesh, result)};
        });
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            CAPTURE(kinds[i].name);
            CAPTURE(kinds[i].wavelength);
            CHECK(outcomes[i].kept > (sigma < 0.2 ? 0.9 : 0.65));
            CHECK(outcomes[i].after < 1.02 * outcomes[i].before);
        }
    }
}

TEST_CASE("shallow relief that would go with the noise on it is put back, and where it is is known")
{
    int n_seen = 0;
    for (test::ReliefKind kind : test::relief_kinds()) {
        if (kind.name != "thread" || kind.wavelength != 8.0)
            continue;
        CAPTURE(kind.name);
        ++n_seen;
        kind.height = 0.1;
        const test::ReliefSurface truth = test::make_relief(kind, few_vertices);
        const PolygonMesh noisy = test::with_gaussian_noise(truth.mesh, 0.1, 3);
        const Topology topology = make_topology(noisy);
        MeshDenoiser denoiser(noisy, topology);
        const Points result = denoiser.denoise(noisy.vertices);
        CHECK(height_kept(truth, result) > 0.9);
        const KeptStructure& kept = denoiser.noise().kept;
        CHECK(kept.vertices > 0.8 * noisy.n_vertices());
        CHECK(kept.height > 0.1 * mean_edge_length(noisy));
        CHECK(kept.height < mean_edge_length(noisy));
        CHECK((noisy.vertices.rowwise() - kept.place).rowwise().norm().minCoeff() == 0.0);
        CHECK(denoiser.noise().part == 0.0);
    }
    CHECK(n_seen == 1);
    // Of noise alone nothing is.
    PolygonMesh ball = make_noisy_sphere(few_vertices, {.amplitude = 0.1, .noise = 0.0});
    ball = test::with_gaussian_noise(ball, 0.2, 3);
    const Topology topology = make_topology(ball);
    MeshDenoiser denoiser(ball, topology);
    denoiser.denoise(ball.vertices);
    CHECK(denoiser.noise().kept.vertices == 0.0);
    CHECK(denoiser.noise().part > 0.9);
}
