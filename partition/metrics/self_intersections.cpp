#include "partition/metrics/self_intersections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "partition/index_lists.h"
#include "partition/metrics/box_tree.h"
#include "partition/metrics/crowded_fans.h"
#include "partition/metrics/triangle_crossing.h"
#include "partition/metrics/triangulation.h"

namespace seamflow {

namespace {

/// Triangles per leaf of the tree, leaves per task, and tasks per round, after which pairs are counted.
constexpr Index leaf_size = 4;
constexpr Index leaves_of_task = 64;
constexpr Index tasks_of_round = 64;

/// A triangle of a face.
struct Piece {
    Triangle vertices;
    Index face;
    /// The number of its crowded fan; no_fan for most triangles.
    Index fan;
};

constexpr Index no_fan = std::numeric_limits<Index>::max();

/// A crowded fan, and the range of its triangles among the sorted pieces.
struct PiecesOfFan {
    CrowdedFan fan;
    Index begin;
    Index end;
};

/// All triangles of all faces with finite corners, face by face.
std::vector<Piece> pieces_of(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    const auto add_face = [&](std::vector<Piece>& pieces, Index f) {
        if (!std::ranges::all_of(mesh.face(f), [&](Index v) { return positions.row(v).allFinite(); }))
            return;
        std::vector<Triangle> triangles;
        triangulate(mesh.face(f), positions, triangles);
        for (const Triangle& t : triangles)
            pieces.push_back({t, f, no_fan});
    };
    return reduce(exec, mesh.n_faces(), std::vector<Piece>{}, add_face,
                  [](auto& pieces, const auto& part) { pieces.insert(pieces.end(), part.begin(), part.end()); });
}

/// The triangles of a mesh, neighbours together, and a tree over them.
class CrossingSearch {
  public:
    CrossingSearch(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
        : positions_(positions)
        , pieces_(pieces_of(mesh, positions, exec))
        , fans_(mark_fans())
        // The pieces are sorted first, by the fans: the leaves of the tree are ranges of sorted pieces.
        , tree_((sort_pieces(exec), boxes_of_leaves(exec)))
    {
    }

    /// Returns the pairs, unsorted; pairs of polygons possibly several times.
    [[nodiscard]] std::vector<FacePair> run(const Executor& exec) const
    {
        std::vector<FacePair> found;
        for (const PiecesOfFan& fan : fans_)
            search_within(fan, found);
        for (Index first = 0; first < tree_.size() && found.size() < most_self_intersections;
             first += tasks_of_round * leaves_of_task)
            run_round(first, found, exec);
        return found;
    }

  private:
    [[nodiscard]] TriangleCorners corners(const Piece& piece) const
    {
        const auto& [a, b, c] = piece.vertices;
        return {positions_.row(a), positions_.row(b), positions_.row(c)};
    }

    [[nodiscard]] Box box(const Piece& piece) const
    {
        Box box;
        for (const Point& p : corners(piece))
            box.add(p);
        return box;
    }

    [[nodiscard]] std::vector<PiecesOfFan> mark_fans();
    void sort_pieces(const Executor& exec);
    [[nodiscard]] std::vector<Box> boxes_of_leaves(const Executor& exec) const;
    void run_round(Index first, std::vector<FacePair>& found, const Executor& exec) const;
    void add_if_crossing(const Piece& one, const Piece& other, std::vector<FacePair>& found) const;
    void search_within(const PiecesOfFan& fan, std::vector<FacePair>& found) const;
    [[nodiscard]] Index first_to_search(Index leaf) const;
    void search_from(Index leaf, std::vector<FacePair>& found) const;
    void search_range(const Piece& piece, const Box& its_box, Index begin, Index end,
                      std::vector<FacePair>& found) const;

    [[nodiscard]] Index begin_of(Index leaf) const { return leaf * leaf_size; }
    [[nodiscard]] Index end_of(Index leaf) const
    {
        return std::min(static_cast<Index>(pieces_.size()), (leaf + 1) * leaf_size);
    }

    const Points& positions_;
    /// The pieces: those of crowded fans first, one fan after the other.
    std::vector<Piece> pieces_;
    std::vector<PiecesOfFan> fans_;
    BoxTree tree_;
};

/// Marks the triangles of crowded fans. Returns the fans with their ranges after sorting.
std::vector<PiecesOfFan> CrossingSearch::mark_fans()
{
    std::vector<Triangle> triangles;
    triangles.reserve(pieces_.size());
    for (const Piece& piece : pieces_)
        triangles.push_back(piece.vertices);
    std::vector<PiecesOfFan> fans;
    Index begin = 0;
    for (CrowdedFan& fan : crowded_fans_of(triangles, static_cast<Index>(positions_.rows()))) {
        for (const Index i : fan.triangles)
            pieces_[i].fan = static_cast<Index>(fans.size());
        const Index end = begin + static_cast<Index>(fan.triangles.size());
        fans.push_back({std::move(fan), begin, end});
        begin = end;
    }
    return fans;
}

/// Sorts the pieces: fan by fan, then all others; neighbours together in each.
void CrossingSearch::sort_pieces(const Executor& exec)
{
    const auto n = static_cast<Index>(pieces_.size());
    std::ranges::stable_sort(pieces_, {}, &Piece::fan);
    std::vector<Point> centres(pieces_.size());
    for_each(exec, n, [&](Index i) { centres[i] = centre_of(box(pieces_[i])); });
    std::vector<Piece> sorted;
    sorted.reserve(pieces_.size());
    const auto add = [&](Index begin, Index end) {
        for (const Index i : order_of_neighbours(std::span(centres).subspan(begin, end - begin), exec))
            sorted.push_back(pieces_[begin + i]);
    };
    for (const PiecesOfFan& fan : fans_)
        add(fan.begin, fan.end);
    add(fans_.empty() ? 0 : fans_.back().end, n);
    pieces_ = std::move(sorted);
}

/// The box around the pieces of each leaf.
std::vector<Box> CrossingSearch::boxes_of_leaves(const Executor& exec) const
{
    const auto n = static_cast<Index>(pieces_.size());
    std::vector<Box> leaves(usize(n / leaf_size) + (n % leaf_size > 0 ? 1 : 0));
    for_each(exec, static_cast<Index>(leaves.size()), [&](Index leaf) {
        for (Index i = begin_of(leaf); i < end_of(leaf); ++i)
            leaves[leaf].add(box(pieces_[i]));
    });
    return leaves;
}

/// Searches for crossing pairs of which one triangle is in the leaves from `first` to the end of a round, and the other
/// in the same leaf or a later one.
void CrossingSearch::run_round(Index first, std::vector<FacePair>& found, const Executor& exec) const
{
    std::vector<std::vector<FacePair>> of_task(tasks_of_round);
    for_each(exec, tasks_of_round, [&](Index task) {
        const Index begin = std::min(tree_.size(), first + task * leaves_of_task);
        const Index end = std::min(tree_.size(), begin + leaves_of_task);
        for (Index leaf = begin; leaf < end && of_task[task].size() < most_self_intersections; ++leaf)
            search_from(leaf, of_task[task]);
    });
    for (const auto& pairs : of_task)
        found.insert(found.end(), pairs.begin(), pairs.end());
}

void CrossingSearch::add_if_crossing(const Piece& one, const Piece& other, std::vector<FacePair>& found) const
{
    if (one.face != other.face && cross(corners(one), corners(other)))
        found.push_back({std::min(one.face, other.face), std::max(one.face, other.face)});
}

/// Adds the crossing pairs within a crowded fan.
void CrossingSearch::search_within(const PiecesOfFan& fan, std::vector<FacePair>& found) const
{
    std::vector<Triangle> corners;
    for (Index i = fan.begin; i < fan.end; ++i)
        corners.push_back(pieces_[i].vertices);
    for_each_pair_in_one_direction(fan.fan, corners, positions_, [&](Index i, Index j) {
        add_if_crossing(pieces_[fan.begin + i], pieces_[fan.begin + j], found);
        return found.size() < most_self_intersections;
    });
}

/// The first leaf with pieces that may cross those of a leaf without being in the same fan.
Index CrossingSearch::first_to_search(Index leaf) const
{
    const Index fan = pieces_[begin_of(leaf)].fan;
    return fan != no_fan && end_of(leaf) <= fans_[fan].end ? fans_[fan].end / leaf_size : leaf;
}

/// Adds the crossing pairs of which one piece is in a leaf, and the other in the same leaf or a later one.
void CrossingSearch::search_from(Index leaf, std::vector<FacePair>& found) const
{
    std::array<Box, leaf_size> boxes;
    for (Index i = begin_of(leaf); i < end_of(leaf); ++i)
        boxes[i - begin_of(leaf)] = box(pieces_[i]);
    tree_.for_each_meeting(tree_.leaf(leaf), first_to_search(leaf), [&](Index other) {
        for (Index i = begin_of(leaf); i < end_of(leaf); ++i)
            search_range(pieces_[i], boxes[i - begin_of(leaf)], other == leaf ? i + 1 : begin_of(other), end_of(other),
                         found);
    });
}

/// Adds the pairs of a piece and the pieces from begin to end - 1 that cross; those within one crowded fan are left to
/// search_within.
void CrossingSearch::search_range(const Piece& piece, const Box& its_box, Index begin, Index end,
                                  std::vector<FacePair>& found) const
{
    for (Index j = begin; j < end; ++j)
        if ((pieces_[j].fan == no_fan || pieces_[j].fan != piece.fan) && box(pieces_[j]).meets(its_box))
            add_if_crossing(piece, pieces_[j], found);
}

}  // namespace

std::vector<FacePair> self_intersections(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    std::vector<FacePair> pairs = CrossingSearch(mesh, positions, exec).run(exec);
    sort_unique(pairs);
    if (pairs.size() > most_self_intersections)
        pairs.resize(most_self_intersections);
    return pairs;
}

}  // namespace seamflow
