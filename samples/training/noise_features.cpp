// Prints the numbers by which noise is told from shape (see solvers/denoising/noise_evidence.h), for places spread over
// a mesh: a line each.
//
//     noise_features MESH PLACES [THINNINGS]
//
// With THINNINGS the mesh is thinned out first, so many times (see solvers/denoising/thinned_mesh.h).

#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/tasks/workers.h"
#include "partition/formats/mesh_io.h"
#include "partition/topology.h"
#include "solvers/denoising/mesh_denoiser.h"
#include "solvers/denoising/noise_evidence.h"
#include "solvers/denoising/thinned_mesh.h"
#include "solvers/denoising/vertex_averages.h"

namespace {

using namespace seamflow;

void print_features(const PolygonMesh& mesh, const Topology& topology, Index most, int thinnings, const Executor& exec)
{
    if (thinnings > 0) {
        const VertexAverages averages(mesh, topology, exec);
        const std::vector<int> n_chosen(usize(mesh.n_vertices()), 0);
        const ThinnedMesh thinned = thin_out(mesh, topology, averages.neighbours(), mesh.vertices, n_chosen, 0);
        return print_features(thinned.mesh, thinned.topology, most, thinnings - 1, exec);
    }
    for (const PlaceStatistics& place : MeshDenoiser(mesh, topology, exec).measure_places(most, exec))
        std::cout << fmt::format("{:.4g}\n", fmt::join(features_of(place), ","));
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        if (argc < 3 || argc > 4) {
            std::cerr << "usage: noise_features MESH PLACES [THINNINGS]\n";
            return 2;
        }
        Workers workers(0);
        const Executor exec = workers.exec();
        const PolygonMesh mesh = read_mesh(argv[1], exec).mesh;
        Topology topology = make_topology(mesh, exec);
        free_boundary(topology);
        workers.execute(
            [&] { print_features(mesh, topology, std::stoi(argv[2]), argc > 3 ? std::stoi(argv[3]) : 0, exec); });
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "noise_features: " << error.what() << '\n';
        return 1;
    }
}
