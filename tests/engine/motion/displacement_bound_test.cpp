#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "engine/motion/displacement_bound.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "tests/support/flows.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

double largest_move(const Points& from, const Points& to)
{
    return (to - from).rowwise().norm().maxCoeff();
}

struct Example {
    PolygonMesh mesh = make_noisy_sphere(2000, {.noise = 0.2});
    Topology topology = make_topology(mesh);
    double edge = mean_edge_length(mesh, mesh.vertices);
    Points moved = [&] {
        FlowOptions options;
        options.time_step = 20.0 * edge * edge;
        return flowed(mesh, options);
    }();
};

/// How rough the change is that a bound makes of the motion.
double roughness_of_change(const Example& e, const Points& positions)
{
    const Points change = positions - e.moved;
    double total = 0.0;
    for (Index v = 0; v < e.mesh.n_vertices(); ++v)
        for (const Index w : neighbours_of(e.mesh, e.topology, v))
            total += (change.row(v) - change.row(w)).squaredNorm();
    return total;
}

}  // namespace

TEST_CASE("no vertex goes further than the bound, and a surface within it stays as it is")
{
    const Example e;
    const double far = largest_move(e.mesh.vertices, e.moved);
    for (const double part : {0.9, 0.5, 0.1, 1e-3}) {
        Points positions = e.moved;
        DisplacementBound(e.mesh, e.topology, part * far).apply(positions);
        const double move = largest_move(e.mesh.vertices, positions);
        CHECK(move <= part * far * (1.0 + 1e-12));
        CHECK(move >= part * far * (1.0 - 1e-9));
    }
    Points positions = e.moved;
    DisplacementBound(e.mesh, e.topology, far * (1.0 + 1e-12)).apply(positions);
    CHECK(same_bits(positions, e.moved));
}

TEST_CASE("what is held pulls along its own displacement alone, and what is not held is free")
{
    const Example e;
    const double bound = 0.4 * largest_move(e.mesh.vertices, e.moved);
    Points positions = e.moved;
    DisplacementBound(e.mesh, e.topology, bound).apply(positions);
    const Points correction = positions - e.moved;
    int n_held = 0;
    double away = 0.0;
    double inwards = 0.0;
    for (Index v = 0; v < e.mesh.n_vertices(); ++v) {
        const std::vector<Index> around = neighbours_of(e.mesh, e.topology, v);
        Point mean = Point::Zero();
        for (const Index w : around)
            mean += correction.row(w);
        mean /= static_cast<double>(around.size());
        // (1 + t L) U, t = 25: the force that holds the vertex back.
        const Point here = correction.row(v);
        const Point force = here + 25.0 * (here - mean);
        const Point displacement = positions.row(v) - e.mesh.vertices.row(v);
        const bool is_fixed = displacement.norm() > bound * (1.0 - 1e-6);
        n_held += is_fixed ? 1 : 0;
        const Point direction = displacement.normalized();
        away = std::max(away, (is_fixed ? Point(force - force.dot(direction) * direction) : force).norm());
        if (is_fixed)
            inwards = std::max(inwards, force.dot(direction));
    }
    CHECK(n_held > 100);
    CHECK(n_held < e.mesh.n_vertices());
    const double correction_size = correction.rowwise().norm().maxCoeff();
    CHECK(away < 0.02 * correction_size);
    CHECK(inwards < 0.02 * correction_size);
}

