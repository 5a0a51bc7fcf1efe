#include <cmath>
#include <utility>

#include <doctest/doctest.h>

#include "engine/denoise.h"
#include "samples/meshes/meshes.h"
#include "tests/support/denoising.h"
#include "tests/support/digitised.h"
#include "tests/support/flows.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::ball;
using test::denoise_in_place;
using test::furthest;
using test::names;
using test::same_bits;
using test::voxel_faces;

TEST_CASE("noise of a component beside rounded ones is removed as without these, and clean ones stay")
{
    PolygonMesh noisy = make_noisy_sphere(600, {.amplitude = 0.0, .noise = 0.3});
    const PolygonMesh clean = make_noisy_sphere(300, {.amplitude = 0.0, .noise = 0.0});
    const PolygonMesh rounded = voxel_faces(ball(14.3), 34);
    PolygonMesh mesh = test::together({noisy, rounded, clean});
    const PolygonMesh before = mesh;
    const DenoiseReport report = denoise_in_place(mesh);
    PolygonMesh without_rounded = test::together({noisy, clean});
    const DenoiseReport alone = denoise_in_place(without_rounded);
    REQUIRE(report.rounding);
    REQUIRE(report.noise);
    REQUIRE(alone.noise);
    CHECK(alone.noise->part > 0.6);
    const double share = static_cast<double>(without_rounded.n_vertices()) / static_cast<double>(mesh.n_vertices());
    CHECK(std::abs(report.noise->part - share * alone.noise->part) < 1e-12);
    CHECK(same_bits(mesh.vertices.topRows(noisy.n_vertices()), without_rounded.vertices.topRows(noisy.n_vertices())));
    CHECK(same_bits(mesh.vertices.bottomRows(clean.n_vertices()), clean.vertices));
    const Points moved = mesh.vertices - before.vertices;
    CHECK(moved.middleRows(noisy.n_vertices(), rounded.n_vertices()).cwiseAbs().maxCoeff() <= 0.5 + 1e-12);
    CHECK(moved.middleRows(noisy.n_vertices(), rounded.n_vertices()).cwiseAbs().maxCoeff() > 0.4);
    CHECK(names(report.choices, "rounded coordinates"));
    CHECK(names(report.choices, "noise"));
}

TEST_CASE("noise of a component beside rounded ones stops at feature edges, as without these")
{
    PolygonMesh noisy = test::with_gaussian_noise(test::triangle_grid(30, 30), 0.3, 4);
    DenoiseOptions options;
    for (Index k = 0; k < 30; ++k)
        options.motion.feature_edges.push_back({31 * 15 + k, 31 * 15 + k + 1});
    PolygonMesh mesh = test::together({noisy, voxel_faces(ball(14.3), 34)});
    const PolygonMesh before = noisy;
    const DenoiseReport report = denoise_in_place(mesh, options);
    REQUIRE(report.rounding);
    const DenoiseReport alone = denoise_in_place(noisy, options);
    // Vertices on the edges count once.
    const double share = static_cast<double>(noisy.n_vertices()) / static_cast<double>(mesh.n_vertices());
    CHECK(std::abs(report.noise->part - share * alone.noise->part) < 1e-12);
    CHECK(alone.noise->part > 0.9);
    CHECK((mesh.vertices.topRows(noisy.n_vertices()) - noisy.vertices).cwiseAbs().maxCoeff() < 1e-9);
    CHECK(same_bits(mesh.vertices.middleRows(31 * 15, 31), before.vertices.middleRows(31 * 15, 31)));
    CHECK(furthest(noisy, before) > 0.1);
    CHECK(same_bits(noisy.vertices.middleRows(31 * 15, 31), before.vertices.middleRows(31 * 15, 31)));
}

TEST_CASE("rounded coordinates of a component are found beside larger ones that are not rounded")
{
    PolygonMesh alone = voxel_faces(ball(10.3), 24);
    const PolygonMesh noisy = test::with_gaussian_noise(test::triangle_grid(60, 60), 0.3, 4);
    REQUIRE(noisy.n_vertices() > alone.n_vertices());
    PolygonMesh mesh = test::together({noisy, alone});
    const DenoiseReport report = denoise_in_place(mesh);
    REQUIRE(report.rounding);
    CHECK(report.rounding->steps == Point(1.0, 1.0, 1.0));
    denoise_in_place(alone);
    CHECK((mesh.vertices.bottomRows(alone.n_vertices()) - alone.vertices).cwiseAbs().maxCoeff() < 0.02);
    PolygonMesh without = noisy;
    denoise_in_place(without);
    CHECK((mesh.vertices.topRows(noisy.n_vertices()) - without.vertices).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("it does not matter which of two components that share a vertex comes first, if one is rounded")
{
    const PolygonMesh rounded = voxel_faces(ball(14.3), 34);
    PolygonMesh noisy = make_noisy_sphere(600, {.amplitude = 0.0, .noise = 0.3});
    // Vertex 0 of each is one vertex.
    noisy.vertices = (4.0 * noisy.vertices).eval().rowwise() + (rounded.vertices.row(0) - 4.0 * noisy.vertices.row(0));
    const auto joined = [](const PolygonMesh& first, const PolygonMesh& second) {
        PolygonMesh mesh = test::together({first, second});
        for (Index h = first.n_corners(); h < mesh.n_corners(); ++h)
            if (mesh.face_vertices[h] == first.n_vertices())
                mesh.face_vertices[h] = 0;
        return mesh;
    };
    PolygonMesh rounded_first = joined(rounded, noisy);
    PolygonMesh noisy_first = joined(noisy, rounded);
    const PolygonMesh before = noisy_first;
    REQUIRE(denoise_in_place(rounded_first).rounding);
    REQUIRE(denoise_in_place(noisy_first).noise);
    CHECK(furthest(noisy_first, before) > 0.4);
    const Index n = noisy.n_vertices() - 1;
    CHECK((noisy_first.vertices.middleRows(1, n) - rounded_first.vertices.bottomRows(n)).cwiseAbs().maxCoeff() < 0.02);
    const Index m = rounded.n_vertices() - 1;
    CHECK((noisy_first.vertices.bottomRows(m) - rounded_first.vertices.middleRows(1, m)).cwiseAbs().maxCoeff() < 0.02);
}

TEST_CASE("given steps count on components that are off their planes, too")
{
    const PolygonMesh rounded = voxel_faces(ball(7.3), 20);
    PolygonMesh off = rounded;
    off.vertices = (0.97 * off.vertices).eval().rowwise() + Point(40.0, 0.3, 0.2);
    const PolygonMesh before = test::together({rounded, off});
    PolygonMesh mesh = before;
    DenoiseOptions options;
    options.method = RemoveNoise{.rounding = {Rounding::Kind::Given, Point::Ones()}};
    REQUIRE(denoise_in_place(mesh, options).rounding);
    const Index n = rounded.n_vertices();
    for (const Points& moved : {Points((mesh.vertices - before.vertices).topRows(n)),
                                Points((mesh.vertices - before.vertices).bottomRows(n))}) {
        CHECK(moved.cwiseAbs().maxCoeff() > 0.4);
        CHECK(moved.cwiseAbs().maxCoeff() <= 0.5 + 1e-12);
    }
}
