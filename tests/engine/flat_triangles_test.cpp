// Triangles whose corners lie on a line up to rounding: what is left where a program inserts a vertex on an edge.

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "engine/geodesic_distance.h"
#include "engine/mean_curvature_flow.h"
#include "engine/setup/presets.h"
#include "partition/errors.h"
#include "partition/inspection/mesh_inspection.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/topology.h"
#include "samples/meshes/random_numbers.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"
#include "tests/support/preset_choices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

constexpr int faces_per_middle = 25;

PolygonMesh bumpy_torus()
{
    PolygonMesh torus = triangle_torus(50, 24);
    RandomNumbers random(7);
    const double size = 0.25 * mean_edge_length(torus, torus.vertices);
    for (Index v = 0; v < torus.n_vertices(); ++v)
        for (int c = 0; c < 3; ++c)
            torus.vertices(v, c) += size * random.symmetric();
    return torus;
}

/// Divides one of so many faces at the middle of its first edge, and leaves the face beyond as it is: a triangle
/// of the edge and its middle lies between them.
/// @param height of the middle above the edge, in lengths of the edge.
PolygonMesh with_middles(const PolygonMesh& mesh, double height)
{
    PolygonMesh result;
    std::vector<Point> middles;
    RandomNumbers random(3);
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto corners = mesh.face(f);
        if (f % faces_per_middle != 0) {
            result.add_face(corners);
            continue;
        }
        const Index a = corners[0];
        const Index b = corners[1];
        const Index c = corners[2];
        const Index middle = mesh.n_vertices() + static_cast<Index>(middles.size());
        const Point edge = mesh.vertices.row(b) - mesh.vertices.row(a);
        const Point upright = edge.cross(Point(random.symmetric(), random.symmetric(), random.symmetric()));
        middles.push_back(0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b)) +
                          height * edge.norm() / upright.norm() * upright);
        result.add_face(std::vector<Index>{a, middle, c});
        result.add_face(std::vector<Index>{middle, b, c});
        result.add_face(std::vector<Index>{a, b, middle});
    }
    result.vertices.resize(mesh.n_vertices() + std::ssize(middles), 3);
    result.vertices.topRows(mesh.n_vertices()) = mesh.vertices;
    for (std::size_t i = 0; i < middles.size(); ++i)
        result.vertices.row(mesh.n_vertices() + static_cast<Index>(i)) = middles[i];
    return result;
}

struct MovedTorus {
    /// In mean edge lengths.
    double largest_motion;
    Points positions;
    std::vector<Remark> remarks;
};

/// In mean edge lengths.
double largest_motion(const PolygonMesh& mesh, const Points& after)
{
    return (after - mesh.vertices).rowwise().norm().maxCoeff() / mean_edge_length(mesh, mesh.vertices);
}

MovedTorus moved_torus(PolygonMesh mesh, const FlowOptions& options)
{
    const Points before = mesh.vertices;
    const double edge = mean_edge_length(mesh, before);
    const FlowReport report = mean_curvature_flow(mesh, options);
    return {(mesh.vertices - before).rowwise().norm().maxCoeff() / edge, mesh.vertices, report.remarks};
}

FlowOptions smoothing_with(Laplacian laplacian)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.radius = {0.03, true};
    return options;
}

struct PlaceOfTorus {
    double unit;
    double distance;
};

/// The last is as far as a million edges.
constexpr PlaceOfTorus places_of_torus[] = {{1.0, 0.0}, {1e-4, 0.0}, {1e7, 0.0}, {1.0, 20.0}, {1e-3, 3e5}};

PolygonMesh put_at(PolygonMesh mesh, const PlaceOfTorus& place)
{
    mesh.vertices = place.unit * (mesh.vertices.rowwise() + place.distance * Point(1.0, 0.7, -0.9));
    return mesh;
}

/// Vertices may move further because fewer of them, or others, move with them.
constexpr double most_ratio = 2.5;

}  // namespace

TEST_CASE("middles of edges make no vertex fly, in any unit and at any place")
{
    for (const PlaceOfTorus& place : places_of_torus) {
        const PolygonMesh plain = put_at(bumpy_torus(), place);
        const PolygonMesh mesh = with_middles(plain, 0.0);
        const std::vector<Index> flat = inspect(mesh, make_topology(mesh)).defects.faces_without_area;
        CAPTURE(place.unit);
        CAPTURE(place.distance);
        // Far from the origin, most middles do not lie on the edge.
        CHECK(flat.size() > (place.distance > 1e3 ? 1 : mesh.n_faces() / (2 * faces_per_middle)));
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(name_of(laplacian));
            FlowOptions options = smoothing_with(laplacian);
            const MovedTorus with = moved_torus(mesh, options);
            CHECK(with.largest_motion < most_ratio * moved_torus(plain, options).largest_motion);
            const bool divides = traits_of(laplacian).divisor == Divisor::FaceAreas;
            CHECK(count_with(with.remarks, "held fixed because faces without area") == (divides ? 1 : 0));
            options.motion.strict = true;
            CHECK_THROWS_AS(moved_torus(mesh, options), InputError);
            if (!divides)
                continue;
            for (const Index f : flat)
                for (const Index v : mesh.face(f))
                    CHECK(with.positions.row(v) == mesh.vertices.row(v));
        }
    }
}

TEST_CASE("presets move surfaces with middles of edges as far as without")
{
    for (const PlaceOfTorus& place : places_of_torus) {
        const PolygonMesh plain = put_at(bumpy_torus(), place);
        const PolygonMesh mesh = with_middles(plain, 0.0);
        for (const PresetTraits& preset : all_presets()) {
            if (preset.along_z)
                continue;
            CAPTURE(preset.name);
            CAPTURE(place.unit);
            CAPTURE(place.distance);
            const double without = largest_motion(plain, test::moved_by(options_for(preset.preset, plain), plain));
            const double with = largest_motion(mesh, test::moved_by(options_for(preset.preset, mesh), mesh));
            CHECK(without > 0.05);
            CHECK(with < most_ratio * without);
            CHECK(with > without / most_ratio);
        }
    }
}

TEST_CASE("triangles of any height do not make vertices fly")
{
    const PolygonMesh plain = bumpy_torus();
    for (const Laplacian laplacian : all_laplacians) {
        const double without = moved_torus(plain, smoothing_with(laplacian)).largest_motion;
        for (double height = 1e-17; height < 1e-8; height *= 10.0) {
            CAPTURE(name_of(laplacian));
            CAPTURE(height);
            CHECK(moved_torus(with_middles(plain, height), smoothing_with(laplacian)).largest_motion <
                  most_ratio * without);
        }
    }
}

TEST_CASE("distances over triangles of any height are those without them")
{
    const PolygonMesh plain = bumpy_torus();
    const std::vector<Index> from{5};
    const Eigen::VectorXd without = geodesic_distance(plain, from);
    for (double height = 1e-17; height < 1e-8; height *= 10.0) {
        CAPTURE(height);
        const Eigen::VectorXd with = geodesic_distance(with_middles(plain, height), from);
        CHECK((with.head(without.size()) - without).cwiseAbs().maxCoeff() < 0.05 * without.maxCoeff());
    }
}
