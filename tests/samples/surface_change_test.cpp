#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/vector_area.h"
#include "samples/meshes/meshes.h"
#include "samples/report/surface_change.h"
#include "samples/report/surface_remarks.h"
#include "tests/support/junction_meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("a closed surface that is scaled has its area and volume change with the powers, and is as rough as before")
{
    PolygonMesh mesh = make_noisy_sphere(3000);
    const SurfaceChangeMeter meter(mesh, run_serially);
    const Points before = mesh.vertices;
    mesh.vertices *= 0.5;
    const SurfaceChange change = meter.measure(mesh, {}, true, run_serially);
    CHECK(change.after.area == relative(change.before.area / 4.0, 1e-5));
    REQUIRE(change.before.volume);
    CHECK(*change.after.volume == relative(*change.before.volume / 8.0, 1e-5));
    CHECK(change.before.roughness->rms == roughness(mesh, before).rms);
    CHECK(change.after.roughness->rms == relative(change.before.roughness->rms, 1e-5));
    CHECK(change.moved.max == relative(0.5 * before.rowwise().norm().maxCoeff(), 1e-5));
    CHECK(change.moved.mean == relative(0.5 * before.rowwise().norm().mean(), 1e-5));
}

TEST_CASE("the roughness of a large mesh is told by a sample, and all numbers are the same on any loop")
{
    PolygonMesh mesh = make_noisy_sphere(60000);
    const SurfaceChangeMeter meter(mesh, run_serially);
    const Points before = mesh.vertices;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        mesh.vertices.row(v) *= 0.9 / before.row(v).norm();
    const SurfaceChange change = meter.measure(mesh, {}, true, run_serially);
    CHECK(change.before.roughness->rms == relative(roughness(mesh, before).rms, 0.03));
    CHECK(change.before.roughness->percentile_95 == relative(roughness(mesh, before).percentile_95, 0.03));
    CHECK(change.after.roughness->percentile_95 == relative(roughness(mesh, mesh.vertices).percentile_95, 0.03));
    const SurfaceChange in_parallel =
        SurfaceChangeMeter(mesh, run_in_parallel).measure(mesh, {}, true, run_in_parallel);
    CHECK(in_parallel.before.area == change.after.area);
    CHECK(in_parallel.before.volume == change.after.volume);
    CHECK(in_parallel.before.roughness->rms == change.after.roughness->rms);
    CHECK(in_parallel.moved.max == 0.0);
}

TEST_CASE("polygons are as rough as all of the mesh is when it is looked at as a whole")
{
    for (const PolygonMesh& mesh : {make_quads(900), make_hexagons(900), make_mixed_polygons(900)}) {
        const SurfaceChange change = SurfaceChangeMeter(mesh, run_serially).measure(mesh, {}, true, run_serially);
        CHECK(change.before.roughness->rms == roughness(mesh, mesh.vertices).rms);
        CHECK(change.before.roughness->percentile_95 == roughness(mesh, mesh.vertices).percentile_95);
    }
}

