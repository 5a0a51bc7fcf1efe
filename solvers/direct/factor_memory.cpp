#include "solvers/direct/factor_memory.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "partition/large_arrays.h"

namespace seamflow {

void* FactorPool::do_allocate(std::size_t bytes, [[maybe_unused]] std::size_t alignment)
{
    assert(alignment <= alignof(std::max_align_t) && "blocks are aligned like memory from the heap");
    const std::size_t size = std::max(bytes, least_bytes_);
    Blocks& blocks = blocks_of_size_[size];
    if (blocks.free.empty()) {
        blocks.free.reserve(blocks.n + 1);
        void* const block = cut_off(size);
        ++blocks.n;
        bytes_ += size;
        return block;
    }
    void* const block = blocks.free.back();
    blocks.free.pop_back();
    return block;
}

/// Cuts a block off a slab. The first slab is one block; later slabs are as large as all blocks so far, within limits.
void* FactorPool::cut_off(std::size_t size)
{
    constexpr std::size_t largest_slab = std::size_t{1} << 24;
    constexpr std::size_t unit = alignof(std::max_align_t);
    const std::size_t rounded = (size + unit - 1) / unit * unit;
    if (rest_bytes_ < rounded) {
        const std::size_t slab = std::max(rounded, std::min(bytes_, largest_slab));
        slabs_.push_back(uninitialised<std::byte>(slab));
        rest_ = slabs_.back().get();
        rest_bytes_ = slab;
    }
    rest_bytes_ -= rounded;
    return std::exchange(rest_, rest_ + rounded);
}

void FactorPool::do_deallocate(void* block, std::size_t bytes, std::size_t)
{
    blocks_of_size_[std::max(bytes, least_bytes_)].free.push_back(block);
}

}  // namespace seamflow
