#include "solvers/rounding/flat_facets.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

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
        , planes_of_step_(std::round(step / planes.step))
        , levels_(static_cast<std::size_t>(points.rows()), std::numeric_limits<double>::quiet_NaN())
        , is_seen_(levels_.size(), 0)
        , hops_(levels_.size(), unknown)
    {
        for (Eigen::Index v = 0; v < points.rows(); ++v)
            if (planes.has(points(v, axis)))
                levels_[usize(static_cast<Index>(v))] = planes.plane_of(points(v, axis));
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
    /// False off the planes.
    [[nodiscard]] bool is_level_with(Index v, Index w) const { return levels_[v] == levels_[w]; }

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

    /// Distances from some vertices with known hops, over vertices that `may_pass` allows, up to fewer than `limit`.
    /// @param reached in: these vertices; out: with all others that were reached.
    template <class MayPass>
    void spread(std::vector<Index>& reached, MayPass&& may_pass, int limit)
    {
        std::map<int, std::vector<Index>> waiting;
        for (const Index v : reached)
            if (hops_[v] < limit)
                waiting[hops_[v]].push_back(v);
        for (; !waiting.empty(); waiting.erase(waiting.begin())) {
            const int label = waiting.begin()->first;
            std::vector<Index>& here = waiting.begin()->second;
            for (std::size_t i = 0; i < here.size(); ++i) {
                const Index v = here[i];
                // It has been reached by a shorter way.
                if (hops_[v] != label)
                    continue;
                for (const Index w : neighbours_[v]) {
                    const int way = may_pass(w) ? label + hop(v, w) : unknown;
                    if (hops_[w] <= way || way >= limit)
                        continue;
                    if (hops_[w] == unknown)
                        reached.push_back(w);
                    hops_[w] = way;
                    (way == label ? here : waiting[way]).push_back(w);
                }
            }
        }
    }

    void forget(const std::vector<Index>& vertices)
    {
        for (const Index v : vertices)
            hops_[v] = unknown;
    }

    /// The largest distance of a vertex of a facet from its rim.
    int depth_of(const std::vector<Index>& facet, const std::vector<Index>& rim)
    {
        std::vector<Index> reached = rim;
        for (const Index v : rim)
            hops_[v] = 0;
        spread(
            reached, [&](Index w) { return is_level_with(rim.front(), w); }, unknown);
        int depth = 0;
        for (const Index v : facet)
            depth = std::max(depth, hops_[v]);
        forget(reached);
        return depth;
    }

    /// For each vertex of a rim: the width of the terrace beside it, in hops: from its first vertex to where the
    /// surface is more than one step higher, or lower, than the facet; of a terrace without such an end, its own. The
    /// largest if there are several. Where there is none, the width stays.
    /// @param sign 1 for terraces above, -1 for those below. @param limit wider ones count as so wide.
    void widen(const std::vector<Index>& rim, double sign, int limit, std::vector<int>& widths)
    {
        const double level = levels_[rim.front()];
        // Comparisons with what is off all planes are false.
        const auto above = [&](Index v) { return sign * (levels_[v] - level); };
        const auto is_beside = [&](Index v) { return above(v) > 0.0 && above(v) <= planes_of_step_; };
        const auto is_beyond = [&](Index v) { return above(v) > planes_of_step_; };
        std::vector<Index> near;
        for (const Index v : rim)
            for (const Index w : neighbours_[v])
                if (is_beside(w) && hops_[w] == unknown) {
                    hops_[w] = 0;
                    near.push_back(w);
                }
        spread(near, is_beside, limit);
        measure_terraces(near, is_beyond, limit);
        for (std::size_t i = 0; i < rim.size(); ++i)
            for (const Index w : neighbours_[rim[i]])
                if (is_beside(w))
                    widths[i] = std::max(widths[i], hops_[w]);
        forget(near);
    }

    /// Replaces the distances of vertices on terraces from the rim of a facet by those to the ends of the terraces, or,
    /// where a terrace has none, by its width.
    /// @param near all that are nearer to the rim than the limit.
    template <class IsBeyond>
    void measure_terraces(const std::vector<Index>& near, IsBeyond&& is_beyond, int limit)
    {
        std::vector<int> from_rim;
        for (const Index v : near)
            from_rim.push_back(hops_[v]);
        constexpr int waiting = unknown - 1;
        for (const Index v : near)
            hops_[v] = waiting;
        std::vector<Index> terrace;
        for (std::size_t i = 0; i < near.size(); ++i) {
            if (hops_[near[i]] != waiting)
                continue;
            terrace.assign(1, near[i]);
            hops_[near[i]] = unknown;
            for (std::size_t k = 0; k < terrace.size(); ++k)
                for (const Index w : neighbours_[terrace[k]])
                    if (hops_[w] == waiting) {
                        hops_[w] = unknown;
                        terrace.push_back(w);
                    }
            measure_terrace(terrace, is_beyond, limit);
        }
        // Terraces without an end are as wide as twice their largest distance from the rim.
        std::map<int, int> furthest;
        for (std::size_t i = 0; i < near.size(); ++i)
            if (hops_[near[i]] < 0) {
                int& most = furthest[hops_[near[i]]];
                most = std::max(most, from_rim[i]);
            }
        for (const Index v : near)
            if (hops_[v] < 0)
                hops_[v] = std::min(2 * furthest[hops_[v]] + 1, limit);
    }

    /// The distances of the vertices of a terrace from its end; without an end, a negative number of its own.
    template <class IsBeyond>
    void measure_terrace(const std::vector<Index>& terrace, IsBeyond&& is_beyond, int limit)
    {
        std::vector<Index> ends;
        for (const Index v : terrace) {
            // The last hop leads beyond the end.
            int least = unknown;
            for (const Index w : neighbours_[v])
                if (is_beyond(w))
                    least = std::min(least, hop(v, w));
            if (least == unknown)
                continue;
            hops_[v] = least;
            ends.push_back(v);
        }
        if (ends.empty()) {
            for (const Index v : terrace)
                hops_[v] = -1 - terrace.front();
            return;
        }
        is_on_terrace_.resize(levels_.size(), 0);
        for (const Index v : terrace)
            is_on_terrace_[v] = 1;
        spread(
            ends, [&](Index w) { return is_on_terrace_[w] != 0; }, limit);
        for (const Index v : terrace) {
            is_on_terrace_[v] = 0;
            hops_[v] = std::min(hops_[v], limit);
        }
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
        const int depth = rim.empty() ? 0 : depth_of(facet, rim);
        if (depth < least_depth)
            return;
        // Beside a terrace as wide as this, nothing of the facet is flat.
        const int limit = 1 + static_cast<int>(std::ceil(depth / times_terrace));
        // Beside a cut, where coordinates are off all planes, there may be a terrace.
        std::vector<int> widths(rim.size(), 0);
        for (std::size_t i = 0; i < rim.size(); ++i)
            if (std::ranges::any_of(neighbours_[rim[i]], [&](Index w) { return std::isnan(levels_[w]); }))
                widths[i] = 1;
        widen(rim, 1.0, limit, widths);
        widen(rim, -1.0, limit, widths);
        // From each vertex of the rim, what is nearer than some widths of the terrace is not flat.
        const std::vector<double> averaged = along_rim(rim, widths);
        for (std::size_t i = 0; i < rim.size(); ++i)
            hops_[rim[i]] = averaged[i] < least_terrace ? 0 : -static_cast<int>(std::ceil(times_terrace * averaged[i]));
        std::vector<Index> reached = rim;
        spread(
            reached, [&](Index w) { return is_level_with(rim.front(), w); }, 0);
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
    /// 1, or 2 for marching cubes.
    double planes_of_step_;
    /// #V: the number of the plane; NaN off the planes.
    std::vector<double> levels_;
    std::vector<std::uint8_t> is_seen_;
    /// #V: see measure_terrace; 0 between calls.
    std::vector<std::uint8_t> is_on_terrace_;
    /// #V: see spread; `unknown` between calls of visit_flat.
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
