#pragma once

#include <Eigen/Core>

#include "engine/ranks/rank_group.h"
#include "partition/executor.h"
#include "partition/formats/file_fields.h"
#include "partition/formats/mesh_io.h"
#include "partition/polygon_mesh.h"
#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"
#include "samples/report/run_record.h"

namespace seamflow {

/// Completes the amount and the lengths of `command` for fields on a mesh.
/// @param run receives the size of the mesh.
/// @throws InputError as resolve_amount.
void resolve_field_amount(SmoothCommand& command, const PolygonMesh& mesh, const Executor& exec, RunRecord& run);

/// Columns nx, ny and nz are normals: as long as they were, unless nothing is left of them.
/// @param before #V by n: the fields before.
void renormalise(FileFields& fields, const Eigen::MatrixXd& before);

/// Checks that OUTPUT has a place for fields, so that nothing is computed in vain.
/// @param file INPUT.
/// @throws OutputError
void require_place(const SmoothCommand& command, const MeshFile& file);

/// Runs `smooth` for fields on the surface of INPUT: reads them, lets them diffuse or measures distances, writes OUTPUT
/// with them, and prints what was done.
/// @param run holds the command line. @param ranks that share the steps, or nullptr.
/// @throws as the functions of files, and as diffuse and geodesic_distance.
ExitStatus run_fields(SmoothCommand& command, RunRecord& run, RankGroup* ranks = nullptr);

}  // namespace seamflow
