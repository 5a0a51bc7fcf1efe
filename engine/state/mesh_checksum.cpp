#include "engine/state/mesh_checksum.h"

#include "engine/state/transfer.h"
#include "engine/surface/origin_offset.h"

namespace seamflow {

std::uint64_t checksum_of_mesh(const PolygonMesh& mesh)
{
    const Point offset = origin_offset(mesh);
    const Points moved = offset.isZero(0.0) ? Points(0, 3) : Points(mesh.vertices.rowwise() - offset);
    return checksum_of(offset.isZero(0.0) ? mesh.vertices : moved, mesh.face_offsets, mesh.face_vertices);
}

}  // namespace seamflow
