#include "engine/fields/white_noise.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "partition/mixed_bits.h"

namespace seamflow {

namespace {

/// A pseudo-random number between -√3 and √3, uniformly distributed, of variance 1: a hash of `number`.
double uniform(std::uint64_t number)
{
    const double in_unit = static_cast<double>(mixed((number + 1) * 0x9e3779b97f4a7c15U) >> 11U) * 0x1p-53;
    return std::numbers::sqrt3 * (2.0 * in_unit - 1.0);
}

/// The count, the sum and the sum of squares of some numbers.
struct NoiseSums {
    double n = 0.0;
    double value = 0.0;
    double squared = 0.0;

    void add(double x)
    {
        n += 1.0;
        value += x;
        squared += x * x;
    }

    [[nodiscard]] double mean() const { return value / n; }
    [[nodiscard]] double variance() const { return squared / n - mean() * mean(); }
};

}  // namespace

Eigen::MatrixXd white_noise(Index n_vertices, Eigen::Index n_columns)
{
    Eigen::MatrixXd noise(n_vertices, n_columns);
    for (Eigen::Index c = 0; c < noise.cols(); ++c)
        for (Eigen::Index v = 0; v < noise.rows(); ++v)
            noise(v, c) = uniform(static_cast<std::uint64_t>(n_columns * v + c));
    return noise;
}

std::optional<double> fwhm_of_noise(const PolygonMesh& mesh, const Eigen::MatrixXd& noise)
{
    std::vector<std::uint8_t> has_face(usize(mesh.n_vertices()), 0);
    for (const Index v : mesh.face_vertices)
        has_face[v] = 1;
    double sum = 0.0;
    for (Eigen::Index c = 0; c < noise.cols(); ++c) {
        NoiseSums values;
        NoiseSums differences;
        NoiseSums lengths;
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if (has_face[v] != 0)
                values.add(noise(v, c));
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            Index v = mesh.face(f).back();
            for (const Index w : mesh.face(f)) {
                differences.add(noise(w, c) - noise(v, c));
                lengths.add((mesh.vertices.row(w) - mesh.vertices.row(v)).norm());
                v = w;
            }
        }
        // Forman and others: FWHM = l √(-2 ln 2 / ln ρ), with the length l of edges and the correlation ρ along them.
        // Where lengths differ it is their root mean square, because differences grow with the length.
        const double correlation = 1.0 - differences.squared / differences.n / (2.0 * values.variance());
        if (!(correlation > 0.0 && correlation < 1.0))
            return std::nullopt;
        sum += std::sqrt(lengths.squared / lengths.n) * std::sqrt(-2.0 * std::numbers::ln2 / std::log(correlation));
    }
    return sum / static_cast<double>(noise.cols());
}

}  // namespace seamflow
