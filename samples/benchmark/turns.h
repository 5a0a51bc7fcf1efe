#pragma once

#include <vector>

#include <nlohmann/json.hpp>

namespace seamflow {

/// Seconds of several turns; one at least where a number is asked for.
struct Turns {
    std::vector<double> seconds;
    [[nodiscard]] double least() const;
    [[nodiscard]] double median() const;
};

/// Members "least_s", "median_s" and "turns_s".
nlohmann::ordered_json turns_json(const Turns& turns);

}  // namespace seamflow
