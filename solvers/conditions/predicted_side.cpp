#include "solvers/conditions/predicted_side.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "partition/index_lists.h"
#include "solvers/conditions/adapted_robin.h"
#include "solvers/conditions/remainder.h"
#include "solvers/conditions/star_laplacian.h"

namespace seamflow {

namespace {

/// The kind of the row at a vertex of Γ in the present step.
enum class RowKind : std::uint8_t {
    /// The row of the undecomposed step, in which the other side responds to the movement of Γ.
    Responding,
    /// The row of the undecomposed step, in which the other side has the predicted positions.
    Fixed,
    /// The row of AdaptedRobin.
    Robin,
};

/// The condition that make_predicted_side describes.
class PredictedSide final : public TransmissionCondition {
  public:
    PredictedSide(const SubMesh& sub_mesh, const ScaledLaplacian& laplacian, const Points* stiffness_at)
        : sub_mesh_(&sub_mesh)
        , star_(sub_mesh,
                traits_of(laplacian).reach == Reach::TwoRings ? ScaledLaplacian(Laplacian::AlexaWardetzky) : laplacian,
                stiffness_at)
        , robin_(sub_mesh)
        , kinds_(sub_mesh.interface.vertices.size(), RowKind::Robin)
        , responds_(sub_mesh.interface.vertices.size())
    {
        for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
            list_columns(i);
            responds_[i] = responds_at(sub_mesh, laplacian, i);
        }
    }

    [[nodiscard]] const IndexLists& columns() const override { return columns_; }

    void begin_step(const Points& positions, const Points& other_side, double time_step, double p) override
    {
        time_step_ = time_step;
        star_.assemble(positions);
        robin_.begin_step(positions, other_side, time_step, p);
        for (Index i = 0; i < sub_mesh_->interface.size(); ++i)
            kinds_[i] = choose_kind(i, positions);
        compute_responses(positions);
    }

    void left_hand_side(Index i, const Points& positions, std::span<double> row) const override
    {
        std::fill(row.begin(), row.end(), 0.0);
        if (kinds_[i] == RowKind::Robin)
            return robin_left_hand_side(i, positions, row);
        const auto star = star_.row(i);
        const auto columns = star_.columns()[i];
        double diagonal = 1.0;
        for (std::size_t k = 0; k < columns.size(); ++k)
            if (columns[k] < sub_mesh_->n_vertices)
                row[usize(place_in(columns_[i], columns[k]))] += time_step_ * star[k];
            else
                diagonal += time_step_ * star[k] * responses(i)[k];
        row[usize(place_in(columns_[i], sub_mesh_->interface.vertices[i]))] += diagonal;
    }

    [[nodiscard]] Point right_hand_side(Index i, const Points& positions, const Points& other_side) const override
    {
        if (kinds_[i] == RowKind::Robin)
            return robin_.right_hand_side(i, positions, other_side);
        const auto star = star_.row(i);
        const auto columns = star_.columns()[i];
        const Point v = positions.row(sub_mesh_->interface.vertices[i]);
        Point sum = v;
        for (std::size_t k = 0; k < columns.size(); ++k)
            if (columns[k] >= sub_mesh_->n_vertices)
                sum -= time_step_ * star[k] * (other_side.row(columns[k]) - responses(i)[k] * v);
        return sum;
    }

  private:
    /// Lists all vertices on which the row can depend, whatever its kind.
    void list_columns(Index i)
    {
        std::vector<Index> columns(robin_.columns()[i].begin(), robin_.columns()[i].end());
        for (const Index column : star_.columns()[i])
            if (column < sub_mesh_->n_vertices)
                columns.push_back(column);
        sort_unique(columns);
        columns_.values.insert(columns_.values.end(), columns.begin(), columns.end());
        columns_.close();
    }

