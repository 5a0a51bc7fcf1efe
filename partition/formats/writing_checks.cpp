#include "partition/formats/writing_checks.h"

#include <limits>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_file.h"

namespace seamflow {

std::string write_polygons_instead()
{
    return "write " + extensions_of(FormatGroup::Polygons) + ", which can hold this mesh";
}

void require_floats(const std::filesystem::path& path, const Points& vertices, const Executor& exec,
                    std::string_view format, const std::string& remedy)
{
    const auto too_large = select(exec, static_cast<Index>(vertices.rows()), [&](Index v) {
        return vertices.row(v).cwiseAbs().maxCoeff() > double{std::numeric_limits<float>::max()};
    });
    if (!too_large.empty())
        throw OutputError(fmt::format("{}: cannot be written: vertex {} (numbered from 0) has a coordinate too large "
                                      "for the single precision of {}; {}",
                                      path.string(), too_large.front(), format, remedy));
}

void require_triangles(const std::filesystem::path& path, const PolygonMesh& mesh, std::string_view format)
{
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (mesh.face(f).size() != 3)
            throw OutputError(fmt::format("{}: cannot be written: face {} (numbered from 0) has {} sides, but {} holds "
                                          "triangles only; {}",
                                          path.string(), f, mesh.face(f).size(), format, write_polygons_instead()));
}

}  // namespace seamflow
