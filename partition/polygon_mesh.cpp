#include "partition/polygon_mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <string>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/large_arrays.h"

namespace seamflow {

namespace {

void require_valid_offsets(const PolygonMesh& mesh)
{
    const auto& offsets = mesh.face_offsets;
    if (offsets.empty() || offsets.front() != 0 || offsets.back() != mesh.n_corners() ||
        !std::is_sorted(offsets.begin(), offsets.end()))
        throw InputError(
            fmt::format("face_offsets must begin with 0, not decrease, and end with the number of face_vertices ({})",
                        mesh.n_corners()));
}

/// Whether no vertex occurs twice in a face.
bool are_different(std::span<const Index> corners)
{
    // For more corners than this, sorting is faster than comparing all pairs.
    constexpr std::size_t many = 16;
    if (corners.size() > many) {
        std::vector<Index> sorted(corners.begin(), corners.end());
        std::sort(sorted.begin(), sorted.end());
        return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
    }
    for (std::size_t k = 1; k < corners.size(); ++k)
        if (std::find(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(k), corners[k]) !=
            corners.begin() + static_cast<std::ptrdiff_t>(k))
            return false;
    return true;
}

bool is_valid_face(const PolygonMesh& mesh, Index f)
{
    const auto corners = mesh.face(f);
    return corners.size() >= 3 &&
           std::all_of(corners.begin(), corners.end(), [&](Index v) { return v >= 0 && v < mesh.n_vertices(); }) &&
           are_different(corners);
}

/// Throws the InputError that says why face f is not valid.
[[noreturn]] void refuse_face(const PolygonMesh& mesh, Index f)
{
    const auto corners = mesh.face(f);
    const std::string face = fmt::format("face {} (numbered from 0)", f);
    if (corners.size() < 3)
        throw InputError(
            fmt::format("{} has {} corners: a face needs at least 3; remove the face", face, corners.size()));
    std::set<Index> met;
    for (const Index v : corners) {
        if (v < 0 || v >= mesh.n_vertices())
            throw InputError(
                fmt::format("{} names vertex {}, but the mesh has {} vertices", face, v, mesh.n_vertices()));
        if (!met.insert(v).second)
            throw InputError(fmt::format("{} names vertex {} twice: split the face there or remove it", face, v));
    }
    throw InputError(face + " is not valid");
}

}  // namespace

void require_valid(const PolygonMesh& mesh, const Executor& exec)
{
    require_valid_offsets(mesh);
    const auto bad_faces = select(exec, mesh.n_faces(), [&](Index f) { return !is_valid_face(mesh, f); });
    if (!bad_faces.empty())
        refuse_face(mesh, bad_faces.front());
    const auto bad_vertices =
        select(exec, mesh.n_vertices(), [&](Index v) { return !mesh.vertices.row(v).allFinite(); });
    if (!bad_vertices.empty())
        throw InputError(
            fmt::format("vertex {} (numbered from 0) has a coordinate that is not a finite number: mend or remove it",
                        bad_vertices.front()));
}

std::vector<std::uint8_t> used_by_faces(const PolygonMesh& mesh, const Executor& exec)
{
    std::vector<std::uint8_t> is_used(mesh.n_vertices(), 0);
    for_each(exec, mesh.n_corners(), [&](Index corner) {
        // Written only once, because threads would wait for each other's cache lines.
        const std::atomic_ref mark(is_used[mesh.face_vertices[corner]]);
        if (mark.load(std::memory_order_relaxed) == 0)
            mark.store(1, std::memory_order_relaxed);
    });
    return is_used;
}

Points uninitialised_points(Index n)
{
    Points points(0, 3);
    resize_large(points, n, 3);
    return points;
}

void copy(const Executor& exec, const Points& from, Points& to)
{
    resize_large(to, from.rows(), 3);
    for_each_block(exec, static_cast<Index>(from.rows()), [&](Index, Index begin, Index end) {
        to.middleRows(begin, end - begin) = from.middleRows(begin, end - begin);
    });
}

}  // namespace seamflow
