#pragma once

#include <string>
#include <vector>

#include "samples/common/smoothing_request.h"

namespace seamflow {

/// What `smooth` knows about its run beyond the FlowReport.
struct RunRecord {
    std::string input;
    std::string output;
    /// As the user typed them.
    std::vector<std::string> arguments;
    /// Name of the Laplacian.
    std::string laplacian;
    /// Of the input.
    MeshScale scale = {};
    /// Wall-clock time for reading all inputs and for writing all results, report and trace excepted.
    double read_seconds = 0.0;
    double write_seconds = 0.0;
};

}  // namespace seamflow
