#include <array>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/distributed/rank_flows.h"
#include "tests/support/flows.h"
#include "tests/support/junction_meshes.h"

using namespace seamflow;
using test::check_bits;
using test::converged;
using test::Example;
using test::some_numbers_of_ranks;

TEST_CASE("ranks find the bits of one machine in converged steps: any surfaces, any number of ranks")
{
    for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement}) {
        // With a coarse space and, as sub-meshes are wide, without.
        for (const double time_step : {3e-2, 1e-4})
            for (const PolygonMesh& mesh : test::height_fields(900))
                check_bits({std::string(name_of(laplacian)), mesh, converged(laplacian, time_step)}, 12, {1, 3});
        check_bits({"torus", test::triangle_torus(30, 24), converged(laplacian, 1e-1)}, 11, some_numbers_of_ranks);
    }
    const FlowOptions options = converged(Laplacian::Fujiwara, 3e-2);
    check_bits({"band", test::moebius_band(60, 8), options}, 7, some_numbers_of_ranks);
    check_bits({"sphere", make_noisy_sphere(1500), converged(Laplacian::AlexaWardetzky, 1e-3)}, 16,
               some_numbers_of_ranks);
    check_bits({"three", test::side_by_side({test::triangle_torus(16, 12), make_hexagons(500), test::cylinder(12, 20)}),
                options},
               10, some_numbers_of_ranks);
    // Fewer sub-meshes than ranks: some have nothing. Sub-meshes without anything in common.
    check_bits({"two", make_triangles(600), options}, 2, some_numbers_of_ranks);
    check_bits({"apart", test::side_by_side({make_triangles(300), make_hexagons(300)}), options}, 2, {1, 2, 3});
}

TEST_CASE("ranks find the bits of one machine in converged steps: what else there is, any number of threads")
{
    const PolygonMesh mesh = make_mixed_polygons(900);
    FlowOptions defaults = converged(Laplacian::VirtualRefinement, 5e-2);
    PolygonMesh far = mesh;
    far.vertices.rowwise() += Point(1e6, -3e5, 1e7);
    check_bits({"far", far, defaults}, 8, {1, 3});
    Example held{"held", mesh, defaults};
    for (Index v = 0; v < held.mesh.n_vertices(); v += 13)
        held.fixed.push_back(v);
    check_bits(held, 8, {1, 3});
    FlowOptions options = defaults;
    options.filter = Filter::LowPass;
    options.motion.attachment = 0.3;
    check_bits({"low-pass", mesh, options}, 10, {1, 3, 5});
    options = defaults;
    options.flow = FlowEquation::Conformalized;
    options.accuracy.tolerance = {};
    check_bits({"conformalized, loose", mesh, options}, 10, {1, 3, 5});
    options = defaults;
    options.flow = FlowEquation::Linear;
    check_bits({"linear", mesh, options}, 10, {1, 3, 5});
    options.accuracy.tolerance = 1e-14;
    check_bits({"linear, tight", mesh, options}, 10, {1, 3});
    options.accuracy.tolerance = {};
    options.resources.memory_limit = 150'000;
    check_bits({"linear, scarce", mesh, options}, 20, {1, 3});
    // Single precision goes no further, and steps are taken again in double precision.
    options = defaults;
    options.accuracy.tolerance = 1e-14;
    check_bits({"tight", mesh, options}, 10, {1, 3});
    options = defaults;
    options.accuracy.converge_iterations = 2;
    check_bits({"few iterations", mesh, options}, 10, {1, 3});
    for (const int threads : {2, 3}) {
        options = defaults;
        options.resources.threads = threads;
        check_bits({"threads", mesh, options}, 20, {1, 3, 5});
    }
    options = defaults;
    options.motion.boundary = Boundary::Free;
    check_bits({"free boundary", mesh, options}, 10, {1, 3, 5});
    // Factors that are made again.
    options = defaults;
    options.resources.memory_limit = 150'000;
    check_bits({"scarce", mesh, options}, 20, {1, 3});
}

TEST_CASE("ranks share sheets that meet: they move in converged steps, and are held in sweeps")
{
    const PolygonMesh mesh = test::foam(12, 5, 3);
    for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::VirtualRefinement}) {
        check_bits({"converged", mesh, converged(laplacian, 1.0)}, 8, {1, 3});
        check_bits({"sweeps", mesh, test::by_sweeps(laplacian, 1.0)}, 8, {1, 3});
    }
    FlowOptions options = converged(Laplacian::VirtualRefinement, 1.0);
    options.motion.boundary = Boundary::Free;
    check_bits({"free boundary", test::plates(std::array{0.0, 1.5, 3.0}, 8, 20), options}, 8, {1, 3});
    options.motion.junctions = Junctions::Hold;
    check_bits({"held", mesh, options}, 8, {1, 3});
}
