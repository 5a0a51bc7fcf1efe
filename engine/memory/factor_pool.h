#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "solvers/direct/factor_memory.h"

namespace seamflow {

/// Memory for a limited number of factors, taken from the heap once and used again and again.
class FactorPool final : public FactorMemory {
  public:
    /// Before the first take.
    /// @param bytes of the largest factor.
    void use_blocks_of(std::size_t bytes) { bytes_ = bytes; }

    std::span<std::byte> take(std::size_t bytes) override;
    void give_back(std::span<std::byte> memory) override;

    /// What has been taken from the heap so far.
    [[nodiscard]] std::size_t bytes() const { return blocks_.size() * bytes_; }

  private:
    std::size_t bytes_ = 0;
    std::mutex mutex_;
    std::vector<std::unique_ptr<std::byte[]>> blocks_;
    /// Those that are free, the last one used first.
    std::vector<std::byte*> free_;
};

}  // namespace seamflow
