#include "samples/benchmark/grid_cell.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <ostream>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

/// Where the search for a tolerance begins: 1e-3.
constexpr std::size_t first_place = 4;
/// Times that differ by more than this factor are not measured again if they are longer than this.
constexpr double clear_factor = 2.0;
constexpr double long_seconds = 1.0;

/// The least of ours and of equally close peers.
double least_seconds(const GridCell& cell)
{
    const Row* const peer = cell.fastest_peer();
    return peer != nullptr ? std::min(peer->seconds(), cell.ours.seconds()) : cell.ours.seconds();
}

}  // namespace

const Row* GridCell::fastest_peer() const
{
    const Row* fastest = nullptr;
    for (const Row& peer : peers)
        if (is_as_near(peer, ours) && (fastest == nullptr || peer.seconds() < fastest->seconds()))
            fastest = &peer;
    return fastest;
}

double GridCell::ratio() const
{
    const Row* const peer = fastest_peer();
    return peer != nullptr ? peer->seconds() / ours.seconds() : std::numeric_limits<double>::infinity();
}

bool is_as_near(const Row& row, const Row& ours)
{
    constexpr double no_v_max = 1e-3;
    constexpr double no_v_mean = 1e-4;
    return row.succeeded() && row.v_max && ours.v_max && *row.v_max <= std::max(*ours.v_max, no_v_max) &&
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
        if (!options_.peers.empty())
            rows_.find_reference(flow);
    } catch (const ComputationError& error) {
        cell.ours.result = failed(std::string("no undecomposed flow: ") + error.what());
        return cell;
    }
    cell.ours = rows_.run(MethodRows::task_of(Method::Ours, flow));
    if (!cell.ours.succeeded())
        return cell;
    for (const Method peer : options_.peers)
        cell.peers.push_back(run_peer(peer, cell, flow));
    repeat(cell);
    return cell;
}

Row GridRunner::run_peer(Method peer, const GridCell& cell, const FlowOptions& flow)
{
    if (!is_iterative(peer) && rows_.reference()->task.method == peer)
        return *rows_.reference();
    if (!is_iterative(peer) || options_.tolerance)
        return rows_.run(MethodRows::task_of(peer, flow, options_.tolerance.value_or(0.0)));
    return run_iterative(peer, cell, flow);
}

Row GridRunner::run_iterative(Method peer, const GridCell& cell, const FlowOptions& flow)
{
    std::size_t& place = place_.try_emplace(peer, first_place).first->second;
    const auto run_at = [&](std::size_t p) { return rows_.run(MethodRows::task_of(peer, flow, tolerance_ladder[p])); };
    Row row = run_at(place);
    while (row.succeeded() && !is_as_near(row, cell.ours)) {
        if (options_.abandons_slower && row.seconds() > clear_factor * least_seconds(cell))
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
        const Row repeated = rows_.run(row.task);
        if (repeated.succeeded())
            row.turns.push_back(repeated.seconds());
    };
    for (int turn = 1; turn < options_.turns; ++turn) {
        const bool is_clear = cell.ratio() > clear_factor || cell.ratio() < 1.0 / clear_factor;
        if (is_clear && least_seconds(cell) > long_seconds)
            return;
        again(cell.ours);
        const double limit = clear_factor * least_seconds(cell);
        for (Row& peer : cell.peers)
            if (is_as_near(peer, cell.ours) && peer.seconds() < limit)
                again(peer);
    }
}

namespace {

std::string ratio_text(const GridCell& cell)
{
    if (!cell.ours.succeeded())
        return "failed";
    return cell.fastest_peer() != nullptr ? fmt::format("{:.2f}", cell.ratio()) : "–";
}

/// A table in Markdown.
void print_ratios(std::ostream& out, const std::vector<GridCell>& cells)
{
    const auto is_same_mesh = [](const GridCell& a, const GridCell& b) {
        return a.mesh == b.mesh && a.vertices == b.vertices;
    };
    out << "\n| mesh | vertices |";
    for (auto cell = cells.begin(); cell != cells.end() && is_same_mesh(*cell, cells.front()); ++cell)
        if (cell == cells.begin() || cell->time_step_edges != std::prev(cell)->time_step_edges)
            out << fmt::format(" dt {} |", cell->time_step_edges);
    for (auto cell = cells.begin(); cell != cells.end(); ++cell) {
        const bool is_first = cell == cells.begin();
        const std::string ratio = ratio_text(*cell);
        if (is_first || !is_same_mesh(*cell, *std::prev(cell)))
            out << fmt::format("\n| {} | {} | {}", cell->mesh, cell->vertices, ratio);
        else
            out << (cell->time_step_edges == std::prev(cell)->time_step_edges ? ", " : " | ") << ratio;
        if (std::next(cell) == cells.end() || !is_same_mesh(*cell, *std::next(cell)))
            out << " |";
    }
    out << "\n\n";
}

void print_losses(std::ostream& out, const std::vector<GridCell>& cells)
{
    const auto is_lost = [](const GridCell& cell) { return cell.ratio() < 1.0; };
    out << fmt::format("ours is not the fastest in {} of {} cells\n",
                       std::count_if(cells.begin(), cells.end(), is_lost), cells.size());
    for (const GridCell& cell : cells)
        if (is_lost(cell))
            out << fmt::format("  {}, {} vertices, dt {}, steps {}: {} takes {:.2f} of the time of {}\n", cell.mesh,
                               cell.vertices, cell.time_step_edges, cell.steps, cell.fastest_peer()->name(),
                               cell.ratio(), cell.ours.name());
    out << std::flush;
}

}  // namespace

Table cell_table(std::ostream& out)
{
    out << "seconds: set-up, median step, and set-up with all steps (median of the turns); dt in squared mean edge "
           "lengths; MB: peak memory\n"
           "V_mean, V_max: distance to the undecomposed flow in mean edge lengths; ratio: all of a peer that is at "
           "least as near as\n"
           "ours (less than 1e-4 and 1e-3 count as none), in all of ours\n\n";
    return {out,
            {{"mesh", "mesh", 20},
             {"vertices", "vertices", 9},
             {"dt_over_h2", "dt", 5},
             {"steps", "steps", 5},
             {"method", "method", 8},
             {"approach", "approach", 12},
             {"tolerance", "to", 6},
             {"setup_s", "set-up", 8},
             {"step_s", "step", 8},
             {"all_s", "all", 8},
             {"peak_memory_mb", "MB", 8},
             {"iterations", "iter.", 5},
             {"v_mean", "V_mean", 9},
             {"v_max", "V_max", 9},
             {"ratio", "ratio", 5}}};
}

void add_cell(Table& table, const GridCell& cell)
{
    const auto add = [&](const Row& row) {
        nlohmann::ordered_json json{{"mesh", cell.mesh},
                                    {"vertices", cell.vertices},
                                    {"dt_over_h2", cell.time_step_edges},
                                    {"steps", cell.steps}};
        json.update(row.json());
        if (is_as_near(row, cell.ours))
            json["ratio"] = row.seconds() / cell.ours.seconds();
        table.add(std::move(json));
    };
    add(cell.ours);
    std::ranges::for_each(cell.peers, add);
}

void print_grid_summary(std::ostream& out, const std::vector<GridCell>& cells)
{
    out << "all of the fastest peer that is as near as ours, in all of ours:\n";
    print_ratios(out, cells);
    print_losses(out, cells);
}

}  // namespace seamflow
