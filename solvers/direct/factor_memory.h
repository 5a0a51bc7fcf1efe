#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace seamflow {

/// Where factors get their memory: it is taken when a factor is made, and given back when that is no longer needed,
/// maybe by another thread.
class FactorMemory {
  public:
    virtual ~FactorMemory() = default;

    /// @returns at least that many bytes, aligned like memory from the heap.
    virtual std::span<std::byte> take(std::size_t bytes) = 0;

    virtual void give_back(std::span<std::byte> memory) = 0;
};

/// The heap: every factor has memory of its own.
FactorMemory& heap_memory();

/// Memory for one factor at a time, taken from the heap once and kept.
class KeptMemory final : public FactorMemory {
  public:
    std::span<std::byte> take(std::size_t bytes) override
    {
        if (size_ < bytes) {
            memory_ = std::make_unique_for_overwrite<std::byte[]>(bytes);
            size_ = bytes;
        }
        return {memory_.get(), size_};
    }

    void give_back(std::span<std::byte>) override {}

  private:
    std::unique_ptr<std::byte[]> memory_;
    std::size_t size_ = 0;
};

}  // namespace seamflow
