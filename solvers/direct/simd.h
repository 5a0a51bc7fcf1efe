#pragma once

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "partition/index.h"

/// Before a function whose loops pay in wider registers: compiled once more for machines that have them. The operations
/// are the same, and so are the results. Nothing in such a function may throw: GCC 12 lets no exception out of it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&               \
    !defined(__SANITIZE_THREAD__)
#define SEAMFLOW_WIDE __attribute__((flatten, target_clones("avx2", "default")))
#else
#define SEAMFLOW_WIDE
#endif

namespace seamflow {

/// Neighbouring numbers in so many registers. Arrays of vectors that are wider than a register do not do as well: GCC
/// keeps them in memory all the time, which takes ten times as long.
template <class Vector, Index Parts>
struct Registers {
    static constexpr Index lanes_of_part = static_cast<Index>(sizeof(Vector) / sizeof(double));
    static constexpr Index lanes = Parts * lanes_of_part;

    Vector part[Parts] = {};

    [[gnu::always_inline]] void load(const double* from)
    {
        for (Index p = 0; p < Parts; ++p)
            std::memcpy(&part[p], from + p * lanes_of_part, sizeof part[p]);
    }
    [[gnu::always_inline]] void add_product(double factor, const Registers& numbers)
    {
        for (Index p = 0; p < Parts; ++p)
            part[p] += factor * numbers.part[p];
    }
    /// Takes all of them away from neighbouring entries.
    [[gnu::always_inline]] void subtract_from(double* target) const
    {
        for (Index p = 0; p < Parts; ++p) {
            Vector entries;
            std::memcpy(&entries, target + p * lanes_of_part, sizeof entries);
            entries -= part[p];
            std::memcpy(target + p * lanes_of_part, &entries, sizeof entries);
        }
    }
    /// The same with the first n.
    [[gnu::always_inline]] void subtract_from(double* target, Index n) const
    {
        for (Index t = 0; t < n; ++t)
            target[t] -= part[t / lanes_of_part][t % lanes_of_part];
    }
};

namespace detail {

template <Index N>
struct Vector;
template <>
struct Vector<2> {
    using Type = double __attribute__((vector_size(16)));
};
template <>
struct Vector<4> {
    using Type = double __attribute__((vector_size(32)));
};
template <>
struct Vector<8> {
    using Type = double __attribute__((vector_size(64)));
};

}  // namespace detail

/// A machine whose registers hold so many numbers.
/// @param Width 2, 4 or 8.
template <Index Width>
struct Machine {
    static constexpr Index width = Width;
    /// So many neighbouring numbers, in as many registers as that takes.
    /// @param Lanes a power of two.
    template <Index Lanes>
    using Neighbours = Registers<typename detail::Vector<std::min(Lanes, Width)>::Type, Lanes / std::min(Lanes, Width)>;
};

#if defined(__x86_64__)

namespace detail {

template <class Kernel, class... Arguments>
[[gnu::target("avx2"), gnu::flatten]] auto run_wide(const Kernel& kernel, Arguments&&... arguments)
{
    return kernel(Machine<4>(), std::forward<Arguments>(arguments)...);
}

template <class Kernel, class... Arguments>
[[gnu::target("avx512f,avx512vl"), gnu::flatten]] auto run_widest(const Kernel& kernel, Arguments&&... arguments)
{
    return kernel(Machine<8>(), std::forward<Arguments>(arguments)...);
}

}  // namespace detail

/// How many numbers the widest registers hold that are of use here.
inline Index register_width()
{
    if (__builtin_cpu_supports("avx512vl"))
        return 8;
    return __builtin_cpu_supports("avx2") ? 4 : 2;
}

/// kernel(machine, arguments…), compiled for a machine with registers of that width. The operations on each number are
/// the same on all of them, and so are the results.
/// @param kernel what it calls is to be inlined always: clang compiles the rest for any machine.
/// @param width 2, 4 or 8, register_width() at most.
template <class Kernel, class... Arguments>
auto on_machine(Index width, const Kernel& kernel, Arguments&&... arguments)
{
    assert(width <= register_width() && "the machine lacks such registers");
    if (width == 8)
        return detail::run_widest(kernel, std::forward<Arguments>(arguments)...);
    if (width == 4)
        return detail::run_wide(kernel, std::forward<Arguments>(arguments)...);
    return kernel(Machine<2>(), std::forward<Arguments>(arguments)...);
}

#else

inline Index register_width()
{
    return 2;
}

template <class Kernel, class... Arguments>
auto on_machine(Index, const Kernel& kernel, Arguments&&... arguments)
{
    return kernel(Machine<2>(), std::forward<Arguments>(arguments)...);
}

#endif

}  // namespace seamflow
