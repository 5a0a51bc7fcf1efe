#include <cmath>
#include <limits>
#include <memory>

#include <doctest/doctest.h>

#include "engine/flow_identity.h"
#include "engine/flow_state.h"
#include "engine/mean_curvature_flow.h"
#include "engine/near_origin.h"
#include "samples/common/meshes.h"
#include "tests/support/flows.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Rounded as they are when they lie that far away, so that both hold the same shape.
Points rounded_at(const Points& positions, double offset)
{
    return ((positions.array() + offset) - offset).matrix();
}

FlowOptions options_for(Laplacian laplacian, Index subdomains)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.subdomains = subdomains;
    options.time_step = 5e-6;
    options.steps = 3;
    return options;
}

}  // namespace

TEST_CASE("a mesh far away flows as it does near the origin, but for one rounding")
{
    for (const double offset : {1048576.0, 123456789.0, -1073741824.0})
        for (const Laplacian laplacian : all_laplacians)
            for (const Index subdomains : {1, 6}) {
                CAPTURE(offset);
                PolygonMesh near = make_noisy_sphere(2000);
                near.vertices = rounded_at(0.02 * near.vertices, offset);
                PolygonMesh far = near;
                far.vertices.array() += offset;
                REQUIRE((far.vertices.array() - offset == near.vertices.array()).all());
                const FlowOptions options = options_for(laplacian, subdomains);
                int n_steps = 0;
                const Points expected = flowed(near, options);
                mean_curvature_flow(far, options, [&](const StepState& state) {
                    ++n_steps;
                    CHECK((state.positions.array() / offset - 1.0).abs().maxCoeff() < 1e-5);
                });
                CHECK(n_steps == 3);
                const double ulp =
                    std::nextafter(std::abs(offset), std::numeric_limits<double>::infinity()) - std::abs(offset);
                CHECK(largest_difference((far.vertices.array() - offset).matrix(), expected) <= 2.0 * ulp);
            }
}

TEST_CASE("vertices that stay keep every bit, far away as well")
{
    PolygonMesh mesh = make_quads(900);
    mesh.vertices = (1e-3 * mesh.vertices.array() + 7654321.123).matrix();
    const Points before = mesh.vertices;
    REQUIRE_FALSE(offset_of(before).isZero(0.0));
    const Topology topology = make_topology(mesh);
    FlowOptions options = options_for(Laplacian::Fujiwara, 4);
    options.time_step = 1e-9;
    mean_curvature_flow(mesh, options);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (!topology.moves(v))
            CHECK((mesh.vertices.row(v).array() == before.row(v).array()).all());
    CHECK(mesh.vertices != before);
}

TEST_CASE("only what lies far away is moved, and no bit of it is lost")
{
    const Points sphere = make_noisy_sphere(500).vertices;
    CHECK(offset_of(sphere).isZero(0.0));
    CHECK(offset_of(Points(0, 3)).isZero(0.0));
    CHECK(offset_of(Points::Constant(4, 3, 5.0)).isZero(0.0));
    Points far = (sphere.array() * 3.7e-4 + 0.0).matrix();
    far.col(1).array() += 9.87654321e5;
    const Point offset = offset_of(far);
    CHECK(offset[0] == 0.0);
    CHECK(std::abs(offset[1] - 9.87654321e5) < 1e-3);
    CHECK(offset[2] == 0.0);
    const Points near = far.rowwise() - offset;
    CHECK(Points(near.rowwise() + offset) == far);
    for (Eigen::Index v = 0; v < far.rows(); ++v)
        CHECK(static_cast<long double>(far(v, 1)) - static_cast<long double>(offset[1]) ==
              static_cast<long double>(near(v, 1)));
    far(3, 0) = std::nan("");
    CHECK(offset_of(far).isZero(0.0));
}

TEST_CASE("after a failure the mesh is back where it was")
{
    PolygonMesh mesh = make_noisy_sphere(500);
    mesh.vertices = (1e-2 * mesh.vertices.array() + 1e6).matrix();
    const Points before = mesh.vertices;
    FlowOptions options = options_for(Laplacian::Fujiwara, 1);
    options.fixed_vertices = {-1};
    CHECK_THROWS(mean_curvature_flow(mesh, options));
    CHECK(mesh.vertices == before);
}

TEST_CASE("a flow far away goes on from a step before")
{
    PolygonMesh mesh = make_noisy_sphere(800);
    mesh.vertices = (1e-2 * mesh.vertices.array() + 1e6).matrix();
    FlowOptions options = options_for(Laplacian::Fujiwara, 3);
    FlowControl control;
    PolygonMesh whole = mesh;
    mean_curvature_flow(whole, options, [&](const StepState& state) {
        if (state.step == 1)
            control.resume = std::make_shared<const FlowState>(state.capture());
    });
    CHECK_NOTHROW(require_same(control.resume->identity, identify(mesh, options)));
    PolygonMesh resumed = mesh;
    mean_curvature_flow(resumed, options, {}, control);
    CHECK(resumed.vertices == whole.vertices);
}
