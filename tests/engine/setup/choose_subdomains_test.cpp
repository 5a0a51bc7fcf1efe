#include <cmath>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/setup/choose_subdomains.h"
#include "samples/common/meshes.h"

using namespace seamflow;

TEST_CASE("small meshes and large time steps are not cut")
{
    CHECK(choose_subdomains(size_of(make_quads(1000)), 1e-8, needs_of_sweeps).count == 1);
    CHECK(choose_subdomains(size_of(make_quads(20000)), 1.0, needs_of_sweeps).count == 1);
    CHECK(choose_subdomains(size_of(PolygonMesh{}), 1.0, needs_of_sweeps).count == 1);
}

TEST_CASE("sub-meshes get a few thousand vertices each, but are no narrower than 10 √dt")
{
    const PolygonMesh mesh = make_quads(50000);
    const SubdomainChoice by_cost = choose_subdomains(size_of(mesh), 1e-8, needs_of_sweeps);
    CHECK(by_cost.count == mesh.n_vertices() / 2500);
    const SubdomainChoice by_width = choose_subdomains(size_of(mesh), 1e-3, needs_of_sweeps);
    CHECK(by_width.count > 1);
    CHECK(by_width.count < by_cost.count);
    CHECK(width_in_diffusion_lengths(total_area(mesh), by_width.count, 1e-3) >= needs_of_sweeps.width);
    CHECK(width_in_diffusion_lengths(total_area(mesh), by_width.count + 1, 1e-3) < needs_of_sweeps.width);
    CHECK(by_width.reason != by_cost.reason);
}

TEST_CASE("without symmetry a sweep has smaller sub-meshes")
{
    FlowOptions options;
    options.time_step = 1e-6;
    PolygonMesh mesh = make_quads(8000);
    CHECK(mean_curvature_flow(mesh, options).subdomains == 3);
    options.laplacian = Laplacian::PtackovaVelho;
    CHECK(mean_curvature_flow(mesh, options).subdomains == mesh.n_vertices() / 1000);
}

TEST_CASE("sub-meshes of converged steps may be narrower, and without symmetry are smaller")
{
    const PolygonMesh mesh = make_quads(50000);
    CHECK(choose_subdomains(size_of(mesh), 1e-8, needs_of_converged_steps).count == mesh.n_vertices() / 2000);
    CHECK(choose_subdomains(size_of(mesh), 1e-8, needs_of_krylov_steps).count == mesh.n_vertices() / 1000);
    const Index count = choose_subdomains(size_of(mesh), 2e-2, needs_of_converged_steps).count;
    CHECK(width_in_diffusion_lengths(total_area(mesh), count, 2e-2) >= needs_of_converged_steps.width);
    CHECK(width_in_diffusion_lengths(total_area(mesh), count + 1, 2e-2) < needs_of_converged_steps.width);
}

TEST_CASE("the choice and its reason are in the report, and so is a warning of narrow sub-meshes")
{
    FlowOptions options;
    options.time_step = 1e-6;
    PolygonMesh mesh = make_quads(8000);
    const FlowReport chosen = mean_curvature_flow(mesh, options);
    CHECK(chosen.subdomains == 3);
    REQUIRE(chosen.remarks.size() == 1);
    CHECK(chosen.remarks[0].find("3 sub-meshes chosen") == 0);

    options.cut.subdomains = 40;
    options.time_step = 1e-3;
    const FlowReport narrow = mean_curvature_flow(mesh, options);
    REQUIRE(narrow.remarks.size() == 1);
    CHECK(narrow.remarks[0].find("narrow") != std::string::npos);
}
