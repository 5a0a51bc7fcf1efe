#include "solvers/rounding/flat_facets.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <limits>
#include <utility>

namespace seamflow {

namespace {

/// A facet has a vertex so many edges away from its rim; facets of fewer vertices have none.
constexpr int least_depth = 3;
constexpr std::size_t fewest_vertices = 25;
/// A facet is flat further from its rim than so many times the width of the terrace beside it; up to its rim if this
/// width is smaller than least_terrace, in hops. Widths are averaged along the rim, so many times.
constexpr double times_terrace = 3.5;
constexpr double least_terrace = 0.75;
constexpr int rounds_of_widths = 4;
/// The fraction of its vertices that are then flat, at least: few may be so by chance.
constexpr double least_flat = 0.25;
/// In steps: levels that differ by less are one.
constexpr double same_level = 0.02;
/// Edges whose part across the axis is a smaller fraction of their length run along walls.
constexpr double steep = 0.5;
constexpr int unknown = std::numeric_limits<int>::max();

/// The facets across one axis.
class FacetsAcrossAxis {
  public:
    FacetsAcrossAxis(const Points& points, const IndexLists& neighbours, const CoordinateSteps& planes, double step,
                     unsigned axis)
        : points_(points)
        , neighbours_(neighbours)
        , axis_(axis)
        , levels_(static_cast<std::size_t>(points.rows()), std::numeric_limits<double>::quiet_NaN())
        , is_seen_(levels_.size(), 0)
        , hops_(levels_.size(), unknown)
    {
        for (Eigen::Index v = 0; v < points.rows(); ++v)
            if (planes.has(points(v, axis)))
                levels_[usize(static_cast<Index>(v))] = (points(v, axis) - planes.origin) / step;
    }

    /// Calls visit with each vertex of a flat part.
    template <class Visit>
    void for_each_flat(Visit&& visit)
    {
        std::vector<Index> facet;
        for (Index v = 0; v < static_cast<Index>(levels_.size()); ++v) {
            if (is_seen_[v] != 0 || std::isnan(levels_[v]))
                continue;
            find_facet(v, facet);
            if (facet.size() >= fewest_vertices)
                visit_flat(facet, visit);
        }
    }

  private:
    [[nodiscard]] bool is_level_with(Index v, Index w) const { return std::abs(levels_[v] - levels_[w]) < same_level; }

    /// 0 along walls, otherwise 1.
    [[nodiscard]] int hop(Index v, Index w) const
    {
        Point edge = points_.row(w) - points_.row(v);
        const double length = edge.norm();
        edge[axis_] = 0.0;
        return edge.norm() < steep * length ? 0 : 1;
    }

    /// Lists all vertices in the plane of one that can be reached in it.
    void find_facet(Index start, std::vector<Index>& facet)
    {
        facet.assign(1, start);
        is_seen_[start] = 1;
        for (std::size_t i = 0; i < facet.size(); ++i)
            for (const Index w : neighbours_[facet[i]])
                if (is_seen_[w] == 0 && is_level_with(facet[i], w)) {
                    is_seen_[w] = 1;
                    facet.push_back(w);
                }
    }

    /// Distances from some vertices, in hops, over vertices that `may_pass` allows.
    /// @param front vertices with known hops, the nearest first. Afterwards all that were reached.
    template <class MayPass>
    void spread(std::vector<Index>& front, MayPass&& may_pass)
    {
        std::deque<Index> waiting(front.begin(), front.end());
        while (!waiting.empty()) {
            const Index v = waiting.front();
            waiting.pop_front();
            for (const Index w : neighbours_[v]) {
                if (!may_pass(w))
                    continue;
                const int way = hop(v, w);
                if (hops_[w] <= hops_[v] + way)
                    continue;
                if (hops_[w] == unknown)
                    front.push_back(w);
                hops_[w] = hops_[v] + way;
                if (way == 0)
                    waiting.push_front(w);
                else
                    waiting.push_back(w);
            }
        }
    }

    void forget(const std::vector<Index>& vertices)
    {
        for (const Index v : vertices)
            hops_[v] = unknown;
    }

    /// Whether some vertex of a facet is far from its rim.
    bool is_wide(const std::vector<Index>& facet, const std::vector<Index>& rim)
    {
        std::vector<Index> reached = rim;
        for (const Index v : rim)
            hops_[v] = 0;
        spread(reached, [&](Index w) { return is_level_with(rim.front(), w); });
        const bool found = std::ranges::any_of(facet, [&](Index v) { return hops_[v] >= least_depth; });
        forget(reached);
        return found;
    }

    /// For each vertex of a rim: the width of the terrace beside it, in hops: from its first vertex to where the
    /// surface is more than one step higher, or lower, than the facet; of a terrace without such an end, its own. The
    /// largest if there are several. Where there is none, the width stays.
    /// @param sign 1 for terraces above, -1 for those below.
    void widen(const std::vector<Index>& rim, double sign, std::vector<int>& widths)
    {
        const double level = levels_[rim.front()];
        // Comparisons with what is off all planes are false.
        const auto above = [&](Index v) { return sign * (levels_[v] - level); };
        const auto is_beside = [&](Index v) { return above(v) > same_level && above(v) <= 1.0 + same_level; };
        const auto is_beyond = [&](Index v) { return above(v) > 1.0 + same_level; };
        std::vector<Index> measured;
        for (const Index v : rim)
            for (const Index w : neighbours_[v])
                if (is_beside(w) && hops_[w] == unknown)
                    measure_terrace(w, is_beside, is_beyond, measured);
        for (std::size_t i = 0; i < rim.size(); ++i)
            for (const Index w : neighbours_[rim[i]])
                if (is_beside(w))
                    widths[i] = std::max(widths[i], hops_[w]);
        forget(measured);
    }

