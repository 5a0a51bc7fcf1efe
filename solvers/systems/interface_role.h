#pragma once

#include <cstdint>

namespace seamflow {

/// Role of a sub-mesh at a vertex of Γ in a sweep.
enum class InterfaceRole : std::uint8_t {
    /// Its row is a transmission condition against the complement fan: the sub-mesh is the first to solve there, or
    /// every sub-mesh keeps its own copy.
    Leads,
    /// Another sub-mesh has solved there before: it takes over that Vᵏ⁺¹.
    Follows,
};

}  // namespace seamflow
