#include "solvers/interface/coarse_space.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>

#include "partition/index_lists.h"
#include "solvers/direct/simd.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/sparse/elimination_ordering.h"

namespace seamflow {

namespace {

/// How much is added to the diagonal of E, relative to it: functions can cancel each other, and then E is singular; as
/// Z cancels them too, it does no harm that their coefficients are arbitrary.
constexpr double regularisation = 1e-8;

/// The values are the indices whose list it is, ascending.
IndexLists inverse_lists(std::span<const Index> list_of, Index n_lists)
{
    IndexLists lists;
    lists.offsets.assign(at(n_lists) + 1, 0);
    for (const Index list : list_of)
        ++lists.offsets[list + 1];
    std::partial_sum(lists.offsets.begin(), lists.offsets.end(), lists.offsets.begin());
    std::vector<Index> next(lists.offsets.begin(), lists.offsets.end() - 1);
    lists.values.resize(list_of.size());
    for (std::size_t i = 0; i < list_of.size(); ++i)
        lists.values[next[list_of[i]]++] = static_cast<Index>(i);
    return lists;
}

std::ptrdiff_t place_in(std::span<const Index> ascending, Index value)
{
    return std::lower_bound(ascending.begin(), ascending.end(), value) - ascending.begin();
}

// Rows are used eight at a time.
using FourDoubles = SimdVector<double, 4>;
static_assert(DenseFactor::lanes == 8);

inline double sum_of(const FourDoubles& low, const FourDoubles& high)
{
    const FourDoubles sums = low + high;
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// The next numbers of two vectors, multiplied and added to eight sums, which are single numbers: GCC keeps arrays of
/// them in memory.
template <class Number>
[[gnu::always_inline]] inline void add_products(const Number* a, const double* b, FourDoubles& low, FourDoubles& high)
{
    FourDoubles of_a;
    FourDoubles of_b;
    load(a, of_a);
    load(b, of_b);
    low += of_a * of_b;
    load(a + 4, of_a);
    load(b + 4, of_b);
    high += of_a * of_b;
}

/// How many numbers ahead of their use products are prefetched; they have left the caches since the last time.
constexpr std::size_t products_ahead = 2048;
constexpr std::size_t cache_line = 64 / sizeof(float);

/// column · v for three columns. Prefetches what comes a certain distance after the column.
/// @param v DenseFactor::room by 3.
SEAMFLOW_WIDE void multiply_column(const float* column, const Columns& v, Point& result)
{
    // The last ones ask for what is after the products, which does no harm.
    const std::uintptr_t ahead = reinterpret_cast<std::uintptr_t>(column) + products_ahead * sizeof(float);
    FourDoubles x_low{}, x_high{}, y_low{}, y_high{}, z_low{}, z_high{};
    const double* x = v.data();
    const double* y = x + v.rows();
    const double* z = y + v.rows();
    for (Eigen::Index i = 0; i < v.rows(); i += DenseFactor::lanes) {
        __builtin_prefetch(reinterpret_cast<const void*>(ahead + static_cast<std::size_t>(i) * sizeof(float)));
        add_products(column + i, x + i, x_low, x_high);
        add_products(column + i, y + i, y_low, y_high);
        add_products(column + i, z + i, z_low, z_high);
    }
    result = {sum_of(x_low, x_high), sum_of(y_low, y_high), sum_of(z_low, z_high)};
}

/// product = columnsᵀ columns. Eigen's products of matrices would go by the size of the processor's caches.
/// @param columns DenseFactor::room by any number.
/// @param product as large as it will be.
SEAMFLOW_WIDE void multiply_by_itself(const Eigen::MatrixXd& columns, Eigen::MatrixXd& product)
{
    const Eigen::Index n = columns.rows();
    for (Eigen::Index f = 0; f < columns.cols(); ++f)
        for (Eigen::Index g = 0; g <= f; ++g) {
            FourDoubles low{}, high{};
            for (Eigen::Index i = 0; i < n; i += DenseFactor::lanes)
                add_products(columns.data() + f * n + i, columns.data() + g * n + i, low, high);
            product(f, g) = product(g, f) = sum_of(low, high);
        }
}

}  // namespace

CoarseSpace::CoarseSpace(const InterfaceCopies& copies)
    : copies_(copies)
    , shares_(copies.n_sub_meshes())
{
    find_functions();
    list_functions();
    analyse();
    products_with_y_.resize(static_cast<Eigen::Index>(functions_at_.values.size()), 3);
    coefficients_.resize(size(), 3);
}

void CoarseSpace::find_functions()
{
    function_.resize(copies_.n_copies());
    Index n_functions = 0;
    std::map<std::vector<Index>, std::vector<Index>> stretches;
    // Vertices with the same first sub-mesh follow each other.
    for (Index begin = 0, end = 0; begin < copies_.n_vertices(); begin = end) {
        const auto first_at = [this](Index v) { return copies_.sub_mesh[copies_.of_vertex[v].front()]; };
        stretches.clear();
        for (; end < copies_.n_vertices() && first_at(end) == first_at(begin); ++end) {
            std::vector<Index> sharing;
            for (const Index copy : copies_.of_vertex[end])
                sharing.push_back(copies_.sub_mesh[copy]);
            stretches[std::move(sharing)].push_back(end);
        }
        for (const auto& [sharing, vertices] : stretches) {
            const bool is_single = vertices.size() == 1;
            for (const Index v : vertices)
                for (std::size_t k = 0; k < sharing.size(); ++k)
                    function_[copies_.of_vertex[v][k]] = n_functions + (is_single ? 0 : static_cast<Index>(k));
            n_functions += is_single ? 1 : static_cast<Index>(sharing.size());
        }
    }
    copies_in_ = inverse_lists(function_, n_functions);
    values_at_.resize(function_.size());
}

/// The first copy of a vertex has the constant.
void CoarseSpace::set_functions(std::span<const double> weights, const Loop& loop)
{
    for_each(loop, size(), [&](Index f) {
        const auto copies = copies_in_[f];
        const auto is_first = [this](Index copy) { return copies_.of_vertex[copies_.vertex[copy]].front() == copy; };
        const bool is_constant = std::any_of(copies.begin(), copies.end(), is_first);
        double mean = 0.0;
        for (const Index copy : copies)
            mean += weights[copy] / static_cast<double>(copies.size());
        for (const Index copy : copies)
            values_at_[copy] = is_constant ? (is_first(copy) ? 1.0 : 0.0) : weights[copy] - mean;
    });
}

void CoarseSpace::list_functions()
{
    std::vector<Index> found;
    for (Index s = 0; s < copies_.n_sub_meshes(); ++s) {
        found.clear();
        for (Index copy = copies_.first[s]; copy < copies_.first[s + 1]; ++copy)
            for (const Index other : copies_.of_vertex[copies_.vertex[copy]])
                found.push_back(function_[other]);
        sort_unique(found);
        functions_at_.values.insert(functions_at_.values.end(), found.begin(), found.end());
        functions_at_.close();
    }
    places_ = inverse_lists(functions_at_.values, size());
}

/// Two unknowns have an entry where one sub-mesh has both of their functions.
std::vector<MatrixEntry> CoarseSpace::entries() const
{
    std::vector<MatrixEntry> entries;
    for (Index s = 0; s < copies_.n_sub_meshes(); ++s)
        for (const Index f : functions_at_[s])
            for (const Index g : functions_at_[s])
                if (energy_.unknown_of[f] <= energy_.unknown_of[g])
                    entries.push_back({energy_.unknown_of[g], energy_.unknown_of[f]});
    return entries;
}

void CoarseSpace::analyse()
{
    energy_.unknown_of.resize(size());
    std::iota(energy_.unknown_of.begin(), energy_.unknown_of.end(), 0);
    if (size() == 0)
        return;
    const std::vector<Index> order = elimination_ordering(make_pattern(size(), entries()));
    for (std::size_t i = 0; i < order.size(); ++i)
        energy_.unknown_of[order[i]] = static_cast<Index>(i);
    const std::vector<MatrixEntry> places = entries();
    const SparsePattern upper = make_pattern(size(), places);
    energy_.solver.emplace(upper);
    energy_.values.resize(upper.n_entries());
    for (const MatrixEntry& entry : places)
        energy_.slots.push_back(upper.slot(entry));
    for (Index u = 0; u < size(); ++u)
        energy_.diagonal_slots.push_back(upper.slot({u, u}));
}

void CoarseSpace::prepare(std::span<const DenseFactor> complements, std::span<const double> weights, const Loop& loop)
{
    if (size() == 0)
        return;
    set_functions(weights, loop);
    for_each(loop, copies_.n_sub_meshes(), [&](Index s) { multiply_functions(s, complements[s]); });
    assemble();
    energy_.factor.reset();
    energy_.factor = energy_.solver->factorise<double>(energy_.values, energy_.memory, energy_.workspace);
}

/// With S = R Rᵀ, the share of E is (Rᵀ Z)ᵀ (Rᵀ Z), which rounding cannot make indefinite.
void CoarseSpace::multiply_functions(Index s, const DenseFactor& schur)
{
    const auto functions = functions_at_[s];
    Share& share = shares_[s];
    const std::size_t room = DenseFactor::room(copies_.n_in(s));
    const std::size_t n_columns = (functions.size() + 2) / 3 * 3;
    AlignedFloats columns;
    columns.assign(n_columns * room);
    for (Index i = 0; i < copies_.n_in(s); ++i)
        for (const Index copy : copies_.of_vertex[copies_.vertex[copies_.first[s] + i]]) {
            const auto column = static_cast<std::size_t>(place_in(functions, function_[copy]));
            columns.data()[column * room + at(i)] += static_cast<float>(values_at_[copy]);
        }
    share.product.assign(n_columns * room);
    for (std::size_t c = 0; c < n_columns; c += 3)
        schur.multiply(columns_at(columns.data() + c * room, room), columns_at(share.product.data() + c * room, room));
    const Eigen::MatrixXd roots = Eigen::Map<const Eigen::MatrixXf>(columns.data(), static_cast<Eigen::Index>(room),
                                                                    static_cast<Eigen::Index>(functions.size()))
                                      .cast<double>();
    share.energy.resize(roots.cols(), roots.cols());
    multiply_by_itself(roots, share.energy);
    share.scale = schur.scale();
    share.energy *= share.scale;
}

/// In the order of `entries`.
void CoarseSpace::assemble()
{
    std::fill(energy_.values.begin(), energy_.values.end(), 0.0);
    auto slot = energy_.slots.begin();
    for (Index s = 0; s < copies_.n_sub_meshes(); ++s) {
        const auto functions = functions_at_[s];
        for (std::size_t f = 0; f < functions.size(); ++f)
            for (std::size_t g = 0; g < functions.size(); ++g)
                if (energy_.unknown_of[functions[f]] <= energy_.unknown_of[functions[g]])
                    energy_.values[*slot++] +=
                        shares_[s].energy(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(g));
    }
    // Where all weights are the same, a function is none.
    for (const Index diagonal : energy_.diagonal_slots)
        energy_.values[diagonal] =
            energy_.values[diagonal] > 0.0 ? (1.0 + regularisation) * energy_.values[diagonal] : 1.0;
}

void CoarseSpace::correct(const Points& residual, Points& y, const Loop& loop)
{
    if (!energy_.factor)
        return;
    for_each(loop, copies_.n_sub_meshes(), [&](Index s) { multiply_transposed(s, y); });
    for_each(loop, size(), [&](Index f) {
        Point sum = Point::Zero();
        for (const Index copy : copies_in_[f])
            sum += values_at_[copy] * residual.row(copies_.vertex[copy]);
        for (const Index place : places_[f])
            sum -= products_with_y_.row(place);
        coefficients_.row(energy_.unknown_of[f]) = sum;
    });
    energy_.factor->solve(coefficients_, coefficients_, energy_.workspace);
    for_each(loop, copies_.n_vertices(), [&](Index v) {
        for (const Index copy : copies_.of_vertex[v])
            y.row(v) += values_at_[copy] * coefficients_.row(energy_.unknown_of[function_[copy]]);
    });
}

/// A sub-mesh's share of Zᵀ S y.
void CoarseSpace::multiply_transposed(Index s, const Points& y)
{
    const Index n = copies_.n_in(s);
    const auto room = static_cast<Eigen::Index>(DenseFactor::room(n));
    if (s + 1 < copies_.n_sub_meshes())
        for (std::size_t i = 0; i < std::min(shares_[s + 1].product.size(), products_ahead); i += cache_line)
            __builtin_prefetch(shares_[s + 1].product.data() + i);
    Columns local(room, 3);
    local.bottomRows(room - n).setZero();
    for (Index i = 0; i < n; ++i)
        local.row(i) = y.row(copies_.vertex[copies_.first[s] + i]);
    const float* product = shares_[s].product.data();
    for (Index place = functions_at_.offsets[s]; place < functions_at_.offsets[s + 1]; ++place) {
        Point share;
        multiply_column(product, local, share);
        products_with_y_.row(place) = shares_[s].scale * share;
        product += room;
    }
}

}  // namespace seamflow
