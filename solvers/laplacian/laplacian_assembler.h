#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "partition/polygon_mesh.h"
#include "solvers/laplacian/laplacian.h"
#include "solvers/sparse/sparse_pattern.h"

namespace seamflow {

/// The faces that a Laplacian is assembled from: those of a sub-mesh or of a whole mesh.
struct FaceView {
    std::span<const Index> offsets;
    std::span<const Index> vertices;
    /// As SubMesh::twin and Topology::twin.
    std::span<const Index> twin;
    Index n_vertices = 0;

    [[nodiscard]] Index n_faces() const { return static_cast<Index>(offsets.size()) - 1; }

    /// The vertices of face f.
    [[nodiscard]] std::span<const Index> face(Index f) const
    {
        return vertices.subspan(offsets[f], offsets[f + 1] - offsets[f]);
    }
};

/// The faces of a sub-mesh, which must outlive the view.
inline FaceView faces_of(const SubMesh& sub_mesh)
{
    return {sub_mesh.face_vertices.offsets, sub_mesh.face_vertices.values, sub_mesh.twin, sub_mesh.n_vertices};
}

/// Adds one Laplacian to the values of a matrix, repeatedly as the mesh moves. Which entries it touches, and in which
/// order, depends on the faces alone: `entries` lists them once, and `add` then finds each value's place in a list of
/// slots made from them, without searching.
class LaplacianAssembler {
  public:
    virtual ~LaplacianAssembler() = default;

    /// The entries in the order in which `add` meets them, maybe repeated.
    [[nodiscard]] virtual std::vector<MatrixEntry> entries() const = 0;

    /// values[slots[i]] += factor · (contribution to the i-th of `entries`).
    /// @param positions at least #V by 3.
    /// @param slots one place per entry. Unwanted entries all point to one place that is never read.
    virtual void add(const Points& positions, double factor, std::span<const Index> slots,
                     std::span<double> values) = 0;

    /// M_v of the positions last added: row v times this is the sum of edge or face contributions.
    [[nodiscard]] virtual double mass(Index v) const = 0;
};

/// The assembler of one Laplacian on the given faces, whose arrays must outlive it.
/// @param stiffness_at at least #V by 3: the positions whose K a symmetric Laplacian keeps while M follows the mesh;
///        needed only during the call. nullptr: K follows the mesh, too.
std::unique_ptr<LaplacianAssembler> make_assembler(const ScaledLaplacian& laplacian, const FaceView& faces,
                                                   const Points* stiffness_at = nullptr);

/// The assembler of Δ_P (see PtackovaVelho).
std::unique_ptr<LaplacianAssembler> make_two_ring_assembler(const FaceView& faces);

}  // namespace seamflow
