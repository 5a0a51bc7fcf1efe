#include "partition/cut/loose_nodes.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include "partition/index.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// The connected pieces of all parts.
struct Pieces {
    IndexLists nodes;
    /// #nodes: the piece of every node.
    std::vector<Index> piece_of;
    /// One entry per piece.
    std::vector<std::int64_t> weight;
};

Pieces find_pieces(const FaceGraph& graph, const std::vector<Index>& labels)
{
    Pieces pieces;
    pieces.piece_of.assign(labels.size(), -1);
    auto& reached = pieces.nodes.values;
    const auto reach = [&](Index node) {
        pieces.piece_of[at(node)] = pieces.nodes.size();
        pieces.weight.back() += graph.node_weights[at(node)];
        reached.push_back(node);
    };
    for (Index start = 0; start < graph.n_nodes(); ++start) {
        if (pieces.piece_of[at(start)] >= 0)
            continue;
        pieces.weight.push_back(0);
        reach(start);
        for (std::size_t i = at(pieces.nodes.offsets.back()); i < reached.size(); ++i) {
            const auto node = at(reached[i]);
            for (Index arc = graph.offsets[node]; arc < graph.offsets[node + 1]; ++arc)
                if (const Index target = graph.targets[at(arc)];
                    pieces.piece_of[at(target)] < 0 && labels[at(target)] == labels[at(start)])
                    reach(target);
        }
        pieces.nodes.close();
    }
    return pieces;
}

/// One entry per piece: whether it is the heaviest of its part.
std::vector<bool> find_heaviest(const Pieces& pieces, Index n_labels, const std::vector<Index>& labels)
{
    const auto label_of = [&](Index piece) { return labels[at(pieces.nodes[piece].front())]; };
    std::vector<Index> heaviest(at(n_labels), -1);
    for (Index piece = 0; piece < pieces.nodes.size(); ++piece) {
        Index& best = heaviest[at(label_of(piece))];
        if (best < 0 || pieces.weight[at(piece)] > pieces.weight[at(best)])
            best = piece;
    }
    std::vector<bool> is_heaviest(pieces.weight.size());
    for (Index piece = 0; piece < pieces.nodes.size(); ++piece)
        is_heaviest[at(piece)] = heaviest[at(label_of(piece))] == piece;
    return is_heaviest;
}

}  // namespace

bool join_loose_nodes(const FaceGraph& graph, Index n_labels, std::vector<Index>& labels)
{
    const Pieces pieces = find_pieces(graph, labels);
    std::vector<bool> settled = find_heaviest(pieces, n_labels, labels);
    std::vector<Index> loose;
    for (Index piece = 0; piece < pieces.nodes.size(); ++piece)
        if (!settled[at(piece)])
            loose.push_back(piece);
    // A piece with none but loose ones around it waits for them.
    const auto join = [&](Index piece) {
        std::map<Index, std::int64_t> shared;
        for (const Index node : pieces.nodes[piece])
            for (Index arc = graph.offsets[at(node)]; arc < graph.offsets[at(node) + 1]; ++arc)
                if (const Index target = graph.targets[at(arc)]; settled[at(pieces.piece_of[at(target)])])
                    shared[labels[at(target)]] += graph.arc_weights[at(arc)];
        if (shared.empty())
            return false;
        const auto best = std::max_element(shared.begin(), shared.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        for (const Index node : pieces.nodes[piece])
            labels[at(node)] = best->first;
        settled[at(piece)] = true;
        return true;
    };
    const bool any = !loose.empty();
    while (!loose.empty())
        std::erase_if(loose, join);
    return any;
}

}  // namespace seamflow
