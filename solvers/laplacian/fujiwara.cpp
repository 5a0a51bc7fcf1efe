#include "solvers/laplacian/fujiwara.h"

#include <algorithm>

namespace seamflow {

namespace {

/// An edge, once, whether it has one face or two.
struct Edge {
    Index start;
    Index end;
    /// ½ for each of its half-edges.
    double weight;
};

class FujiwaraAssembler final : public LaplacianAssembler {
  public:
    explicit FujiwaraAssembler(const FaceView& faces)
        : degree_(at(faces.n_vertices), 0.0)
        , length_(at(faces.n_vertices), 0.0)
    {
        for (Index f = 0; f < faces.n_faces(); ++f) {
            const auto corners = faces.face(f);
            for (std::size_t k = 0; k < corners.size(); ++k)
                list_edge(faces, at(faces.offsets[at(f)]) + k, corners[k], corners[(k + 1) % corners.size()]);
        }
        inverse_length_.resize(edges_.size());
    }

    [[nodiscard]] std::vector<MatrixEntry> entries() const override
    {
        std::vector<MatrixEntry> entries;
        entries.reserve(4 * edges_.size());
        for (const Edge& e : edges_)
            entries.insert(entries.end(), {{e.start, e.start}, {e.end, e.start}, {e.end, e.end}, {e.start, e.end}});
        return entries;
    }

    void add(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values) override
    {
        measure_edges(positions);
        const Index* slot = slots.data();
        for (std::size_t i = 0; i < edges_.size(); ++i, slot += 4) {
            const Edge& e = edges_[i];
            const double weight = factor * e.weight * inverse_length_[i];
            const double at_start = weight * degree_[at(e.start)] / length_[at(e.start)];
            const double at_end = weight * degree_[at(e.end)] / length_[at(e.end)];
            values[at(slot[0])] += at_start;
            values[at(slot[1])] -= at_start;
            values[at(slot[2])] += at_end;
            values[at(slot[3])] -= at_end;
        }
    }

  private:
    void list_edge(const FaceView& faces, std::size_t halfedge, Index start, Index end)
    {
        const Index twin = faces.twin[halfedge];
        if (twin >= 0 && at(twin) < halfedge)
            return;
        const double weight = twin >= 0 ? 1.0 : 0.5;
        edges_.push_back({start, end, weight});
        degree_[at(start)] += weight;
        degree_[at(end)] += weight;
    }

    void measure_edges(const Points& positions)
    {
        std::fill(length_.begin(), length_.end(), 0.0);
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            const Edge& e = edges_[i];
            const double length = (positions.row(e.end) - positions.row(e.start)).norm();
            inverse_length_[i] = 1.0 / length;
            length_[at(e.start)] += e.weight * length;
            length_[at(e.end)] += e.weight * length;
        }
    }

    std::vector<Edge> edges_;
    /// Per vertex: number of edges and sum of their lengths, boundary edges counted half.
    std::vector<double> degree_;
    std::vector<double> length_;
    std::vector<double> inverse_length_;
};

}  // namespace

std::unique_ptr<LaplacianAssembler> make_fujiwara_assembler(const FaceView& faces)
{
    return std::make_unique<FujiwaraAssembler>(faces);
}

}  // namespace seamflow
