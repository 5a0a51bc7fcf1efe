#include <algorithm>
#include <array>
#include <cmath>

#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

namespace {

/// K has ⟨b_i, b_k⟩ / |f| for each two corners of each face f, b the corners' bisectors; M_v is the area of v.
class SymmetricAlexaWardetzky final : public SymmetricLaplacian {
  public:
    explicit SymmetricAlexaWardetzky(const FacesOnBothSides& faces)
        : lists_{&faces.own}
    {
        if (faces.contributions == Contributions::BothSides)
            lists_.push_back(&faces.beyond);
    }

    [[nodiscard]] bool uses_faces() const override { return true; }

    [[nodiscard]] std::vector<VertexPair> pairs() const override
    {
        std::vector<VertexPair> pairs;
        for (const IndexLists* faces : lists_)
            for (Index f = 0; f < faces->size(); ++f)
                append_pairs((*faces)[f], pairs);
        return pairs;
    }

    void assemble(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values,
                  std::span<double> diagonal, std::span<double> mass, Points* product) override
    {
        if (product != nullptr) {
            product->setZero();
            assemble_with(positions, factor, slots, values, diagonal, mass, [&](Index v, Index w, const Point& change) {
                product->row(v) += change;
                product->row(w) -= change;
            });
        } else {
            assemble_with(positions, factor, slots, values, diagonal, mass, [](Index, Index, const Point&) {});
        }
    }

  private:
    /// Calls add_change(v, w, factor · K_vw times the difference of V_w and V_v).
    template <class AddChange>
    void assemble_with(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values,
                       std::span<double> diagonal, std::span<double> mass, AddChange&& add_change)
    {
        std::fill(diagonal.begin(), diagonal.end(), 0.0);
        std::fill(mass.begin(), mass.end(), 0.0);
        const Index* slot = slots.data();
        for (const IndexLists* faces : lists_)
            for (Index f = 0; f < faces->size(); ++f) {
                const auto corners = (*faces)[f];
                slot = corners.size() == 3
                           ? add_triangle(corners, positions, factor, slot, values, diagonal, mass, add_change)
                           : add_polygon(corners, positions, factor, slot, values, diagonal, mass, add_change);
            }
    }

    static void append_pairs(std::span<const Index> corners, std::vector<VertexPair>& pairs)
    {
        for (std::size_t i = 0; i < corners.size(); ++i)
            for (std::size_t k = i + 1; k < corners.size(); ++k)
                pairs.push_back({corners[i], corners[k]});
    }

    /// A triangle's bisectors are half the opposite edges, and each row of its matrix sums to zero.
    /// @returns where the slots of the next face begin.
    template <class AddChange>
    static const Index* add_triangle(std::span<const Index> corners, const Points& positions, double factor,
                                     const Index* slot, std::span<double> values, std::span<double> diagonal,
                                     std::span<double> mass, AddChange&& add_change)
    {
        const Point first = positions.row(corners[1]) - positions.row(corners[0]);
        const Point second = positions.row(corners[2]) - positions.row(corners[0]);
        const double double_area = first.cross(second).norm();
        const double weight = 0.5 * factor / double_area;
        // Of corners 1 and 2, of 0 and 2, of 0 and 1: cotangents of the opposite angles.
        const double opposite_0 = weight * first.dot(second);
        const double opposite_1 = weight * first.dot(first - second);
        const double opposite_2 = weight * second.dot(second - first);
        add_change(corners[0], corners[1], -opposite_2 * first);
        add_change(corners[0], corners[2], -opposite_1 * second);
        add_change(corners[1], corners[2], -opposite_0 * (second - first));
        values[at(slot[0])] -= opposite_2;
        values[at(slot[1])] -= opposite_1;
        values[at(slot[2])] -= opposite_0;
        diagonal[at(corners[0])] += opposite_1 + opposite_2;
        diagonal[at(corners[1])] += opposite_0 + opposite_2;
        diagonal[at(corners[2])] += opposite_0 + opposite_1;
        for (const Index v : corners)
            mass[at(v)] += double_area / 6.0;
        return slot + 3;
    }

    template <class AddChange>
    const Index* add_polygon(std::span<const Index> corners, const Points& positions, double factor, const Index* slot,
                             std::span<double> values, std::span<double> diagonal, std::span<double> mass,
                             AddChange&& add_change)
    {
        const double face_area = area(corners, positions);
        const double share = face_area / static_cast<double>(corners.size());
        bisectors_.resize(corners.size());
        for (std::size_t k = 0; k < corners.size(); ++k)
            bisectors_[k] = corner_bisector(corners, k, positions);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Point scaled = factor / face_area * bisectors_[i];
            diagonal[at(corners[i])] += scaled.dot(bisectors_[i]);
            mass[at(corners[i])] += share;
            for (std::size_t k = i + 1; k < corners.size(); ++k) {
                const double weight = scaled.dot(bisectors_[k]);
                add_change(corners[i], corners[k], weight * (positions.row(corners[k]) - positions.row(corners[i])));
                values[at(*slot++)] += weight;
            }
        }
        return slot;
    }

    std::vector<const IndexLists*> lists_;
    std::vector<Point> bisectors_;
};

}  // namespace

std::unique_ptr<SymmetricLaplacian> make_symmetric_alexa_wardetzky(const FacesOnBothSides& faces)
{
    return std::make_unique<SymmetricAlexaWardetzky>(faces);
}

}  // namespace seamflow
