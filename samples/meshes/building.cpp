#include "samples/meshes/building.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "partition/errors.h"

namespace seamflow {

Grid grid_of(Index vertices, double aspect)
{
    Grid grid;
    grid.columns = std::max(Index{2}, static_cast<Index>(std::lround(std::sqrt(aspect * vertices))));
    grid.rows = std::max(Index{2}, static_cast<Index>(std::lround(static_cast<double>(vertices) / grid.columns)));
    return grid;
}

void require_vertices(Index vertices)
{
    require_between("the number of vertices", vertices, 100, 100'000'000);
}

void require_between(const char* name, double value, double least, double most)
{
    if (value >= least && value <= most)
        return;
    std::ostringstream message;
    message.precision(9);
    message << name << " is " << value << ", but must be between " << least << " and " << most;
    throw OptionError(message.str());
}

PolygonMesh mesh_with_room(Index vertices, std::size_t corners, std::size_t faces)
{
    PolygonMesh mesh;
    mesh.vertices.resize(vertices, 3);
    mesh.face_vertices.reserve(corners);
    mesh.face_offsets.reserve(faces + 1);
    return mesh;
}

}  // namespace seamflow
