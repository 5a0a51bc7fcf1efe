#include "engine/state/flow_identity.h"

#include <tuple>

#include "engine/measure/origin_offset.h"
#include "engine/options/option_table.h"
#include "engine/state/archive.h"

namespace seamflow {

auto fields(Is<LengthOnMesh> auto& of)
{
    auto& [value, of_diagonal] = of;
    return std::tie(value, of_diagonal);
}

auto fields(Is<MotionDirection> auto& of)
{
    auto& [kind, vector] = of;
    return std::tie(kind, vector[0], vector[1], vector[2]);
}

std::uint64_t identify(const PolygonMesh& mesh, const FlowOptions& options)
{
    // The positions near the origin, as they flow.
    const Point offset = origin_offset(mesh);
    const Points moved = offset.isZero(0.0) ? Points(0, 3) : Points(mesh.vertices.rowwise() - offset);
    std::uint64_t identity = checksum_of(offset.isZero(0.0) ? mesh.vertices : moved, mesh.face_offsets,
                                         mesh.face_vertices, filter_of(options).order);
    for_each_option(options, [&](const auto& row) {
        // An order of 0 stands for the default of the filter.
        if ((row.concerns & concern::no_result) == 0 && row.field != "order")
            identity = checksum_of(identity, *row.value);
    });
    return identity;
}

}  // namespace seamflow
