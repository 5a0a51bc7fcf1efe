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

// The letters of this file:
// Γ  the vertices that several sub-meshes share. Each of these sub-meshes has a copy of the vertex.
// S  the matrix of the equations on Γ that is left when the unknowns within all sub-meshes are eliminated (the Schur
//    complement). It is the sum of the complements of the sub-meshes, each on the sub-mesh's part of Γ.
// Z  the matrix whose columns are the functions of the coarse space, each one value per vertex of Γ.
// E  Zᵀ S Z, the matrix of the unknowns of the coarse space: one coefficient per function.
// A function is 0 outside one class, the vertices that the same sub-meshes share. S Z and E are sums, too: a sub-mesh
// has a share in them, for the functions on its part of Γ.

/// The amount added to the diagonal of E, relative to it: functions can cancel each other, and then E is singular;
/// since they also cancel in Z, their arbitrary coefficients do no harm.
constexpr double regularisation = 1e-8;

/// Inverse of list_of: list k holds the indices i with list_of[i] = k, ascending.
IndexLists inverse_lists(std::span<const Index> list_of, Index n_lists)
{
    return make_lists(n_lists, [&](auto&& add) {
        for (std::size_t i = 0; i < list_of.size(); ++i)
            add(list_of[i], static_cast<Index>(i));
    });
}

// Eight rows are processed at a time, which is DenseFactor::lanes, in two of these vectors.
using FourDoubles = SimdVector<double, 4>;
static_assert(DenseFactor::lanes == 8);

