#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "samples/meshes/meshes.h"
#include "solvers/denoising/denoised_normals.h"
#include "solvers/denoising/mixing_network.h"
#include "solvers/denoising/mixing_weights.h"
#include "solvers/denoising/normal_motion.h"
#include "solvers/denoising/position_filters.h"
#include "tests/support/denoising.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::relative;

namespace {

/// Of the faces of a mesh where it is.
Points normals_of(const PolygonMesh& mesh)
{
    Points normals(mesh.n_faces(), 3);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        normals.row(f) = vector_area(mesh.face(f), mesh.vertices).normalized();
    return normals;
}

double mean_angle(const Points& a, const Points& b)
{
    double total = 0.0;
    for (Eigen::Index f = 0; f < a.rows(); ++f)
        total += std::acos(std::clamp(a.row(f).dot(b.row(f)), -1.0, 1.0));
    return total / static_cast<double>(a.rows());
}

}  // namespace

TEST_CASE("averages leave what is constant, get shorter where vectors differ, and stop at edges with a guide")
{
    const PolygonMesh mesh = make_mesh("box", 2000);
    const Topology topology = make_topology(mesh);
    FaceAverages averages(mesh, topology);
    averages.measure(mesh.vertices);
    const FaceVectors same = FaceVectors::Ones(mesh.n_faces(), 4);
    FaceVectors normals;
    averages.measure_normals(mesh.vertices, normals);
    AverageWeights weights;
    averages.weigh(weights);
    FaceVectors means;
    averages.average(weights, same, means);
    CHECK((means - same).cwiseAbs().maxCoeff() < 1e-6F);
    averages.average(weights, normals, means);
    float shortest = 1.0F;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        shortest = std::min(shortest, means.row(f).norm());
    CHECK(shortest < 0.95F);
    averages.weigh(normals, 0.1F, weights);
    averages.average(weights, normals, means);
    CHECK((means - normals).cwiseAbs().maxCoeff() < 1e-6F);
    averages.average(0.1F, normals, means);
    CHECK((means - normals).cwiseAbs().maxCoeff() < 1e-6F);
    averages.average_best_patch(normals, means);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        CHECK(means.row(f).norm() > shortest);
}

TEST_CASE("means that reach far keep planes and edges, and leave little noise")
{
    const PolygonMesh truth = make_mesh("box", 2000);
    const PolygonMesh noisy = test::with_gaussian_noise(truth, 0.05, 2);
    const Topology topology = make_topology(truth);
    FaceAverages averages(truth, topology);
    averages.measure(truth.vertices);
    FaceVectors normals;
    averages.measure_normals(truth.vertices, normals);
    FaceVectors of_noisy;
    averages.measure_normals(noisy.vertices, of_noisy);
    AverageWeights weights;
    averages.weigh(normals, 0.1F, weights);
    std::array<FaceVectors, 2> scratch;
    FaceVectors far;
    averages.average_far(weights, normals, far, scratch);
    CHECK((far - normals).cwiseAbs().maxCoeff() < 1e-5F);
    averages.average_far(weights, of_noisy, far, scratch);
    normalise(far);
    CHECK((far - normals).norm() < 0.15F * (of_noisy - normals).norm());
}

TEST_CASE("numbers spread evenly: constants stay, and all columns do the same")
{
    const PolygonMesh mesh = test::triangle_torus(20, 12);
    const Topology topology = make_topology(mesh);
    const VertexAverages averages(mesh, topology);
    constexpr int n = 19;
    VertexAverages::Rows near = VertexAverages::Rows::Zero(mesh.n_faces(), n);
    near.row(5).setOnes();
    near.col(3).setConstant(2.0F);
    VertexAverages::Rows around(mesh.n_faces(), n);
    averages.spread(near, around, 2, 3);
    // On a torus every face has as many neighbours: nothing is lost.
    for (const int column : {0, 7, 18}) {
        CHECK(near.col(column).sum() == relative(1.0, 1e-5));
        CHECK(around.col(column).sum() == relative(1.0, 1e-5));
        CHECK(around.col(column).cwiseEqual(around.col(0)).all());
        CHECK(around.col(column).maxCoeff() < near.col(column).maxCoeff());
    }
    CHECK(near.col(3).minCoeff() == relative(2.0, 1e-5));
}

TEST_CASE("low-pass filters keep planes, and the robust one ignores the few vertices that noise has moved")
{
    PolygonMesh mesh = test::triangle_grid(30, 30);
    const Topology topology = make_topology(mesh);
    const VertexAverages averages(mesh, topology);
    const PositionFilters filters(topology, averages.neighbours());
    const auto middle = static_cast<Index>(mesh.n_vertices() / 2 + 8);
    REQUIRE(topology.kind[middle] == VertexKind::Interior);
    for (const Points& positions : filters.low_pass(mesh.vertices, {2, 5}))
        CHECK(positions.col(2).cwiseAbs().maxCoeff() == 0.0);
    mesh.vertices(middle, 2) = 0.5;
    const Points plain = filters.low_pass(mesh.vertices, {4}).front();
    Points up = Points::Zero(mesh.n_vertices(), 3);
    up.col(2).setOnes();
    const Points robust = filters.robust_low_pass(mesh.vertices, plain, up, {4}).front();
    CHECK(std::abs(robust(middle, 2)) < 0.3 * std::abs(plain(middle, 2)));
}

