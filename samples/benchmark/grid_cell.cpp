#include "samples/benchmark/grid_cell.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "partition/errors.h"
#include "samples/benchmark/loosest_tolerance.h"

namespace seamflow {

namespace {

/// Where the search for a tolerance begins: 1e-3.
constexpr std::size_t first_place = 4;
/// Times that differ by more than this factor are not measured again if they are longer than this.
constexpr double clear_factor = 2.0;
constexpr double long_seconds = 1.0;

double seconds(const Row& row)
{
    return row.turns.median();
}

/// The least of ours and of equally close peers.
double least_seconds(const GridCell& cell)
{
    const Row* const peer = cell.fastest_peer();
    return peer != nullptr ? std::min(seconds(*peer), seconds(cell.ours)) : seconds(cell.ours);
}

}  // namespace

const Row* GridCell::fastest_peer() const
{
    const Row* fastest = nullptr;
    for (const Row& peer : peers)
        if (is_as_near(peer, ours) && (fastest == nullptr || seconds(peer) < seconds(*fastest)))
            fastest = &peer;
    return fastest;
}

double GridCell::ratio() const
{
    const Row* const peer = fastest_peer();
    return peer != nullptr ? seconds(*peer) / seconds(ours) : std::numeric_limits<double>::infinity();
}

bool is_as_near(const Row& row, const Row& ours)
{
    constexpr double no_v_max = 1e-3;
    constexpr double no_v_mean = 1e-4;
    return row.succeeded() && row.v_max && row.v_mean && *row.v_max <= std::max(*ours.v_max, no_v_max) &&
           *row.v_mean <= std::max(*ours.v_mean, no_v_mean);
}

GridRunner::GridRunner(const PolygonMesh& mesh, const GridOptions& options)
    : options_(options)
    , rows_(mesh)
{
}

GridCell GridRunner::run(const FlowOptions& flow)
{
    GridCell cell;
    cell.vertices = rows_.mesh().n_vertices();
    cell.steps = flow.steps;
    try {
        rows_.find_reference(options_.reference, flow);
    } catch (const ComputationError& error) {
        cell.ours.result = failed(std::string("no undecomposed flow: ") + error.what());
        return cell;
    }
    cell.ours = run_once(MethodRows::task_of(Method::Ours, flow));
    if (!cell.ours.succeeded())
        return cell;
    for (const Method peer : options_.peers)
        cell.peers.push_back(run_peer(peer, cell, flow));
    repeat(cell);
    return cell;
}

Row GridRunner::run_once(const MethodTask& task) const
{
    Row row = rows_.run(task);
    rows_.measure(row);
    row.turns.seconds = {row.result.total_seconds()};
    return row;
}

Row GridRunner::run_peer(Method peer, const GridCell& cell, const FlowOptions& flow)
{
    if (is_iterative(peer))
        return run_iterative(peer, cell, flow);
    const std::optional<Row>& reference = rows_.reference();
    if (!reference || reference->task.method != peer)
        return run_once(MethodRows::task_of(peer, flow));
    Row row = *reference;
    row.v_mean = row.v_max = 0.0;
    row.turns.seconds = {row.result.total_seconds()};
    return row;
}

Row GridRunner::run_iterative(Method peer, const GridCell& cell, const FlowOptions& flow)
{
    std::size_t& place = place_.try_emplace(peer, first_place).first->second;
    const auto run_at = [&](std::size_t p) {
        Row row = run_once(MethodRows::task_of(peer, flow, tolerance_ladder[p]));
        row.name = title_of(peer, flow.laplacian);
        return row;
    };
    Row row = run_at(place);
    while (row.succeeded() && !is_as_near(row, cell.ours)) {
        if (seconds(row) > clear_factor * least_seconds(cell))
            row.result.error = "slower";
        else if (place + 1 == tolerance_ladder.size())
            row.result.error = "not reached";
        else
            row = run_at(++place);
    }
    while (row.succeeded() && place > 0) {
        Row looser = run_at(place - 1);
        if (!is_as_near(looser, cell.ours))
            break;
        row = std::move(looser);
        --place;
    }
    return row;
}

/// Several turns, if it is not clear who is faster.
void GridRunner::repeat(GridCell& cell) const
{
    const auto again = [&](Row& row) {
        const Row repeated = run_once(row.task);
        if (repeated.succeeded())
            row.turns.seconds.push_back(seconds(repeated));
    };
    for (int turn = 1; turn < options_.turns; ++turn) {
        const bool is_clear = cell.ratio() > clear_factor || cell.ratio() < 1.0 / clear_factor;
        if (is_clear && least_seconds(cell) > long_seconds)
            return;
        again(cell.ours);
        const double limit = clear_factor * least_seconds(cell);
        for (Row& peer : cell.peers)
            if (is_as_near(peer, cell.ours) && seconds(peer) < limit)
                again(peer);
    }
}

}  // namespace seamflow
