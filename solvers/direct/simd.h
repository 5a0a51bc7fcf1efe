#pragma once

#include <algorithm>
#include <cassert>
#include <cstring>
#include <type_traits>
#include <utility>

#include "partition/index.h"

// SIMD: one instruction for several numbers (lanes) in a register. A kernel, which is a function with all functions
// that it calls inlined into it, is compiled once for each width of registers; when it is called, the width is chosen
// that the machine has (see SEAMFLOW_WIDE and with_simd_width). No library is used for this: xsimd and highway let the
// machine choose between whole files, or between functions that they compile several times. Each kernel would have to
// be moved out of its file, or be divided at the functions that it calls.

/// Marks a function whose loops gain from wider registers: it is compiled once more for machines that have them. The
/// operations, and so the results, are the same. Such a function must not throw: with GCC 12, exceptions do not leave
/// it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&               \
    !defined(__SANITIZE_THREAD__)
#define SEAMFLOW_WIDE __attribute__((flatten, target_clones("avx2", "default")))
#else
#define SEAMFLOW_WIDE
#endif

namespace seamflow {

namespace detail {

template <class Number, Index Lanes>
struct SimdVectorOf {
    using Type [[gnu::vector_size(Lanes * sizeof(Number))]] = Number;
};

}  // namespace detail

/// `Lanes` neighbouring numbers, in a register if one is that wide. The type is explicit, because compilers do not
/// vectorise sums in loops. Functions load values into a vector that the caller passes, and return no vectors: without
/// registers of this width, compilers have no common way to return it.
/// @param Lanes a power of two.
template <class Number, Index Lanes>
using SimdVector = typename detail::SimdVectorOf<Number, Lanes>::Type;

/// Loads consecutive numbers, which need not be aligned, and converts them to the type of the vector's elements.
template <class Number, class Vector>
[[gnu::always_inline]] inline void load(const Number* from, Vector& vector)
{
    using Own = std::remove_cvref_t<decltype(vector[0])>;
    SimdVector<Number, sizeof(Vector) / sizeof(Own)> numbers;
    std::memcpy(&numbers, from, sizeof numbers);
    vector = __builtin_convertvector(numbers, Vector);
}

/// Stores the elements of a vector as consecutive numbers, which need not be aligned.
template <class Number, class Vector>
[[gnu::always_inline]] inline void store(const Vector& vector, Number* to)
{
    std::memcpy(to, &vector, sizeof vector);
}

/// `Lanes` neighbouring numbers, in as many registers as needed. Arrays of vectors wider than a register are no
/// substitute: GCC always keeps them in memory, which takes ten times as long.
/// @param Width of a register, in double-precision numbers. @param Lanes a power of two.
template <class Number, Index Width, Index Lanes>
struct SimdBlock {
    static constexpr Index lanes = Lanes;
    static constexpr Index lanes_of_register = std::min(Lanes, Width* Index{sizeof(double) / sizeof(Number)});
    static constexpr Index n_registers = Lanes / lanes_of_register;
    using Vector = SimdVector<Number, lanes_of_register>;

    Vector registers[n_registers] = {};

    /// Loads as many neighbouring numbers as the block has lanes.
    [[gnu::always_inline]] void load_from(const Number* from)
    {
        for (Index p = 0; p < n_registers; ++p)
            load(from + p * lanes_of_register, registers[p]);
    }
    /// Adds factor times the numbers of another block.
    [[gnu::always_inline]] void add_product(Number factor, const SimdBlock& numbers)
    {
        for (Index p = 0; p < n_registers; ++p)
            registers[p] += factor * numbers.registers[p];
    }
    /// Subtracts the numbers of the block from as many neighbouring entries.
    [[gnu::always_inline]] void subtract_from(Number* target) const
    {
        for (Index p = 0; p < n_registers; ++p) {
            Vector entries;
            load(target + p * lanes_of_register, entries);
            entries -= registers[p];
            store(entries, target + p * lanes_of_register);
        }
    }
    /// Subtracts the first n numbers of the block from n neighbouring entries.
    [[gnu::always_inline]] void subtract_from(Number* target, Index n) const
    {
        for (Index t = 0; t < n; ++t)
            target[t] -= registers[t / lanes_of_register][t % lanes_of_register];
    }
};

/// The number of double-precision numbers in a register, at compile time.
template <Index Width>
using SimdWidth = std::integral_constant<Index, Width>;

/// The number of double-precision numbers in the widest registers that are of use here.
inline Index register_width()
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512vl"))
        return 8;
    if (__builtin_cpu_supports("avx2"))
        return 4;
#endif
    return 2;
}

#if defined(__x86_64__)

namespace detail {

template <class Kernel, class... Arguments>
[[gnu::target("avx2"), gnu::flatten]] auto run_with_avx2(const Kernel& kernel, Arguments&&... arguments)
{
    return kernel(SimdWidth<4>(), std::forward<Arguments>(arguments)...);
}

template <class Kernel, class... Arguments>
[[gnu::target("avx512f,avx512vl"), gnu::flatten]] auto run_with_avx512(const Kernel& kernel, Arguments&&... arguments)
{
    return kernel(SimdWidth<8>(), std::forward<Arguments>(arguments)...);
}

}  // namespace detail

#endif

/// Calls kernel(SimdWidth<width>(), arguments…), compiled for registers of that width. The operations on each number,
/// and so the results, are the same for all widths.
/// @param kernel all functions that it calls must be inlined: clang compiles other functions for any machine.
/// @param width 2, 4 or 8, register_width() at most.
template <class Kernel, class... Arguments>
auto with_simd_width([[maybe_unused]] Index width, const Kernel& kernel, Arguments&&... arguments)
{
    assert(width <= register_width() && "the machine lacks such registers");
#if defined(__x86_64__)
    if (width == 8)
        return detail::run_with_avx512(kernel, std::forward<Arguments>(arguments)...);
    if (width == 4)
        return detail::run_with_avx2(kernel, std::forward<Arguments>(arguments)...);
#endif
    return kernel(SimdWidth<2>(), std::forward<Arguments>(arguments)...);
}

}  // namespace seamflow
