#include "solvers/denoising/denoising_amount.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "partition/metrics/vertex_normals.h"
#include "partition/mixed_bits.h"
#include "solvers/denoising/chebyshev.h"
#include "solvers/denoising/filter_sample.h"

namespace seamflow {

namespace {

/// The number of terms of the Chebyshev basis, which is exact to 1e-4 for the largest amount; and the amounts that are
/// compared.
constexpr Index n_terms = 48;
constexpr double smallest_amount = 0.25;
constexpr double largest_amount = 12.0;
constexpr Index n_amounts = 52;
/// In the first round, the normals are those of the filter with this amount; in the second, those of the filter found
/// in the first.
constexpr double first_amount = 1.5;
constexpr int n_rounds = 2;
/// The true noise is assumed to be within these factors of the given value.
constexpr double least_noise = 0.9;
constexpr double most_noise = 1.15;
/// Two regrets that differ by less count as equal.
constexpr double same_regret = 0.02;
/// The factor on the amount of least regret: a little more is better for normals.
constexpr double for_normals = 1.2;
/// A filter is used only if its risk is below this fraction of σ², the risk of the unchanged mesh.
constexpr double clear_gain = 0.9;

/// The column of the random vector in the signals.
constexpr int probe_column = 3;

/// The value of the filter (1 + (t L)³)⁻¹ at an eigenvalue of L. @param amount t.
double filter_of_order_three(double amount, double eigenvalue)
{
    const double scaled = amount * eigenvalue;
    return 1.0 / (1.0 + scaled * scaled * scaled);
}

/// The amount at a position in the list of amounts, which are in geometric progression.
/// @param place from 0 to n_amounts - 1, need not be whole.
double amount_at(double place)
{
    return smallest_amount * std::pow(largest_amount / smallest_amount, place / (n_amounts - 1));
}

/// 1 or -1, pseudorandom, depending only on the number of a vertex.
double random_sign(Index v)
{
    return mixed((static_cast<std::uint64_t>(v) + 1) * 0x9e3779b97f4a7c15ULL) >> 63U == 0 ? 1.0 : -1.0;
}

/// The positions relative to their mean, and the random vector in the last column.
Signals signals_of(const PolygonMesh& mesh, const FilterSample& sample)
{
    Signals signals(static_cast<Eigen::Index>(sample.vertices.size()), Signals::ColsAtCompileTime);
    for (Index i = 0; i < signals.rows(); ++i) {
        signals.row(i).head<3>() = mesh.vertices.row(sample.vertices[i]);
        signals(i, probe_column) = random_sign(sample.vertices[i]);
    }
    const Eigen::RowVector3d centre = signals.leftCols<3>().colwise().mean();
    signals.leftCols<3>().rowwise() -= centre;
    return signals;
}

/// The risks of all amounts, from the basis along given normals.
class Risks {
  public:
    /// @param products n_terms by n_terms: the products of the changes Tⱼ X - (-1)ʲ X along the normals, averaged over
    /// the measured vertices. @param traces n_terms: tr(Tⱼ - (-1)ʲ) / #V. @param filters n_terms by n_amounts: the
    /// Chebyshev coefficients of the filters.
    Risks(const Eigen::MatrixXd& products, const Eigen::VectorXd& traces, const Eigen::MatrixXd& filters)
    {
        // Filters leave constants unchanged: H X - X = Σ cⱼ (Tⱼ X - (-1)ʲ X), and tr(H) = #V + Σ cⱼ tr(Tⱼ - (-1)ʲ).
        squared_moves_ = filters.cwiseProduct(products * filters).colwise().sum().cwiseMax(0.0);
        traces_ = (traces.transpose() * filters).array() + 1.0;
    }

    /// The mean squared displacement along the normals, in length².
    /// @param place a position in the list of amounts, which need not be whole.
    [[nodiscard]] double squared_move(double place) const { return interpolate(squared_moves_, place); }

    /// The risk at a position in the list of amounts, in length².
    [[nodiscard]] double risk(double place, double noise) const
    {
        return squared_move(place) + noise * noise * (2.0 * interpolate(traces_, place) - 1.0);
    }

    /// The position of least regret. The regret is the excess of the risk over the least risk at a noise, over the
    /// square of the noise, at the worse of two noises. The result is the mean of all positions, weighted more the less
    /// their regret.
    [[nodiscard]] double place_of_least_regret(double least, double most) const
    {
        const auto regrets = [&](double noise) -> Eigen::RowVectorXd {
            const Eigen::RowVectorXd risks = squared_moves_ / (noise * noise) + 2.0 * traces_;
            return risks.array() - risks.minCoeff();
        };
        const Eigen::RowVectorXd worst = regrets(least).cwiseMax(regrets(most));
        const Eigen::RowVectorXd weights = ((worst.minCoeff() - worst.array()) / same_regret).exp();
        return weights.dot(Eigen::RowVectorXd::LinSpaced(n_amounts, 0.0, n_amounts - 1.0)) / weights.sum();
    }

    /// The largest position up to the given one at which the root mean square displacement is at most the noise; 0, the
    /// smallest amount, if there is none. The displacement is taken to grow with the amount.
    /// @param place a position in the list of amounts, which need not be whole.
    [[nodiscard]] double last_place_within(double noise, double place) const
    {
        constexpr int n_halvings = 40;
        double allowed = 0.0;
        if (squared_move(place) <= noise * noise)
            return place;
        for (int i = 0; i < n_halvings; ++i) {
            const double middle = (allowed + place) / 2.0;
            (squared_move(middle) <= noise * noise ? allowed : place) = middle;
        }
        return allowed;
    }

