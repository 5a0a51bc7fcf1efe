#include "solvers/interface/interface_equation.h"

#include <algorithm>
#include <cmath>

namespace seamflow {

namespace {

/// How much of the residual single precision may take away before it is measured anew.
constexpr double most_reduction_at_once = 1e-5;

double largest_ratio(const std::array<double, 3>& norms, const std::array<double, 3>& first)
{
    double largest = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
        if (first[c] > 0.0)
            largest = std::max(largest, norms[c] / first[c]);
    return largest;
}

}  // namespace

InterfaceEquation::InterfaceEquation(const Decomposition& decomposition)
    : first_copy_{0}
{
    for (const SubMesh& sub_mesh : decomposition.sub_meshes)
        first_copy_.push_back(first_copy_.back() + sub_mesh.interface.size());
    vertex_of_copy_.assign(at(n_copies()), -1);
    copy_offsets_.push_back(0);
    for (Index s = 0; s < static_cast<Index>(decomposition.sub_meshes.size()); ++s) {
        const auto& interface = decomposition.sub_meshes[at(s)].interface;
        for (Index i = 0; i < interface.size(); ++i) {
            if (interface.sharing[i].front() != s)
                continue;
            for (std::size_t k = 0; k < interface.sharing[i].size(); ++k) {
                const Index t = interface.sharing[i][k];
                const auto& others = decomposition.sub_meshes[at(t)].interface.vertices;
                const auto place = std::lower_bound(others.begin(), others.end(), interface.index_in_sharing[i][k]);
                copies_.push_back(first_copy_[at(t)] + static_cast<Index>(place - others.begin()));
                vertex_of_copy_[at(copies_.back())] = size();
            }
            copy_offsets_.push_back(static_cast<Index>(copies_.size()));
        }
    }
    products_.resize(3 * at(n_copies()));
    residual_copies_.resize(n_copies(), 3);
    for (Points* array : {&residual_, &direction_, &product_, &preconditioned_})
        array->resize(size(), 3);
    partial_.resize(at(size() / block_size) + 1);
}

InterfaceResult InterfaceEquation::solve(std::span<const NeumannSystem* const> systems, const Points& right_hand_sides,
                                         const InterfaceStop& stop, Points& x, const Loop& loop)
{
    measure_residual(systems, right_hand_sides, x, loop);
    Sums first = dot(residual_, residual_, loop);
    for (double& norm : first)
        norm = std::sqrt(norm);
    Sums norms = first;
    InterfaceResult result;
    while (result.iterations < stop.iterations && largest_ratio(norms, first) > stop.tolerance) {
        Sums goals;
        for (std::size_t c = 0; c < 3; ++c)
            goals[c] = std::max(stop.tolerance * first[c], most_reduction_at_once * norms[c]);
        result.iterations += iterate(systems, goals, stop.iterations - result.iterations, x, loop);
        if (result.iterations < stop.iterations || stop.tolerance > 0.0)
            measure_residual(systems, right_hand_sides, x, loop);
        const Sums before = norms;
        norms = dot(residual_, residual_, loop);
        for (double& norm : norms)
            norm = std::sqrt(norm);
        if (largest_ratio(norms, before) > 0.5)
            break;
    }
    result.residual = largest_ratio(norms, first);
    return result;
}

/// In double precision.
void InterfaceEquation::measure_residual(std::span<const NeumannSystem* const> systems, const Points& right_hand_sides,
                                         const Points& x, const Loop& loop)
{
    for_each(loop, static_cast<Index>(systems.size()), [&](Index s) {
        const NeumannSystem& system = *systems[at(s)];
        Points local(system.n_interface(), 3);
        for (Index i = 0; i < system.n_interface(); ++i)
            local.row(i) = x.row(vertex_of_copy_[at(first_copy(s) + i)]);
        auto residual = residual_copies_.middleRows(first_copy(s), system.n_interface());
        residual = right_hand_sides.middleRows(first_copy(s), system.n_interface());
        system.subtract_schur(local, residual);
    });
    for_each(loop, size(), [&](Index v) {
        Point sum = Point::Zero();
        for (Index k = copy_offsets_[at(v)]; k < copy_offsets_[at(v) + 1]; ++k)
            sum += residual_copies_.row(copies_[at(k)]);
        residual_.row(v) = sum;
    });
}

/// Conjugate gradients from the present residual; x and the residual are brought up to date.
/// @returns how many iterations.
int InterfaceEquation::iterate(std::span<const NeumannSystem* const> systems, const Sums& goals, int most, Points& x,
                               const Loop& loop)
{
    Sums energy{};
    for (int iteration = 0; iteration < most; ++iteration) {
        precondition(systems, loop);
        const Sums renewed = dot(residual_, preconditioned_, loop);
        Point beta;
        for (std::size_t c = 0; c < 3; ++c)
            beta[static_cast<Eigen::Index>(c)] = energy[c] > 0.0 ? renewed[c] / energy[c] : 0.0;
        energy = renewed;
        for_each(loop, size(), [&](Index v) {
            direction_.row(v) = iteration == 0 ? Point(preconditioned_.row(v))
                                               : Point(preconditioned_.row(v) + direction_.row(v).cwiseProduct(beta));
        });
        multiply(systems, loop);
        const Sums curvature = dot(direction_, product_, loop);
        Point alpha;
        for (std::size_t c = 0; c < 3; ++c)
            alpha[static_cast<Eigen::Index>(c)] = curvature[c] > 0.0 ? energy[c] / curvature[c] : 0.0;
        for_each(loop, size(), [&](Index v) {
            x.row(v) += direction_.row(v).cwiseProduct(alpha);
            residual_.row(v) -= product_.row(v).cwiseProduct(alpha);
        });
        const Sums squares = dot(residual_, residual_, loop);
        if (std::sqrt(squares[0]) <= goals[0] && std::sqrt(squares[1]) <= goals[1] && std::sqrt(squares[2]) <= goals[2])
            return iteration + 1;
    }
    return most;
}

void InterfaceEquation::multiply(std::span<const NeumannSystem* const> systems, const Loop& loop)
{
    on_each(systems, direction_, false, product_, loop,
            [](const DenseFactor& schur, FloatColumns columns) { schur.multiply(columns); });
}

void InterfaceEquation::precondition(std::span<const NeumannSystem* const> systems, const Loop& loop)
{
    on_each(systems, residual_, true, preconditioned_, loop,
            [](const DenseFactor& schur, FloatColumns columns) { schur.solve(columns); });
}

/// Target = the sum of what `apply` makes of the source on each sub-mesh's Γ.
/// @param weighted whether source and results are divided by the number of copies.
template <class Apply>
void InterfaceEquation::on_each(std::span<const NeumannSystem* const> systems, const Points& source, bool weighted,
                                Points& target, const Loop& loop, Apply&& apply)
{
    const auto weight = [&](Index v) {
        return weighted ? 1.0 / static_cast<double>(copy_offsets_[at(v) + 1] - copy_offsets_[at(v)]) : 1.0;
    };
    for_each(loop, static_cast<Index>(systems.size()), [&](Index s) {
        const auto n = static_cast<std::ptrdiff_t>(systems[at(s)]->n_interface());
        float* begin = products_.data() + 3 * static_cast<std::ptrdiff_t>(first_copy(s));
        const FloatColumns columns{begin, begin + n, begin + 2 * n};
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            const Index v = vertex_of_copy_[at(first_copy(s)) + static_cast<std::size_t>(i)];
            const Point value = weight(v) * source.row(v);
            columns.x[i] = static_cast<float>(value[0]);
            columns.y[i] = static_cast<float>(value[1]);
            columns.z[i] = static_cast<float>(value[2]);
        }
        apply(systems[at(s)]->schur(), columns);
        for (std::ptrdiff_t i = 0; i < n; ++i)
            residual_copies_.row(first_copy(s) + i) << columns.x[i], columns.y[i], columns.z[i];
    });
    for_each(loop, size(), [&](Index v) {
        Point sum = Point::Zero();
        for (Index k = copy_offsets_[at(v)]; k < copy_offsets_[at(v) + 1]; ++k)
            sum += residual_copies_.row(copies_[at(k)]);
        target.row(v) = weight(v) * sum;
    });
}

InterfaceEquation::Sums InterfaceEquation::dot(const Points& a, const Points& b, const Loop& loop)
{
    for_each_block(loop, size(), [&](Index block, Index begin, Index end) {
        Point sum = Point::Zero();
        for (Index v = begin; v < end; ++v)
            sum += a.row(v).cwiseProduct(b.row(v));
        partial_[at(block)] = {sum[0], sum[1], sum[2]};
    });
    Sums total{};
    const Index n_blocks = size() / block_size + (size() % block_size > 0 ? 1 : 0);
    for (Index block = 0; block < n_blocks; ++block)
        for (std::size_t c = 0; c < 3; ++c)
            total[c] += partial_[at(block)][c];
    return total;
}

}  // namespace seamflow
