#include "tests/support/matrices.h"

#include <algorithm>
#include <utility>

#include <Eigen/LU>

#include "samples/meshes/meshes.h"

namespace seamflow::test {

FacesOnBothSides faces_of(const PolygonMesh& mesh, const Topology& topology)
{
    return {{mesh.face_offsets, mesh.face_vertices}, {}, topology.twin, mesh.n_vertices()};
}

LaplacianMatrix laplacian_matrix(Laplacian laplacian, const FacesOnBothSides& faces, const Points& positions)
{
    const auto assembler = make_assembler(laplacian, faces);
    const auto entries = assembler->entries();
    LaplacianMatrix matrix;
    matrix.pattern = make_pattern(faces.n_vertices, entries);
    std::vector<Index> slots(entries.size());
    std::transform(entries.begin(), entries.end(), slots.begin(),
                   [&](const MatrixEntry& entry) { return matrix.pattern.slot(entry); });
    matrix.values.assign(matrix.pattern.n_entries(), 0.0);
    assembler->add(positions, 1.0, slots, matrix.values);
    return matrix;
}

NamedMesh named(const std::string& name, PolygonMesh mesh)
{
    Topology topology = make_topology(mesh);
    return {name, std::move(mesh), std::move(topology)};
}

std::vector<NamedMesh> sound_meshes()
{
    std::vector<NamedMesh> meshes;
    meshes.push_back(named("quad grid", quad_grid(7, 6)));
    meshes.push_back(named("triangles", make_triangles(120)));
    meshes.push_back(named("quads", make_quads(120)));
    meshes.push_back(named("hexagons", make_hexagons(150)));
    meshes.push_back(named("mixed polygons", make_mixed_polygons(150)));
    meshes.push_back(named("sphere", make_noisy_sphere(120)));
    meshes.push_back(named("cylinder", make_cylinder(120)));
    meshes.push_back(named("two-level cylinder", make_two_level_cylinder(150)));
    meshes.push_back(named("quad torus", quad_torus(12, 8)));
    meshes.push_back(named("triangle torus", triangle_torus(11, 7)));
    meshes.push_back(named("Möbius band", moebius_band(16, 4)));
    return meshes;
}

Eigen::MatrixXd dense(const SparsePattern& pattern, std::span<const double> values)
{
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(pattern.n(), pattern.n());
    for (Index column = 0; column < pattern.n(); ++column)
        for (Index i = pattern.column_offsets[column]; i < pattern.column_offsets[column + 1]; ++i)
            matrix(pattern.rows[i], column) += values[i];
    return matrix;
}

Eigen::MatrixXd dense_laplacian(Laplacian laplacian, const PolygonMesh& mesh, const Topology& topology)
{
    const LaplacianMatrix matrix = laplacian_matrix(laplacian, faces_of(mesh, topology), mesh.vertices);
    return dense(matrix.pattern, matrix.values);
}

Points undecomposed_step(const CutMesh& cut, Laplacian laplacian, double time_step)
{
    Eigen::MatrixXd A = time_step * dense_laplacian(laplacian, cut.mesh, cut.topology);
    for (Index v = 0; v < cut.mesh.n_vertices(); ++v)
        if (cut.topology.kind[v] != VertexKind::Interior)
            A.row(v).setZero();
    A += Eigen::MatrixXd::Identity(A.rows(), A.cols());
    return A.partialPivLu().solve(cut.mesh.vertices);
}

}  // namespace seamflow::test
