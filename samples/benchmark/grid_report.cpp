#include "samples/benchmark/grid_report.h"

#include <algorithm>
#include <iterator>
#include <ostream>

#include <fmt/format.h>

#include "samples/benchmark/case_json.h"

namespace seamflow {

std::string name_with_tolerance(const Row& row)
{
    return is_iterative(row.task.method) ? fmt::format("{} {:.0e}", row.name, row.task.tolerance) : row.name;
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
                               cell.vertices, cell.time_step_edges, cell.steps,
                               name_with_tolerance(*cell.fastest_peer()), cell.ratio(), cell.ours.result.approach);
    out << std::flush;
}

}  // namespace

void print_grid_head(std::ostream& out)
{
    out << fmt::format("{:<20} {:>9} {:>4} {:>5}  {:>9} {:<13} {:>8} {:>8}  {:>9} {:<14} {:>6}\n", "mesh", "vertices",
                       "dt", "steps", "ours, s", "approach", "V_max", "V_mean", "peer, s", "fastest peer", "ratio")
        << std::flush;
}

void print_grid_cell(std::ostream& out, const GridCell& cell)
{
    const Row& ours = cell.ours;
    out << fmt::format("{:<20} {:>9} {:>4} {:>5}  ", cell.mesh, cell.vertices, cell.time_step_edges, cell.steps);
    if (!ours.succeeded()) {
        out << ours.result.error << std::endl;
        return;
    }
    out << fmt::format("{:>9.4f} {:<13} {:>8.1e} {:>8.1e}", ours.turns.median(), ours.result.approach, *ours.v_max,
                       *ours.v_mean);
    if (const Row* const peer = cell.fastest_peer())
        out << fmt::format("  {:>9.4f} {:<14} {:>6.2f}", peer->turns.median(), name_with_tolerance(*peer),
                           cell.ratio());
    out << std::endl;
}

void print_grid_summary(std::ostream& out, const std::vector<GridCell>& cells)
{
    out << "seconds: set-up and all steps, without what is measured of them, median of the turns; dt in squared mean\n"
           "edge lengths\n"
           "fastest peer: of those at least as near to the undecomposed flow as ours, by V_max and V_mean (of mean\n"
           "edges; less than 1e-3 and 1e-4 count as none), with the loosest tolerance that is\n"
           "ratio: its time in that of ours\n";
    print_ratios(out, cells);
    print_losses(out, cells);
}

nlohmann::ordered_json grid_cell_json(const GridCell& cell)
{
    nlohmann::ordered_json json{{"mesh", cell.mesh},
                                {"vertices", cell.vertices},
                                {"dt_over_h2", cell.time_step_edges},
                                {"steps", cell.steps},
                                {"ours", row_json(cell.ours)}};
    if (cell.ours.succeeded())
        json["ours"]["total"] = turns_json(cell.ours.turns);
    json["peers"] = nlohmann::ordered_json::object();
    for (const Row& peer : cell.peers) {
        json["peers"][peer.name] = row_json(peer);
        if (peer.succeeded())
            json["peers"][peer.name]["total"] = turns_json(peer.turns);
    }
    if (const Row* const peer = cell.fastest_peer()) {
        json["fastest_peer"] = peer->name;
        json["ratio"] = cell.ratio();
    }
    return json;
}

}  // namespace seamflow
