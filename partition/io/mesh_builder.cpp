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
    if (index < 0 || index >= n) {
        position_.fault("names vertex " + std::to_string(index + first_number_) + ", but the file has " +
                        (n == 0 ? std::string("no vertices")
                                : "only the vertices " + std::to_string(first_number_) + " to " +
                                      std::to_string(n - 1 + first_number_)) +
                        "; correct the face or export the mesh again");
        return -1;
    }
    return static_cast<Index>(index);
}

bool MeshBuilder::are_distinct(std::span<const Index> corners)
{
    sorted_.assign(corners.begin(), corners.end());
    std::sort(sorted_.begin(), sorted_.end());
    const auto twice = std::adjacent_find(sorted_.begin(), sorted_.end());
    if (twice == sorted_.end())
        return true;
    position_.fault("the face names vertex " + std::to_string(std::int64_t{*twice} + first_number_) +
                    " twice; remove the face, or split it at that vertex");
    return false;
}

void MeshBuilder::add_face(std::span<const Index> corners)
{
    if (corners.size() < 3) {
        position_.fault("the face has " + counted(corners.size(), "corner", "corners") +
                        ", but needs at least 3; remove it or add what is missing");
        return;
    }
    if (position_.notes_faults() && std::find(corners.begin(), corners.end(), -1) != corners.end())
        return;
    if (corners.size() > most - mesh_.face_vertices.size())
        position_.fail("the faces have more than " + std::to_string(most) +
                       " corners together; divide the mesh into several files");
    const bool triangle = corners.size() == 3;
    const bool suspicious =
        !triangle || corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
    if (!suspicious || are_distinct(corners))
        mesh_.add_face(corners);
}

/// Those that named vertices which never came.
void MeshBuilder::leave_out_faces_without_vertices()
{
    const PolygonMesh all = std::exchange(mesh_, {});
    for (Index f = 0; f < all.n_faces(); ++f) {
        const auto corners = all.face(f);
        if (std::all_of(corners.begin(), corners.end(), [&](Index v) { return v < n_vertices(); }))
            mesh_.add_face(corners);
    }
}

PolygonMesh MeshBuilder::finish()
{
    if (coordinates_.empty())
        position_.fail("the file has no vertices; export the mesh again");
    if (position_.notes_faults())
        leave_out_faces_without_vertices();
    mesh_.vertices = Eigen::Map<const Points>(coordinates_.data(), n_vertices(), 3);
    coordinates_ = {};
    return std::exchange(mesh_, {});
}

}  // namespace seamflow
