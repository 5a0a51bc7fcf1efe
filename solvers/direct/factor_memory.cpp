#include "solvers/direct/factor_memory.h"

#include <algorithm>
#include <cassert>

namespace seamflow {

void* FactorPool::do_allocate(std::size_t bytes, [[maybe_unused]] std::size_t alignment)
{
    assert(alignment <= alignof(std::max_align_t) && "blocks are aligned like memory from the heap");
    const std::size_t size = std::max(bytes, least_bytes_);
    Blocks& blocks = blocks_of_size_[size];
    if (blocks.free.empty()) {
        blocks.free.reserve(blocks.all.size() + 1);
        blocks.all.push_back(std::make_unique_for_overwrite<std::byte[]>(size));
        bytes_ += size;
        return blocks.all.back().get();
    }
    void* const block = blocks.free.back();
    blocks.free.pop_back();
    return block;
}

void FactorPool::do_deallocate(void* block, std::size_t bytes, std::size_t)
{
    blocks_of_size_[std::max(bytes, least_bytes_)].free.push_back(block);
}

}  // namespace seamflow
