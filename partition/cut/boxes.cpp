#include "partition/cut/boxes.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace seamflow {

namespace {

/// The number of sampled points per box that determine its median.
constexpr Index sample_of_box = 256;

using Box = Eigen::AlignedBox3d;

Index longest_side(const Box& box)
{
    Index axis = 0;
    box.sizes().maxCoeff(&axis);
    return axis;
}

/// A complete binary tree as a heap: the children of node k are 2 k and 2 k + 1, the root is 1.
class Tree {
  public:
    Tree(const Points& positions, Index n_boxes)
        : n_boxes_(n_boxes)
        , nodes_(n_boxes)
    {
        const auto n = static_cast<Index>(positions.rows());
        const Index stride = std::max(n / (n_boxes * sample_of_box), 1);
        std::vector<Index> sample;
        for (Index i = 0; i < n; i += stride)
            sample.push_back(i);
        split(1, sample, positions);
    }

    /// The number of the box, a leaf of the tree, that contains a point.
    [[nodiscard]] Index box_of(const Eigen::RowVector3d& point) const
    {
        Index k = 1;
        while (k < n_boxes_)
            k = 2 * k + (point[nodes_[k].axis] < nodes_[k].median ? 0 : 1);
        return k - n_boxes_;
    }

  private:
    /// A plane across an axis. Points on it belong to the second child.
    struct Node {
        Index axis = 0;
        double median = 0.0;
    };

    /// Sets node k and all nodes below it. A node divides its sample at the median across the longest side of the
    /// sample's bounding box.
    /// @param sample reordered.
    void split(Index k, std::span<Index> sample, const Points& positions)
    {
        if (k >= n_boxes_ || sample.empty())
            return;
        Box box;
        for (const Index i : sample)
            box.extend(positions.row(i).transpose());
        Node& node = nodes_[k];
        node.axis = longest_side(box);
        const auto half = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
        std::nth_element(sample.begin(), half, sample.end(),
                         [&](Index i, Index j) { return positions(i, node.axis) < positions(j, node.axis); });
        node.median = positions(*half, node.axis);
        split(2 * k, {sample.begin(), half}, positions);
        split(2 * k + 1, {half, sample.end()}, positions);
    }

    Index n_boxes_;
    std::vector<Node> nodes_;
};

/// Sorts points along the longest side of their bounding box.
void sort_along_longest_side(std::span<Index> points, const Points& positions)
{
    struct Projection {
        double coordinate;
        Index point;
        auto operator<=>(const Projection&) const = default;
    };
    Box box;
    for (const Index i : points)
        box.extend(positions.row(i).transpose());
    if (box.isEmpty())
        return;
    const Index axis = longest_side(box);
    std::vector<Projection> projections;
    projections.reserve(points.size());
    for (const Index i : points)
        projections.push_back({positions(i, axis), i});
    std::sort(projections.begin(), projections.end());
    std::transform(projections.begin(), projections.end(), points.begin(),
                   [](const Projection& projection) { return projection.point; });
}

}  // namespace

IndexLists divide_into_boxes(const Points& positions, Index n_boxes, const Executor& exec)
{
    const auto n = static_cast<Index>(positions.rows());
    const Tree tree(positions, n_boxes);
    std::vector<std::uint16_t> box_of(n);
    for_each(exec, n, [&](Index i) { box_of[i] = static_cast<std::uint16_t>(tree.box_of(positions.row(i))); });
    IndexLists boxes = make_lists(n_boxes, [&](auto&& add) {
        for (Index i = 0; i < n; ++i)
            add(box_of[i], i);
    });
    for_each(exec, n_boxes, [&](Index box) {
        const std::span<Index> values = boxes.values;
        sort_along_longest_side(values.subspan(usize(boxes.offsets[box]), boxes[box].size()), positions);
    });
    return boxes;
}

}  // namespace seamflow
