#include "partition/io/mesh_builder.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace seamflow {

namespace {

constexpr std::size_t most = std::numeric_limits<Index>::max();

}  // namespace

MeshBuilder::MeshBuilder(const InputPosition& position, Index first_number)
    : position_(position)
    , first_number_(first_number)
{
}

void MeshBuilder::reserve(std::uint64_t n_vertices, std::uint64_t n_faces)
{
    coordinates_.reserve(3 * n_vertices);
    mesh_.face_offsets.reserve(n_faces + 1);
    mesh_.face_vertices.reserve(3 * n_faces);
}

void MeshBuilder::add_vertex(double x, double y, double z)
{
    if (coordinates_.size() >= 3 * most)
        position_.fail("more than " + std::to_string(most) + " vertices; divide the mesh into several files");
    coordinates_.insert(coordinates_.end(), {x, y, z});
}

Index MeshBuilder::vertex(std::int64_t index, std::int64_t n) const
{
    if (index < 0 || index >= n)
        position_.fail("names vertex " + std::to_string(index + first_number_) + ", but the file has " +
                       (n == 0 ? std::string("no vertices")
                               : "only the vertices " + std::to_string(first_number_) + " to " +
                                     std::to_string(n - 1 + first_number_)) +
                       "; correct the face or export the mesh again");
    return static_cast<Index>(index);
}

void MeshBuilder::require_distinct(std::span<const Index> corners)
{
    sorted_.assign(corners.begin(), corners.end());
    std::sort(sorted_.begin(), sorted_.end());
    const auto twice = std::adjacent_find(sorted_.begin(), sorted_.end());
    if (twice != sorted_.end())
        position_.fail("the face names vertex " + std::to_string(std::int64_t{*twice} + first_number_) +
                       " twice; remove the face, or split it at that vertex");
}

void MeshBuilder::add_face(std::span<const Index> corners)
{
    if (corners.size() < 3)
        position_.fail("the face has " + counted(corners.size(), "corner", "corners") +
                       ", but needs at least 3; remove it or add what is missing");
    if (corners.size() > most - mesh_.face_vertices.size())
        position_.fail("the faces have more than " + std::to_string(most) +
                       " corners together; divide the mesh into several files");
    const bool triangle = corners.size() == 3;
    if (!triangle || corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        require_distinct(corners);
    mesh_.add_face(corners);
}

PolygonMesh MeshBuilder::finish()
{
    if (coordinates_.empty())
        position_.fail("the file has no vertices; export the mesh again");
    mesh_.vertices = Eigen::Map<const Points>(coordinates_.data(), n_vertices(), 3);
    coordinates_ = {};
    return std::exchange(mesh_, {});
}

}  // namespace seamflow
