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

namespace seamflow {

namespace {

[[noreturn]] void refuse_mesh(const std::filesystem::path& path, const std::string& reason)
{
    throw OutputError(fmt::format("{}: cannot be written: {}; write {}, which can hold this mesh", path.string(),
                                  reason, extensions_of(FormatGroup::Polygons)));
}

void require_triangles(const std::filesystem::path& path, const PolygonMesh& mesh)
{
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (mesh.face(f).size() != 3)
            refuse_mesh(path, fmt::format("face {} (numbered from 0) has {} sides, but STL holds triangles only", f,
                                          mesh.face(f).size()));
}

void require_no_isolated_vertex(const std::filesystem::path& path, const PolygonMesh& mesh)
{
    std::vector<bool> used(at(mesh.n_vertices()), false);
    for (const Index v : mesh.face_vertices)
        used[v] = true;
    const auto unused = std::find(used.begin(), used.end(), false);
    if (unused != used.end())
        refuse_mesh(path,
                    fmt::format("vertex {} (numbered from 0) belongs to no face, and STL holds only vertices of faces",
                                unused - used.begin()));
}

template <class Scalar>
void require_distinct_as(const std::filesystem::path& path, Index f, std::span<const Index> corners,
                         const StlFacet& facet)
{
    for (std::size_t k = 0; k < 3; ++k)
        if (facet[k].cast<Scalar>() == facet[(k + 1) % 3].cast<Scalar>())
            refuse_mesh(path,
                        fmt::format("the vertices {} and {} of face {} (all numbered from 0) are one and the "
                                    "same point{}",
                                    corners[k], corners[(k + 1) % 3], f,
                                    std::is_same_v<Scalar, float> ? " in the single precision of binary STL" : ""));
}

StlFacet facet_of(const PolygonMesh& mesh, Index f)
{
    const auto corners = mesh.face(f);
    return {mesh.vertices.row(corners[0]), mesh.vertices.row(corners[1]), mesh.vertices.row(corners[2])};
}

/// Of unit length; zero for a triangle without area. Scaled beforehand, lest products of large or small coordinates
/// overflow or vanish.
Eigen::Vector3f normal_of(const StlFacet& triangle)
{
    const double scale = std::max({triangle[0].cwiseAbs().maxCoeff(), triangle[1].cwiseAbs().maxCoeff(),
                                   triangle[2].cwiseAbs().maxCoeff(), std::numeric_limits<double>::min()});
    const Eigen::Vector3d origin = triangle[0].transpose() / scale;
    const Eigen::Vector3d u = triangle[1].transpose() / scale - origin;
    const Eigen::Vector3d v = triangle[2].transpose() / scale - origin;
    return u.stableNormalized().cross(v.stableNormalized()).stableNormalized().cast<float>();
}

void write_text_facet(ByteWriter& file, const StlFacet& triangle)
{
    file.line("facet normal", normal_of(triangle));
    file.text("outer loop\n");
    for (const auto& point : triangle)
        file.line("vertex", point);
    file.text("endloop\nendfacet\n");
}

void write_binary_facet(ByteWriter& file, const StlFacet& triangle)
{
    const Eigen::Vector3f normal = normal_of(triangle);
    for (const float x : {normal[0], normal[1], normal[2]})
        file.binary(x, std::endian::little);
    for (const auto& point : triangle)
        for (const double x : {point[0], point[1], point[2]})
            file.binary(static_cast<float>(x), std::endian::little);
    file.binary(std::uint16_t{0}, std::endian::little);
}

}  // namespace

void write_stl_begin(ByteWriter& file, Index n_faces, Encoding encoding)
{
    if (encoding == Encoding::Ascii)
        return file.text("solid mesh\n");
    std::string title = "binary STL";
    title.resize(80, ' ');
    file.text(title);
    file.binary(static_cast<std::uint32_t>(n_faces), std::endian::little);
}

void write_stl_facet(ByteWriter& file, const StlFacet& facet, Encoding encoding)
{
    encoding == Encoding::Ascii ? write_text_facet(file, facet) : write_binary_facet(file, facet);
}

void write_stl_end(ByteWriter& file, Encoding encoding)
{
    if (encoding == Encoding::Ascii)
        file.text("endsolid mesh\n");
}

void require_floats(const std::filesystem::path& path, const Points& vertices, Index first)
{
    for (Index v = 0; v < vertices.rows(); ++v)
        if (vertices.row(v).cwiseAbs().maxCoeff() > double{std::numeric_limits<float>::max()})
            refuse_mesh(path,
                        fmt::format("vertex {} (numbered from 0) has a coordinate too large for the single precision "
                                    "of binary STL",
                                    first + v));
}

void require_distinct_corners(const std::filesystem::path& path, Index f, std::span<const Index> corners,
                              const StlFacet& facet, Encoding encoding)
{
    encoding == Encoding::Ascii ? require_distinct_as<double>(path, f, corners, facet)
                                : require_distinct_as<float>(path, f, corners, facet);
}

void require_fits_stl(const std::filesystem::path& path, const PolygonMesh& mesh, Encoding encoding)
{
    require_triangles(path, mesh);
    require_no_isolated_vertex(path, mesh);
    if (encoding != Encoding::Ascii)
        require_floats(path, mesh.vertices);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        require_distinct_corners(path, f, mesh.face(f), facet_of(mesh, f), encoding);
}

void write_stl(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, const Slicing& slicing)
{
    write_stl_begin(file, mesh.n_faces(), encoding);
    constexpr std::size_t bytes_per_facet = 128;
    write_elements(file, mesh.n_faces(), elements_per_slice(slicing, bytes_per_facet), slicing.loop,
                   [&](ByteWriter& slice, Index f) { write_stl_facet(slice, facet_of(mesh, f), encoding); });
    write_stl_end(file, encoding);
}

}  // namespace seamflow
