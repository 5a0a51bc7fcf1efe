#include "engine/distributed/cut/hilbert.h"

namespace seamflow {

std::uint64_t hilbert_code(std::array<std::uint32_t, 3> cell)
{
    constexpr std::uint32_t highest = std::uint32_t{1} << (hilbert_bits - 1);
    auto& [x, y, z] = cell;
    // From large cubes to small ones: the curve within an octant is transformed back to that within the first.
    for (std::uint32_t bit = highest; bit > 1; bit /= 2) {
        const std::uint32_t below = bit - 1;
        for (std::uint32_t* const axis : {&x, &y, &z}) {
            if ((*axis & bit) != 0) {
                x ^= below;
                continue;
            }
            const std::uint32_t swapped = (x ^ *axis) & below;
            x ^= swapped;
            *axis ^= swapped;
        }
    }
    // Octants in the order of a Gray code.
    y ^= x;
    z ^= y;
    std::uint32_t parity = 0;
    for (std::uint32_t bit = highest; bit > 1; bit /= 2)
        parity ^= (z & bit) != 0 ? bit - 1 : 0;
    std::uint64_t code = 0;
    for (int bit = hilbert_bits - 1; bit >= 0; --bit)
        for (const std::uint32_t axis : cell)
            code = 2 * code + (((axis ^ parity) >> bit) & 1U);
    return code;
}

}  // namespace seamflow