TEST_CASE("no coordinate goes further than its own bound, and the others give way smoothly")
{
    const Example e;
    const Points moves = (e.moved - e.mesh.vertices).cwiseAbs();
    const Point lengths(0.5 * moves.col(0).maxCoeff(), 0.9 * moves.col(1).maxCoeff(), 1e-3 * moves.col(2).maxCoeff());
    Points positions = e.moved;
    DisplacementBound(e.mesh, e.topology, {lengths.x(), lengths.y(), lengths.z()}).apply(positions);
    const Points bounded = positions - e.mesh.vertices;
    const Points cut = (e.moved - e.mesh.vertices)
                           .cwiseMin(lengths.replicate(e.mesh.n_vertices(), 1))
                           .cwiseMax(-lengths.replicate(e.mesh.n_vertices(), 1));
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(bounded.col(axis).cwiseAbs().maxCoeff() <= lengths[axis] * (1.0 + 1e-12));
        CHECK(bounded.col(axis).cwiseAbs().maxCoeff() >= lengths[axis] * (1.0 - 1e-9));
    }
    CHECK(roughness_of_change(e, positions) < 0.9 * roughness_of_change(e, e.mesh.vertices + cut));
    positions = e.moved;
    DisplacementBound(e.mesh, e.topology, {2.0, 2.0, 2.0}).apply(positions);
    CHECK(same_bits(positions, e.moved));
}

TEST_CASE("vertices that move along a direction stay on it, within the bounds along the axes")
{
    const Example e;
    FlowOptions options;
    options.time_step = 20.0 * e.edge * e.edge;
    options.motion.direction = {MotionDirection::Kind::Vector, Point(1.0, 2.0, -2.0)};
    const Point lengths(0.02 * e.edge, 0.5 * e.edge, 0.1 * e.edge);
    options.motion.within = {lengths.x(), lengths.y(), lengths.z()};
    const Points bounded = flowed(e.mesh, options) - e.mesh.vertices;
    for (Index v = 0; v < e.mesh.n_vertices(); ++v)
        CHECK(Point(bounded.row(v)).cross(options.motion.direction.vector).norm() <= 1e-12 * e.edge);
    CHECK(bounded.col(0).cwiseAbs().maxCoeff() <= lengths.x() * (1.0 + 1e-9));
    CHECK(bounded.col(0).cwiseAbs().maxCoeff() >= lengths.x() * (1.0 - 1e-6));
}

TEST_CASE("what gives way is smoother than what is cut off at the bound")
{
    const Example e;
    const double bound = 0.3 * largest_move(e.mesh.vertices, e.moved);
    Points cut = e.moved;
    for (Index v = 0; v < e.mesh.n_vertices(); ++v) {
        const Point displacement = e.moved.row(v) - e.mesh.vertices.row(v);
        cut.row(v) = e.mesh.vertices.row(v) + displacement * std::min(1.0, bound / displacement.norm());
    }
    Points positions = e.moved;
    DisplacementBound(e.mesh, e.topology, bound).apply(positions);
    CHECK(roughness_of_change(e, positions) < 0.7 * roughness_of_change(e, cut));
}

TEST_CASE("every kind of flow keeps the bound, and fixed vertices stay")
{
    const Example e;
    for (const auto& change : std::vector<std::function<void(AllOptions&)>>{
             [](AllOptions& o) { o.cut.subdomains = 5, o.accuracy.approach = Approach::Sweep; },
             [](AllOptions& o) { o.cut.subdomains = 5, o.accuracy.tolerance = 1e-6; },
             [](AllOptions& o) { o.accuracy.approach = Approach::ConjugateGradients; },
             [](AllOptions& o) { o.laplacian = Laplacian::PtackovaVelho; },
             [](AllOptions& o) { o.laplacian = Laplacian::Uniform, o.order = 3; },
             [](AllOptions& o) { o.motion.rescale = Rescale::Volume, o.motion.fixed_vertices = {}; },
             [](AllOptions& o) { o.keep_edges = 30.0; }}) {
        AllOptions options;
        options.time_step = 4.0 * e.edge * e.edge;
        options.steps = 3;
        options.motion.fixed_vertices = {0, 7, 500};
        options.motion.within = 0.15 * e.edge;
        change(options);
        const Points result = flowed(e.mesh, options);
        CHECK(largest_move(e.mesh.vertices, result) <= 0.15 * e.edge * (1.0 + 1e-12));
        CHECK(largest_move(e.mesh.vertices, result) >= 0.14 * e.edge);
        for (const Index v : options.motion.fixed_vertices)
            CHECK(Point(result.row(v)) == Point(e.mesh.vertices.row(v)));
    }
}
