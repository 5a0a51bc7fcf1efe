#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <memory_resource>
#include <vector>

namespace seamflow {

/// The memory resource of factors. The heap is std::pmr::new_delete_resource().
using FactorMemory = std::pmr::memory_resource;

/// Returns an array to its memory resource.
template <class Number>
struct GiveBack {
    FactorMemory* memory = nullptr;
    std::size_t n = 0;

    void operator()(Number* numbers) const { memory->deallocate(numbers, n * sizeof(Number), alignof(Number)); }
};

/// The numbers of a factor. On destruction, maybe in another thread, their memory is returned to its memory resource.
template <class Number>
using FactorNumbers = std::unique_ptr<Number[], GiveBack<Number>>;

/// Allocates n uninitialised numbers.
/// @param memory must outlive them.
template <class Number>
FactorNumbers<Number> take_numbers(FactorMemory& memory, std::size_t n)
{
    void* const numbers = n > 0 ? memory.allocate(n * sizeof(Number), alignof(Number)) : nullptr;
    return {static_cast<Number*>(numbers), {&memory, n}};
}

/// Memory that is taken from the heap once and reused; each block is used by one factor at a time. Blocks are pieces of
/// slabs, in large pages where the system has them. For one thread at a time.
class FactorPool : public FactorMemory {
  public:
    /// @param least_bytes of a block: the size of the largest factor, so that any block fits any factor; 0: each block
    ///        fits factors of one size.
    explicit FactorPool(std::size_t least_bytes = 0)
        : least_bytes_(least_bytes)
    {
    }

    /// The bytes of all blocks. Slabs have at most twice as many.
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

  protected:
    void* do_allocate(std::size_t bytes, std::size_t alignment) override;
    void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override;

  private:
    struct Blocks {
        std::size_t n = 0;
        /// The free blocks, the most recently used last.
        std::vector<void*> free;
    };

    void* cut_off(std::size_t size);

    [[nodiscard]] bool do_is_equal(const FactorMemory& other) const noexcept override { return this == &other; }

    std::size_t least_bytes_;
    std::size_t bytes_ = 0;
    std::map<std::size_t, Blocks> blocks_of_size_;
    std::vector<std::unique_ptr<std::byte[]>> slabs_;
    /// The unused rest of the last slab.
    std::byte* rest_ = nullptr;
    std::size_t rest_bytes_ = 0;
};

}  // namespace seamflow
