#include "samples/benchmark/memory_bandwidth.h"

#include <algorithm>
#include <barrier>
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "engine/tasks/stopwatch.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// 128 MB each: more than any cache holds.
constexpr std::size_t vector_length = std::size_t{1} << 24;
constexpr int n_triads = 7;

}  // namespace

double triad_bandwidth(int threads)
{
    // Not set to 0 here: each thread touches its own range first, so that it is near it.
    const auto a = std::make_unique_for_overwrite<double[]>(vector_length);
    const auto b = std::make_unique_for_overwrite<double[]>(vector_length);
    const auto c = std::make_unique_for_overwrite<double[]>(vector_length);
    std::barrier<> barrier(threads);
    double least = std::numeric_limits<double>::infinity();
    const auto work = [&](int thread) {
        const auto n = static_cast<std::size_t>(threads);
        const std::size_t begin = vector_length * static_cast<std::size_t>(thread) / n;
        const std::size_t end = vector_length * (static_cast<std::size_t>(thread) + 1) / n;
        std::fill(a.get() + begin, a.get() + end, 0.0);
        std::fill(b.get() + begin, b.get() + end, 1.0);
        std::fill(c.get() + begin, c.get() + end, 2.0);
        Stopwatch watch;
        for (int run = 0; run < n_triads; ++run) {
            barrier.arrive_and_wait();
            watch.lap();
            for (std::size_t i = begin; i < end; ++i)
                a[i] = b[i] + run * c[i];
            barrier.arrive_and_wait();
            if (thread == 0)
                least = std::min(least, watch.lap());
        }
    };
    std::vector<std::jthread> others;
    others.reserve(static_cast<std::size_t>(threads));
    try {
        for (int thread = 1; thread < threads; ++thread)
            others.emplace_back(work, thread);
    } catch (const std::exception&) {
        // Those that have started wait for all others.
        for (auto n = static_cast<int>(others.size()); n < threads; ++n)
            barrier.arrive_and_drop();
        throw ComputationError(
            fmt::format("cannot start {} threads to measure the bandwidth of memory: use fewer", threads));
    }
    work(0);
    return 3 * sizeof(double) * static_cast<double>(vector_length) / least;
}

}  // namespace seamflow
