#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/stl.h"
#include "partition/formats/writing_checks.h"

namespace seamflow {

namespace {

void require_no_isolated_vertex(const std::filesystem::path& path, const PolygonMesh& mesh)
{
    std::vector<bool> used(usize(mesh.n_vertices()), false);
    for (const Index v : mesh.face_vertices)
        used[v] = true;
    const auto unused = std::find(used.begin(), used.end(), false);
    if (unused != used.end())
        throw OutputError(fmt::format("{}: cannot be written: vertex {} (numbered from 0) belongs to no face, and STL "
                                      "holds only vertices of faces; {}",
                                      path.string(), unused - used.begin(), write_polygons_instead()));
}

void write_text_facet(ByteWriter& file, const StlFacet& triangle)
{
    file.line("facet normal", Eigen::RowVector3f(normal_of_facet(triangle).cast<float>()));
    file.text("outer loop\n");
    for (const auto& point : triangle)
        file.line("vertex", point);
    file.text("endloop\nendfacet\n");
}

void write_binary_facet(ByteWriter& file, const StlFacet& triangle)
{
    for (const Point& point : {normal_of_facet(triangle), triangle[0], triangle[1], triangle[2]})
        for (const double x : {point[0], point[1], point[2]})
            file.binary(static_cast<float>(x), std::endian::little);
    file.binary(std::uint16_t{0}, std::endian::little);
}

}  // namespace

bool is_line(const StlFacet& facet)
{
    return facet[0] == facet[1] || facet[1] == facet[2] || facet[2] == facet[0];
}

StlFacet rounded(const StlFacet& facet)
{
    StlFacet floats;
    std::transform(facet.begin(), facet.end(), floats.begin(),
                   [](const Point& corner) { return Point(corner.cast<float>().cast<double>()); });
    return floats;
}

StlFacet facet_of(const PolygonMesh& mesh, Index f)
{
    const auto corners = mesh.face(f);
    return {mesh.vertices.row(corners[0]), mesh.vertices.row(corners[1]), mesh.vertices.row(corners[2])};
}

/// The coordinates are scaled first, so that products of large or small ones do not overflow or vanish.
Point normal_of_facet(const StlFacet& triangle)
{
    const double scale = std::max({triangle[0].cwiseAbs().maxCoeff(), triangle[1].cwiseAbs().maxCoeff(),
                                   triangle[2].cwiseAbs().maxCoeff(), std::numeric_limits<double>::min()});
    const Eigen::Vector3d origin = triangle[0].transpose() / scale;
    const Eigen::Vector3d u = triangle[1].transpose() / scale - origin;
    const Eigen::Vector3d v = triangle[2].transpose() / scale - origin;
    const Eigen::Vector3d normal = u.stableNormalized().cross(v.stableNormalized()).stableNormalized();
    return normal.transpose().cast<float>().cast<double>();
}

std::vector<std::string> require_fits_stl(const std::filesystem::path& path, const PolygonMesh& mesh, Encoding encoding)
{
    require_triangles(path, mesh, "STL");
    require_no_isolated_vertex(path, mesh);
    if (encoding != Encoding::Ascii)
        require_floats(path, mesh.vertices, run_serially, "binary STL");
    std::int64_t n_lines = 0;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        n_lines += is_line(encoding == Encoding::Ascii ? facet_of(mesh, f) : rounded(facet_of(mesh, f))) ? 1 : 0;
    return remarks_on_lines(path, n_lines);
}

void write_stl(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, const Slicing& slicing)
{
    const bool is_text = encoding == Encoding::Ascii;
    if (is_text) {
        file.text("solid mesh\n");
    } else {
        std::string title = "binary STL";
        title.resize(80, ' ');
        file.text(title);
        file.binary(static_cast<std::uint32_t>(mesh.n_faces()), std::endian::little);
    }
    constexpr std::size_t bytes_per_facet = 128;
    write_elements(file, mesh.n_faces(), elements_per_slice(slicing, bytes_per_facet), slicing.exec,
                   [&](ByteWriter& slice, Index f) {
                       const StlFacet facet = facet_of(mesh, f);
                       is_text ? write_text_facet(slice, facet) : write_binary_facet(slice, facet);
                   });
    if (is_text)
        file.text("endsolid mesh\n");
}

}  // namespace seamflow
