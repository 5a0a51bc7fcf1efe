#include "samples/page/shown_steps.h"

#include <algorithm>
#include <cmath>

#include "partition/errors.h"

namespace seamflow {

namespace {

/// Approximate bytes of a vertex of one state in the file: its position, curvature and distance.
constexpr double bytes_of_state = 8.0;
constexpr double bytes_of_undecomposed_state = 6.0;
constexpr double most_bytes = 80e6;
constexpr int most_steps = 200;
/// Four times the largest page shown in a browser so far.
constexpr Index most_faces = 5'000'000;

}  // namespace

void require_showable(const PolygonMesh& mesh, const std::filesystem::path& path)
{
    if (mesh.n_faces() > most_faces)
        throw OutputError(path.string() + ": cannot be written: a browser shows at most " + std::to_string(most_faces) +
                          " faces, and the mesh has " + std::to_string(mesh.n_faces()));
}

std::vector<int> shown_steps(int steps, Index n_vertices, bool undecomposed)
{
    const double per_step =
        std::max(n_vertices, 1) * (bytes_of_state + (undecomposed ? bytes_of_undecomposed_state : 0));
    const int room = static_cast<int>(std::clamp(most_bytes / per_step, 1.0, static_cast<double>(most_steps)));
    const int n = std::min(steps, room);
    std::vector<int> shown;
    for (int k = 1; k <= n; ++k)
        shown.push_back(static_cast<int>(std::lround(static_cast<double>(steps) * k / n)));
    return shown;
}

std::string remark_on_shown_steps(int steps, int shown)
{
    if (shown == steps)
        return {};
    return "The page shows " + std::to_string(shown) + " of the " + std::to_string(steps) +
           " steps' surfaces: as many of this run's as a browser can take; its plots have all steps.";
}

}  // namespace seamflow
