#include "solvers/interface/trace_equation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/direct/columns.h"
#include "solvers/krylov/gmres.h"

namespace seamflow {

namespace {

/// The memory that the directions of GMRES may take before it restarts, but it keeps at least this many.
constexpr std::size_t most_direction_bytes = std::size_t{1} << 30;
constexpr std::size_t least_directions = 60;
/// The rounding error of a residual, relative to the positions.
constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();

/// About this fraction of a residual is amplified most (measured on real meshes).
constexpr double amplified_share = 0.1;

int most_directions(Index n)
{
    const std::size_t affordable = most_direction_bytes / (3 * sizeof(double) * std::max<std::size_t>(at(n), 1));
    return static_cast<int>(std::clamp<std::size_t>(affordable, least_directions, 1'000'000));
}

double longest_row(const Points& a)
{
    return a.rows() > 0 ? std::sqrt(a.rowwise().squaredNorm().maxCoeff()) : 0.0;
}

}  // namespace

TraceEquation::TraceEquation(Blocks blocks, Index n_vertices)
    : ends_(blocks.size())
    , basis_(0)
{
    constexpr Index unmarked = -1;
    std::vector<Index> number_of(n_vertices, unmarked);
    for (const auto& block : blocks)
        for (const Index v : block->beyond())
            number_of[block->sub_mesh().local_to_global[v]] = 0;
    Index n = 0;
    for (std::size_t s = 0; s < blocks.size(); ++s) {
        const SubMesh& sub_mesh = blocks[s]->sub_mesh();
        const std::vector<Index>& unknowns = blocks[s]->unknowns();
        for (std::size_t u = 0; u < unknowns.size(); ++u) {
            Index& number = number_of[sub_mesh.local_to_global[unknowns[u]]];
            if (number == unmarked || sub_mesh.owned[unknowns[u]] == 0)
                continue;
            number = n++;
            ends_[s].outputs.push_back(static_cast<Index>(u));
        }
        first_.push_back(n);
    }
    for (std::size_t s = 0; s < blocks.size(); ++s)
        for (const Index v : blocks[s]->beyond())
            ends_[s].inputs.push_back(number_of[blocks[s]->sub_mesh().local_to_global[v]]);
    traces_.resize(n, 3);
    residual_.resize(n, 3);
    basis_ = KrylovBasis(n);
}

InterfaceResult TraceEquation::solve(const FactorisedBlocks& system, const IterationStop& stop, Points& x,
                                     const Threads& threads)
{
    for_each(threads.exec, static_cast<Index>(ends_.size()), [&](Index s) {
        const SchwarzBlock& block = *system.blocks[s];
        for (std::size_t i = 0; i < ends_[s].outputs.size(); ++i)
            traces_.row(first_[s] + static_cast<Index>(i)) =
                x.row(block.sub_mesh().local_to_global[block.unknowns()[ends_[s].outputs[i]]]);
    });
    renew(system, x, threads);
    const Executor& exec = threads.exec;
    const double unit = std::max(norm(residual_, exec), rounding * norm(traces_, exec) / stop.tolerance);
    const auto multiply = [&](const Points& p, Points& product) { this->multiply(system, p, product, threads); };
    const auto measure = [&] { renew(system, x, threads); };
    const GmresResult found = gmres(multiply, measure, {stop.tolerance * unit, stop.iterations},
                                    most_directions(size()), {basis_, traces_, residual_}, exec);
    InterfaceResult result{found};
    result.residual = unit > 0.0 ? found.residual / unit : 0.0;
    result.estimated_distance = std::max(1.0, amplified_share * found.amplification) * longest_row(residual_);
    return result;
}

/// Computes all vertices from the traces, and the traces' residual T g + c - g.
void TraceEquation::renew(const FactorisedBlocks& system, Points& x, const Threads& threads)
{
    for_each(threads.exec, static_cast<Index>(ends_.size()), [&](Index s) {
        const SchwarzBlock& block = *system.blocks[s];
        SolverWorkspace& workspace = threads.workspace();
        solve_block(system, s, traces_, SchwarzBlock::RightHandSide::Step, workspace);
        const SubMesh& sub_mesh = block.sub_mesh();
        for (std::size_t u = 0; u < block.unknowns().size(); ++u)
            if (sub_mesh.owned[block.unknowns()[u]] != 0)
                x.row(sub_mesh.local_to_global[block.unknowns()[u]]) =
                    workspace.solution.row(static_cast<Eigen::Index>(u));
        Index trace = first_[s];
        for (const Index u : ends_[s].outputs) {
            residual_.row(trace) = workspace.solution.row(u) - traces_.row(trace);
            ++trace;
        }
    });
}

/// (I - T) p.
void TraceEquation::multiply(const FactorisedBlocks& system, const Points& p, Points& product,
                             const Threads& threads) const
{
    for_each(threads.exec, static_cast<Index>(ends_.size()), [&](Index s) {
        SolverWorkspace& workspace = threads.workspace();
        solve_block(system, s, p, SchwarzBlock::RightHandSide::Zero, workspace);
        Index trace = first_[s];
        for (const Index u : ends_[s].outputs) {
            product.row(trace) = p.row(trace) - workspace.solution.row(u);
            ++trace;
        }
    });
}

/// The result is in workspace.solution.
void TraceEquation::solve_block(const FactorisedBlocks& system, Index s, const Points& traces,
                                SchwarzBlock::RightHandSide right_hand_side, SolverWorkspace& workspace) const
{
    const Ends& ends = ends_[s];
    Points& given = workspace.positions;
    set_rows(given, static_cast<Eigen::Index>(ends.inputs.size()));
    for (std::size_t i = 0; i < ends.inputs.size(); ++i)
        given.row(static_cast<Eigen::Index>(i)) = traces.row(ends.inputs[i]);
    system.blocks[s]->solve(system.factors[s], given, right_hand_side, workspace.solution, workspace);
}

}  // namespace seamflow
