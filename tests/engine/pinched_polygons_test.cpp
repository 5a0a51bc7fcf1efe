// Every operation on polygons with corners at one place: of one edge, of two, of a whole face, of a whole region.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/denoise.h"
#include "engine/diffuse.h"
#include "engine/geodesic_distance.h"
#include "engine/mean_curvature_flow.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/denoising.h"
#include "tests/support/flows.h"

using namespace seamflow;

namespace {

constexpr Index source = 40;

/// A mesh, with corners at one place, and the same mesh without.
struct Pinched {
    std::string what;
    PolygonMesh mesh;
    /// #V: whether a vertex lies within four mean edges of one that is pinched.
    std::vector<bool> is_near;
};

Pinched pinched(const std::string& what, const PolygonMesh& mesh, const std::vector<std::pair<Index, Index>>& onto)
{
    Pinched result{what, mesh, std::vector<bool>(static_cast<std::size_t>(mesh.n_vertices()), false)};
    for (const auto& [moved, to] : onto)
        result.mesh.vertices.row(moved) = result.mesh.vertices.row(to);
    const double near = 4.0 * mean_edge_length(mesh);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        for (const auto& [moved, to] : onto)
            if ((mesh.vertices.row(v) - mesh.vertices.row(moved)).norm() < near)
                result.is_near[static_cast<std::size_t>(v)] = true;
    return result;
}

std::vector<Pinched> pinched_meshes(const PolygonMesh& mesh)
{
    const Index middle = mesh.n_faces() / 2;
    const auto corners = [&](Index f) { return mesh.face(f); };
    std::vector<std::pair<Index, Index>> face;
    std::vector<std::pair<Index, Index>> region;
    const Index centre = corners(middle)[0];
    for (const Index v : corners(middle))
        face.emplace_back(v, centre);
    for (Index f = middle; f < middle + 4; ++f)
        for (const Index v : corners(f))
            region.emplace_back(v, centre);
    const auto last = corners(middle).size() - 1;
    return {pinched("edge", mesh, {{corners(middle)[1], corners(middle)[0]}}),
            pinched("two edges", mesh,
                    {{corners(middle)[1], corners(middle)[0]}, {corners(middle)[last], corners(middle)[last - 1]}}),
            pinched("face", mesh, face), pinched("region", mesh, region)};
}

/// The largest difference at vertices away from those that are pinched.
double difference_away(const Pinched& item, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
    double largest = 0.0;
    for (Index v = 0; v < item.mesh.n_vertices(); ++v)
        if (!item.is_near[static_cast<std::size_t>(v)])
            largest = std::max(largest, (a.row(v) - b.row(v)).norm());
    return largest;
}

/// Compares an operation on pinched meshes with that on the mesh as it was.
/// @param result #V by any. @param most the largest difference away from what is pinched.
void compare(const PolygonMesh& mesh, const std::function<Eigen::MatrixXd(const PolygonMesh&)>& result, double most)
{
    const Eigen::MatrixXd expected = result(mesh);
    for (const Pinched& item : pinched_meshes(mesh)) {
        CAPTURE(item.what);
        Eigen::MatrixXd found;
        REQUIRE_NOTHROW(found = result(item.mesh));
        CHECK(found.allFinite());
        CHECK(difference_away(item, found, expected) < most);
    }
}

Eigen::MatrixXd waves(const PolygonMesh& mesh)
{
    Eigen::MatrixXd fields(mesh.n_vertices(), 1);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        fields(v, 0) = std::sin(7.0 * mesh.vertices(v, 0)) + std::cos(5.0 * mesh.vertices(v, 1));
    return fields;
}

}  // namespace

TEST_CASE("flows go on around polygons with corners at one place, by any Laplacian")
{
    const PolygonMesh mesh = make_hexagons(1500);
    const double edge = mean_edge_length(mesh);
    for (const Laplacian laplacian : test::all_laplacians)
        for (const Index subdomains : {1, 4}) {
            CAPTURE(name_of(laplacian));
            CAPTURE(subdomains);
            FlowOptions options;
            options.laplacian = laplacian;
            options.time_step = 2.0 * edge * edge;
            options.steps = 2;
            options.cut.subdomains = subdomains;
            compare(
                mesh,
                [&](const PolygonMesh& before) {
                    PolygonMesh after = before;
                    mean_curvature_flow(after, options);
                    return Eigen::MatrixXd(after.vertices);
                },
                0.6 * edge);
        }
}

TEST_CASE("fields diffuse, are filled, and have distances across polygons with corners at one place")
{
    const PolygonMesh mesh = make_hexagons(1500);
    const double edge = mean_edge_length(mesh);
    FlowOptions options;
    options.time_step = 4.0 * edge * edge;
    options.steps = 2;
    for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement})
        for (const bool fill : {false, true})
            for (const bool keeps_edges : {false, true}) {
                CAPTURE(name_of(laplacian));
                CAPTURE(fill);
                CAPTURE(keeps_edges);
                FieldOptions of_fields{.fill = fill, .laplacian = laplacian};
                if (keeps_edges)
                    of_fields.keep_edges = 1.0;
                compare(
                    mesh,
                    [&](const PolygonMesh& on) {
                        Eigen::MatrixXd fields = waves(mesh);
                        if (fill)
                            for (Index v = 100; v < 140; ++v)
                                fields(v, 0) = std::numeric_limits<double>::quiet_NaN();
                        diffuse(on, fields, options, of_fields);
                        return fields;
                    },
                    0.2);
            }
    compare(
        mesh,
        [&](const PolygonMesh& on) { return Eigen::MatrixXd(geodesic_distance(on, std::array<Index, 1>{source})); },
        // The region is four edges wide.
        4.0 * edge);
}

TEST_CASE("noise goes around polygons with corners at one place")
{
    for (const PolygonMesh& truth : {make_hexagons(3000), make_mesh("gear", 3000)}) {
        const PolygonMesh noisy = test::with_gaussian_noise(truth, 0.2, 3);
        compare(
            noisy,
            [](const PolygonMesh& before) {
                PolygonMesh after = before;
                denoise(after);
                return Eigen::MatrixXd(after.vertices);
            },
            0.7 * mean_edge_length(truth));
    }
}
