#pragma once

#include <vector>

#include <Eigen/Core>

#include "engine/distributed/parts/mesh_part.h"
#include "engine/distributed/ranks/communicator.h"
#include "engine/distributed/ranks/transport.h"
#include "engine/fields/diffuse.h"
#include "engine/fields/field_columns.h"
#include "engine/fields/field_options.h"
#include "engine/options/flow_options.h"

namespace seamflow {

/// Groups columns by the vertices of all ranks at which they have data. All ranks call this together.
/// @param fields rows of some vertices of this rank. @returns `lacks` and `n_lacking` of these.
/// @throws InputError if ranks have different numbers of columns.
std::vector<FieldGroup> groups_of_all(Communicator& comm, const Eigen::MatrixXd& fields);

/// Lets fields on a surface that no rank has as a whole diffuse, as diffuse does: each rank gives some of the
/// sub-meshes with all their faces, and the fields of their vertices. All ranks call this together, with the same
/// options. The result is the same, bit for bit, for any number of ranks, and of threads of each; where all vertices
/// have data, also that of diffuse with these labels and Approach::Converged.
///
/// Not supported: FieldOptions::fill and keep_edges, and what distributed_mean_curvature_flow leaves out; steps are
/// always converged. FlowOptions::radius is not known to ranks: give the time step, or FieldOptions::fwhm. Labels and
/// fixed vertices are those of the part.
/// @param part the surface, which stays.
/// @param fields #V of the part by n, n the same on all ranks: see diffuse. A vertex that several ranks have has the
///        same numbers on all of them. They change when the flow has succeeded on all ranks.
/// @returns without `fwhm`, and without numbers of vertices without data. Seconds are those that this rank sees.
/// @throws on all ranks the same: OptionError; InputError for a part or fields that cannot be used; ComputationError
///         naming step and sub-mesh.
FieldReport diffuse_on_ranks(Transport& transport, const MeshPart& part, Eigen::MatrixXd& fields,
                             const FlowOptions& options, const FieldOptions& field_options = {});

}  // namespace seamflow
