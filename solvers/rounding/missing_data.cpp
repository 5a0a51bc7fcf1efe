#include "solvers/rounding/missing_data.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace seamflow {

namespace {

/// How far a value for missing data is from all others, in their ranges.
constexpr double least_gap = 3.0;
/// Different values for missing data, on one side of the others.
constexpr int most_values = 2;

/// The vertices that faces use.
std::vector<Index> used_vertices(const PolygonMesh& mesh)
{
    std::vector<std::uint8_t> is_used(usize(mesh.n_vertices()), 0);
    for (const Index v : mesh.face_vertices)
        is_used[v] = 1;
    std::vector<Index> used;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (is_used[v] != 0)
            used.push_back(v);
    return used;
}

/// Takes the vertices with the largest value out of a list, if it stands for missing data.
/// @param value_of the coordinate of a vertex, or its negative. @returns whether it does.
template <class ValueOf>
bool take_out_largest(std::vector<Index>& vertices, std::size_t n_all, ValueOf&& value_of,
                      std::vector<std::uint8_t>& is_missing)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double largest = -infinity;
    for (const Index v : vertices)
        largest = std::max(largest, value_of(v));
    double next = -infinity;
    double smallest = infinity;
    std::size_t n_largest = 0;
    for (const Index v : vertices) {
        const double value = value_of(v);
        smallest = std::min(smallest, value);
        if (value == largest)
            ++n_largest;
        else
            next = std::max(next, value);
    }
    // What lies in one plane has no range to compare with.
    if (!(next > smallest) || largest - next <= least_gap * (next - smallest) || 2 * n_largest >= n_all)
        return false;
    std::erase_if(vertices, [&](Index v) {
        if (value_of(v) != largest)
            return false;
        is_missing[v] = 1;
        return true;
    });
    return true;
}

}  // namespace

std::vector<std::uint8_t> vertices_without_data(const PolygonMesh& mesh, const Points& positions)
{
    std::vector<Index> vertices = used_vertices(mesh);
    const std::size_t n_all = vertices.size();
    std::vector<std::uint8_t> is_missing(usize(mesh.n_vertices()), 0);
    bool found = false;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0})
            for (int i = 0; i < most_values; ++i) {
                const auto value_of = [&](Index v) { return sign * positions(v, axis); };
                if (!take_out_largest(vertices, n_all, value_of, is_missing))
                    break;
                found = true;
            }
    return found ? is_missing : std::vector<std::uint8_t>();
}

}  // namespace seamflow
