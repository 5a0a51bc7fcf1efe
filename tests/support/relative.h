#pragma once

#include <algorithm>
#include <cmath>
#include <ostream>

namespace seamflow::test {

/// A number to compare others with that may differ from it by the part `most` of the larger of the two. Unlike
/// doctest::Approx, which adds 1 to that, it does not accept any number where all are small: of 0 there is no part.
struct Relative {
    double value;
    double most;

    friend bool operator==(double other, const Relative& one)
    {
        return std::abs(other - one.value) <= one.most * std::max(std::abs(other), std::abs(one.value));
    }

    friend std::ostream& operator<<(std::ostream& out, const Relative& one)
    {
        return out << one.value << " to " << one.most;
    }
};

inline Relative relative(double value, double most)
{
    return {value, most};
}

}  // namespace seamflow::test
