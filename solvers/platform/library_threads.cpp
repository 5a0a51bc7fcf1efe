#include "solvers/platform/library_threads.h"

#include <mutex>
#include <optional>

#include <dlfcn.h>

namespace seamflow {

namespace {

/// A function of a library that may or may not be loaded. It is looked up by name, because only at run time it is known
/// which BLAS is behind libblas, and whether OpenMP is present.
template <class Function>
Function* find_function(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// The number of SingleThreadedBlas objects, and the setting to restore when the last one is destroyed; empty: nothing
/// was changed. OpenBLAS has one number of threads for the whole process, so that there is one of these for the whole
/// process.
struct BlasThreads {
    std::mutex mutex;
    int users = 0;
    std::optional<int> before;
};

BlasThreads& blas_threads()
{
    static BlasThreads threads;
    return threads;
}

}  // namespace

void end_threads_of_blas()
{
    if (const auto end = find_function<int()>("blas_thread_shutdown_"); end != nullptr)
        end();
}

SingleThreadedBlas::SingleThreadedBlas()
{
    const auto get = find_function<int()>("openblas_get_num_threads");
    const auto set = find_function<void(int)>("openblas_set_num_threads");
    const std::lock_guard lock(blas_threads().mutex);
    if (blas_threads().users++ > 0 || get == nullptr || set == nullptr)
        return;
    blas_threads().before = get();
    set(1);
}

SingleThreadedBlas::~SingleThreadedBlas()
{
    const auto set = find_function<void(int)>("openblas_set_num_threads");
    const std::lock_guard lock(blas_threads().mutex);
    if (--blas_threads().users > 0 || !blas_threads().before)
        return;
    set(*blas_threads().before);
    blas_threads().before.reset();
}

SingleThreadedOpenMp::SingleThreadedOpenMp()
{
    static const auto get = find_function<int()>("omp_get_max_active_levels");
    static const auto set = find_function<void(int)>("omp_set_max_active_levels");
    if (get == nullptr || set == nullptr)
        return;
    levels_before_ = get();
    set(0);
}

SingleThreadedOpenMp::~SingleThreadedOpenMp()
{
    static const auto set = find_function<void(int)>("omp_set_max_active_levels");
    if (set != nullptr)
        set(levels_before_);
}

}  // namespace seamflow
