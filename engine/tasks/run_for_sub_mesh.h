#pragma once

#include <new>
#include <string>

#include "partition/errors.h"
#include "solvers/platform/library_threads.h"

namespace seamflow {

/// Runs `body` for sub-mesh s, in one thread; failures name it.
/// @param sub_mesh a SubMesh, or anything with `faces` and `n_vertices`.
template <class SubMeshLike, class Body>
void run_for_sub_mesh(const SubMeshLike& sub_mesh, Index s, Body&& body)
{
    const auto name = [&] {
        return "sub-mesh " + std::to_string(s) + " (" + std::to_string(sub_mesh.n_vertices) +
               " vertices, among its faces number " + std::to_string(sub_mesh.faces.front()) + "): ";
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
