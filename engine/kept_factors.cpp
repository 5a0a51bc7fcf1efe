#include "engine/kept_factors.h"

#include <algorithm>
#include <string>

#include "partition/errors.h"

namespace seamflow {

namespace {

KeptFactors keep_all(std::span<const FactorBytes> factors)
{
    KeptFactors kept;
    kept.whole.assign(factors.size(), 1);
    kept.n_whole = static_cast<Index>(factors.size());
    for (const FactorBytes& factor : factors)
        kept.bytes += factor.whole;
    return kept;
}

}  // namespace

KeptFactors choose_kept_factors(std::span<const FactorBytes> factors, std::optional<std::size_t> limit, Index n_threads)
{
    KeptFactors kept = keep_all(factors);
    if (!limit || kept.bytes <= *limit)
        return kept;
    std::size_t largest = 1;
    std::size_t on_interface = 0;
    for (const FactorBytes& factor : factors) {
        largest = std::max(largest, factor.whole);
        on_interface += factor.on_interface;
    }
    if (*limit < on_interface + largest)
        throw OptionError("memory_limit is " + std::to_string(*limit) +
                          " bytes, but one factorisation, and what a converged step keeps of all others, take " +
                          std::to_string(on_interface + largest) +
                          ": raise it, or take sweeps (Approach::Sweep, --converge never)");
    kept = {.whole = std::vector<std::uint8_t>(factors.size(), 0)};
    kept.n_places = static_cast<Index>(std::min(at(n_threads), (*limit - on_interface) / largest));
    kept.bytes_per_place = largest;
    kept.bytes = on_interface;
    for (std::size_t s = 0; s < factors.size(); ++s)
        if (const std::size_t interior = factors[s].whole - factors[s].on_interface;
            interior <= *limit - kept.most_bytes()) {
            kept.whole[s] = 1;
            ++kept.n_whole;
            kept.bytes += interior;
        }
    return kept;
}

}  // namespace seamflow
