#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "solvers/direct/factor_memory.h"

namespace seamflow::test {

/// Memory from the heap for factors that nobody gives back.
class OwnedMemory final : public FactorMemory {
  public:
    std::span<std::byte> take(std::size_t bytes) override
    {
        blocks_.push_back(std::make_unique_for_overwrite<std::byte[]>(bytes));
        return {blocks_.back().get(), bytes};
    }

    void give_back(std::span<std::byte> memory) override
    {
        std::erase_if(blocks_, [&](const auto& block) { return block.get() == memory.data(); });
    }

  private:
    std::vector<std::unique_ptr<std::byte[]>> blocks_;
};

}  // namespace seamflow::test