  private:
    static double interpolate(const Eigen::RowVectorXd& values, double place)
    {
        const auto i = std::min(static_cast<Index>(place), n_amounts - 2);
        return values[i] + (place - i) * (values[i + 1] - values[i]);
    }

    Eigen::RowVectorXd squared_moves_;
    Eigen::RowVectorXd traces_;
};

/// A sample of a mesh, and the results of filtering it.
class FilteredSample {
  public:
    FilteredSample(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
        : normals_(mesh, topology)
        , sample_(take_filter_sample(mesh, topology, exec))
        , signals_(signals_of(mesh, sample_))
        , positions_(mesh.n_vertices(), 3)
        , filters_(n_terms, n_amounts)
        , exec_(exec)
    {
        for (Index k = 0; k < n_amounts; ++k)
            filters_.col(k) = coefficients(amount_at(k));
    }

    [[nodiscard]] bool empty() const { return sample_.measured.empty(); }

    /// The risks of all amounts along the normals of the mesh that is filtered with one amount.
    [[nodiscard]] Risks risks(double amount)
    {
        filter_positions(coefficients(amount));
        const auto n = static_cast<Index>(sample_.measured.size());
        std::vector<Point> normals(usize(n));
        for_each(exec_, n, [&](Index m) { normals[m] = normals_(sample_.vertices[sample_.measured[m]], positions_); });
        Eigen::MatrixXd along_normals(n, n_terms);
        Eigen::VectorXd traces(n_terms);
        visit_chebyshev_basis(
            sample_, signals_, n_terms,
            [&](Index j, const Signals& term) {
                for_each(exec_, n, [&](Index m) {
                    along_normals(m, j) = normals[m].dot(change(j, term, sample_.measured[m]).head<3>());
                });
                traces[j] = sum(exec_, n, [&](Index m) {
                    const Index place = sample_.measured[m];
                    return signals_(place, probe_column) * change(j, term, place)[probe_column];
                });
            },
            exec_);
        return {products(along_normals) / n, traces / n, filters_};
    }

  private:
    /// The Chebyshev coefficients of the filter with an amount.
    [[nodiscard]] Eigen::VectorXd coefficients(double amount) const
    {
        return expansion_.coefficients(
            [amount](double eigenvalue) { return filter_of_order_three(amount, eigenvalue); });
    }

    /// Tⱼ X - (-1)ʲ X at vertex i of the sample, which is 0 if X is constant: filters leave constants unchanged,
    /// whatever their size and however few terms the filters have.
    [[nodiscard]] Eigen::RowVector4d change(Index j, const Signals& term, Index i) const
    {
        return term.row(i) + (j % 2 == 0 ? -1.0 : 1.0) * signals_.row(i);
    }

    /// Sets positions_ to the positions filtered with these Chebyshev coefficients.
    void filter_positions(const Eigen::VectorXd& coefficients)
    {
        Signals filtered = signals_;
        const auto n = static_cast<Index>(filtered.rows());
        visit_chebyshev_basis(
            sample_, signals_, n_terms,
            [&](Index j, const Signals& term) {
                for_each(exec_, n, [&](Index i) { filtered.row(i) += coefficients[j] * change(j, term, i); });
            },
            exec_);
        for_each(exec_, n, [&](Index i) { positions_.row(sample_.vertices[i]) = filtered.row(i).head<3>(); });
    }

    /// n_terms by n_terms: the scalar products of all columns with each other, summed over the rows.
    [[nodiscard]] Eigen::MatrixXd products(const Eigen::MatrixXd& columns) const
    {
        const auto n = static_cast<Index>(columns.rows());
        std::vector<Eigen::MatrixXd> of_blocks(usize(n / block_size) + 1, Eigen::MatrixXd::Zero(n_terms, n_terms));
        for_each_block(exec_, n, [&](Index block, Index begin, Index end) {
            const auto rows = columns.middleRows(begin, end - begin);
            of_blocks[block].noalias() = rows.transpose() * rows;
        });
        Eigen::MatrixXd total = Eigen::MatrixXd::Zero(n_terms, n_terms);
        for (const Eigen::MatrixXd& of_block : of_blocks)
            total += of_block;
        return total;
    }

    VertexNormals normals_;
    FilterSample sample_;
    Signals signals_;
    /// #V by 3: filtered positions; only those of the sample are set.
    Points positions_;
    ChebyshevExpansion expansion_{n_terms};
    /// n_terms by n_amounts: the coefficients of the filters.
    Eigen::MatrixXd filters_;
    const Executor& exec_;
};

/// The amount of least regret, enlarged for the sake of normals, at which vertices move by no more than the noise.
DenoisingAmount best_amount(const Risks& risks, double noise)
{
    const double nearest = risks.place_of_least_regret(least_noise * noise, most_noise * noise);
    const double ratio = largest_amount / smallest_amount;
    // The number of positions over which the amount grows by the factor for_normals.
    const double more = std::log(for_normals) / std::log(ratio) * (n_amounts - 1);
    const double place = risks.last_place_within(noise, std::min<double>(nearest + more, n_amounts - 1));
    return {amount_at(place), std::max(risks.risk(place, noise), 0.0), std::sqrt(risks.squared_move(place))};
}

}  // namespace

DenoisingAmount denoising_amount(const PolygonMesh& mesh, const Topology& topology, double noise, const Executor& exec)
{
    const DenoisingAmount none{0.0, noise * noise, 0.0};
    if (!(noise > 0.0))
        return {};
    FilteredSample sample(mesh, topology, exec);
    if (sample.empty())
        return none;
    DenoisingAmount found{first_amount, 0.0, 0.0};
    for (int round = 0; round < n_rounds; ++round)
        found = best_amount(sample.risks(found.amount), noise);
    return found.risk < clear_gain * noise * noise && found.move <= noise ? found : none;
}

}  // namespace seamflow
