#include "samples/report/error_map.h"

#include <cstdint>
#include <limits>
#include <vector>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "partition/metrics/displacement.h"
#include "partition/metrics/surface_distance.h"
#include "samples/report/comparison.h"

namespace seamflow {

namespace {

using Values = std::vector<double>;

Values vertex_distances(const PolygonMesh& reference, const PolygonMesh& candidate)
{
    Values distances;
    for (Eigen::Index v = 0; v < candidate.vertices.rows(); ++v)
        distances.push_back((candidate.vertices.row(v) - reference.vertices.row(v)).norm());
    return distances;
}

/// The values to show come first.
std::vector<VertexValues> measure(const PolygonMesh& reference, const PolygonMesh& candidate, Shown shown)
{
    if (shown == Shown::SurfaceDistance) {
        VertexValues distance{"distance", SurfaceDistance(reference)(candidate.vertices)};
        const std::vector<std::uint8_t> is_used = used_by_faces(candidate);
        for (std::size_t v = 0; v < is_used.size(); ++v)
            if (is_used[v] == 0)
                distance.values[v] = std::numeric_limits<double>::quiet_NaN();
        return {distance};
    }
    const VertexValues distance{"distance", vertex_distances(reference, candidate)};
    if (shown == Shown::VertexDistance)
        return {distance};
    const DisplacementField field = displacement_field(reference, reference.vertices, candidate.vertices);
    const VertexValues tangential{"tangential", field.tangential};
    const VertexValues normal{"normal", field.normal};
    return shown == Shown::Normal ? std::vector{normal, tangential, distance}
                                  : std::vector{tangential, normal, distance};
}

std::vector<Colour> colours_of(const Values& values, double last, bool with_sign)
{
    std::vector<Colour> colours;
    for (const double value : values) {
        const double relative = last > 0.0 ? value / last : 0.0 * value;
        colours.push_back(with_sign ? signed_colour(relative) : rainbow_colour(relative));
    }
    return colours;
}

}  // namespace

ErrorRange write_error_map(const std::filesystem::path& path, const PolygonMesh& reference,
                           const PolygonMesh& candidate, Shown shown, std::optional<double> last)
{
    const std::string mismatch = why_not_corresponding(reference, candidate);
    if (shown != Shown::SurfaceDistance && !mismatch.empty())
        throw InputError("the error map cannot show this, because the vertices do not correspond: " + mismatch);
    const std::vector<VertexValues> values = measure(reference, candidate, shown);
    const bool with_sign = shown == Shown::Normal;
    const double end = last ? *last : length_statistics(values[0].values).max;
    write_valued_ply(path, candidate, colours_of(values[0].values, end, with_sign), values);
    return {.first = with_sign ? -end : 0.0, .last = end};
}

}  // namespace seamflow
