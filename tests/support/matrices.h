#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "solvers/laplacian/laplacian_assembler.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/test_meshes.h"

namespace seamflow::test {

/// The faces of a whole mesh, which must outlive the view.
FacesOnBothSides faces_of(const PolygonMesh& mesh, const Topology& topology);

/// A Laplacian as a matrix.
struct LaplacianMatrix {
    SparsePattern pattern;
    /// One per entry of the pattern, in 1/length².
    std::vector<double> values;
};

/// The Laplacian of all vertices, boundary vertices included (there with the paper's half-edge weights; a flow that
/// holds the boundary fixed never uses these rows). Rows sum to zero.
LaplacianMatrix laplacian_matrix(Laplacian laplacian, const FacesOnBothSides& faces, const Points& positions);

/// A mesh with its topology.
NamedMesh named(const std::string& name, PolygonMesh mesh);

/// Curved or flat meshes of all kinds of faces, open and closed, on which every Laplacian is well defined.
std::vector<NamedMesh> sound_meshes();

/// A sparse matrix written out.
Eigen::MatrixXd dense(const SparsePattern& pattern, std::span<const double> values);

/// A Laplacian of a whole mesh written out, #V by #V.
Eigen::MatrixXd dense_laplacian(Laplacian laplacian, const PolygonMesh& mesh, const Topology& topology);

/// The positions after one step of a whole mesh, by a dense matrix.
Points undecomposed_step(const CutMesh& cut, Laplacian laplacian, double time_step);

}  // namespace seamflow::test
