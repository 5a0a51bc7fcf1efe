#include "tests/support/reference_data.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace seamflow::test {

namespace {

using nlohmann::json;

json parse(const std::filesystem::path& path)
{
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error("cannot open " + path.string());
    return json::parse(file);
}

Laplacian laplacian_named(const std::string& name)
{
    for (const LaplacianTraits& traits : all_laplacian_traits())
        if (traits.name == name)
            return traits.laplacian;
    throw std::runtime_error("no Laplacian " + name);
}

Points points_from(const json& rows)
{
    Points points(static_cast<Eigen::Index>(rows.size()), 3);
    for (std::size_t v = 0; v < rows.size(); ++v)
        for (std::size_t c = 0; c < 3; ++c)
            points(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(c)) = rows[v][c].get<double>();
    return points;
}

/// Null is NaN.
Eigen::MatrixXd matrix_from(const json& rows)
{
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows[0].size()));
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
            const json& value = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
            matrix(i, j) = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
        }
    return matrix;
}

PolygonMesh mesh_from(const json& data)
{
    PolygonMesh mesh;
    mesh.vertices = points_from(data.at("vertices"));
    for (const json& face : data.at("faces"))
        mesh.add_face(face.get<std::vector<Index>>());
    return mesh;
}

Row row_from(const json& coefficients)
{
    Row row;
    for (const auto& [column, value] : coefficients.items())
        row[std::stoi(column)] = value.get<double>();
    return row;
}

}  // namespace

std::vector<std::filesystem::path> reference_files(const std::string& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SEAMFLOW_TEST_DATA) / folder))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

ReferenceOperators read_operators(const std::filesystem::path& path)
{
    const json data = parse(path);
    ReferenceOperators reference;
    reference.mesh = mesh_from(data);
    reference.boundary = data.at("boundary").get<std::vector<Index>>();
    reference.face_area = data.at("face_area").get<std::vector<double>>();
    reference.labels = data.at("labels").get<std::vector<Index>>();
    for (const auto& [name, entries] : data.at("laplacian").items())
        for (const json& entry : entries)
            reference.laplacian[laplacian_named(name)][entry[0].get<Index>()][entry[1].get<Index>()] +=
                entry[2].get<double>();
    for (const json& row : data.at("interface_rows"))
        reference.interface_rows.push_back({row.at("vertex").get<Index>(), row.at("sub_mesh").get<Index>(),
                                            row_from(row.at("normal_derivative")),
                                            row_from(row.at("tangential_derivative"))});
    return reference;
}

ReferenceStiffness read_stiffness(const std::filesystem::path& path)
{
    const json data = parse(path);
    ReferenceStiffness reference{mesh_from(data), {}, data.at("mass").get<std::vector<double>>()};
    for (const json& entry : data.at("stiffness"))
        reference.stiffness[entry[0].get<Index>()][entry[1].get<Index>()] += entry[2].get<double>();
    return reference;
}

ReferenceFlow read_further_flow(const std::filesystem::path& path)
{
    const json data = parse(path);
    ReferenceFlow reference{mesh_from(data), {}, {}};
    FlowOptions& options = reference.options;
    options.laplacian = laplacian_named(data.at("laplacian").get<std::string>());
    options.time_step = data.at("time_step").get<double>();
    options.steps = static_cast<int>(data.at("positions_after_step").size());
    options.cut.subdomains = 1;
    if (data.at("conformalized").get<bool>())
        options.flow = FlowEquation::Conformalized;
    if (!data.at("attachment").is_null())
        options.motion.attachment_weights = data.at("attachment").get<std::vector<double>>();
    if (data.at("low_pass").get<bool>())
        options.filter = Filter::LowPass;
    for (const json& positions : data.at("positions_after_step"))
        reference.positions_after_step.push_back(points_from(positions));
    return reference;
}

ReferenceFields read_diffusion(const std::filesystem::path& path)
{
    const json data = parse(path);
    ReferenceFields reference{mesh_from(data), {}, matrix_from(data.at("fields")), {}};
    reference.options.laplacian = laplacian_named(data.at("laplacian").get<std::string>());
    reference.options.time_step = data.at("time_step").get<double>();
    for (const json& fields : data.at("fields_after_step"))
        reference.fields_after_step.push_back(matrix_from(fields));
    return reference;
}

ReferenceFlow read_flow(const std::filesystem::path& path)
{
    const json data = parse(path);
    ReferenceFlow reference;
    reference.mesh = mesh_from(data);
    FlowOptions& options = reference.options = FlowOptions::plain();
    options.laplacian = laplacian_named(data.at("laplacian").get<std::string>());
    options.time_step = data.at("time_step").get<double>();
    options.steps = static_cast<int>(data.at("positions_after_step").size());
    options.interface.colouring = data.at("coloring") == "label" ? Colouring::Label : Colouring::Greedy;
    // The authors correct after adapted conditions only; the files say true for Schwarz, too.
    options.interface.correction = data.at("correction").get<bool>() ? Correction::Automatic : Correction::None;
    if (data.at("conditions") == "schwarz")
        options.interface.conditions = Conditions::Schwarz;
    if (data.at("conditions") == "none")
        options.cut.subdomains = 1;
    else
        options.cut.labels = data.at("labels").get<std::vector<Index>>();
    if (data.at("conditions") == "adapted-ventcell") {
        options.interface.conditions = Conditions::AdaptedVentcell;
        options.interface.q = data.at("q").get<double>();
    }
    if (!data.at("p").is_null())
        options.interface.p = data.at("p").get<double>();
    for (const json& positions : data.at("positions_after_step"))
        reference.positions_after_step.push_back(points_from(positions));
    return reference;
}

}  // namespace seamflow::test