    /// The kind of row i for the geometry of this step: Responding wherever the Laplacian allows it and its diagonal
    /// stays at least 0, Fixed where the diagonal would not; elsewhere Robin where it is well defined, and otherwise
    /// Fixed.
    [[nodiscard]] RowKind choose_kind(Index i, const Points& positions) const
    {
        if (!responds_[i])
            return robin_.is_well_defined(i, positions) ? RowKind::Robin : RowKind::Fixed;
        return remaining_diagonal(i, positions) >= 0.0 ? RowKind::Responding : RowKind::Fixed;
    }

    /// The diagonal of the Laplacian that remains when the other side responds. Obtuse triangles can make it negative.
    [[nodiscard]] double remaining_diagonal(Index i, const Points& positions) const
    {
        const auto star = star_.row(i);
        const auto columns = star_.columns()[i];
        const Index vertex = sub_mesh_->interface.vertices[i];
        double sum = 0.0;
        for (std::size_t k = 0; k < columns.size(); ++k)
            if (columns[k] == vertex)
                sum += star[k];
            else if (columns[k] >= sub_mesh_->n_vertices)
                sum += star[k] * remainder_between(positions, vertex, columns[k], time_step_);
        return sum;
    }

    /// Fills responses_: ρ of the vertices beyond Γ in all rows where the other side responds, 0 elsewhere.
    void compute_responses(const Points& positions)
    {
        responses_.assign(star_.columns().values.size(), 0.0);
        for (Index i = 0; i < sub_mesh_->interface.size(); ++i) {
            const auto columns = star_.columns()[i];
            for (std::size_t k = 0; kinds_[i] == RowKind::Responding && k < columns.size(); ++k)
                if (columns[k] >= sub_mesh_->n_vertices)
                    responses_[usize(star_.columns().offsets[i]) + k] =
                        remainder_between(positions, sub_mesh_->interface.vertices[i], columns[k], time_step_);
        }
    }

    /// The responses in row i, one per entry of its star; 0 where the other side has the predicted positions.
    [[nodiscard]] std::span<const double> responses(Index i) const
    {
        return std::span(responses_).subspan(usize(star_.columns().offsets[i]), star_.columns()[i].size());
    }

    /// The columns of Robin's row are a subset of this condition's columns: the row is computed at the beginning of
    /// `row`, and then spread to its columns from the end.
    void robin_left_hand_side(Index i, const Points& positions, std::span<double> row) const
    {
        const auto columns = robin_.columns()[i];
        robin_.left_hand_side(i, positions, row.first(columns.size()));
        for (std::size_t k = columns.size(); k-- > 0;) {
            const double coefficient = std::exchange(row[k], 0.0);
            row[usize(place_in(columns_[i], columns[k]))] = coefficient;
        }
    }

    const SubMesh* sub_mesh_;
    StarLaplacian star_;
    AdaptedRobin robin_;
    IndexLists columns_;
    std::vector<RowKind> kinds_;
    /// Per vertex of Γ, whether the Laplacian lets the other side respond there.
    std::vector<bool> responds_;
    /// The responses ρ of all rows, one per entry of the star.
    std::vector<double> responses_;
    double time_step_ = 0.0;
};

}  // namespace

bool responds_at(const SubMesh& sub_mesh, Laplacian laplacian, Index i)
{
    const auto& interface = sub_mesh.interface;
    const auto are_triangles = [](std::span<const Index> fan, const IndexLists& faces) {
        return std::ranges::all_of(fan, [&](Index f) { return faces[f].size() == 3; });
    };
    const Reach reach = traits_of(laplacian).reach;
    return reach == Reach::Edges ||
           (reach == Reach::Faces && are_triangles(interface.own_faces[i], sub_mesh.face_vertices) &&
            are_triangles(interface.complement_faces[i], interface.halo_faces));
}

std::unique_ptr<TransmissionCondition> make_predicted_side(const SubMesh& sub_mesh, const ScaledLaplacian& laplacian,
                                                           const Points* stiffness_at)
{
    return std::make_unique<PredictedSide>(sub_mesh, laplacian, stiffness_at);
}

}  // namespace seamflow
