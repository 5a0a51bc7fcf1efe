#pragma once

#include <iosfwd>
#include <string>

#include "samples/benchmark/benchmark_case.h"

namespace seamflow {

/// The table of a case, a line for each row as soon as it is known.
class CaseTable {
  public:
    /// Prints the setting of the measurements, and the head of the table.
    /// @param mesh name of the mesh.
    /// @param dt_over_h2 time step in squared mean edge lengths.
    CaseTable(std::ostream& out, const std::string& mesh, Index vertices, double dt_over_h2,
              const CaseOptions& options);

    void print(const Row& row);

    /// Prints the meaning of the numbers, and remarks.
    void finish(const CaseResult& result) const;

  private:
    std::ostream& out_;
    /// Time per step of ours and of ours in one thread, in seconds.
    double ours_ = 0.0;
    double ours_one_thread_ = 0.0;
};

/// A number with the given number of significant digits.
std::string short_number(double value, int significant = 3);

}  // namespace seamflow
