#pragma once

#include <cstddef>
#include <span>

namespace seamflow {

/// Where factors get their memory: it is taken when a factor is made, and given back when that is no longer needed,
/// maybe by another thread.
class FactorMemory {
  public:
    virtual ~FactorMemory() = default;

    /// @returns at least that many bytes, aligned like memory of ::operator new.
    virtual std::span<std::byte> take(std::size_t bytes) = 0;

    virtual void give_back(std::span<std::byte> memory) = 0;
};

/// The heap: every factor has memory of its own.
FactorMemory& heap_memory();

}  // namespace seamflow
