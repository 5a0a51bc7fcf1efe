#include "solvers/direct/factor_memory.h"

#include <new>

namespace seamflow {

namespace {

class HeapMemory final : public FactorMemory {
  public:
    std::span<std::byte> take(std::size_t bytes) override
    {
        return {static_cast<std::byte*>(::operator new(bytes)), bytes};
    }

    void give_back(std::span<std::byte> memory) override { ::operator delete(memory.data()); }
};

}  // namespace

FactorMemory& heap_memory()
{
    static HeapMemory heap;
    return heap;
}

}  // namespace seamflow