    /// Measures the distances of all vertices of a terrace to its end, or from a vertex to its furthest one if it has
    /// no end.
    template <class IsBeside, class IsBeyond>
    void measure_terrace(Index start, IsBeside&& is_beside, IsBeyond&& is_beyond, std::vector<Index>& measured)
    {
        hops_[start] = 0;
        std::vector<Index> terrace{start};
        spread(terrace, is_beside);
        int furthest = 0;
        std::vector<Index> ends;
        for (const Index v : terrace) {
            furthest = std::max(furthest, hops_[v]);
            if (std::ranges::any_of(neighbours_[v], is_beyond))
                ends.push_back(v);
        }
        // The last hop leads beyond the end.
        const auto last_hop = [&](Index v) {
            int least = 1;
            for (const Index w : neighbours_[v])
                if (is_beyond(w))
                    least = std::min(least, hop(v, w));
            return least;
        };
        measured.insert(measured.end(), terrace.begin(), terrace.end());
        for (const Index v : terrace)
            hops_[v] = ends.empty() ? furthest : unknown;
        for (const Index v : ends)
            hops_[v] = last_hop(v);
        spread(ends, is_beside);
    }

    /// Widths averaged over neighbours along the rim.
    std::vector<double> along_rim(const std::vector<Index>& rim, const std::vector<int>& widths)
    {
        // hops_ holds places in the rim for the while.
        for (std::size_t i = 0; i < rim.size(); ++i)
            hops_[rim[i]] = static_cast<int>(i);
        std::vector<double> averaged(widths.begin(), widths.end());
        for (int round = 0; round < rounds_of_widths; ++round) {
            const std::vector<double> before = averaged;
            for (std::size_t i = 0; i < rim.size(); ++i) {
                double sum = before[i];
                double n = 1.0;
                for (const Index w : neighbours_[rim[i]])
                    if (hops_[w] != unknown) {
                        sum += before[static_cast<std::size_t>(hops_[w])];
                        n += 1.0;
                    }
                averaged[i] = sum / n;
            }
        }
        forget(rim);
        return averaged;
    }

    template <class Visit>
    void visit_flat(const std::vector<Index>& facet, Visit&& visit)
    {
        std::vector<Index> rim;
        std::ranges::copy_if(facet, std::back_inserter(rim), [&](Index v) {
            return std::ranges::any_of(neighbours_[v], [&](Index w) { return !is_level_with(v, w); });
        });
        if (rim.empty() || !is_wide(facet, rim))
            return;
        // Beside a cut, where coordinates are off all planes, there may be a terrace.
        std::vector<int> widths(rim.size(), 0);
        for (std::size_t i = 0; i < rim.size(); ++i)
            if (std::ranges::any_of(neighbours_[rim[i]], [&](Index w) { return std::isnan(levels_[w]); }))
                widths[i] = 1;
        widen(rim, 1.0, widths);
        widen(rim, -1.0, widths);
        // From each vertex of the rim, what is nearer than some widths of the terrace is not flat: hops count from the
        // vertex with the widest terrace.
        const std::vector<double> averaged = along_rim(rim, widths);
        std::vector<std::pair<int, Index>> order;
        for (std::size_t i = 0; i < rim.size(); ++i)
            order.emplace_back(
                averaged[i] < least_terrace ? 0 : -static_cast<int>(std::ceil(times_terrace * averaged[i])), rim[i]);
        std::ranges::sort(order);
        std::vector<Index> reached;
        for (const auto& [hops, v] : order) {
            hops_[v] = hops;
            reached.push_back(v);
        }
        spread(reached, [&](Index w) { return is_level_with(rim.front(), w); });
        const auto is_flat = [&](Index v) { return hops_[v] >= 0; };
        if (static_cast<double>(std::ranges::count_if(facet, is_flat)) >=
            least_flat * static_cast<double>(facet.size()))
            for (const Index v : facet)
                if (is_flat(v))
                    visit(v);
        forget(reached);
    }

    const Points& points_;
    const IndexLists& neighbours_;
    Eigen::Index axis_;
    /// #V: the coordinate, in steps; NaN off the planes.
    std::vector<double> levels_;
    std::vector<std::uint8_t> is_seen_;
    /// #V: see spread; `unknown` between calls.
    std::vector<int> hops_;
};

}  // namespace

std::vector<std::uint8_t> flat_facets(const Points& points, const IndexLists& neighbours,
                                      const std::array<CoordinateSteps, 3>& planes, const Point& steps,
                                      const Executor& exec)
{
    std::array<std::vector<Index>, 3> flat;
    for_each(exec, 3, [&](Index axis) {
        if (steps[axis] > 0.0)
            FacetsAcrossAxis(points, neighbours, planes[usize(axis)], steps[axis], static_cast<unsigned>(axis))
                .for_each_flat([&](Index v) { flat[usize(axis)].push_back(v); });
    });
    std::vector<std::uint8_t> bits(static_cast<std::size_t>(points.rows()), 0);
    for (unsigned axis = 0; axis < 3; ++axis)
        for (const Index v : flat[axis])
            bits[usize(v)] = static_cast<std::uint8_t>(bits[usize(v)] | (1U << axis));
    return bits;
}

}  // namespace seamflow
