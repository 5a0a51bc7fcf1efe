#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/state/flow_identity.h"
#include "engine/state/flow_state.h"
#include "engine/surface/origin_offset.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/flows.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Rounded as they are when they lie that far away, so that both hold the same shape.
Points rounded_at(const Points& positions, double offset)
{
    return ((positions.array() + offset) - offset).matrix();
}

FlowOptions short_step_options(Laplacian laplacian, Index subdomains)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.cut.subdomains = subdomains;
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
                const FlowOptions options = short_step_options(laplacian, subdomains);
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
    REQUIRE_FALSE(origin_offset(mesh).isZero(0.0));
    const Topology topology = make_topology(mesh);
    FlowOptions options = short_step_options(Laplacian::Fujiwara, 4);
    options.time_step = 1e-9;
    mean_curvature_flow(mesh, options);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (!topology.moves(v))
            CHECK((mesh.vertices.row(v).array() == before.row(v).array()).all());
    CHECK(mesh.vertices != before);
}

TEST_CASE("only what lies far away is moved, and no bit of it is lost")
{
    PolygonMesh mesh = make_noisy_sphere(500);
    CHECK(origin_offset(mesh).isZero(0.0));
    CHECK(origin_offset(PolygonMesh{}).isZero(0.0));
    Points& far = mesh.vertices;
    far *= 3.7e-4;
    far.col(1).array() += 9.87654321e5;
    const Point offset = origin_offset(mesh);
    CHECK(offset[0] == 0.0);
    CHECK(std::abs(offset[1] - 9.87654321e5) < 1e-3);
    CHECK(offset[2] == 0.0);
    const Points near = far.rowwise() - offset;
    CHECK(Points(near.rowwise() + offset) == far);
    for (Eigen::Index v = 0; v < far.rows(); ++v)
        CHECK(static_cast<long double>(far(v, 1)) - static_cast<long double>(offset[1]) ==
              static_cast<long double>(near(v, 1)));
    PolygonMesh unsound = mesh;
    unsound.face_vertices[7] = unsound.n_vertices();
    CHECK(origin_offset(unsound).isZero(0.0));
    unsound.face_vertices[7] = -1;
    CHECK(origin_offset(unsound).isZero(0.0));
    unsound = mesh;
    unsound.vertices(3, 0) = std::nan("");
    CHECK(origin_offset(unsound).isZero(0.0));
    far.setConstant(5.0);
    CHECK(origin_offset(mesh).isZero(0.0));
}

TEST_CASE("vertices without faces neither decide where a surface lies nor lose a bit")
{
    for (const Conditions conditions : {Conditions::AdaptedRobin, Conditions::Robin}) {
        PolygonMesh near = make_noisy_sphere(800);
        near.vertices = rounded_at(0.02 * near.vertices, 1e6);
        PolygonMesh far = near;
        far.vertices.array() += 1e6;
        Points alone(4, 3);
        alone << 0.0, 0.0, 0.0, 0.1, -1e-9, 3e300, 1e6 + 0.125, 1e6, 1e6, 0.3, 0.7, -0.0;
        const auto n = near.n_vertices();
        for (PolygonMesh* mesh : {&near, &far}) {
            mesh->vertices.conservativeResize(n + 4, 3);
            mesh->vertices.bottomRows(4) = alone;
        }
        const Point offset = origin_offset(far);
        CHECK((offset.array() - 1e6).abs().maxCoeff() < 0.1);
        FlowOptions options = short_step_options(Laplacian::Fujiwara, 4);
        options.interface.conditions = conditions;
        options.report.keep_gaps = conditions == Conditions::Robin;
        options.accuracy.approach = Approach::Sweep;
        options.report.reference = true;
        const Points expected = flowed(near, options).topRows(n);
        int n_steps = 0;
        const auto check = [&](const Points& positions) {
            CHECK(same_bits(positions.middleRows(n, 4), alone));
            CHECK((positions.topRows(n).array() - 1e6).abs().maxCoeff() < 0.1);
        };
        const FlowReport report = mean_curvature_flow(far, options, [&](const StepState& state) {
            ++n_steps;
            check(state.positions);
            REQUIRE(state.reference_positions != nullptr);
            check(*state.reference_positions);
            REQUIRE((state.separated != nullptr) == options.report.keep_gaps);
            if (state.separated != nullptr)
                CHECK(same_bits(state.separated->vertices.middleRows(n, 4), alone));
        });
        CHECK(n_steps == 3);
        CHECK(same_bits(far.vertices.bottomRows(4), alone));
        CHECK(largest_difference((far.vertices.topRows(n).array() - 1e6).matrix(), expected) < 1e-9);
        CHECK(report.separated.has_value() == options.report.keep_gaps);
        if (report.separated)
            CHECK(same_bits(report.separated->vertices.middleRows(n, 4), alone));
    }
}

TEST_CASE(
    "an observer sees everything where it is in truth: the undecomposed flow and the separated sub-meshes as well")
{
    constexpr double offset = 1e6;
    PolygonMesh near = make_noisy_sphere(800);
    near.vertices = rounded_at(0.02 * near.vertices, offset);
    PolygonMesh far = near;
    far.vertices.array() += offset;
    FlowOptions options = short_step_options(Laplacian::Fujiwara, 4);
    options.interface.conditions = Conditions::Robin;
    options.report.keep_gaps = true;
    options.report.reference = true;
    struct Seen {
        Points positions;
        Points undecomposed;
        Points of_separated;
    };
    const auto seen_in = [&](PolygonMesh mesh) {
        std::vector<Seen> seen;
        const FlowReport report = mean_curvature_flow(mesh, options, [&](const StepState& state) {
            REQUIRE(state.reference_positions != nullptr);
            REQUIRE(state.separated != nullptr);
            seen.push_back({state.positions, *state.reference_positions, state.separated->vertices});
        });
        CHECK(seen.back().positions == mesh.vertices);
        CHECK(seen.back().of_separated == report.separated.value().vertices);
        return seen;
    };
    const std::vector<Seen> expected = seen_in(near);
    const std::vector<Seen> seen = seen_in(far);
    REQUIRE(seen.size() == 3);
    const auto check_same = [offset](const Points& of_far, const Points& of_near) {
        REQUIRE(of_far.rows() == of_near.rows());
        CHECK(largest_difference((of_far.array() - offset).matrix(), of_near) < 1e-9);
    };
    for (std::size_t step = 0; step < 3; ++step) {
        check_same(seen[step].positions, expected[step].positions);
        check_same(seen[step].undecomposed, expected[step].undecomposed);
        check_same(seen[step].of_separated, expected[step].of_separated);
        CHECK(seen[step].undecomposed != seen[step].positions);
        CHECK(seen[step].of_separated.rows() > seen[step].positions.rows());
    }
}

TEST_CASE("after a failure the mesh is back where it was")
{
    PolygonMesh mesh = make_noisy_sphere(500);
    mesh.vertices = (1e-2 * mesh.vertices.array() + 1e6).matrix();
    const Points before = mesh.vertices;
    FlowOptions options = short_step_options(Laplacian::Fujiwara, 1);
    options.motion.fixed_vertices = {-1};
    CHECK_THROWS(mean_curvature_flow(mesh, options));
    CHECK(mesh.vertices == before);
}