TEST_CASE("a loss of much of the volume is remarked on, or of most of the area where there is no volume")
{
    const auto remark = [](std::optional<double> volume, double area, Rescale rescale = Rescale::None,
                           Filter filter = Filter::Diffusion) {
        SurfaceChange change;
        change.before.area = 1.0;
        change.after.area = area;
        if (volume)
            change.before.volume = 1.0;
        change.after.volume = volume;
        FlowOptions options;
        options.motion.rescale = rescale;
        options.filter = filter;
        std::vector<Remark> remarks;
        remark_on_loss(options, change, remarks);
        return remarks.empty() ? std::string() : sentence(remarks.front());
    };
    CHECK(remark(0.75, 0.9).find("lost 25% of its volume") != std::string::npos);
    CHECK(remark(0.85, 0.3).empty());
    CHECK(remark({}, 0.25).find("lost 75% of its area") != std::string::npos);
    CHECK(remark({}, 0.55).empty());
    SurfaceChange of_cells;
    of_cells.before.area = 1.0;
    of_cells.after.area = 0.25;
    of_cells.before.cell_volumes = {0.1};
    of_cells.after.cell_volumes = {0.01};
    std::vector<Remark> remarks;
    remark_on_loss({}, of_cells, remarks);
    REQUIRE(remarks.size() == 2);
    CHECK(sentence(remarks[0]).starts_with("The only cell has lost more than 20% of its volume"));
    CHECK(sentence(remarks[1]).find("lost 75% of its area") != std::string::npos);
    CHECK(remark({}, 0.25, Rescale::Area).empty());
    // What the user has asked for already is no advice.
    CHECK(remark(0.75, 0.9).find("--filter low-pass") != std::string::npos);
    CHECK(remark(0.75, 0.9, Rescale::None, Filter::LowPass).find("--filter") == std::string::npos);
    CHECK(remark(0.75, 0.9).find("--rescale volume scales it back") != std::string::npos);
    // A point has no shape to scale back.
    CHECK(remark(0.0, 0.0).find("--rescale") == std::string::npos);
}

TEST_CASE("a surface with two sides is measured once, and a volume that is rounding is none")
{
    const PolygonMesh sphere = make_noisy_sphere(500);
    PolygonMesh both = sphere;
    std::vector<Index> turned;
    for (Index f = 0; f < sphere.n_faces(); ++f) {
        turned.assign(sphere.face(f).rbegin(), sphere.face(f).rend());
        both.add_face(turned);
    }
    const auto changed = [](PolygonMesh mesh, MeshReport report) {
        const SurfaceChangeMeter meter(mesh, run_serially);
        mesh.vertices *= 0.9;
        return meter.measure(mesh, report, true, run_serially);
    };
    MeshReport report;
    for (Index f = sphere.n_faces(); f < both.n_faces(); ++f)
        report.repeated_faces.push_back(f);
    const SurfaceChange one = changed(sphere, {});
    const SurfaceChange two = changed(both, report);
    CHECK(two.before.area == one.before.area);
    CHECK(two.after.volume == one.after.volume);
    CHECK(two.before.roughness->rms == one.before.roughness->rms);
    CHECK(two.before.self_intersections == one.before.self_intersections);
    // As if both sides flowed.
    const SurfaceChange as_volume = changed(both, {});
    CHECK_FALSE(as_volume.before.volume);
    CHECK_FALSE(as_volume.after.volume);
}

TEST_CASE("what one of several bodies has lost is remarked on, however small it is and however far away")
{
    PolygonMesh small = make_noisy_sphere(300);
    small.vertices *= 0.01;
    small.vertices.rowwise() += Point(1e4, 0.0, 0.0);
    PolygonMesh both = together({make_noisy_sphere(500), small});
    const SurfaceChangeMeter meter(both, run_serially);
    auto of_small = both.vertices.bottomRows(small.n_vertices());
    const Point centre = of_small.colwise().mean();
    of_small = ((of_small.rowwise() - centre) * 0.5).rowwise() + centre;
    const SurfaceChange change = meter.measure(both, {}, false, run_serially);
    REQUIRE(change.before.bodies.size() == 2);
    CHECK(*change.after.bodies[1].volume == relative(*change.before.bodies[1].volume / 8.0, 1e-5));
    std::vector<Remark> remarks;
    remark_on_loss({}, change, remarks);
    REQUIRE(remarks.size() == 1);
    CHECK(sentence(remarks[0]).starts_with("1 of 2 components has lost much, up to 8"));
    CHECK(sentence(remarks[0]).find("--rescale volume scales each component back") != std::string::npos);
    SurfaceChange to_point = change;
    to_point.after.bodies[1] = {.area = 0.0, .volume = 0.0};
    remarks.clear();
    remark_on_loss({}, to_point, remarks);
    REQUIRE(remarks.size() == 1);
    CHECK(sentence(remarks[0]).find("--rescale") == std::string::npos);
    FlowOptions held;
    held.motion.fixed_vertices = {0};
    remarks.clear();
    remark_on_loss(held, change, remarks);
    CHECK(sentence(remarks[0]).find("--rescale") == std::string::npos);
}

