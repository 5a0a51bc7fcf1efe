#include "engine/state/flow_identity.h"

#include "engine/options/option_table.h"
#include "engine/state/mesh_checksum.h"
#include "engine/state/option_fields.h"

namespace seamflow {

std::uint64_t identify(const PolygonMesh& mesh, const FlowOptions& options)
{
    std::uint64_t identity = checksum_of(checksum_of_mesh(mesh), filter_of(options).order);
    for_each_option(options, [&](const auto& row) {
        // An empty order stands for the default of the filter: the identity begins with the order that applies.
        if ((row.concerns & concern::no_result) == 0 && row.field != "order")
            identity = checksum_of(identity, *row.value);
    });
    return identity;
}

}  // namespace seamflow
