#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace seamflow {

/// File names with the number of a step: "step_%d.obj" is step_7.obj for step 7, "step_%03d.obj" is step_007.obj.
/// A percent sign itself is written %%.
class StepPattern {
  public:
    /// @throws OptionError unless the pattern contains exactly one %d (or %03d, a width of at most two digits) and no
    ///         other conversion.
    explicit StepPattern(std::string_view pattern);

    [[nodiscard]] std::filesystem::path path(int step) const;

  private:
    std::string before_;
    std::string after_;
    std::size_t width_ = 0;
    char fill_ = ' ';
};

}  // namespace seamflow
