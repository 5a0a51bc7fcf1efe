#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// The factors that a converged step keeps from condensation until back substitution. Other factors are recomputed
/// whenever they are needed; a slot is memory for one of these.
struct KeptFactors {
    /// Per sub-mesh: 1 where the whole factor is kept.
    std::vector<std::uint8_t> whole;
    Index n_whole = 0;
    /// The number of slots, which is the number of recomputed factors that can exist at once, and the size of a slot.
    Index n_slots = 0;
    std::size_t bytes_per_slot = 0;
    /// The bytes of the kept factors.
    std::size_t bytes = 0;

    /// The most factors that exist at once.
    [[nodiscard]] Index n_live() const { return n_whole + n_slots; }

    /// The most bytes that factors take at once.
    [[nodiscard]] std::size_t most_bytes() const { return bytes + usize(n_slots) * bytes_per_slot; }
};

/// Keeps the largest factors, and recomputes the others in slots. The number of slots is the power of 2, or n_threads,
/// with which the others are computed in the fewest rounds; as many factors are kept as fit beside these slots.
/// @param factors the sizes of the factors of all sub-meshes, in bytes.
/// @param limit in bytes. Empty: all are kept.
/// @param n_threads at least 1: there are no more slots than that.
/// @throws MemoryLimitError if there is no room for any factor; its message gives the necessary number of bytes.
KeptFactors choose_kept_factors(std::span<const std::size_t> factors, std::optional<std::size_t> limit,
                                Index n_threads);

}  // namespace seamflow
