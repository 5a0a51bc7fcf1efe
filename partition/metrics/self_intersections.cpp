#include "partition/metrics/self_intersections.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "partition/index_lists.h"
#include "partition/metrics/box_tree.h"
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
            pieces.push_back({t, f});
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
        , tree_((sort_pieces(exec), boxes_of_leaves(exec)))
    {
    }

    /// Unsorted, and pairs of polygons possibly several times.
    [[nodiscard]] std::vector<FacePair> run(const Executor& exec) const
    {
        std::vector<FacePair> found;
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

    void sort_pieces(const Executor& exec);
    [[nodiscard]] std::vector<Box> boxes_of_leaves(const Executor& exec) const;
    void run_round(Index first, std::vector<FacePair>& found, const Executor& exec) const;
    void search(Index leaf, std::vector<FacePair>& found) const;
    void search(const Piece& piece, const Box& its_box, Index begin, Index end, std::vector<FacePair>& found) const;

    [[nodiscard]] Index begin_of(Index leaf) const { return leaf * leaf_size; }
    [[nodiscard]] Index end_of(Index leaf) const
    {
        return std::min(static_cast<Index>(pieces_.size()), (leaf + 1) * leaf_size);
    }

    const Points& positions_;
    std::vector<Piece> pieces_;
    BoxTree tree_;
};

/// Along the curve, those at one place in their previous order.
void CrossingSearch::sort_pieces(const Executor& exec)
{
    const auto n = static_cast<Index>(pieces_.size());
    Box whole;
    for (const Piece& piece : pieces_)
        whole.add(box(piece));
    std::vector<std::pair<std::uint64_t, Index>> order(pieces_.size());
    for_each(exec, n, [&](Index i) { order[i] = {place_on_curve(box(pieces_[i]), whole), i}; });
    std::sort(order.begin(), order.end());
    std::vector<Piece> sorted(pieces_.size());
    for_each(exec, n, [&](Index i) { sorted[i] = pieces_[order[i].second]; });
    pieces_ = std::move(sorted);
}

std::vector<Box> CrossingSearch::boxes_of_leaves(const Executor& exec) const
{
    const auto n = static_cast<Index>(pieces_.size());
    std::vector<Box> leaves(at(n / leaf_size) + (n % leaf_size > 0 ? 1 : 0));
    for_each(exec, static_cast<Index>(leaves.size()), [&](Index leaf) {
        for (Index i = begin_of(leaf); i < end_of(leaf); ++i)
            leaves[leaf].add(box(pieces_[i]));
    });
    return leaves;
}

/// Searches for pairs with a triangle in the leaves from `first` to the end of a round, and one in the same leaf or a
/// later one.
void CrossingSearch::run_round(Index first, std::vector<FacePair>& found, const Executor& exec) const
{
    std::vector<std::vector<FacePair>> of_task(tasks_of_round);
    for_each(exec, tasks_of_round, [&](Index task) {
        const Index begin = std::min(tree_.size(), first + task * leaves_of_task);
        const Index end = std::min(tree_.size(), begin + leaves_of_task);
        for (Index leaf = begin; leaf < end && of_task[task].size() < most_self_intersections; ++leaf)
            search(leaf, of_task[task]);
    });
    for (const auto& pairs : of_task)
        found.insert(found.end(), pairs.begin(), pairs.end());
}

void CrossingSearch::search(Index leaf, std::vector<FacePair>& found) const
{
    std::array<Box, leaf_size> boxes;
    for (Index i = begin_of(leaf); i < end_of(leaf); ++i)
        boxes[i - begin_of(leaf)] = box(pieces_[i]);
    tree_.for_each_meeting(tree_.leaf(leaf), leaf, [&](Index other) {
        for (Index i = begin_of(leaf); i < end_of(leaf); ++i)
            search(pieces_[i], boxes[i - begin_of(leaf)], other == leaf ? i + 1 : begin_of(other), end_of(other),
                   found);
    });
}

void CrossingSearch::search(const Piece& piece, const Box& its_box, Index begin, Index end,
                            std::vector<FacePair>& found) const
{
    for (Index j = begin; j < end; ++j)
        if (pieces_[j].face != piece.face && box(pieces_[j]).meets(its_box) &&
            cross(corners(piece), corners(pieces_[j])))
            found.push_back({std::min(piece.face, pieces_[j].face), std::max(piece.face, pieces_[j].face)});
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
