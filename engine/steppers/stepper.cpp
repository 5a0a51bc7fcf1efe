#include "engine/steppers/stepper.h"

namespace seamflow {

void move_rows(std::span<const Index> vertices, const Points& to, Points& positions)
{
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (vertices[i] >= 0)
            positions.row(vertices[i]) = to.row(static_cast<Index>(i));
}

}  // namespace seamflow
