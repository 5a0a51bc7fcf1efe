#include "samples/figures/picture.h"

#include "partition/io/mesh_io.h"

namespace seamflow {

void write_picture(const std::filesystem::path& path, const PolygonMesh& input, const Points& positions)
{
    const auto z = input.vertices.col(2);
    const double low = z.minCoeff();
    const double range = z.maxCoeff() - low;
    VertexValues heights{.name = "height", .values = {}};
    std::vector<Colour> colours;
    for (const double height : z) {
        heights.values.push_back(height);
        colours.push_back(rainbow_colour(range > 0.0 ? (height - low) / range : 0.0));
    }
    PolygonMesh state = input;
    state.vertices = positions;
    write_valued_ply(path, state, colours, {&heights, 1});
}

}  // namespace seamflow
