#pragma once

#include <mutex>

#include "solvers/direct/factor_memory.h"

namespace seamflow {

/// A FactorPool for several threads.
class SharedFactorPool final : public FactorPool {
  public:
    using FactorPool::FactorPool;

  private:
    void* do_allocate(std::size_t bytes, std::size_t alignment) override
    {
        const std::scoped_lock lock(mutex_);
        return FactorPool::do_allocate(bytes, alignment);
    }
    void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override
    {
        const std::scoped_lock lock(mutex_);
        FactorPool::do_deallocate(block, bytes, alignment);
    }

    std::mutex mutex_;
};

}  // namespace seamflow
