#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "partition/polygon_mesh.h"
#include "samples/options/all_options.h"

/// One surface, written in many ways that should make no difference to what is computed on it.
namespace seamflow::test {

/// A mesh that stands for another one, the original.
struct Writing {
    PolygonMesh mesh;
    /// #V of `mesh`: the vertex of the original; -1 for one that the original lacks.
    std::vector<Index> vertex_from;
    /// #F of `mesh`: the face of the original, or one beside it whose label it shares; -1 for a face of another body.
    std::vector<Index> face_from;
    /// Vertices of the original that would move only in `mesh`.
    std::vector<Index> held = {};
    /// Whether measures of the whole surface are others: there are faces that repeat none of the original.
    bool has_other_faces = false;
    /// A point p of the original lies at scale · turn · p + shift.
    double scale = 1.0;
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    Point shift = Point::Zero();

    /// Positions in the place of the original at the same in that of `mesh`, and the reverse; any number of rows.
    [[nodiscard]] Points read_back(const Points& positions) const;
    [[nodiscard]] Points placed(const Points& positions) const;

    /// For each vertex of the original, the last one that stands for it.
    [[nodiscard]] std::vector<Index> vertices(const std::vector<Index>& of_original) const;

    /// Rows at the vertices of the original, at those of `mesh`; `otherwise` where the original lacks the vertex.
    [[nodiscard]] Eigen::MatrixXd field(const Eigen::MatrixXd& of_original, double otherwise) const;

    /// Options for the original, for `mesh`: lengths are scaled, vectors turned, lists translated.
    [[nodiscard]] AllOptions options(AllOptions of_original) const;

    /// The largest difference of two rows that belong together; of a vertex that is written several times, each counts.
    [[nodiscard]] double difference(const Eigen::MatrixXd& here, const Eigen::MatrixXd& of_original) const;
};

/// A change of how a surface is written.
struct SimpleChange {
    std::string_view name;
    std::function<void(Writing&)> make;
    /// How exactly results come back, in mean edge lengths; 0: bit for bit.
    double tolerance = 0.0;
};

const std::vector<SimpleChange>& simple_changes();

/// One or several, one after another.
struct Change {
    std::vector<SimpleChange> steps;

    [[nodiscard]] Writing operator()(const PolygonMesh& mesh) const;
    [[nodiscard]] std::string name() const;
    /// The largest of all.
    [[nodiscard]] double tolerance() const;
    [[nodiscard]] bool has(std::string_view name) const;
};

/// @param names of simple_changes.
Change changes_named(std::initializer_list<std::string_view> names);

/// An open sheet of polygons with noise, a crease and a hole, of some hundred vertices.
PolygonMesh creased_sheet();

/// A closed surface of triangles with noise and a sharp rim, of some hundred vertices.
PolygonMesh rimmed_ball();

}  // namespace seamflow::test
