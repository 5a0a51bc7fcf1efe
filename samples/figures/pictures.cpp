#include "samples/figures/pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "partition/formats/mesh_io.h"
#include "partition/metrics/triangulation.h"
#include "samples/files/output_files.h"

namespace seamflow {

namespace {

/// From 0 for the lowest vertex that has faces to 1 for the highest.
std::vector<double> relative_heights(const PolygonMesh& mesh)
{
    const Eigen::VectorXd z = mesh.vertices(mesh.face_vertices, 2);
    const double low = z.minCoeff();
    const double range = z.maxCoeff() - low;
    std::vector<double> heights;
    for (const double height : mesh.vertices.col(2))
        heights.push_back(range > 0.0 ? (height - low) / range : 0.0);
    return heights;
}

/// The texture: a colour for each height, darker along lines of equal height.
Colour height_colour(double height)
{
    constexpr double lines = 16.0;
    constexpr double width = 0.14;
    Colour colour = rainbow_colour(height);
    const double place = height * lines;
    if (std::abs(place - std::round(place)) < width / 2.0)
        for (std::uint8_t& part : colour)
            part = static_cast<std::uint8_t>(part / 2);
    return colour;
}

/// The values of the vertices, and for each centre the mean around its face.
std::vector<double> with_centres(const PolygonMesh& mesh, const CentreFans& fans, std::vector<double> values)
{
    values.resize(fans.triangles.n_vertices());
    for (Index t = 0; t < fans.triangles.n_faces(); ++t) {
        const Index centre = fans.triangles.face(t)[0];
        if (centre < mesh.n_vertices())
            continue;
        const auto face = mesh.face(fans.faces[t]);
        double sum = 0.0;
        for (const Index v : face)
            sum += values[v];
        values[centre] = sum / static_cast<double>(face.size());
    }
    return values;
}

/// The faces with a label, among all vertices.
PolygonMesh part_of(const FigureMesh& input, Index label)
{
    PolygonMesh part;
    part.vertices = input.mesh.vertices;
    for (Index f = 0; f < input.mesh.n_faces(); ++f)
        if (input.labels[f] == label)
            part.add_face(input.mesh.face(f));
    return part;
}

bool is_in_halves(const Variant& variant)
{
    return variant.cut == CutKind::Halves;
}

}  // namespace

Pictures::Pictures(const Experiment& experiment, std::filesystem::path folder, const FigureMesh& input)
    : figure_(experiment.name)
    , folder_(std::move(folder))
    , input_(input)
    , is_cut_(std::any_of(experiment.variants.begin(), experiment.variants.end(), is_in_halves))
    , overlaps_(std::all_of(
          experiment.variants.begin(), experiment.variants.end(),
          [](const Variant& variant) { return !is_in_halves(variant) || variant.conditions == Conditions::Schwarz; }))
    , viewpoint_(input.mesh)
    , heights_(relative_heights(input.mesh))
{
    write_ply(picture_of::input, input.mesh.vertices);
    if (!is_cut_)
        return;
    std::string labels;
    for (const Index label : input.labels)
        labels.append(std::to_string(label)).append("\n");
    write_text(path(picture_of::cut, ".txt"), labels);
}

std::filesystem::path Pictures::path(std::string_view title, std::string_view ending) const
{
    return folder_ / std::string(figure_).append("-").append(title).append(ending);
}

void Pictures::write(const std::string& title, const Points& positions) const
{
    write_ply(title, positions);
    draw_textured(title, input_.mesh, positions);
}

void Pictures::write_inputs(Index leading) const
{
    draw_textured(picture_of::input, input_.mesh, input_.mesh.vertices);
    if (!is_cut_)
        return;
    draw_textured(picture_of::part, part_of(input_, leading), input_.mesh.vertices);
    draw_cut(leading);
}

void Pictures::write_ply(std::string_view title, const Points& positions) const
{
    const VertexValues heights{
        .name = "height",
        .values = std::vector<double>(input_.mesh.vertices.col(2).begin(), input_.mesh.vertices.col(2).end())};
    std::vector<Colour> colours;
    for (const double height : heights_)
        colours.push_back(rainbow_colour(height));
    PolygonMesh state = input_.mesh;
    state.vertices = positions;
    write_valued_ply(path(title, ".ply"), state, colours, {&heights, 1});
}

void Pictures::draw_textured(std::string_view title, const PolygonMesh& mesh, const Points& positions) const
{
    const CentreFans fans = fans_around_centres(mesh, positions);
    const auto paint = [](Index, double height) { return height_colour(height); };
    write_png(path(title, ".png"), draw(fans.triangles, with_centres(mesh, fans, heights_), paint, viewpoint_));
}

void Pictures::draw_cut(Index leading) const
{
    constexpr Colour colours[] = {{0xd9, 0x8f, 0x4e}, {0x6d, 0x9f, 0xc6}, {0x9a, 0x7d, 0x9c}};
    const CentreFans fans = fans_around_centres(input_.mesh, input_.mesh.vertices);
    const std::vector<Index> labels = overlaps_ ? with_overlap(input_.mesh, input_.labels, leading) : input_.labels;
    const auto paint = [&](Index triangle, double) { return colours[labels[fans.faces[triangle]]]; };
    write_png(path(picture_of::cut, ".png"),
              draw(fans.triangles, with_centres(input_.mesh, fans, heights_), paint, viewpoint_));
}

}  // namespace seamflow
