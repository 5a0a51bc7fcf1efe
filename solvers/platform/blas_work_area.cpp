#include "solvers/platform/blas_work_area.h"

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <new>
#include <string>
#include <vector>

#include <dlfcn.h>

#include "partition/errors.h"
#include "solvers/platform/address_space.h"

namespace seamflow {

namespace {

/// The memory that OpenBLAS takes for one caller, and a little more.
constexpr std::size_t area_bytes = std::size_t{130} << 20;

/// Room for an area, and for anything else allocated until it is taken.
constexpr std::size_t plenty = 4 * area_bytes;

/// One for the whole process, like the areas of OpenBLAS.
struct Callers {
    std::mutex mutex;
    std::condition_variable one_has_left;
    std::size_t count = 0;
    bool has_area = false;
};

Callers& callers()
{
    static Callers callers;
    return callers;
}

/// Makes OpenBLAS allocate the work areas that it keeps and reuses, by a product so large that its threads share it and
/// that no processor's kernels for small matrices, which need no area, take it (with AVX-512, up to 100³). With another
/// BLAS, or none, it has no relevant effect. There must be room.
void take_blas_work_areas()
{
    using Gemm = void(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
                      const int*, const double*, const int*, const double*, double*, const int*);
    auto* const gemm = reinterpret_cast<Gemm*>(dlsym(RTLD_DEFAULT, "dgemm_"));
    if (gemm == nullptr)
        return;
    constexpr int n = 256;
    constexpr double one = 1.0;
    const std::vector<double> a(std::size_t{n} * n, 1.0);
    std::vector<double> product = a;
    gemm("N", "N", &n, &n, &n, &one, a.data(), &n, a.data(), &n, &one, product.data(), &n);
}

/// Makes BLAS allocate what it keeps from then on.
void take_area()
{
    try {
        ::operator delete(::operator new(area_bytes));
    } catch (const std::bad_alloc&) {
        throw ComputationError("there is no memory for the work area of BLAS, " + std::to_string(area_bytes >> 20) +
                               " MiB: raise the limit of this program (ulimit -v)");
    }
    take_blas_work_areas();
}

}  // namespace

BlasWorkArea::BlasWorkArea()
{
    const auto limit = limit_of_address_space();
    if (!limit)
        return;
    Callers& all = callers();
    std::unique_lock lock(all.mutex);
    all.one_has_left.wait(lock, [&] { return all.count == 0 || room_within(*limit) >= (all.count + 1) * plenty; });
    if (!all.has_area)
        take_area();
    all.has_area = true;
    ++all.count;
    is_counted_ = true;
}

BlasWorkArea::~BlasWorkArea()
{
    if (!is_counted_)
        return;
    Callers& all = callers();
    const std::lock_guard lock(all.mutex);
    --all.count;
    all.one_has_left.notify_all();
}

}  // namespace seamflow
