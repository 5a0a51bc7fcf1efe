#include "engine/state/step_memory.h"

#include "engine/options/motion_options.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

[[noreturn]] void refuse()
{
    throw InputError("the state to resume from does not fit the flow: it has been changed or belongs to another one");
}

}  // namespace

const Points& StepMemoryReader::array(Eigen::Index rows)
{
    const Points& points = array_of_any(rows);
    if (!points.allFinite())
        refuse();
    return points;
}

const Points& StepMemoryReader::array_of_any(Eigen::Index rows)
{
    if (next_array_ == memory_->arrays.size() || memory_->arrays[next_array_].rows() != rows)
        refuse();
    return memory_->arrays[next_array_++];
}

double StepMemoryReader::number()
{
    if (next_number_ == memory_->numbers.size())
        refuse();
    return memory_->numbers[next_number_++];
}

int StepMemoryReader::count()
{
    const double value = number();
    if (!(value >= 0.0 && value <= most_steps))
        refuse();
    return static_cast<int>(value);
}

Index StepMemoryReader::index(Index n)
{
    const double value = number();
    if (!(value >= 0.0 && value < n))
        refuse();
    return static_cast<Index>(value);
}

void StepMemoryReader::require_end() const
{
    if (next_array_ != memory_->arrays.size() || next_number_ != memory_->numbers.size())
        refuse();
}

}  // namespace seamflow
