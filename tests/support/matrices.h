#pragma once

#include <span>

#include <Eigen/Core>

#include "solvers/laplacian/laplacian_assembler.h"
#include "tests/support/test_meshes.h"

namespace seamflow::test {

/// The faces of a whole mesh, which must outlive the view.
FaceView faces_of(const PolygonMesh& mesh, const Topology& topology);

/// A mesh with its topology.
NamedMesh named(const std::string& name, PolygonMesh mesh);

/// Curved or flat meshes of all kinds of faces, open and closed, on which every Laplacian is well defined.
std::vector<NamedMesh> sound_meshes();

/// A sparse matrix written out.
Eigen::MatrixXd dense(const SparsePattern& pattern, std::span<const double> values);

/// A Laplacian of a whole mesh written out, #V by #V.
Eigen::MatrixXd dense_laplacian(Laplacian laplacian, const PolygonMesh& mesh, const Topology& topology);

}  // namespace seamflow::test