TEST_CASE("a mix of equal estimates is that estimate")
{
    const PolygonMesh mesh = test::triangle_torus(20, 12);
    const Topology topology = make_topology(mesh);
    FaceAverages averages(mesh, topology);
    averages.measure(mesh.vertices);
    FaceVectors normals;
    averages.measure_normals(mesh.vertices, normals);
    NormalEstimates estimates;
    NormalEstimator estimator(mesh, topology);
    estimator.begin(mesh.vertices);
    estimator.first(estimates);
    for (FaceVectors& vectors : estimates.vectors)
        vectors = normals;
    EstimateFeatures features;
    features.measure(estimates, VertexAverages(mesh, topology));
    const FaceVectors mixed = MixingNetwork(mixing_weights().front()).mix(estimates, features);
    CHECK((mixed - normals).cwiseAbs().maxCoeff() < 1e-5F);
}

TEST_CASE("normals and noise are found, from side to side of an edge and with any sense of the faces")
{
    const PolygonMesh truth = make_mesh("gear", 4000);
    const PolygonMesh noisy = test::with_gaussian_noise(truth, 0.2, 3);
    const auto denoise = [](const PolygonMesh& mesh) {
        const Topology topology = make_topology(mesh);
        return denoise_normals(mesh, topology, mesh.vertices);
    };
    const DenoisedNormals found = denoise(noisy);
    CHECK(mean_angle(found.normals, normals_of(truth)) < 0.15 * mean_angle(normals_of(noisy), normals_of(truth)));
    double noise = 0.0;
    for (const float deviation : found.noise)
        noise += static_cast<double>(deviation) / static_cast<double>(found.noise.size());
    CHECK(noise > 0.08);
    CHECK(noise < 0.25);

    const PolygonMesh flipped = test::with_faces_flipped(noisy, 1);
    const DenoisedNormals of_flipped = denoise(flipped);
    Points turned_back = of_flipped.normals;
    for (Index f = 0; f < truth.n_faces(); ++f)
        if (vector_area(flipped.face(f), noisy.vertices).dot(vector_area(noisy.face(f), noisy.vertices)) < 0.0)
            turned_back.row(f) *= -1.0;
    CHECK(mean_angle(turned_back, found.normals) < 0.002);
}

TEST_CASE("in pieces normals and noise are those of the whole mesh, with any sense of the faces")
{
    for (const PolygonMesh& truth : {make_mesh("gear", 4000), make_mesh("triangles", 4000)}) {
        const PolygonMesh noisy = test::with_gaussian_noise(truth, 0.2, 3);
        for (const PolygonMesh& mesh : {noisy, test::with_faces_flipped(noisy, 1)}) {
            const Topology topology = make_topology(mesh);
            const DenoisedNormals whole = denoise_normals(mesh, topology, mesh.vertices);
            const DenoisedNormals in_pieces =
                denoise_normals(mesh, topology, mesh.vertices, run_serially, mesh.n_faces() / 3);
            CHECK(mean_angle(in_pieces.normals, whole.normals) > 0.0);
            CHECK(mean_angle(in_pieces.normals, whole.normals) < 2e-3);
            for (Index f = 0; f < mesh.n_faces(); ++f)
                CHECK(in_pieces.noise[f] == relative(whole.noise[f], 0.06));
        }
    }
}

TEST_CASE("of a motion only what changes faces is left, and no face turns over")
{
    const PolygonMesh mesh = test::triangle_grid(12, 12);
    const Topology topology = make_topology(mesh);
    const Points up = normals_of(mesh);
    // Along the plane nothing moves, out of it all does.
    Points after = mesh.vertices;
    after.rowwise() += Point(0.1, 0.05, 0.2);
    const Points moved = along_normals(mesh, topology, mesh.vertices, after, up);
    CHECK((moved.leftCols(2) - mesh.vertices.leftCols(2)).cwiseAbs().maxCoeff() < 1e-12);
    CHECK((moved.col(2).array() - 0.2).abs().maxCoeff() < 1e-3);

    // At an edge of a box a vertex moves across it, too, but not along it.
    const PolygonMesh box = make_mesh("box", 2000);
    const Topology of_box = make_topology(box);
    const Points normals = normals_of(box);
    Points shaken = box.vertices;
    shaken.rowwise() += Point(0.01, 0.02, 0.03);
    const Points back = along_normals(box, of_box, box.vertices, shaken, normals);
    for (Index v = 0; v < box.n_vertices(); ++v)
        for (int x = 0; x < 3; ++x) {
            double across = 0.0;
            for (const Index corner : of_box.corners_at(v))
                across = std::max(across, std::abs(normals(of_box.face_of[corner], x)));
            CHECK(back(v, x) - box.vertices(v, x) == relative(across > 0.5 ? 0.01 * (x + 1) : 0.0, 0.05));
        }

    // A vertex that is drawn far across its neighbours stays where no face turns.
    Points torn = mesh.vertices;
    const auto middle = static_cast<Index>(mesh.n_vertices() / 2);
    torn.row(middle) += Point(3.0, 0.0, 0.0);
    Points tilted = up;
    for (const Index corner : topology.corners_at(middle))
        tilted.row(topology.face_of[corner]) = Point(1.0, 0.0, 1.0).normalized();
    Points kept = along_normals(mesh, topology, mesh.vertices, torn, tilted);
    keep_facing(mesh, topology, mesh.vertices, tilted, kept);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        CHECK(vector_area(mesh.face(f), kept).dot(tilted.row(f)) > 0.0);
}
