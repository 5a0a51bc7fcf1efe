#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow::test {

/// The files of tests/data/FOLDER, sorted by name.
std::vector<std::filesystem::path> reference_files(const std::string& folder);

/// One row of a matrix: coefficient by column.
using Row = std::map<Index, double>;

/// Operators of a small mesh, as the paper's authors compute them (tests/data/operators).
struct ReferenceOperators {
    struct InterfaceRow {
        Index vertex;
        Index sub_mesh;
        Row normal_derivative;
        Row tangential_derivative;
    };

    PolygonMesh mesh;
    std::vector<Index> boundary;
    std::vector<double> face_area;
    /// Per Laplacian, the rows by vertex.
    std::map<Laplacian, std::map<Index, Row>> laplacian;
    /// A cut into two sub-meshes, and the derivatives on its interface.
    std::vector<Index> labels;
    std::vector<InterfaceRow> interface_rows;
};

ReferenceOperators read_operators(const std::filesystem::path& path);

/// K and M of Δ_B on a small mesh (tests/data/stiffness).
struct ReferenceStiffness {
    PolygonMesh mesh;
    /// By vertex.
    std::map<Index, Row> stiffness;
    std::vector<double> mass;
};

ReferenceStiffness read_stiffness(const std::filesystem::path& path);

/// A flow as the paper's authors compute it (tests/data/flow).
struct ReferenceFlow {
    PolygonMesh mesh;
    FlowOptions options;
    std::vector<Points> positions_after_step;
};

ReferenceFlow read_flow(const std::filesystem::path& path);

/// A flow beyond the paper's (tests/data/beyond), undecomposed.
ReferenceFlow read_further_flow(const std::filesystem::path& path);

/// Fields that diffuse with a free boundary (tests/data/fields).
struct ReferenceFields {
    PolygonMesh mesh;
    FlowOptions options;
    /// #V by columns; NaN is no data.
    Eigen::MatrixXd fields;
    std::vector<Eigen::MatrixXd> fields_after_step;
};

ReferenceFields read_diffusion(const std::filesystem::path& path);

}  // namespace seamflow::test
