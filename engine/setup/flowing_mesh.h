#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/topology.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// A mesh in the form in which it flows: as it was given, or as a copy, near the origin where the given one lies far
/// from it (see origin_offset), with vertices along seams joined (see weld), and without faces that repeat others. Both
/// move together.
class FlowingMesh {
  public:
    /// @param given must outlive this; only this moves it.
    explicit FlowingMesh(PolygonMesh& given);

    /// The mesh that flows. Its address does not change.
    [[nodiscard]] const PolygonMesh& mesh() const { return copy_ ? *copy_ : *given_; }

    /// Lets vertices along seams move as one. To be called at most once, before anything refers to mesh().
    /// @param topology of mesh(); becomes that of the mesh with vertices joined.
    /// @param motion its settings for joined vertices then apply to the first of them: it is held, or attached by the
    ///        largest of their weights.
    void weld_seams(Topology& topology, MotionOptions& motion, const Executor& exec);

    /// How many vertices of mesh() were joined to others before them, and no longer have faces.
    [[nodiscard]] Index n_copies() const { return static_cast<Index>(copies_.size()); }

    /// As it was given, where it is now.
    [[nodiscard]] const PolygonMesh& given() const { return *given_; }

    /// The vertices of the given mesh that no face uses, ascending.
    [[nodiscard]] std::vector<Index> unused_vertices() const;

    /// The vertex of mesh() that a vertex of the given mesh moves with.
    [[nodiscard]] Index moves_with(Index v) const { return first_.empty() ? v : first_[v]; }

    /// Converts positions of the given mesh to those of mesh().
    [[nodiscard]] Points to_flowing(const Points& positions) const { return positions.rowwise() - offset_; }

    /// Puts those of the vertices that have no faces elsewhere, which move_to does not do.
    /// @param vertices of the given mesh. @param to #vertices by 3.
    void move_isolated(std::span<const Index> vertices, const Points& to);

    /// Leaves out the faces on which no row of a moving vertex depends. To be called at most once, first of all.
    /// @param strength see MotionOptions::strength: one per vertex of mesh(). @param reach of the Laplacian.
    /// @returns whether there were any.
    bool leave_out_still_faces(std::span<const double> strength, Reach reach);

    /// Leaves out faces that repeat others. A surface whose faces occur twice (to be seen from both sides, say) is
    /// manifold nowhere, but flows like the single one. To be called at most once, before anything refers to mesh().
    /// @param topology of mesh(): only places where it is not manifold are searched.
    /// @returns whether there were any.
    bool leave_out_repeated_faces(const Topology& topology);

    /// Takes triangles in place of faces. To be called at most once, after all else has left out or joined any, and
    /// before anything refers to mesh().
    /// @param face_of per triangle, ascending: the face of mesh() that it came from, each at least once.
    void replace_faces(PolygonMesh triangles, std::span<const Index> face_of);

    /// The labels of the faces that are left. A list of wrong length stays as it is.
    [[nodiscard]] std::vector<Index> of_faces_left(const std::vector<Index>& labels) const;

    /// Moves the vertices.
    /// @param positions #V by 3, of mesh().
    void move_to(const Points& positions);

    /// Whether positions of mesh() differ from those of the given mesh: they lie elsewhere, or vertices are joined.
    [[nodiscard]] bool is_elsewhere() const { return is_shifted() || !copies_.empty(); }

    /// Converts positions of mesh() to those of the given mesh. Vertices without faces, which never move, are as at
    /// first, bit for bit.
    /// @param positions #V by 3, and any number of further rows.
    void bring_back(Points& positions) const;

    /// The same for separated sub-meshes (see FlowReport::separated).
    void bring_back(PolygonMesh& separated) const;

    /// Gives the first of joined vertices the mean of all of them.
    /// @param data #V by any number of columns.
    template <class Rows>
    void join(Rows&& data) const
    {
        if (copies_.empty())
            return;
        std::vector<double> n(first_.size(), 1.0);
        for (const Index v : copies_)
            n[first_[v]] += 1.0;
        for (Eigen::Index c = 0; c < data.cols(); ++c) {
            // The mean of equal values is exact.
            std::vector<double> sums(first_.size(), 0.0);
            for (const Index v : copies_)
                sums[first_[v]] += data(v, c) - data(first_[v], c);
            for (Index v = 0; v < static_cast<Index>(first_.size()); ++v)
                data(v, c) += sums[v] / n[v];
        }
    }

    /// Moves joined vertices to the first of them.
    /// @param rows #V by any number of columns, of mesh().
    template <class Rows>
    void take_along(Rows&& rows) const
    {
        for (const Index v : copies_)
            rows.row(v) = rows.row(first_[v]);
    }

    /// Converts the report to the given mesh: faces that were left out get the sub-mesh of the face that they repeat,
    /// or the number after that of the last sub-mesh where nothing moves.
    void complete(FlowReport& report) const;

  private:
    /// A vertex that is joined with others at some distance.
    struct Apart {
        Index vertex;
        /// Its own position, and that of the joined vertices, both in mesh() and before the first step.
        Point own;
        Point joined;
    };

    /// Whether the given mesh lies elsewhere.
    [[nodiscard]] bool is_shifted() const { return !offset_.isZero(0.0); }
    void shift_back(Points& positions) const;
    [[nodiscard]] std::vector<Index> repeated_faces() const;
    void renumber(std::vector<Index> number);

    PolygonMesh* given_;
    Point offset_;
    std::optional<PolygonMesh> copy_;
    /// If the given mesh is far away: the vertices without faces, and their positions.
    std::vector<Index> isolated_;
    Points of_isolated_ = Points(0, 3);
    /// See Weld::first; empty where nothing is joined. Those that are not their own first.
    std::vector<Index> first_;
    std::vector<Index> copies_;
    std::vector<Apart> apart_;
    std::optional<Remark> remark_on_seams_;
    /// Per face of the given mesh: its number, or that of the face that it repeats, among those that are left; -1 where
    /// nothing moves. Empty if none is left out.
    std::vector<Index> number_;
};

}  // namespace seamflow
