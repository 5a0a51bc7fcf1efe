#include "solvers/blas_turn.h"

#include <cstddef>
#include <new>
#include <vector>

#include <dlfcn.h>
#include <sys/resource.h>

namespace seamflow {

namespace {

/// One for the whole process, as OpenBLAS has its areas.
struct Area {
    LibraryMutex mutex;
    bool is_there = false;
};

Area& area()
{
    static Area area;
    return area;
}

bool is_address_space_limited()
{
    rlimit limit = {};
    return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

/// Makes BLAS take what it keeps from then on.
void take_area()
{
    constexpr std::size_t bytes = std::size_t{130} << 20;
    ::operator delete(::operator new(bytes));
    using Gemm = void(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
                      const int*, const double*, const int*, const double*, double*, const int*);
    auto* const gemm = reinterpret_cast<Gemm*>(dlsym(RTLD_DEFAULT, "dgemm_"));
    if (gemm == nullptr)
        return;
    constexpr int n = 96;  // small products do without
    constexpr double one = 1.0;
    const std::vector<double> a(std::size_t{n} * n, 1.0);
    std::vector<double> product = a;
    gemm("N", "N", &n, &n, &n, &one, a.data(), &n, a.data(), &n, &one, product.data(), &n);
}

}  // namespace

BlasTurn::BlasTurn()
{
    if (!is_address_space_limited())
        return;
    turn_ = LibraryLock(area().mutex);
    if (!area().is_there)
        take_area();
    area().is_there = true;
}

}  // namespace seamflow
