#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "samples/training/draws.h"

namespace seamflow {

/// A smooth random function in space, about -1 to 1, whose waves are about 1 long (Perlin, Improving Noise, 2002).
class GradientNoise {
  public:
    explicit GradientNoise(RandomNumbers& random)
        : seed_(static_cast<std::uint32_t>(random.unit() * 0x1p32))
    {
    }

    double operator()(const Point& p) const
    {
        const Point cell = p.array().floor();
        const Point in_cell = p - cell;
        const Point weight = in_cell.array().cube() * (in_cell.array() * (in_cell.array() * 6.0 - 15.0) + 10.0);
        double total = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const Point offset(corner & 1, corner >> 1 & 1, corner >> 2);
            const Point weights = offset.array() * weight.array() + (1.0 - offset.array()) * (1.0 - weight.array());
            total += weights.prod() * gradient(cell + offset).dot(in_cell - offset);
        }
        return amplitude * total;
    }

    /// Three numbers that have nothing to do with each other.
    [[nodiscard]] Point vector(const Point& p) const
    {
        const Point shift(17.3, 4.1, 9.2);
        return {(*this)(p), (*this)(p + shift), (*this)(p - shift)};
    }

  private:
    static constexpr double amplitude = 1.6;

    [[nodiscard]] Point gradient(const Point& corner) const
    {
        std::uint32_t bits = seed_;
        for (const double coordinate : corner)
            bits = mixed_bits(bits, static_cast<std::uint32_t>(static_cast<std::int32_t>(coordinate)));
        const double angle = 2.0 * std::numbers::pi * 0x1p-16 * (bits & 0xffffU);
        const double height = 2.0 * 0x1p-16 * (bits >> 16U) - 1.0;
        const double radius = std::sqrt(1.0 - height * height);
        return {radius * std::cos(angle), radius * std::sin(angle), height};
    }

    std::uint32_t seed_;
};

}  // namespace seamflow
