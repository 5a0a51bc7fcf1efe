#include <algorithm>

#include "partition/index_lists.h"
#include "solvers/laplacian/laplacian_assembler.h"
#include "solvers/laplacian/ptackova_velho.h"

namespace seamflow {

namespace {

/// Assembles Δ_P (Laplacian::PtackovaVelho) face by face, from the fluxes Φ_f (see PtackovaVelho).
class TwoRingAssembler final : public LaplacianAssembler {
  public:
    explicit TwoRingAssembler(const FacesOnBothSides& faces)
        : faces_(faces)
        , face_areas_(faces.own.size())
        , vertex_areas_(faces.n_vertices)
        , face_of_(faces.own.values.size())
    {
        for (Index f = 0; f < faces_.own.size(); ++f)
            std::fill(face_of_.begin() + faces_.own.offsets[f], face_of_.begin() + faces_.own.offsets[f + 1], f);
        for (Index f = 0; f < faces_.own.size(); ++f)
            list_stencil(f);
    }

    [[nodiscard]] std::vector<MatrixEntry> entries() const override
    {
        std::vector<MatrixEntry> entries;
        for (Index f = 0; f < faces_.own.size(); ++f)
            for (const Index row : faces_.own[f])
                for (const Index column : stencil_[f])
                    entries.push_back({column, row});
        return entries;
    }

    void add(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values) override
    {
        measure_areas(positions);
        const Index* slot = slots.data();
        const Index* stencil_index = stencil_index_.data();
        for (Index f = 0; f < faces_.own.size(); ++f) {
            stencil_index = measure_flux(f, positions, stencil_index);
            const auto corners = faces_.own[f];
            for (const Index v : corners) {
                const double scale = factor / (vertex_areas_[v] * static_cast<double>(corners.size()));
                for (const double coefficient : flux_)
                    values[*slot++] += scale * coefficient;
            }
        }
    }

    [[nodiscard]] double mass(Index v) const override { return vertex_areas_[v]; }

  private:
    [[nodiscard]] PtackovaVelho::Across across(Index h) const { return PtackovaVelho::across(h, faces_.twin[h]); }

    /// The face with the half-edge whose flux counts at half-edge h.
    [[nodiscard]] Index face_across(Index h) const { return face_of_[across(h).halfedge]; }

    /// Lists all vertices on which Φ_f depends, and the indices in this list of the corners of each face across.
    void list_stencil(Index f)
    {
        const std::size_t begin = stencil_.values.size();
        for (Index h = faces_.own.offsets[f]; h < faces_.own.offsets[f + 1]; ++h)
            for (const Index v : faces_.own[face_across(h)])
                stencil_.values.push_back(v);
        const auto first = stencil_.values.begin() + static_cast<std::ptrdiff_t>(begin);
        std::sort(first, stencil_.values.end());
        stencil_.values.erase(std::unique(first, stencil_.values.end()), stencil_.values.end());
        stencil_.close();
        for (Index h = faces_.own.offsets[f]; h < faces_.own.offsets[f + 1]; ++h)
            for (const Index v : faces_.own[face_across(h)])
                stencil_index_.push_back(place_in(stencil_[f], v));
    }

    /// Computes face_areas_ and vertex_areas_.
    void measure_areas(const Points& positions)
    {
        std::fill(vertex_areas_.begin(), vertex_areas_.end(), 0.0);
        for (Index f = 0; f < faces_.own.size(); ++f) {
            const auto corners = faces_.own[f];
            face_areas_[f] = area(corners, positions);
            for (const Index v : corners)
                vertex_areas_[v] += corner_area(face_areas_[f], corners.size());
        }
    }

    /// Computes the coefficients of Φ_f at the vertices of its stencil, in `flux_`.
    /// @returns the first stencil index of the next face.
    const Index* measure_flux(Index f, const Points& positions, const Index* stencil_index)
    {
        flux_.assign(stencil_[f].size(), 0.0);
        for (Index h = faces_.own.offsets[f]; h < faces_.own.offsets[f + 1]; ++h) {
            const auto [halfedge, sign] = across(h);
            const Index f_across = face_of_[halfedge];
            const auto corners = faces_.own[f_across];
            const Point half_flux =
                PtackovaVelho::half_flux(edge_vector(halfedge, f_across, positions), sign, face_areas_[f_across]);
            for (std::size_t k = 0; k < corners.size(); ++k)
                flux_[*stencil_index++] += half_flux.dot(corner_bisector(corners, k, positions));
        }
        return stencil_index;
    }

    [[nodiscard]] Point edge_vector(Index h, Index f, const Points& positions) const
    {
        const Index next = h + 1 == faces_.own.offsets[f + 1] ? faces_.own.offsets[f] : h + 1;
        return positions.row(faces_.own.values[next]) - positions.row(faces_.own.values[h]);
    }

    FacesOnBothSides faces_;
    std::vector<double> face_areas_;
    std::vector<double> vertex_areas_;
    /// Per half-edge: its face.
    std::vector<Index> face_of_;
    /// Per face: the vertices on which Φ depends, ascending.
    IndexLists stencil_;
    /// Per half-edge of each face, and corner of the face across: the index of that corner in the stencil.
    std::vector<Index> stencil_index_;
    /// The coefficients of Φ_f of one face at its stencil.
    std::vector<double> flux_;
};

}  // namespace

std::unique_ptr<LaplacianAssembler> make_two_ring_assembler(const FacesOnBothSides& faces)
{
    return std::make_unique<TwoRingAssembler>(faces);
}

}  // namespace seamflow