TEST_CASE("volumes of cells are left out where sheets with different faces lie on each other, with a remark")
{
    PolygonMesh mesh = touching_balls(10);
    const auto volumes_and_remarks = [&] {
        const SurfaceChangeMeter meter(mesh, run_serially);
        MeshReport report;
        report.junction_vertices = 20;
        const SurfaceChange change = meter.measure(mesh, report, false, run_serially);
        std::vector<Remark> remarks;
        remark_on_folds({}, change, remarks);
        CHECK(change.before.cell_volumes.size() == change.after.cell_volumes.size());
        return std::pair(change.before.cell_volumes.size(), remarks);
    };
    CHECK(volumes_and_remarks() == std::pair(std::size_t{2}, std::vector<Remark>{}));
    // The half of a quad on that quad.
    const auto quad = mesh.face(0);
    mesh.add_face(std::array{quad[0], quad[1], quad[2]});
    const auto [n_cells, remarks] = volumes_and_remarks();
    CHECK(n_cells == 0);
    REQUIRE(remarks.size() == 1);
    CHECK(sentence(remarks[0])
              .starts_with("Sheets lie on each other with different faces, at 2 edges: the volumes of cells are "));
}

TEST_CASE("a mesh without faces has no surface")
{
    PolygonMesh mesh;
    mesh.vertices = Points::Zero(3, 3);
    const SurfaceChangeMeter meter(mesh, run_serially);
    mesh.vertices(1, 2) = 2.0;
    const SurfaceChange change = meter.measure(mesh, {}, true, run_serially);
    CHECK(change.after.area == 0.0);
    CHECK_FALSE(change.after.volume);
    CHECK(change.after.roughness->rms == 0.0);
    CHECK(change.moved.max == 2.0);
}

TEST_CASE("faces that fold over and cross are told of, and those that noise had turned are not")
{
    const auto remark = [](const SurfaceChange& change) {
        std::vector<Remark> remarks;
        remark_on_folds({}, change, remarks);
        return remarks.empty() ? std::string() : sentence(remarks.front());
    };
    PolygonMesh mesh = triangle_grid(6, 6);
    const Points flat = mesh.vertices;
    const SurfaceChangeMeter of_flat(mesh, run_serially);
    CHECK(remark(of_flat.measure(mesh, {}, true, run_serially)).empty());
    // A vertex inside goes beyond its neighbours on one side.
    const Index v = 24;
    mesh.vertices.row(v) += Point(1.7, 0.2, 0.0);
    const SurfaceChange folded = of_flat.measure(mesh, {}, true, run_serially);
    CHECK(folded.flipped_faces > 0);
    CHECK(folded.folded_faces == folded.flipped_faces);
    CHECK(folded.before.self_intersections == 0);
    CHECK(folded.after.self_intersections == folded.new_self_intersections);
    CHECK(*folded.new_self_intersections > 0);
    CHECK(remark(folded).find("faces have turned over") != std::string::npos);
    CHECK(remark(folded).find("pairs of faces cross now") != std::string::npos);
    CHECK(remark(folded).find("--within") != std::string::npos);
    // And back.
    const SurfaceChangeMeter of_folded(mesh, run_serially);
    const SurfaceChange unchanged = of_folded.measure(mesh, {}, true, run_serially);
    CHECK(unchanged.before.self_intersections == folded.after.self_intersections);
    CHECK(unchanged.new_self_intersections == 0);
    mesh.vertices = flat;
    const SurfaceChange mended = of_folded.measure(mesh, {}, true, run_serially);
    CHECK(mended.flipped_faces == folded.flipped_faces);
    CHECK(mended.folded_faces == 0);
    CHECK(mended.new_self_intersections == 0);
    CHECK(remark(mended).empty());
    // Crossings are searched for where it is asked for alone.
    CHECK_FALSE(of_folded.measure(mesh, {}, false, run_serially).new_self_intersections);
}
