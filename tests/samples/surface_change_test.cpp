#include <cmath>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_loop.h"
#include "partition/vector_area.h"
#include "samples/common/meshes.h"
#include "samples/common/surface_change.h"

using namespace seamflow;

TEST_CASE("a closed surface that is scaled has its area and volume change with the powers, and is as rough as before")
{
    PolygonMesh mesh = make_noisy_sphere(3000);
    const SurfaceChangeMeter meter(mesh, run_serially);
    const Points before = mesh.vertices;
    mesh.vertices *= 0.5;
    const SurfaceChange change = meter.measure(mesh, {}, run_serially);
    CHECK(change.after.area == doctest::Approx(change.before.area / 4.0));
    REQUIRE(change.before.volume);
    CHECK(*change.after.volume == doctest::Approx(*change.before.volume / 8.0));
    CHECK(change.before.roughness.rms == roughness(mesh, before).rms);
    CHECK(change.after.roughness.rms == doctest::Approx(change.before.roughness.rms));
    CHECK(change.moved.max == doctest::Approx(0.5 * before.rowwise().norm().maxCoeff()));
    CHECK(change.moved.mean == doctest::Approx(0.5 * before.rowwise().norm().mean()));
}

TEST_CASE("the roughness of a large mesh is told by a sample, and all numbers are the same on any loop")
{
    PolygonMesh mesh = make_noisy_sphere(60000);
    const SurfaceChangeMeter meter(mesh, run_serially);
    const Points before = mesh.vertices;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        mesh.vertices.row(v) *= 0.9 / before.row(v).norm();
    const SurfaceChange change = meter.measure(mesh, {}, run_serially);
    CHECK(change.before.roughness.rms == doctest::Approx(roughness(mesh, before).rms).epsilon(0.03));
    CHECK(change.before.roughness.percentile_95 ==
          doctest::Approx(roughness(mesh, before).percentile_95).epsilon(0.03));
    CHECK(change.after.roughness.percentile_95 ==
          doctest::Approx(roughness(mesh, mesh.vertices).percentile_95).epsilon(0.03));
    const SurfaceChange in_parallel = SurfaceChangeMeter(mesh, run_in_parallel).measure(mesh, {}, run_in_parallel);
    CHECK(in_parallel.before.area == change.after.area);
    CHECK(in_parallel.before.volume == change.after.volume);
    CHECK(in_parallel.before.roughness.rms == change.after.roughness.rms);
    CHECK(in_parallel.moved.max == 0.0);
}

TEST_CASE("a mesh without faces has no surface")
{
    PolygonMesh mesh;
    mesh.vertices = Points::Zero(3, 3);
    const SurfaceChangeMeter meter(mesh, run_serially);
    mesh.vertices(1, 2) = 2.0;
    const SurfaceChange change = meter.measure(mesh, {}, run_serially);
    CHECK(change.after.area == 0.0);
    CHECK_FALSE(change.after.volume);
    CHECK(change.after.roughness.rms == 0.0);
    CHECK(change.moved.max == 2.0);
}
