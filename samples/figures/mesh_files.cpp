#include "samples/figures/mesh_files.h"

#include <algorithm>
#include <string>
#include <vector>

#include "partition/formats/mesh_io.h"
#include "partition/formats/palette.h"
#include "samples/files/output_files.h"

namespace seamflow {

namespace {

std::filesystem::path path_of(const Experiment& experiment, const std::filesystem::path& folder, std::string_view title,
                              std::string_view ending)
{
    return folder / std::string(experiment.name).append("-").append(title).append(ending);
}

/// From the lowest vertex that has faces to the highest; vertices of equal height are all as the lowest.
std::vector<Colour> colours_of_heights(const PolygonMesh& mesh)
{
    const Eigen::VectorXd z = mesh.vertices(mesh.face_vertices, 2);
    const double low = z.minCoeff();
    const double range = z.maxCoeff() - low;
    std::vector<Colour> colours;
    for (const double height : mesh.vertices.col(2))
        colours.push_back(rainbow_colour(range > 0.0 ? (height - low) / range : 0.0));
    return colours;
}

}  // namespace

void write_input(const Experiment& experiment, const std::filesystem::path& folder, const FigureMesh& input)
{
    write_state(experiment, folder, input, picture_of::input, input.mesh.vertices);
    if (std::ranges::none_of(experiment.variants,
                             [](const Variant& variant) { return variant.cut == CutKind::Halves; }))
        return;
    std::string labels;
    for (const Index label : input.labels)
        labels.append(std::to_string(label)).append("\n");
    write_text(path_of(experiment, folder, picture_of::cut, ".txt"), labels);
}

void write_state(const Experiment& experiment, const std::filesystem::path& folder, const FigureMesh& input,
                 std::string_view title, const Points& positions)
{
    const auto heights = input.mesh.vertices.col(2);
    const VertexValues values{.name = "height", .values = {heights.begin(), heights.end()}};
    PolygonMesh state = input.mesh;
    state.vertices = positions;
    write_valued_ply(path_of(experiment, folder, title, ".ply"), state, colours_of_heights(input.mesh), {&values, 1});
}

}  // namespace seamflow
