#include "partition/metrics/exact_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace seamflow::exact {

namespace {

__extension__ using Wide = unsigned __int128;

/// A sum of products of three finite doubles without any rounding, as an integer in units of 2⁻³³⁹².
class ExactSum {
  public:
    /// Adds sign · x y z.
    void add(int sign, double x, double y, double z)
    {
        // A double is a mantissa of 53 bits times a power of two, of at least 2⁻¹¹²⁶: in the unit of the sum, no
        // product of three has a negative exponent.
        int exponent = 3392;
        const auto mantissa = [&exponent](double number) -> Wide {
            int of_number = 0;
            const double fraction = std::frexp(std::abs(number), &of_number);
            exponent += of_number - 53;
            return static_cast<std::uint64_t>(std::ldexp(fraction, 53));
        };
        // The product has 159 bits, and six digits after the shift.
        const Wide of_two = mantissa(x) * mantissa(y);
        const Wide of_third = mantissa(z);
        const int shift = exponent % bits;
        const Wide low = static_cast<std::uint64_t>(of_two) * of_third;
        const Wide high = (of_two >> 64) * of_third + (low >> 64);
        const Wide low_shifted = Wide{static_cast<std::uint64_t>(low)} << shift;
        const Wide high_shifted = (high << shift) + (low_shifted >> 64);
        const std::int64_t factor = (std::signbit(x) != std::signbit(y)) != std::signbit(z) ? -sign : sign;
        std::int64_t* const digit = digits_.data() + exponent / bits;
        for (int i = 0; i < 2; ++i)
            digit[i] += factor * static_cast<std::uint32_t>(low_shifted >> (i * bits));
        for (int i = 0; i < 4; ++i)
            digit[2 + i] += factor * static_cast<std::uint32_t>(high_shifted >> (i * bits));
    }

    /// Adds sign times the determinant of three rows.
    void add_determinant(int sign, const Point& p, const Point& q, const Point& r)
    {
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            const int k = (i + 2) % 3;
            add(sign, p[i], q[j], r[k]);
            add(-sign, p[i], q[k], r[j]);
        }
    }

    /// The sign of the sum: 1, 0 or -1.
    [[nodiscard]] int sign() const
    {
        std::int64_t carry = 0;
        bool is_zero = true;
        for (const std::int64_t digit : digits_) {
            carry += digit;
            is_zero &= static_cast<std::uint32_t>(carry) == 0;
            carry >>= bits;
        }
        return carry < 0 ? -1 : is_zero ? 0 : 1;
    }

  private:
    static constexpr int bits = 32;
    /// The digits of 32 bits, the lowest first, enough for the largest doubles. Each is the sum of the digits of all
    /// products so far, with their signs; carries are left to sign().
    std::array<std::int64_t, 208> digits_{};
};

/// The side of the plane through a, b and c on which d lies: 1, -1, or 0 in that plane.
int side_of_plane(const Point& a, const Point& b, const Point& c, const Point& d)
{
    ExactSum sum;
    sum.add_determinant(1, b, c, d);
    sum.add_determinant(-1, a, c, d);
    sum.add_determinant(1, a, b, d);
    sum.add_determinant(-1, a, b, c);
    return sum.sign();
}

/// The side of the line through a and b on which c lies, seen along a coordinate axis: 1, -1, or 0 on that line.
int side_of_line(int axis, const Point& a, const Point& b, const Point& c)
{
    // As in side_of_plane, with d infinitely far away along the axis.
    const Point along = Point::Unit(axis);
    ExactSum sum;
    sum.add_determinant(1, b, c, along);
    sum.add_determinant(-1, a, c, along);
    sum.add_determinant(1, a, b, along);
    return sum.sign();
}

/// The first coordinate axis along which a triangle is seen with an area; 3: there is none.
int axis_of_view(const TriangleCorners& t)
{
    int axis = 0;
    while (axis < 3 && side_of_line(axis, t[0], t[1], t[2]) == 0)
        ++axis;
    return axis;
}

/// For an edge in the plane of a triangle: whether no line along one of the triangle's edges, nor along the edge
/// itself, separates them.
bool meets_in_plane(const Point& p, const Point& q, const TriangleCorners& t)
{
    const int axis = axis_of_view(t);
    for (std::size_t i = 0; i < 3; ++i) {
        const Point& from = t[i];
        const Point& to = t[(i + 1) % 3];
        const int inside = side_of_line(axis, from, to, t[(i + 2) % 3]);
        if (inside * side_of_line(axis, from, to, p) < 0 && inside * side_of_line(axis, from, to, q) < 0)
            return false;
    }
    const int side = side_of_line(axis, p, q, t[0]);
    return side == 0 || side_of_line(axis, p, q, t[1]) != side || side_of_line(axis, p, q, t[2]) != side;
}

/// Whether an edge has a point in common with a triangle that has area.
bool meets(const Point& p, const Point& q, const TriangleCorners& t)
{
    const int side_of_p = side_of_plane(t[0], t[1], t[2], p);
    const int side_of_q = side_of_plane(t[0], t[1], t[2], q);
    if (side_of_p * side_of_q > 0)
        return false;
    if (side_of_p == 0 && side_of_q == 0)
        return meets_in_plane(p, q, t);
    // They meet if the line through p and q passes all three edges on the same side.
    const auto [least, most] = std::minmax(
        {side_of_plane(p, q, t[0], t[1]), side_of_plane(p, q, t[1], t[2]), side_of_plane(p, q, t[2], t[0])});
    return least * most >= 0;
}

bool has_edge_that_meets(const TriangleCorners& a, const TriangleCorners& b)
{
    return meets(a[0], a[1], b) || meets(a[1], a[2], b) || meets(a[2], a[0], b);
}

}  // namespace

bool is_flat(const TriangleCorners& t)
{
    return axis_of_view(t) == 3;
}

bool meet(const TriangleCorners& a, const TriangleCorners& b)
{
    return has_edge_that_meets(a, b) || has_edge_that_meets(b, a);
}

bool meet_beyond_corner(const TriangleCorners& a, const TriangleCorners& b)
{
    return meets(b[1], b[2], a) || meets(a[1], a[2], b);
}

bool meet_beyond_edge(const TriangleCorners& a, const TriangleCorners& b)
{
    if (side_of_plane(a[0], a[1], a[2], b[2]) != 0)
        return false;
    const int axis = axis_of_view(a);
    return side_of_line(axis, a[0], a[1], a[2]) == side_of_line(axis, a[0], a[1], b[2]);
}

}  // namespace seamflow::exact
