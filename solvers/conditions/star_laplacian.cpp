#include "solvers/conditions/star_laplacian.h"

#include <algorithm>
#include <utility>

#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// The own faces that touch Γ, then the faces of other sub-meshes that touch Γ.
PolygonMesh faces_around_interface(const SubMesh& sub_mesh)
{
    const auto& interface = sub_mesh.interface;
    std::vector<Index> own = interface.own_faces.values;
    sort_unique(own);
    PolygonMesh mesh;
    mesh.vertices.setZero(sub_mesh.n_vertices + sub_mesh.n_halo, 3);
    for (const Index f : own)
        mesh.add_face(sub_mesh.face_vertices[f]);
    for (Index f = 0; f < interface.halo_faces.size(); ++f)
        mesh.add_face(interface.halo_faces[f]);
    return mesh;
}

}  // namespace

StarLaplacian::StarLaplacian(const SubMesh& sub_mesh, const ScaledLaplacian& laplacian, const Points* stiffness_at)
    : faces_(faces_around_interface(sub_mesh))
    , topology_(make_topology(faces_))
    , assembler_(make_assembler(laplacian,
                                {{faces_.face_offsets, faces_.face_vertices}, {}, topology_.twin, faces_.n_vertices()},
                                stiffness_at))
{
    make_slots(sub_mesh.interface);
}

void StarLaplacian::make_slots(const SubMeshInterface& interface)
{
    const auto entries = assembler_->entries();
    const auto row_of = [&](Index vertex) { return find_in(interface.vertices, vertex); };
    std::vector<std::vector<Index>> columns(interface.vertices.size());
    for (const MatrixEntry& entry : entries)
        if (const Index row = row_of(entry.row); row >= 0)
            columns[row].push_back(entry.column);
    for (auto& of_row : columns) {
        sort_unique(of_row);
        columns_.values.insert(columns_.values.end(), of_row.begin(), of_row.end());
        columns_.close();
    }
    const auto unread = static_cast<Index>(columns_.values.size());
    for (const MatrixEntry& entry : entries) {
        const Index row = row_of(entry.row);
        if (row < 0) {
            slots_.push_back(unread);
            continue;
        }
        slots_.push_back(columns_.offsets[row] + place_in(columns_[row], entry.column));
    }
    values_.resize(usize(unread) + 1);
}

void StarLaplacian::assemble(const Points& positions)
{
    std::fill(values_.begin(), values_.end(), 0.0);
    assembler_->add(positions, 1.0, slots_, values_);
}

}  // namespace seamflow
