#include "engine/steppers/stepper.h"

namespace seamflow {

void move_rows(std::span<const Index> vertices, const Points& to, Points& positions)
{
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (vertices[i] >= 0)
            positions.row(vertices[i]) = to.row(static_cast<Index>(i));
}

void add_up(std::span<const PhaseSeconds> tasks, PhaseSeconds& sum)
{
    for (const PhaseSeconds& task : tasks) {
        sum.assemble += task.assemble;
        sum.factorise += task.factorise;
        sum.solve += task.solve;
        sum.correct += task.correct;
        sum.interface += task.interface;
    }
}

}  // namespace seamflow