/// The sum of eight numbers.
inline double sum_of(const FourDoubles& low, const FourDoubles& high)
{
    const FourDoubles sums = low + high;
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Multiplies the next eight numbers of two vectors and adds the products to eight sums. The sums are two variables:
/// GCC would keep arrays of them in memory.
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

/// The distance, in numbers, at which the columns of S Z are prefetched before their use: they have left the caches
/// since their last use. And the numbers of a cache line.
constexpr std::size_t products_ahead = 2048;
constexpr std::size_t cache_line = 64 / sizeof(float);

/// column · v for three columns of v. Prefetches the numbers at the distance products_ahead after the column.
/// @param v DenseFactor::room by 3.
SEAMFLOW_WIDE void multiply_column(const float* column, const Columns& v, Point& result)
{
    // The last columns prefetch memory beyond the products, which does no harm.
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

/// product = columnsᵀ columns, by hand: the bits of Eigen's products depend on the size of the processor's caches.
/// @param columns DenseFactor::room by any number.
/// @param product square, of the right size already.
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

CoarseSpace::CoarseSpace(const InterfaceCopies& copies, InterfaceRanks& ranks)
    : copies_(copies)
    , ranks_(ranks)
    , shares_(copies.n_sub_meshes())
{
    find_functions();
    analyse();
    products_with_y_.resize(static_cast<Eigen::Index>(functions_at_.values.size()), 3);
    sums_.resize(size(), 3);
    coefficients_.resize(size(), 3);
}

/// Finds the classes of Γ (vertices that the same sub-meshes share) and numbers their functions: fills function_,
/// copies_in_, functions_at_, terms_of_ and sent_.
void CoarseSpace::find_functions()
{
    std::vector<VertexClass> here;
    std::vector<std::vector<Index>> vertices_of;
    std::map<std::vector<Index>, std::vector<Index>> found;
    // Vertices with the same first sub-mesh are consecutive.
    for (Index begin = 0, end = 0; begin < copies_.n_vertices(); begin = end) {
        const auto first_at = [this](Index v) { return copies_.sub_mesh[copies_.of_vertex[v].front()]; };
        found.clear();
        for (; end < copies_.n_vertices() && first_at(end) == first_at(begin); ++end) {
            std::vector<Index> sharing;
            for (const Index copy : copies_.of_vertex[end])
                sharing.push_back(ranks_.global_numbers()[copies_.sub_mesh[copy]]);
            found[std::move(sharing)].push_back(end);
        }
        for (auto& [sharing, vertices] : found) {
            here.push_back({sharing, vertices.size() == 1});
            vertices_of.push_back(std::move(vertices));
        }
    }
    const std::vector<VertexClass> classes = classes_of_all(here);
    function_.resize(copies_.n_copies());
    values_at_.resize(function_.size());
    Index n_functions = 0;
    // The functions of all classes are numbered in order; copies are known for the classes of this rank alone.
    auto next = classes.begin();
    const auto pass = [&] { n_functions += (next++)->n_functions(); };
    for (std::size_t i = 0; i < here.size(); ++i, pass()) {
        while (next->sharing != here[i].sharing)
            pass();
        for (const Index v : vertices_of[i])
            for (std::size_t k = 0; k < here[i].sharing.size(); ++k)
                function_[copies_.of_vertex[v][k]] = n_functions + (here[i].is_single ? 0 : static_cast<Index>(k));
    }
    while (next != classes.end())
        pass();
    copies_in_ = inverse_lists(function_, n_functions);
    list_functions(classes);
    divide_terms(classes);
}

/// The classes of all ranks, ascending. Each rank sends the classes whose lowest sub-mesh is its own.
/// @param here the classes known on this rank, ascending.
std::vector<CoarseSpace::VertexClass> CoarseSpace::classes_of_all(const std::vector<VertexClass>& here) const
{
    std::vector<double> own;
    for (const VertexClass& vertices : here)
        if (ranks_.holders()[vertices.sharing.front()] == ranks_.own_rank()) {
            own.push_back(vertices.is_single ? 1.0 : 0.0);
            own.push_back(static_cast<double>(vertices.sharing.size()));
            own.insert(own.end(), vertices.sharing.begin(), vertices.sharing.end());
        }
    std::vector<VertexClass> all;
    for (const std::vector<double>& numbers : ranks_.gather(own))
        for (auto number = numbers.begin(); number != numbers.end();) {
            VertexClass& vertices = all.emplace_back();
            vertices.is_single = *number++ != 0.0;
            vertices.sharing.resize(static_cast<std::size_t>(*number++));
            for (Index& global_number : vertices.sharing)
                global_number = static_cast<Index>(*number++);
        }
    std::ranges::stable_sort(all, {}, &VertexClass::sharing);
    return all;
}

/// Computes values_at_ from the weights of all copies. The function of a vertex's first copy is the constant 1; that of
/// another copy is the weight of its sub-mesh minus the mean of this weight over the class.
void CoarseSpace::set_functions(std::span<const double> weights, const Executor& exec)
{
    for_each(exec, size(), [&](Index f) {
        const auto copies = copies_in_[f];
        const auto is_first = [this](Index copy) { return copies_.of_vertex[copies_.vertex[copy]].front() == copy; };
        const bool is_constant = std::any_of(copies.begin(), copies.end(), is_first);
        double mean = 0.0;
        for (const Index copy : copies)
            mean += weights[copy] / static_cast<double>(copies.size());
        for (const Index copy : copies)
            if (weights[copy] == 0.0)
                values_at_[copy] = 0.0;
            else
                values_at_[copy] = is_constant ? (is_first(copy) ? 1.0 : 0.0) : weights[copy] - mean;
    });
}

/// Lists the functions on each sub-mesh's part of Γ, and where each function is in these lists: fills functions_at_ and
/// terms_of_.
void CoarseSpace::list_functions(const std::vector<VertexClass>& classes)
{
    functions_at_ = make_lists(ranks_.n_sub_meshes(), [&](auto&& add) {
        Index f = 0;
        for (const VertexClass& vertices : classes) {
            for (const Index global_number : vertices.sharing)
                for (Index k = 0; k < vertices.n_functions(); ++k)
                    add(global_number, f + k);
            f += vertices.n_functions();
        }
    });
    terms_of_ = inverse_lists(functions_at_.values, size());
}

/// Decides what each rank (a process that owns some of the sub-meshes) sends to the others in `correct`: fills sent_.
void CoarseSpace::divide_terms(const std::vector<VertexClass>& classes)
{
    const std::vector<Index>& holders = ranks_.holders();
    sent_.resize(holders.empty() ? 0 : usize(*std::ranges::max_element(holders)) + 1);
    std::vector<std::uint8_t> is_begun(usize(size()), 0);
    Index f = 0;
    for (const VertexClass& vertices : classes) {
        const Index holder = holders[vertices.sharing.front()];
        const bool is_finished = std::ranges::all_of(
            vertices.sharing, [&](Index global_number) { return holders[global_number] == holder; });
        for (const Index end = f + vertices.n_functions(); f < end; ++f) {
            (is_finished ? sent_[holder].finished : sent_[holder].begun).push_back(f);
            is_begun[f] = is_finished ? 0 : 1;
        }
    }
    for (Index global_number = 0; global_number < ranks_.n_sub_meshes(); ++global_number)
        for (Index term = functions_at_.offsets[global_number]; term < functions_at_.offsets[global_number + 1]; ++term)
            if (is_begun[functions_at_.values[term]] != 0)
                sent_[holders[global_number]].terms.push_back(term);
}

/// The entries of E on and above the diagonal, sub-mesh by sub-mesh. Two functions have an entry in E where one
/// sub-mesh has both.
std::vector<MatrixEntry> CoarseSpace::entries() const
{
    std::vector<MatrixEntry> entries;
    for (Index global_number = 0; global_number < functions_at_.size(); ++global_number)
        for (const Index f : functions_at_[global_number])
            for (const Index g : functions_at_[global_number])
                if (energy_.unknown_of[f] <= energy_.unknown_of[g])
                    entries.push_back({energy_.unknown_of[g], energy_.unknown_of[f]});
    return entries;
}

/// Finds the elimination ordering of E, and analyses its pattern.
void CoarseSpace::analyse()
{
    energy_.unknown_of.resize(size());
    std::iota(energy_.unknown_of.begin(), energy_.unknown_of.end(), 0);
    if (size() == 0)
        return;
    const std::vector<Index> order = elimination_ordering(make_pattern(size(), entries()));
    for (std::size_t i = 0; i < order.size(); ++i)
        energy_.unknown_of[order[i]] = static_cast<Index>(i);
    const std::vector<MatrixEntry> matrix_entries = entries();
    const SparsePattern upper = make_pattern(size(), matrix_entries);
    energy_.solver.emplace(upper);
    energy_.values.resize(upper.n_entries());
    for (const MatrixEntry& entry : matrix_entries)
        energy_.slots.push_back(upper.slot(entry));
    for (Index u = 0; u < size(); ++u)
        energy_.diagonal_slots.push_back(upper.slot({u, u}));
}

/// Computes the values of the functions, then each sub-mesh's share of S Z and of E = Zᵀ S Z, and adds up and
/// factorises E.
void CoarseSpace::prepare(std::span<const DenseFactor> complements, std::span<const double> weights,
                          const Executor& exec)
{
    if (size() == 0)
        return;
    set_functions(weights, exec);
    for_each(exec, copies_.n_sub_meshes(), [&](Index s) {
        if (ranks_.is_own(s))
            compute_share(s, complements[s]);
    });
    assemble();
    energy_.factor.reset();
    energy_.factor = energy_.solver->factorise<double>(energy_.values, energy_.memory, energy_.workspace);
}

/// Computes the Share of sub-mesh s in S Z and in E, for the functions on its part of Γ. With S = R Rᵀ the share in E
/// is (Rᵀ Z)ᵀ (Rᵀ Z), which rounding cannot make indefinite.
/// @param schur the sub-mesh's complement, which is its share of S.
void CoarseSpace::compute_share(Index s, const DenseFactor& schur)
{
    const auto functions = functions_at_[ranks_.global_numbers()[s]];
    Share& share = shares_[s];
    const std::size_t room = DenseFactor::room(copies_.n_in(s));
    // DenseFactor multiplies three columns at a time.
    const std::size_t n_columns = (functions.size() + 2) / 3 * 3;
    // Z, restricted to the sub-mesh.
    AlignedFloats columns;
    columns.assign(n_columns * room);
    for (Index i = 0; i < copies_.n_in(s); ++i)
        for (const Index copy : copies_.of_vertex[copies_.vertex[copies_.offsets[s] + i]]) {
            const auto column = static_cast<std::size_t>(place_in(functions, function_[copy]));
            columns.data()[column * room + usize(i)] += static_cast<float>(values_at_[copy]);
        }
    share.product.assign(n_columns * room);
    // Each call writes three columns of S Z, and overwrites those of Z by Rᵀ Z.
    for (std::size_t c = 0; c < n_columns; c += 3)
        schur.multiply(columns_at(columns.data() + c * room, room), columns_at(share.product.data() + c * room, room));
    // Rᵀ Z.
    const Eigen::MatrixXd roots = Eigen::Map<const Eigen::MatrixXf>(columns.data(), static_cast<Eigen::Index>(room),
                                                                    static_cast<Eigen::Index>(functions.size()))
                                      .cast<double>();
    share.energy.resize(roots.cols(), roots.cols());
    multiply_by_itself(roots, share.energy);
    share.scale = schur.scale();
    share.energy *= share.scale;
}

/// Adds up E, in the order of `entries`, which is identical on all ranks.
void CoarseSpace::assemble()
{
    const auto for_entries_at = [&](Index global_number, auto&& action) {
        const auto functions = functions_at_[global_number];
        for (std::size_t f = 0; f < functions.size(); ++f)
            for (std::size_t g = 0; g < functions.size(); ++g)
                if (energy_.unknown_of[functions[f]] <= energy_.unknown_of[functions[g]])
                    action(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(g));
    };
    std::vector<double> own;
    for (Index s = 0; s < copies_.n_sub_meshes(); ++s)
        if (ranks_.is_own(s))
            for_entries_at(ranks_.global_numbers()[s],
                           [&](Eigen::Index f, Eigen::Index g) { own.push_back(shares_[s].energy(f, g)); });
    const InterfaceRanks::Numbers of_all = ranks_.gather(own);
    std::vector<std::vector<double>::const_iterator> next;
    for (const std::vector<double>& numbers : of_all)
        next.push_back(numbers.begin());
    std::fill(energy_.values.begin(), energy_.values.end(), 0.0);
    auto slot = energy_.slots.begin();
    for (Index global_number = 0; global_number < functions_at_.size(); ++global_number)
        for_entries_at(global_number, [&](Eigen::Index, Eigen::Index) {
            energy_.values[*slot++] += *next[ranks_.holders()[global_number]]++;
        });
    // A function vanishes if all weights are the same. Its diagonal entry is then 0, and becomes 1.
    for (const Index diagonal : energy_.diagonal_slots)
        energy_.values[diagonal] =
            energy_.values[diagonal] > 0.0 ? (1.0 + regularisation) * energy_.values[diagonal] : 1.0;
}

/// Adds Z E⁻¹ Zᵀ (residual - S y) to y. `sums_` becomes Zᵀ (residual - S y): the sum for a function begins with its
/// term of Zᵀ residual, from which the shares of the sub-meshes in Zᵀ S y are subtracted.
void CoarseSpace::correct(const Points& residual, Points& y, const Executor& exec)
{
    if (!energy_.factor)
        return;
    for_each(exec, copies_.n_sub_meshes(), [&](Index s) {
        if (ranks_.is_own(s))
            multiply_transposed(s, y);
    });
    const auto begin = [&](Index f) {
        Point sum = Point::Zero();
        for (const Index copy : copies_in_[f])
            sum += values_at_[copy] * residual.row(copies_.vertex[copy]);
        sums_.row(f) = sum;
    };
    if (usize(ranks_.own_rank()) < sent_.size()) {
        const SentTerms& own = sent_[ranks_.own_rank()];
        for_each(exec, static_cast<Index>(own.finished.size()), [&](Index i) {
            begin(own.finished[i]);
            subtract_terms(own.finished[i]);
        });
        std::ranges::for_each(own.begun, begin);
    }
    exchange_terms();
    for (Index f = 0; f < size(); ++f)
        coefficients_.row(energy_.unknown_of[f]) = sums_.row(f);
    energy_.factor->solve(coefficients_, coefficients_, energy_.workspace);
    for_each(exec, copies_.n_vertices(), [&](Index v) {
        for (const Index copy : copies_.of_vertex[v])
            y.row(v) += values_at_[copy] * coefficients_.row(energy_.unknown_of[function_[copy]]);
    });
}

/// Subtracts the shares of all sub-meshes in Zᵀ S y, which are the terms of f, from the sum for function f.
void CoarseSpace::subtract_terms(Index f)
{
    Point sum = sums_.row(f);
    for (const Index term : terms_of_[f])
        sum -= products_with_y_.row(term);
    sums_.row(f) = sum;
}

/// Completes the sums for all functions by the terms of other ranks.
void CoarseSpace::exchange_terms()
{
    const auto for_rows_of = [&](std::size_t rank, auto&& action) {
        for (const Index f : sent_[rank].finished)
            action(sums_.row(f));
        for (const Index f : sent_[rank].begun)
            action(sums_.row(f));
        for (const Index term : sent_[rank].terms)
            action(products_with_y_.row(term));
    };
    std::vector<double> own;
    if (usize(ranks_.own_rank()) < sent_.size())
        for_rows_of(usize(ranks_.own_rank()), [&](auto&& row) { own.insert(own.end(), row.data(), row.data() + 3); });
    const InterfaceRanks::Numbers of_all = ranks_.gather(own);
    for (std::size_t rank = 0; rank < sent_.size(); ++rank) {
        const double* next = of_all[rank].data();
        for_rows_of(rank, [&](auto&& row) {
            row = Eigen::Map<const Point>(next);
            next += 3;
        });
    }
    for (const SentTerms& sent : sent_)
        for (const Index f : sent.begun)
            subtract_terms(f);
}

/// Computes a sub-mesh's share of Zᵀ S y.
void CoarseSpace::multiply_transposed(Index s, const Points& y)
{
    const Index n = copies_.n_in(s);
    const Index global_number = ranks_.global_numbers()[s];
    const auto room = static_cast<Eigen::Index>(DenseFactor::room(n));
    if (s + 1 < copies_.n_sub_meshes())
        for (std::size_t i = 0; i < std::min(shares_[s + 1].product.size(), products_ahead); i += cache_line)
            __builtin_prefetch(shares_[s + 1].product.data() + i);
    Columns local(room, 3);
    local.bottomRows(room - n).setZero();
    for (Index i = 0; i < n; ++i)
        local.row(i) = y.row(copies_.vertex[copies_.offsets[s] + i]);
    const float* product = shares_[s].product.data();
    for (Index term = functions_at_.offsets[global_number]; term < functions_at_.offsets[global_number + 1]; ++term) {
        Point share;
        multiply_column(product, local, share);
        products_with_y_.row(term) = shares_[s].scale * share;
        product += room;
    }
}

}  // namespace seamflow
