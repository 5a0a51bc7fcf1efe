#pragma once

namespace seamflow {

/// A length in units of the mesh, or a fraction of the diagonal of the box around its faces: {0.01, true} is
/// 1 % of it.
struct LengthOnMesh {
    double value = 0.0;
    bool of_diagonal = false;

    friend bool operator==(const LengthOnMesh&, const LengthOnMesh&) = default;
};

}  // namespace seamflow
