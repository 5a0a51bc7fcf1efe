#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// What a sub-mesh's factor takes, in bytes.
struct FactorBytes {
    std::size_t whole = 0;
    /// What of it has to be there while the equation on Γ is solved.
    std::size_t on_interface = 0;
};

/// Which factors a converged step keeps from condensation until back substitution. The others are made twice; in
/// between only their block on Γ is kept.
struct KeptFactors {
    /// Per sub-mesh: 1 where the whole factor is kept.
    std::vector<std::uint8_t> whole;
    Index n_whole = 0;
    /// How many of the others may be there at once, and what the largest of these takes.
    Index n_places = 0;
    std::size_t bytes_per_place = 0;
    /// What the former take, and what stays of the others on Γ.
    std::size_t bytes = 0;

    /// How many factors are there at once at most.
    [[nodiscard]] Index n_live() const { return n_whole + n_places; }

    /// What all that takes at once at most.
    [[nodiscard]] std::size_t most_bytes() const { return bytes + at(n_places) * bytes_per_place; }
};

/// Keeps the largest factors, as many as the limit allows, and leaves as many places for the others as lets them be
/// made in the fewest rounds.
/// @param factors of all sub-meshes.
/// @param limit in bytes. Empty: all are kept.
/// @param n_threads at least 1: there are no more places than that.
/// @throws OptionError if there is no room for what a step has to keep and one more factor; it tells how much that
/// takes.
KeptFactors choose_kept_factors(std::span<const FactorBytes> factors, std::optional<std::size_t> limit,
                                Index n_threads);

}  // namespace seamflow
