#include "tests/support/cut_meshes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "partition/cut/cut_into.h"
#include "samples/meshes/meshes.h"
#include "tests/support/test_meshes.h"

namespace seamflow::test {

namespace {

std::vector<std::pair<std::string, PolygonMesh>> meshes_to_cut()
{
    return {{"quad grid", quad_grid(12, 10)},
            {"triangles", make_triangles(200)},
            {"quads", make_quads(200)},
            {"hexagons", make_hexagons(300)},
            {"mixed polygons", make_mixed_polygons(300)},
            {"sphere", make_noisy_sphere(200)},
            {"cylinder", make_cylinder(250)},
            {"torus", quad_torus(18, 12)},
            {"Möbius band", moebius_band(24, 6)},
            {"cup", cup(80, 3)},
            {"several", side_by_side({quad_grid(8, 8), triangle_torus(9, 9), hourglass(), cylinder(8, 6)})}};
}

CutMesh cut_by_metis(const std::string& name, PolygonMesh mesh, Index k)
{
    Topology topology = make_topology(mesh);
    Cut cut = cut_into(mesh, topology, k);
    return {name + ", METIS", std::move(mesh), std::move(topology), std::move(cut.labels), cut.n_parts};
}

void add_cuts(const std::string& name, const PolygonMesh& mesh, std::vector<CutMesh>& cuts)
{
    const Point middle = mesh.vertices.colwise().mean();
    const double width = mesh.vertices.col(0).maxCoeff() - mesh.vertices.col(0).minCoeff();
    const auto label = [](bool condition) { return condition ? Index{1} : Index{0}; };
    cuts.push_back(cut_by_place(name + ", halves", mesh, [&](const Point& c) { return label(c.x() > middle.x()); }));
    cuts.push_back(cut_by_place(name + ", strips", mesh, [&](const Point& c) {
        return label(c.x() > middle.x() - width / 5) + label(c.x() > middle.x() + width / 5);
    }));
    cuts.push_back(cut_by_place(name + ", sectors", mesh, [&](const Point& c) {
        const double turn = std::atan2(c.y() - middle.y(), c.x() - middle.x()) / (2.0 * std::numbers::pi) + 0.5;
        return static_cast<Index>(turn * 2.999);
    }));
    cuts.push_back(cut_by_place(name + ", quarters", mesh, [&](const Point& c) {
        return 2 * label(c.x() > middle.x()) + label(c.y() > middle.y());
    }));
    for (const Index k : {2, 8})
        cuts.push_back(cut_by_metis(name, mesh, k));
}

}  // namespace

CutMesh cut_by_place(const std::string& name, PolygonMesh mesh, const std::function<Index(const Point&)>& label_at)
{
    std::vector<Index> labels;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        labels.push_back(label_at(centroid(mesh.face(f), mesh.vertices)));
    Topology topology = make_topology(mesh);
    Cut cut = cut_by_labels(mesh, topology, labels);
    return {name, std::move(mesh), std::move(topology), std::move(cut.labels), cut.n_parts};
}

const std::vector<CutMesh>& cut_meshes()
{
    static const std::vector<CutMesh> all = [] {
        std::vector<CutMesh> cuts;
        for (const auto& [name, mesh] : meshes_to_cut())
            add_cuts(name, mesh, cuts);
        return cuts;
    }();
    return all;
}

Decomposition decompose(const CutMesh& cut)
{
    return seamflow::decompose(cut.mesh, cut.topology, cut.labels, cut.n_parts);
}

Points localised(const SubMesh& sub_mesh, const Points& positions)
{
    return positions(sub_mesh.local_to_global, Eigen::all);
}

}  // namespace seamflow::test
