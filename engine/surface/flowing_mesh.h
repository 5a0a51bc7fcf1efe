#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/measure/run_report.h"
#include "engine/options/motion_options.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/topology.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// A mesh in the form in which it flows: the given mesh itself; or a copy, near the origin if the given mesh lies far
/// from it (see origin_offset), with vertices along seams joined (see weld), and without faces that repeat others. The
/// copy and the given mesh move together. make_surface makes it complete; then nothing replaces mesh() any more.
class FlowingMesh {
  public:
    /// @param given must outlive this; only this object moves it.
    explicit FlowingMesh(PolygonMesh& given);

    /// The mesh that flows.
    [[nodiscard]] const PolygonMesh& mesh() const { return copy_ ? *copy_ : *given_; }

    /// Lets vertices along seams move as one. To be called at most once. Replaces mesh().
    /// @param topology of mesh(); becomes that of the mesh with vertices joined.
    /// @param motion with lengths in units of length; its settings for joined vertices then apply to their
    /// representative: it is fixed if any of them is, attached by the largest of their weights, and moves with the
    /// smallest of their strengths.
    void weld_seams(Topology& topology, MotionOptions& motion, const Executor& exec);

    /// The number of vertices of mesh() that were merged into others, and no longer have faces.
    [[nodiscard]] Index n_copies() const { return static_cast<Index>(copies_.size()); }

    /// The given mesh, at its present positions.
    [[nodiscard]] const PolygonMesh& given() const { return *given_; }

    /// The vertices of the given mesh that no face uses, ascending.
    [[nodiscard]] std::vector<Index> unused_vertices() const;

    /// The vertex of mesh() that a vertex of the given mesh moves with.
    [[nodiscard]] Index moves_with(Index v) const { return representative_.empty() ? v : representative_[v]; }

    /// Subtracts the offset of mesh(). Rows are any positions; vertices are not joined.
    [[nodiscard]] Points to_flowing(const Points& positions) const { return positions.rowwise() - offset_; }

    /// Sets the positions that move_to and bring_back give to vertices without faces, if mesh() has an offset. Without
    /// one these vertices get the positions of mesh(), as all others do.
    /// @param vertices of the given mesh; those with faces are ignored. @param to #vertices by 3.
    void set_isolated_positions(std::span<const Index> vertices, const Points& to);

    /// Leaves out the faces on which no row of a moving vertex depends. To be called before all other functions.
    /// Replaces mesh().
    /// @param strength see MotionOptions::strength: one per vertex of mesh(). @param reach of the Laplacian.
    /// @returns whether there were any.
    bool leave_out_still_faces(std::span<const double> strength, Reach reach);

    /// Leaves out faces that repeat others. A surface whose faces occur twice (such as to be seen from both sides) is
    /// manifold nowhere, but flows like the single surface. Replaces mesh().
    /// @param topology of mesh(): only vertices and edges where it is not manifold are searched.
    /// @returns whether there were any.
    bool leave_out_repeated_faces(const Topology& topology);

    /// Replaces faces by triangles. To be called after faces were left out and vertices joined. Replaces mesh().
    /// @param face_of per triangle, ascending: the face of mesh() that it came from, each at least once.
    void replace_faces(PolygonMesh triangles, std::span<const Index> face_of);

    /// The labels of the remaining faces. A list of wrong length is returned unchanged.
    [[nodiscard]] std::vector<Index> of_faces_left(const std::vector<Index>& labels) const;

    /// Moves the vertices.
    /// @param positions #V by 3, of mesh().
    void move_to(const Points& positions);

    /// Whether positions of mesh() differ from those of the given mesh: because of an offset, or because vertices are
    /// joined.
    [[nodiscard]] bool is_elsewhere() const { return is_shifted() || !copies_.empty(); }

    /// Converts positions of mesh() to those of the given mesh. Vertices without faces get their initial positions, bit
    /// for bit, or those that set_isolated_positions has set.
    /// @param positions #V by 3, and any number of further rows.
    void bring_back(Points& positions) const;

    /// Converts a mesh of separated sub-meshes (see FlowReport::separated), whose first vertices are those of mesh(),
    /// and whose further ones are copies of those on Γ: its positions and the vertices of its faces become those of the
    /// given mesh.
    void bring_back(PolygonMesh& separated) const;

    /// Gives the representative of joined vertices the mean of their rows.
    /// @param data #V by any number of columns.
    template <class Rows>
    void join(Rows&& data) const
    {
        if (copies_.empty())
            return;
        std::vector<double> n(representative_.size(), 1.0);
        for (const Index v : copies_)
            n[representative_[v]] += 1.0;
        for (Eigen::Index c = 0; c < data.cols(); ++c) {
            // The mean of equal values is exact.
            std::vector<double> sums(representative_.size(), 0.0);
            for (const Index v : copies_)
                sums[representative_[v]] += data(v, c) - data(representative_[v], c);
            for (Index v = 0; v < static_cast<Index>(representative_.size()); ++v)
                data(v, c) += sums[v] / n[v];
        }
    }

    /// Gives joined vertices the row of their representative.
    /// @param rows #V by any number of columns, of mesh().
    template <class Rows>
    void take_along(Rows&& rows) const
    {
        for (const Index v : copies_)
            rows.row(v) = rows.row(representative_[v]);
    }

    /// Converts the report to the given mesh.
    void complete(RunReport& report) const;

    /// The labels of all faces of the given mesh: a face that repeats another gets the label of that face; other faces
    /// that were left out, in which nothing moves, get `of_still`.
    /// @param labels of the faces of mesh().
    [[nodiscard]] std::vector<Index> labels_of_given(std::vector<Index> labels, Index of_still) const;

  private:
    /// A vertex that is joined with others at some distance.
    struct Apart {
        Index vertex;
        /// The vertex's own position, and the position of its representative, both in mesh() and before the first step.
        Point own;
        Point joined;
    };

    /// Whether mesh() has an offset to the given mesh.
    [[nodiscard]] bool is_shifted() const { return !offset_.isZero(0.0); }
    void shift_back(Points& positions) const;
    [[nodiscard]] std::vector<Index> repeated_faces() const;
    void renumber(std::vector<Index> number);

    PolygonMesh* given_;
    /// Subtracted from the positions of the given mesh; 0: the given mesh is not far from the origin.
    Point offset_;
    /// The mesh that flows; empty if the given mesh itself flows.
    std::optional<PolygonMesh> copy_;
    /// If mesh() has an offset: the vertices without faces, and their positions.
    std::vector<Index> isolated_;
    Points of_isolated_ = Points(0, 3);
    /// #V: the vertex of mesh() that each vertex moves with (see Weld::representative); empty if no vertices are
    /// joined.
    std::vector<Index> representative_;
    /// The vertices that were merged into another, ascending.
    std::vector<Index> copies_;
    std::vector<Apart> apart_;
    std::optional<Remark> remark_on_seams_;
    /// Per face of the given mesh: its number among the remaining faces, or that of the face that it repeats; -1 for
    /// faces in which nothing moves. Empty if no face is left out.
    std::vector<Index> number_;
};

}  // namespace seamflow
