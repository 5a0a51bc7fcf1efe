#pragma once

#include <cstddef>
#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Data passed from step to step: the positions, and further data that depend on the stepper.
struct StepMemory {
    /// #V by 3, after the last complete step.
    Points positions = Points(0, 3);
    /// The further data, in the order in which `save` of the stepper writes and `restore` reads them.
    std::vector<Points> arrays;
    std::vector<double> numbers;
};

/// Reads a StepMemory in the order in which it was written.
class StepMemoryReader {
  public:
    explicit StepMemoryReader(const StepMemory& memory)
        : memory_(&memory)
    {
    }

    /// Returns the next array.
    /// @throws InputError if there is no further array, or it has another number of rows, or non-finite numbers.
    const Points& array(Eigen::Index rows);

    /// Returns the next array, whose numbers need not be finite.
    /// @throws InputError if there is no further array, or it has another number of rows.
    const Points& array_of_any(Eigen::Index rows);

    /// Returns the next number.
    /// @throws InputError if there is no further number.
    double number();

    /// Returns the next number as an integer.
    /// @throws InputError if there is no further number, or it is not from 0 to most_steps.
    int count();

    /// Returns the next number as the number of an element. @param n the number of elements.
    /// @throws InputError if there is no further number, or it is none of 0 to n - 1.
    Index index(Index n);

    /// @throws InputError if any data are left.
    void require_end() const;

  private:
    const StepMemory* memory_;
    std::size_t next_array_ = 0;
    std::size_t next_number_ = 0;
};

}  // namespace seamflow
