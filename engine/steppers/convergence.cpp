#include "engine/steppers/convergence.h"

#include <cmath>
#include <string>

#include "engine/measure/remarks.h"

namespace seamflow {

void Convergence::add(const ConvergedStep& step)
{
    last_ = step;
    if (!(step.residual <= tolerance_))
        ++n_short_of_tolerance_;
    if (step.stagnated)
        ++n_stagnated_;
    distance_ = std::hypot(distance_, step.distance);
}

void Convergence::save(StepMemory& memory) const
{
    for (const double number :
         {distance_, static_cast<double>(n_short_of_tolerance_), static_cast<double>(n_stagnated_)})
        memory.numbers.push_back(number);
}

void Convergence::restore(StepMemoryReader& memory)
{
    distance_ = memory.number();
    n_short_of_tolerance_ = memory.count();
    n_stagnated_ = memory.count();
}

void Convergence::describe(StepReport& report) const
{
    report.iterations = last_.iterations;
    report.residual = last_.residual;
    report.estimated_v_max = distance_;
}

void Convergence::describe(FlowReport& report, std::string_view advice) const
{
    report.convergence.steps_short_of_tolerance = n_short_of_tolerance_;
    report.convergence.steps_stagnated = n_stagnated_;
    remark_on_missed_tolerance(most_iterations_, std::string(advice), report);
}

}  // namespace seamflow
