#pragma once

#include <cstdint>

namespace seamflow {

/// Role of a sub-mesh at a vertex of Γ in a sweep.
enum class InterfaceRole : std::uint8_t {
    /// The row of the sub-mesh is a transmission condition against the complement fan. The sub-mesh is the first to
    /// solve at this vertex, or every sub-mesh has its own copy of Γ.
    Leads,
    /// Another sub-mesh solves first at this vertex. This one takes over its Vᵏ⁺¹.
    Follows,
};

}  // namespace seamflow
