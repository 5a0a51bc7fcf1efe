#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/flows.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::flowed;
using test::same_bits;

namespace {

FlowOptions classical_options(Conditions conditions, Laplacian laplacian, Index subdomains)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.interface.conditions = conditions;
    if (conditions == Conditions::Ventcell)
        options.interface.q = 0.2;
    options.time_step = 0.001;
    options.steps = 3;
    options.cut.subdomains = subdomains;
    return options;
}

constexpr std::array classical{Conditions::Robin, Conditions::Ventcell};

}  // namespace

TEST_CASE("a flat grid cut along a straight line rests, and its copies of the line stay together")
{
    const test::CutMesh cut = test::cut_by_place("", test::quad_grid(10, 6),
                                                 [](const Point& c) { return c.x() > 4.0 ? Index{1} : Index{0}; });
    for (const Conditions conditions : classical)
        for (const Laplacian laplacian : test::all_laplacians) {
            CAPTURE(name_of(laplacian));
            FlowOptions options = classical_options(conditions, laplacian, 0);
            options.cut.labels = cut.labels;
            options.time_step = 0.5;
            PolygonMesh mesh = cut.mesh;
            const FlowReport report = mean_curvature_flow(mesh, options);
            CHECK(test::largest_difference(mesh.vertices, cut.mesh.vertices) < 1e-12);
            CHECK(report.steps.back().gap->max < 1e-12);
        }
}

TEST_CASE("the result has the mean of the copies, and the gap is the largest distance of two of them")
{
    const PolygonMesh mesh = make_hexagons(900);
    for (const Conditions conditions : classical)
        for (const Index subdomains : {2, 9}) {
            PolygonMesh moved = mesh;
            FlowOptions options = classical_options(conditions, Laplacian::Fujiwara, subdomains);
            options.report.keep_gaps = true;
            Points separated_seen;
            const FlowReport report = mean_curvature_flow(
                moved, options, [&](const StepState& state) { separated_seen = state.separated->vertices; });
            const PolygonMesh& separated = *report.separated;
            CHECK(same_bits(separated_seen, separated.vertices));
            REQUIRE(separated.n_faces() == mesh.n_faces());
            REQUIRE(separated.n_vertices() > mesh.n_vertices());

            std::vector<std::vector<Index>> copies(mesh.n_vertices());
            for (std::size_t c = 0; c < mesh.face_vertices.size(); ++c) {
                auto& of_vertex = copies[mesh.face_vertices[c]];
                if (std::find(of_vertex.begin(), of_vertex.end(), separated.face_vertices[c]) == of_vertex.end())
                    of_vertex.push_back(separated.face_vertices[c]);
            }
            double largest = 0.0;
            for (Index v = 0; v < mesh.n_vertices(); ++v) {
                Point mean = Point::Zero();
                for (const Index a : copies[v]) {
                    mean += separated.vertices.row(a) / static_cast<double>(copies[v].size());
                    for (const Index b : copies[v])
                        largest = std::max(largest, (separated.vertices.row(a) - separated.vertices.row(b)).norm());
                }
                CHECK((mean - moved.vertices.row(v)).norm() < 1e-14);
            }
            CHECK(largest > 0.0);
            CHECK(report.steps.back().gap->max == test::relative(largest, 1e-12));
            CHECK(report.steps.back().gap->mean <= report.steps.back().gap->max);
        }
}
