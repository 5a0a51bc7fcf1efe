#include "samples/training/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/subdivision_method_3.h>
#include <Eigen/Geometry>

#include "samples/training/bodies.h"
#include "samples/training/draws.h"
#include "samples/training/gradient_noise.h"

namespace seamflow {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

/// Results of operations with fewer triangles are not worth keeping.
constexpr std::size_t fewest_faces = 20;
/// Midpoint subdivision ends above the first, and no mesh has more than the second.
constexpr std::size_t subdivided_faces = 15'000;
constexpr std::size_t most_faces_at_all = 40'000;

/// @param aligned whether the axes of space are only exchanged.
Eigen::Matrix3d draw_rotation(bool aligned, RandomNumbers& random)
{
    if (!aligned)
        return Eigen::AngleAxisd{between(random, 0.0, 2.0 * std::numbers::pi), random_direction(random).transpose()}
            .toRotationMatrix();
    const int shift = random.below(3);
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
    for (int axis = 0; axis < 3; ++axis)
        rotation((axis + shift) % 3, axis) = 1.0;
    return rotation;
}

Solid place(Solid solid, const Eigen::Matrix3d& rotation, const Point& offset)
{
    for (const auto v : solid.vertices())
        solid.point(v) = to_cgal(from_cgal(solid.point(v)) * rotation.transpose() + offset);
    return solid;
}

/// The same solid with its vertices and triangles in order of their positions: CGAL's order depends on where memory was
/// free.
Solid ordered(const Solid& solid)
{
    std::vector<std::pair<CgalPoint, Solid::Vertex_index>> vertices;
    for (const auto v : solid.vertices())
        vertices.emplace_back(solid.point(v), v);
    std::ranges::sort(vertices, [](const auto& a, const auto& b) { return a.first < b.first; });
    Solid result;
    std::vector<Solid::Vertex_index> new_vertex(solid.num_vertices());
    for (const auto& [p, v] : vertices)
        new_vertex[v] = result.add_vertex(p);
    std::vector<std::array<Solid::Vertex_index, 3>> triangles;
    for (const auto f : solid.faces()) {
        auto& corners = triangles.emplace_back();
        std::ranges::transform(solid.vertices_around_face(solid.halfedge(f)), corners.begin(),
                               [&](auto v) { return new_vertex[v]; });
        std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    }
    std::ranges::sort(triangles);
    for (const auto& [u, v, w] : triangles)
        result.add_face(u, v, w);
    return result;
}

/// Puts the result of an operation in the place of a solid, unless it fails or hardly anything is left.
template <class Operation>
void combine(Solid& solid, Solid other, Operation&& operation)
{
    Solid result;
    if (operation(solid, other, result) && result.number_of_faces() > fewest_faces)
        solid = ordered(result);
}

void subtract(Solid& solid, Solid other)
{
    combine(solid, std::move(other),
            [](Solid& a, Solid& b, Solid& result) { return pmp::corefine_and_compute_difference(a, b, result); });
}

Solid draw_combination(int most_operations, RandomNumbers& random)
{
    Solid solid = draw_body(random);
    solid = place(std::move(solid), draw_rotation(true, random), Point::Zero());
    const int n_operations = whole_between(random, 0, most_operations);
    const bool aligned = chance(random, 0.6);
    for (int k = 0; k < n_operations; ++k) {
        Solid other = draw_body(random);
        const Eigen::Matrix3d rotation = draw_rotation(aligned, random);
        Point offset;
        for (double& coordinate : offset)
            coordinate = between(random, -0.8, 0.8);
        other = place(std::move(other), rotation, offset);
        const int choice = random.below(6);
        if (choice < 3)
            combine(solid, std::move(other),
                    [](Solid& a, Solid& b, Solid& result) { return pmp::corefine_and_compute_union(a, b, result); });
        else if (choice < 5)
            subtract(solid, std::move(other));
        else
            combine(solid, std::move(other), [](Solid& a, Solid& b, Solid& result) {
                return pmp::corefine_and_compute_intersection(a, b, result);
            });
    }
    return solid;
}

/// Parallel grooves: round ones all around, or straight ones on one side.
void cut_grooves(Solid& solid, RandomNumbers& random)
{
    const Eigen::Matrix3d rotation = draw_rotation(chance(random, 0.5), random);
    const int n_grooves = whole_between(random, 2, 5);
    const double width = between(random, 0.04, 0.1);
    const double gap = between(random, 0.2, 0.4);
    const bool around = chance(random, 0.4);
    for (int k = 0; k < n_grooves; ++k) {
        Point offset(0.0, 0.0, (k - 0.5 * (n_grooves - 1)) * gap);
        Solid groove = around ? make_torus(between(random, 0.5, 1.0), width)
                              : make_prism(ellipse(4, 3.0, std::numbers::sqrt2 * width), 3.0);
        if (!around)
            offset.y() = between(random, 0.3, 0.9);
        const Eigen::Matrix3d upright =
            Eigen::AngleAxisd(around ? 0.0 : 0.5 * std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
        subtract(solid, place(std::move(groove), rotation * upright, offset * rotation.transpose()));
    }
}

Point end_of(const Solid& solid, Solid::Edge_index e, unsigned end)
{
    return from_cgal(solid.point(solid.vertex(e, end)));
}

Point midpoint(const Solid& solid, Solid::Edge_index e)
{
    return 0.5 * (end_of(solid, e, 0) + end_of(solid, e, 1));
}

/// Triangles of about one length. Sharp edges stay, unless they are to be blurred.
void remesh(Solid& solid, double length, bool blur, double sharp_angle, RandomNumbers& random)
{
    const int rounds = whole_between(random, 1, 4);
    auto is_sharp = solid.add_property_map<Solid::Edge_index, bool>("e:is_sharp", false).first;
    if (!blur) {
        constexpr double longest_sharp = 1.2;
        pmp::detect_sharp_edges(solid, sharp_angle, is_sharp);
        std::vector<Solid::Edge_index> sharp_edges;
        std::ranges::copy_if(solid.edges(), std::back_inserter(sharp_edges), [&](auto e) { return is_sharp[e]; });
        pmp::split_long_edges(sharp_edges, longest_sharp * length, solid,
                              CGAL::parameters::edge_is_constrained_map(is_sharp));
    }
    pmp::isotropic_remeshing(
        solid.faces(), length, solid,
        CGAL::parameters::number_of_iterations(rounds).protect_constraints(true).edge_is_constrained_map(is_sharp));
    solid.collect_garbage();
}

double length_of(const Solid& solid, Solid::Edge_index e)
{
    return (end_of(solid, e, 0) - end_of(solid, e, 1)).norm();
}

/// Whether no other edge of the triangle of a half-edge is longer.
bool is_longest(const Solid& solid, Solid::Halfedge_index h)
{
    const double length = length_of(solid, solid.edge(h));
    return length >= length_of(solid, solid.edge(solid.next(h))) &&
           length >= length_of(solid, solid.edge(solid.prev(h)));
}

/// Cuts edges in half that are the longest of a triangle, until they are short enough everywhere; how short, varies in
/// space.
void refine_unevenly(Solid& solid, double length, RandomNumbers& random)
{
    constexpr int most_passes = 14;
    constexpr double longest = 1.5;
    const GradientNoise size(random);
    const double wave = length * between(random, 10.0, 40.0);
    const double least = between(random, 0.45, 1.1);
    const auto excess = [&](Solid::Edge_index e) {
        const double wanted = least + 1.3 * std::clamp(0.5 + size(midpoint(solid, e) / wave), 0.0, 1.0);
        return length_of(solid, e) / (longest * length * wanted);
    };
    for (int pass = 0; pass < most_passes; ++pass) {
        std::vector<std::pair<double, Solid::Edge_index>> too_long;
        for (const auto e : solid.edges())
            if (const double ratio = excess(e); ratio > 1.0)
                too_long.emplace_back(-ratio, e);
        if (too_long.empty())
            break;
        std::ranges::sort(too_long);
        for (const auto& [ratio, e] : too_long) {
            const auto halfedge = solid.halfedge(e);
            if (!is_longest(solid, halfedge) && !is_longest(solid, solid.opposite(halfedge)))
                continue;
            const CgalPoint middle = to_cgal(midpoint(solid, e));
            const auto half = CGAL::Euler::split_edge(halfedge, solid);
            solid.point(solid.target(half)) = middle;
            CGAL::Euler::split_face(half, solid.next(halfedge), solid);
            const auto opposite = solid.opposite(halfedge);
            CGAL::Euler::split_face(opposite, solid.next(solid.next(opposite)), solid);
        }
    }
}

/// The rule of midpoint subdivision: vertices stay, and new ones are in the middle of edges.
struct MidpointRule {
    Solid* solid;

    void edge_node(Solid::Halfedge_index h, CgalPoint& p) const { p = to_cgal(midpoint(*solid, solid->edge(h))); }
    void vertex_node(Solid::Vertex_index v, CgalPoint& p) const { p = solid->point(v); }
    void border_node(Solid::Halfedge_index h, CgalPoint& p, CgalPoint& q) const
    {
        edge_node(h, p);
        vertex_node(solid->target(h), q);
    }
};

/// One to four, to about as many triangles.
void subdivide(Solid& solid, int n_faces)
{
    do
        CGAL::Subdivision_method_3::PTQ(solid, MidpointRule{&solid}, CGAL::parameters::number_of_iterations(1));
    while (2 * solid.number_of_faces() < usize(n_faces) && solid.number_of_faces() < subdivided_faces);
}

void stretch(Solid& solid, int axis, double factor)
{
    for (const auto v : solid.vertices()) {
        Point p = from_cgal(solid.point(v));
        p[axis] *= factor;
        solid.point(v) = to_cgal(p);
    }
}

void make_triangles(Solid& solid, const SolidShape& shape, RandomNumbers& random)
{
    const int n_faces = whole_between(random, shape.least_faces, shape.most_faces);
    const double length = std::sqrt(CGAL::to_double(pmp::area(solid)) / n_faces * 4.0 / std::numbers::sqrt3);
    const double factor = chance(random, 0.25) ? between(random, 1.0, 2.2) : 1.0;
    const int axis = random.below(3);
    const bool blur = shape.may_blur && chance(random, 0.5);
    const auto remesh_to = [&](double wanted) {
        stretch(solid, axis, factor);
        remesh(solid, wanted, blur, shape.sharp_angle, random);
        stretch(solid, axis, 1.0 / factor);
    };
    const int choice = random.below(10);
    if (choice < 4)
        remesh_to(length);
    else if (choice < 7) {
        remesh_to(length * between(random, 1.3, 2.2));
        refine_unevenly(solid, length, random);
    } else {
        if (choice < 9)
            remesh_to(2.0 * length);
        subdivide(solid, n_faces);
    }
}

PolygonMesh to_mesh(const Solid& solid)
{
    PolygonMesh mesh;
    mesh.vertices.resize(solid.number_of_vertices(), 3);
    for (const auto v : solid.vertices())
        mesh.vertices.row(static_cast<Index>(v)) = from_cgal(solid.point(v));
    for (const auto f : solid.faces()) {
        std::vector<Index> corners;
        for (const auto v : solid.vertices_around_face(solid.halfedge(f)))
            corners.push_back(static_cast<Index>(v));
        mesh.add_face(corners);
    }
    return mesh;
}

Solid to_solid(const PolygonMesh& mesh)
{
    Solid solid;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        solid.add_vertex(to_cgal(mesh.vertices.row(v)));
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        std::vector<Solid::Vertex_index> corners;
        for (const Index v : mesh.face(f))
            corners.emplace_back(static_cast<Solid::size_type>(v));
        solid.add_face(corners);
    }
    return solid;
}

}  // namespace

void decimate(PolygonMesh& mesh, double part)
{
    namespace sms = CGAL::Surface_mesh_simplification;
    Solid solid = to_solid(mesh);
    const sms::GarlandHeckbert_plane_policies<Solid, CGAL::Exact_predicates_inexact_constructions_kernel> quadrics(
        solid);
    sms::edge_collapse(solid, sms::Count_ratio_stop_predicate<Solid>(part),
                       CGAL::parameters::get_cost(quadrics.get_cost()).get_placement(quadrics.get_placement()));
    solid.collect_garbage();
    mesh = to_mesh(solid);
}

std::optional<PolygonMesh> make_solid(const SolidShape& shape, RandomNumbers& random)
{
    try {
        Solid solid = draw_combination(shape.most_operations, random);
        if (shape.may_have_grooves && chance(random, 0.35))
            cut_grooves(solid, random);
        make_triangles(solid, shape, random);
        solid.collect_garbage();
        if (solid.number_of_faces() > most_faces_at_all)
            return std::nullopt;
        return to_mesh(solid);
    } catch (const std::exception&) {
        // Bodies that meet in ways that CGAL cannot cut, such as along faces in common.
        return std::nullopt;
    }
}

}  // namespace seamflow
