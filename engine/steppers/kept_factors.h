#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// Which factors a converged step keeps from condensation until back substitution. The others are recomputed whenever
/// they are needed.
struct KeptFactors {
    /// Per sub-mesh: 1 where the whole factor is kept.
    std::vector<std::uint8_t> whole;
    Index n_whole = 0;
    /// How many of the others may exist at once, and the size of the largest of these.
    Index n_places = 0;
    std::size_t bytes_per_place = 0;
    /// Bytes of the former.
    std::size_t bytes = 0;

    /// The most factors that exist at once.
    [[nodiscard]] Index n_live() const { return n_whole + n_places; }

    /// The most bytes taken at once.
    [[nodiscard]] std::size_t most_bytes() const { return bytes + usize(n_places) * bytes_per_place; }
};

/// Keeps the largest factors, as many as the limit allows, and leaves as many places for the others as lets them be
/// made in the fewest rounds.
/// @param factors their sizes for all sub-meshes, in bytes.
/// @param limit in bytes. Empty: all are kept.
/// @param n_threads at least 1: there are no more places than that.
/// @throws MemoryLimitError if there is no room for any factor; its message gives the necessary number of bytes.
KeptFactors choose_kept_factors(std::span<const std::size_t> factors, std::optional<std::size_t> limit,
                                Index n_threads);

}  // namespace seamflow
