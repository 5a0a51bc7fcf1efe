#include "partition/cut/pieces.h"

#include <algorithm>
#include <numeric>

#include "partition/cut/components.h"
#include "partition/index.h"

namespace seamflow {

namespace {

constexpr Index settled = -1;
constexpr Index unvisited = -2;

/// The loose pieces of the suspect parts and what is done about them.
class LoosePieces {
  public:
    LoosePieces(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels, std::size_t n_labels)
        : mesh_(mesh)
        , topology_(topology)
        , labels_(labels)
        , shared_length_(n_labels, 0.0)
    {
    }

    void find(const std::vector<bool>& suspects);
    std::vector<Index> join();

  private:
    template <class Visit>
    void for_each_neighbour(Index f, Visit&& visit) const;
    void collect_piece(Index f);
    void settle_largest_pieces();
    void enqueue_loose_neighbours(Index f);
    Index best_neighbour(Index piece);

    [[nodiscard]] std::span<const Index> faces_of(Index piece) const
    {
        const auto begin = piece_offsets_[at(piece)];
        return std::span<const Index>(piece_faces_).subspan(begin, piece_offsets_[at(piece) + 1] - begin);
    }

    const PolygonMesh& mesh_;
    const Topology& topology_;
    std::vector<Index>& labels_;
    /// #F: the face's piece, or `settled`.
    std::vector<Index> piece_of_;
    std::vector<std::size_t> piece_offsets_{0};
    std::vector<Index> piece_faces_;
    std::vector<bool> queued_;
    std::vector<Index> queue_;
    /// Scratch: one entry per label, zero between uses.
    std::vector<double> shared_length_;
    std::vector<Index> candidates_;
};

/// Calls visit(half-edge of f, face across).
template <class Visit>
void LoosePieces::for_each_neighbour(Index f, Visit&& visit) const
{
    for (Index h = mesh_.face_offsets[at(f)]; h < mesh_.face_offsets[at(f) + 1]; ++h)
        if (const Index twin = topology_.twin[at(h)]; twin >= 0)
            visit(h, topology_.face_of[at(twin)]);
}

void LoosePieces::collect_piece(Index f)
{
    const auto piece = static_cast<Index>(piece_offsets_.size()) - 1;
    piece_of_[at(f)] = piece;
    piece_faces_.push_back(f);
    for (std::size_t i = piece_offsets_.back(); i < piece_faces_.size(); ++i)
        for_each_neighbour(piece_faces_[i], [&](Index, Index g) {
            if (piece_of_[at(g)] != unvisited || labels_[at(g)] != labels_[at(f)])
                return;
            piece_of_[at(g)] = piece;
            piece_faces_.push_back(g);
        });
    piece_offsets_.push_back(piece_faces_.size());
}

void LoosePieces::settle_largest_pieces()
{
    std::vector<Index> largest(shared_length_.size(), -1);
    const auto n_pieces = static_cast<Index>(piece_offsets_.size()) - 1;
    for (Index piece = 0; piece < n_pieces; ++piece) {
        Index& best = largest[at(labels_[at(faces_of(piece).front())])];
        if (best < 0 || faces_of(piece).size() > faces_of(best).size())
            best = piece;
    }
    for (const Index piece : largest)
        if (piece >= 0)
            for (const Index f : faces_of(piece))
                piece_of_[at(f)] = settled;
}

void LoosePieces::find(const std::vector<bool>& suspects)
{
    piece_of_.resize(labels_.size());
    std::transform(labels_.begin(), labels_.end(), piece_of_.begin(),
                   [&](Index label) { return suspects[at(label)] ? unvisited : settled; });
    for (Index f = 0; f < mesh_.n_faces(); ++f)
        if (piece_of_[at(f)] == unvisited)
            collect_piece(f);
    queued_.assign(piece_offsets_.size() - 1, false);
    settle_largest_pieces();
}

void LoosePieces::enqueue_loose_neighbours(Index f)
{
    for_each_neighbour(f, [&](Index, Index g) {
        const Index piece = piece_of_[at(g)];
        if (piece == settled || queued_[at(piece)])
            return;
        queued_[at(piece)] = true;
        queue_.push_back(piece);
    });
}

/// The settled part with the longest boundary to the piece; of equals the one met first.
Index LoosePieces::best_neighbour(Index piece)
{
    candidates_.clear();
    for (const Index f : faces_of(piece))
        for_each_neighbour(f, [&](Index h, Index g) {
            if (piece_of_[at(g)] != settled)
                return;
            const Index from = mesh_.face_vertices[at(h)];
            const Index to = mesh_.face_vertices[at(topology_.next(mesh_, h))];
            double& length = shared_length_[at(labels_[at(g)])];
            if (length == 0)
                candidates_.push_back(labels_[at(g)]);
            // Not zero even for an edge without length, so that each part becomes a candidate once.
            length += 1e-300 + (mesh_.vertices.row(from) - mesh_.vertices.row(to)).norm();
        });
    const Index best = *std::max_element(candidates_.begin(), candidates_.end(), [&](Index a, Index b) {
        return shared_length_[at(a)] < shared_length_[at(b)];
    });
    for (const Index label : candidates_)
        shared_length_[at(label)] = 0;
    return best;
}

/// Joins the loose pieces in rings around the settled ones.
std::vector<Index> LoosePieces::join()
{
    std::vector<Index> moved;
    for (const Index f : piece_faces_)
        if (piece_of_[at(f)] != settled)
            for_each_neighbour(f, [&](Index, Index g) {
                const Index piece = piece_of_[at(f)];
                if (piece_of_[at(g)] != settled || queued_[at(piece)])
                    return;
                queued_[at(piece)] = true;
                queue_.push_back(piece);
            });
    for (std::size_t i = 0; i < queue_.size(); ++i) {
        const Index label = best_neighbour(queue_[i]);
        for (const Index f : faces_of(queue_[i])) {
            labels_[at(f)] = label;
            piece_of_[at(f)] = settled;
            moved.push_back(f);
        }
        for (const Index f : faces_of(queue_[i]))
            enqueue_loose_neighbours(f);
    }
    return moved;
}

}  // namespace

std::vector<Index> join_loose_pieces(const PolygonMesh& mesh, const Topology& topology,
                                     const std::vector<bool>& suspects, std::vector<Index>& labels)
{
    LoosePieces pieces(mesh, topology, labels, suspects.size());
    pieces.find(suspects);
    return pieces.join();
}

Index split_by_component(const PolygonMesh& mesh, const Topology& topology, Index n_labels, std::vector<Index>& labels)
{
    const FaceComponents components = face_components(mesh, topology);
    if (components.count < 2)
        return n_labels;
    std::vector<Index> by_component(labels.size());
    std::iota(by_component.begin(), by_component.end(), 0);
    std::stable_sort(by_component.begin(), by_component.end(),
                     [&](Index f, Index g) { return components.component[at(f)] < components.component[at(g)]; });
    // For each label, the component seen last and what the label is called there.
    std::vector<Index> component_of(at(n_labels), -1);
    std::vector<Index> name(at(n_labels), -1);
    Index n_names = n_labels;
    for (const Index f : by_component) {
        const auto label = at(labels[at(f)]);
        if (component_of[label] != components.component[at(f)]) {
            name[label] = component_of[label] < 0 ? static_cast<Index>(label) : n_names++;
            component_of[label] = components.component[at(f)];
        }
        labels[at(f)] = name[label];
    }
    return n_names;
}

}  // namespace seamflow
