#pragma once

#include <cstdint>
#include <random>

namespace seamflow {

/// Numbers drawn from the bits of a Mersenne twister: unlike the distributions of the standard library, the same on
/// every platform.
class RandomNumbers {
  public:
    explicit RandomNumbers(std::uint32_t seed)
        : bits_(seed)
    {
    }

    /// In [0, 1), a multiple of 2⁻³².
    double unit() { return static_cast<double>(bits_()) * 0x1p-32; }

    /// In [-1, 1).
    double symmetric() { return 2.0 * unit() - 1.0; }

    /// 0 to n - 1.
    int below(int n) { return static_cast<int>(unit() * n); }

  private:
    std::mt19937 bits_;
};

}  // namespace seamflow
