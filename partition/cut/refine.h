#pragma once

#include <cstdint>
#include <vector>

#include "partition/cut/face_graph.h"

namespace seamflow {

/// The excess of a part's weight over the mean of all parts, as a fraction, that is allowed when nodes or faces move
/// between parts.
inline constexpr double balance_tolerance = 0.04;

/// The weights of parts between which nodes or faces move. A part is too heavy if its weight exceeds the mean of all
/// parts times 1 + balance_tolerance, too light if its weight is less than the mean divided by 1 + balance_tolerance.
class PartWeights {
  public:
    /// @param weights one entry per part.
    explicit PartWeights(std::vector<std::int64_t> weights);

    std::int64_t operator[](Index part) const { return weights_[part]; }

    /// Whether the giving part is too heavy or the receiving part too light, and the receiving part with this weight
    /// would still be lighter than the giving part is now.
    [[nodiscard]] bool relieves(Index weight, Index from, Index to) const
    {
        return (weights_[from] > heaviest_ || weights_[to] < lightest_) && weights_[to] + weight < weights_[from];
    }

    /// Whether neither part would become too heavy or too light.
    [[nodiscard]] bool stay_balanced(Index weight, Index from, Index to) const
    {
        return weights_[to] + weight <= heaviest_ && weights_[from] - weight >= lightest_;
    }

    void move(Index weight, Index from, Index to)
    {
        weights_[from] -= weight;
        weights_[to] += weight;
    }

  private:
    std::vector<std::int64_t> weights_;
    std::int64_t heaviest_;
    std::int64_t lightest_;
};

/// Makes the parts of a divided graph connected: each part keeps its heaviest connected component (of equals the
/// first); every other component moves to the neighbouring part to which its arcs weigh most.
/// @param labels #nodes, from 0 to n_labels - 1; no part may have nodes in several connected components of the graph.
/// @returns whether a part had several components.
bool join_loose_components(const FaceGraph& graph, Index n_labels, std::vector<Index>& labels);

/// Makes the parts of a divided graph connected (see join_loose_components) and better: nodes move to neighbouring
/// parts if one of the two parts is too heavy or too light (see balance_tolerance), to the part across their heaviest
/// arcs, and elsewhere if this cuts less.
/// @param labels #nodes, from 0 to n_labels - 1; no part may have nodes in several connected components of the graph.
void refine(const FaceGraph& graph, Index n_labels, std::vector<Index>& labels);

}  // namespace seamflow
