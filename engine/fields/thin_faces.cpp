#include "engine/fields/thin_faces.h"

#include "solvers/laplacian/geometry.h"

namespace seamflow {

bool is_thin(std::span<const Index> face, const Points& positions)
{
    constexpr double thinnest = 1e-10;
    double squares = 0.0;
    Index before = face.back();
    for (const Index v : face) {
        squares += (positions.row(v) - positions.row(before)).squaredNorm();
        before = v;
    }
    return !(area(face, positions) > thinnest * squares);
}

}  // namespace seamflow
