#include "partition/io/mesh_builder.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "partition/text.h"

namespace seamflow {

bool are_corners_of_face(std::span<const Index> corners, std::vector<Index>& sorted)
{
    if (corners.size() < 3)
        return false;
    if (corners.size() == 3 && corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
        return true;
    sorted.assign(corners.begin(), corners.end());
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

void find_distinct_corners(std::span<const Index> corners, std::vector<Index>& positions)
{
    positions.clear();
    for (std::size_t k = 0; k < corners.size(); ++k)
        if (k == 0 || corners[k] != corners[k - 1])
            positions.push_back(static_cast<Index>(k));
    while (positions.size() > 1 && corners[usize(positions.back())] == corners.front())
        positions.pop_back();
}

void require_vertices(const InputPosition& position, std::int64_t n)
{
    if (n == 0)
        position.fail("the file has no vertices; export the mesh again");
}

MeshBuilder::MeshBuilder(const InputPosition& position, Index first_number, const MeshSlice& slice)
    : position_(position)
    , first_number_(first_number)
    , n_vertices_(slice.first_vertex)
    , vertices_(slice.vertices)
    , mesh_(slice.faces)
{
}

Index MeshBuilder::refuse_vertex(std::int64_t index, std::int64_t n) const
{
    const std::string there =
        n == 0 ? "no vertices" : fmt::format("only the vertices {} to {}", first_number_, n - 1 + first_number_);
    position_.fault(fmt::format("names vertex {}, but the file has {}; correct the face or export the mesh again",
                                index + first_number_, there));
    return -1;
}

void MeshBuilder::refuse_face(std::span<const Index> corners)
{
    if (corners.size() < 3) {
        position_.harmless_fault(fmt::format("the face has {}, but needs at least 3; remove it or add what is missing",
                                             counted(corners.size(), "corner", "corners")));
    } else {
        sorted_.assign(corners.begin(), corners.end());
        std::ranges::sort(sorted_);
        position_.harmless_fault(
            fmt::format("the face names vertex {} twice; remove the face, or split it at that vertex",
                        std::int64_t{*std::ranges::adjacent_find(sorted_)} + first_number_));
    }
}

void MeshBuilder::add_face(std::span<const Index> corners)
{
    const Index number = n_faces_++;
    // The fault of a corner without a vertex has been collected already, by refuse_vertex.
    if (position_.notes_faults() && std::find(corners.begin(), corners.end(), -1) != corners.end())
        return;
    if (!are_corners_of_face(corners, sorted_)) {
        find_distinct_corners(corners, distinct_);
        for (Index& corner : distinct_)
            corner = corners[usize(corner)];
        if (!are_corners_of_face(distinct_, sorted_)) {
            refuse_face(corners);
            position_.leave_out_face(number);
            return;
        }
        corners = distinct_;
    }
    constexpr std::size_t most = std::numeric_limits<Index>::max();
    if (corners.size() > most - mesh_.face_vertices.size())
        position_.fail("the faces have more than {} corners in total; divide the mesh into several files", most);
    mesh_.add_face(corners);
}

}  // namespace seamflow
