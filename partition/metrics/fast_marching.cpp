#include "partition/metrics/fast_marching.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "partition/vector_area.h"

namespace seamflow {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The distance at which a front, straight within the triangle u v w, reaches w if it reaches u and v at the given
/// distances; infinite if its path to w does not cross the edge u v.
double reach_across(const Point& u, double at_u, const Point& v, double at_v, const Point& w)
{
    const double edge = (v - u).norm();
    const double cosine = (at_v - at_u) / edge;
    const double sine = std::sqrt(1.0 - cosine * cosine);
    if (!(sine > 0.0))
        return never;
    const double x = (w - u).dot(v - u) / edge;
    const double y = std::sqrt(std::max((w - u).squaredNorm() - x * x, 0.0));
    // Where the path to w crosses the edge u v, measured from u.
    const double comes_from = x - y * cosine / sine;
    return comes_from >= 0.0 && comes_from <= edge ? at_u + x * cosine + y * sine : never;
}

/// The front that moves from the sources over a surface.
class Front {
  public:
    Front(const PolygonMesh& mesh, const Topology& topology)
        : mesh_(mesh)
        , topology_(topology)
        , is_reached_(usize(mesh.n_vertices()), 0)
        , distances_(usize(mesh.n_vertices()), never)
    {
    }

    /// Notes that the front can reach v at a distance.
    void put(Index v, double distance)
    {
        if (distance < distances_[v]) {
            distances_[v] = distance;
            next_.emplace(distance, v);
        }
    }

    /// Moves the front from vertex to vertex, the nearest first, up to a distance.
    /// @returns #V: the distances; infinite at vertices that are not reached.
    std::vector<double> march(double farthest)
    {
        while (!next_.empty() && next_.top().first <= farthest) {
            const Index v = next_.top().second;
            next_.pop();
            if (std::exchange(is_reached_[v], 1) == 0)
                for (const Index corner : topology_.corners_at(v))
                    cross_face(corner);
        }
        for (std::size_t v = 0; v < distances_.size(); ++v)
            if (is_reached_[v] == 0)
                distances_[v] = never;
        return std::move(distances_);
    }

  private:
    /// Moves the front from the vertex at a corner to the other corners of its face.
    void cross_face(Index corner)
    {
        const Index v = mesh_.face_vertices[corner];
        const Index beside[] = {mesh_.face_vertices[topology_.next(mesh_, corner)],
                                mesh_.face_vertices[topology_.previous(mesh_, corner)]};
        for (const Index w : mesh_.face(topology_.face_of[corner])) {
            if (is_reached_[w] != 0)
                continue;
            put(w, distances_[v] + (position(w) - position(v)).norm());
            for (const Index u : beside)
                if (is_reached_[u] != 0)
                    put(w, reach_across(position(u), distances_[u], position(v), distances_[v], position(w)));
        }
    }

    [[nodiscard]] Point position(Index v) const { return mesh_.vertices.row(v); }

    using Candidate = std::pair<double, Index>;
    const PolygonMesh& mesh_;
    const Topology& topology_;
    std::vector<std::uint8_t> is_reached_;
    std::vector<double> distances_;
    /// Distances and vertices that the front reaches next, the nearest first; a vertex may occur several times.
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> next_;
};

}  // namespace

std::vector<double> distances_from(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> sources,
                                   double most)
{
    Front front(mesh, topology);
    for (const Index v : sources)
        front.put(v, 0.0);
    return front.march(most);
}

}  // namespace seamflow
