#pragma once

#include <new>
#include <string>
#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/errors.h"
#include "partition/index.h"
#include "solvers/platform/library_threads.h"

namespace seamflow {

/// The names of a sub-mesh in messages of failures: its numbers in the whole mesh.
struct SubMeshName {
    Index number = 0;
    Index n_vertices = 0;
    /// The number of one of its faces.
    Index face = 0;
};

/// The names of all sub-meshes of a mesh.
inline std::vector<SubMeshName> names_of(const Decomposition& decomposition)
{
    std::vector<SubMeshName> names;
    for (const SubMesh& sub_mesh : decomposition.sub_meshes)
        names.push_back({static_cast<Index>(names.size()), sub_mesh.n_vertices, sub_mesh.faces.front()});
    return names;
}

/// Runs `body` for a sub-mesh, in one thread; messages of failures name the sub-mesh.
/// @throws ComputationError with this name, for a ComputationError or a std::bad_alloc; other exceptions as they are.
template <class Body>
void run_for_sub_mesh(const SubMeshName& sub_mesh, Body&& body)
{
    const auto name = [&] {
        return "sub-mesh " + std::to_string(sub_mesh.number) + " (" + std::to_string(sub_mesh.n_vertices) +
               " vertices, among its faces number " + std::to_string(sub_mesh.face) + "): ";
    };
    const SingleThreadedOpenMp single_threaded;
    try {
        body();
    } catch (const ComputationError& error) {
        throw ComputationError(name() + error.what());
    } catch (const std::bad_alloc&) {
        throw ComputationError(name() + "out of memory: use more sub-meshes");
    }
}

}  // namespace seamflow
