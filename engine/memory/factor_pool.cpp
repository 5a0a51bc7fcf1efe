#include "engine/memory/factor_pool.h"

#include <cassert>

namespace seamflow {

std::span<std::byte> FactorPool::take(std::size_t bytes)
{
    assert(bytes <= bytes_ && "no factor is larger than the largest");
    const std::scoped_lock lock(mutex_);
    if (free_.empty()) {
        blocks_.push_back(std::make_unique_for_overwrite<std::byte[]>(bytes_));
        free_.reserve(blocks_.size());
        return {blocks_.back().get(), bytes};
    }
    std::byte* block = free_.back();
    free_.pop_back();
    return {block, bytes};
}

void FactorPool::give_back(std::span<std::byte> memory)
{
    const std::scoped_lock lock(mutex_);
    free_.push_back(memory.data());
}

}  // namespace seamflow
