#include "engine/denoise/denoise_identity.h"

#include <variant>

#include "engine/options/motion_option_table.h"
#include "engine/state/mesh_checksum.h"
#include "engine/state/option_fields.h"

namespace seamflow {

namespace {

/// The checksum of the numbers of a method, appended to a checksum `before`.
struct ChecksumOfMethod {
    std::uint64_t before;

    std::uint64_t operator()(const RemoveNoise& method) const
    {
        const Rounding& rounding = method.rounding;
        return checksum_of(before, method.edge_angle, static_cast<int>(rounding.kind), rounding.steps.x(),
                           rounding.steps.y(), rounding.steps.z());
    }
    std::uint64_t operator()(const SmoothBetweenEdges& method) const
    {
        return checksum_of(before, method.edge_angle, method.amount.time_step);
    }
    std::uint64_t operator()(const SmoothRims& method) const { return checksum_of(before, method.amount.time_step); }
};

}  // namespace

std::uint64_t identify(const PolygonMesh& mesh, const DenoiseOptions& options)
{
    const std::uint64_t of_mesh = checksum_of(checksum_of_mesh(mesh), static_cast<int>(options.method.index()));
    std::uint64_t identity = std::visit(ChecksumOfMethod{of_mesh}, options.method);
    for_each_row(motion_table(options.motion), [&](const auto& row) {
        if ((row.concerns & concern::no_result) == 0)
            identity = checksum_of(identity, *row.value);
    });
    return identity;
}

}  // namespace seamflow
