#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "solvers/denoising/correlated_noise.h"
#include "solvers/denoising/vertex_averages.h"
#include "tests/support/denoising.h"

using namespace seamflow;

TEST_CASE("noise that is correlated over an edge or two is measured, and local fits take it, with any threads")
{
    const PolygonMesh truth = make_noisy_sphere(6000, {.amplitude = 0.1, .noise = 0.0});
    const Topology topology = make_topology(truth);
    const VertexAverages averages(truth, topology);
    const double edge = mean_edge_length(truth);
    for (const int rounds : {4}) {
        CAPTURE(rounds);
        std::mt19937 random(7);
        std::normal_distribution<double> normal;
        std::vector<double> noise(usize(truth.n_vertices()));
        for (double& one : noise)
            one = normal(random);
        for (int round = 0; round < rounds; ++round) {
            const std::vector<double> last = noise;
            for (Index v = 0; v < truth.n_vertices(); ++v) {
                double total = 0.0;
                for (const Index w : averages.neighbours()[v])
                    total += last[w];
                noise[v] = 0.5 * (last[v] + total / static_cast<double>(averages.neighbours()[v].size()));
            }
        }
        double squares = 0.0;
        for (const double one : noise)
            squares += one * one;
        constexpr double deviation = 0.2;
        PolygonMesh noisy = truth;
        for (Index v = 0; v < truth.n_vertices(); ++v)
            noisy.vertices.row(v) += deviation * edge * std::sqrt(truth.n_vertices() / squares) * noise[v] *
                                     truth.vertices.row(v).normalized();
        const CorrelatedNoise found(noisy, topology, averages, {}, noisy.vertices, run_in_parallel);
        CHECK(found.deviation() > 0.7 * deviation);
        CHECK(found.deviation() < 1.1 * deviation);
        CHECK(found.least_risk() < 0.8);
        PolygonMesh result = noisy;
        result.vertices = found.without(run_in_parallel);
        CHECK(test::angle_to_truth(truth, result) < 0.4 * test::angle_to_truth(truth, noisy));
        CHECK(CorrelatedNoise(noisy, topology, averages, {}, noisy.vertices).without() == result.vertices);
    }
}
