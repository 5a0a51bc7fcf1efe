#include "samples/benchmark/whole_run.h"

#include <algorithm>
#include <fstream>
#include <ostream>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "samples/benchmark/methods/median.h"
#include "samples/process/process.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The program in the folder of this one.
std::string path_of_smooth()
{
    return (fs::read_symlink("/proc/self/exe").parent_path() / "smooth").string();
}

/// `smooth` and its peers from file to file, in turn after turn.
class WholeRunner {
  public:
    WholeRunner(const WholeRunInput& input, const FlowOptions& flow, double time_step_edges, const GridOptions& options)
        : grid_(input.mesh, options)
        , flow_(flow)
        , time_step_edges_(time_step_edges)
        , input_(input.file.empty() ? scratch() / ("input." + input.format) : input.file)
        , output_(scratch() / ("output." + input.format))
    {
        if (input.file.empty())
            write_mesh(input_, input.mesh, kind_for_writing(input_, FileKind{}));
        if (options.peers.empty())
            return;
        const GridCell cell = grid_.run(flow);
        require_success(cell.ours);
        for (const Row& peer : cell.peers)
            if (is_as_near(peer, cell.ours))
                add_peer(peer);
    }

    /// Leaves the output of `smooth`.
    void take_turn()
    {
        for (Row& peer : peers_) {
            if (peer.task.method == Method::Cholmod)
                run_cholmod_step();
            const Row row = grid_.rows().run(peer.task);
            require_success(row);
            peer.turns.push_back(row.result.process_seconds);
        }
        const ProcessEnd end = run_smooth({});
        smooth_.turns.push_back(end.seconds);
        smooth_.result.peak_memory_bytes = static_cast<std::int64_t>(end.peak_memory_bytes);
    }

    /// The phases of one more run, for a report. What that measures besides takes its time, so that the rest is that of
    /// the runs before.
    Json phases()
    {
        const fs::path file = scratch() / "report.json";
        run_smooth({"--report", file.string()});
        const Json seconds = Json::parse(std::ifstream(file)).at("seconds");
        Json phases;
        double rest = smooth_.seconds();
        for (const auto& [phase, member] :
             {std::pair{"read", "read"}, std::pair{"cut", "cut"}, std::pair{"analyse", "analyse"},
              std::pair{"steps_s", "step"}, std::pair{"write", "write"}}) {
            phases[phase] = seconds.at(member);
            rest -= seconds.at(member).get<double>();
        }
        phases["rest"] = std::max(rest, 0.0);
        return phases;
    }

    /// With the distance of the output of the last turn.
    const Row& smooth()
    {
        grid_.rows().measure(smooth_, output_);
        return smooth_;
    }

    [[nodiscard]] const std::vector<Row>& peers() const { return peers_; }
    [[nodiscard]] const std::vector<double>& cholmod_steps() const { return cholmod_steps_; }
    [[nodiscard]] std::uintmax_t file_bytes() const { return fs::file_size(input_); }

  private:
    [[nodiscard]] const fs::path& scratch() const { return grid_.rows().scratch().path(); }

    void add_peer(Row row)
    {
        row.task.input = input_;
        row.task.output = output_;
        row.turns.clear();
        peers_.push_back(std::move(row));
    }

    ProcessEnd run_smooth(const std::vector<std::string>& further)
    {
        std::vector<std::string> words{"smooth",
                                       input_.string(),
                                       output_.string(),
                                       "--laplacian",
                                       std::string(name_of(flow_.laplacian)),
                                       "--time-step-edges",
                                       fmt::format("{}", time_step_edges_),
                                       "--steps",
                                       std::to_string(flow_.steps),
                                       "--threads",
                                       std::to_string(flow_.resources.threads)};
        if (flow_.cut.subdomains > 0)
            words.insert(words.end(), {"--subdomains", std::to_string(flow_.cut.subdomains)});
        if (flow_.accuracy.tolerance)
            words.insert(words.end(), {"--converge", fmt::format("{}", *flow_.accuracy.tolerance)});
        else if (flow_.accuracy.approach == Approach::Sweep)
            words.insert(words.end(), {"--converge", "never"});
        words.insert(words.end(), further.begin(), further.end());
        ProcessEnd end = run_process(path_of_smooth(), words, flow_.resources.threads);
        if (!end.failure.empty())
            throw ComputationError("smooth: " + end.failure);
        return end;
    }

    void run_cholmod_step()
    {
        FlowOptions flow = flow_;
        flow.steps = 1;
        const Row row = grid_.rows().run(MethodRows::task_of(Method::Cholmod, flow));
        require_success(row);
        cholmod_steps_.push_back(row.result.step_seconds());
    }

    GridRunner grid_;
    const FlowOptions& flow_;
    double time_step_edges_;
    fs::path input_;
    fs::path output_;
    Row smooth_;
    std::vector<Row> peers_;
    std::vector<double> cholmod_steps_;
};

}  // namespace

Table whole_run_table(std::ostream& out)
{
    out << "seconds from file to file, medians of the turns, and of the phases of smooth; MB: of the file, and peak "
           "memory; ratio: in the time of smooth\n"
           "V_mean, V_max: distance of smooth to the undecomposed flow in mean edge lengths; peers are at least as "
           "near\n\n";
    return {out,
            {{"mesh", "mesh", 20},
             {"vertices", "vertices", 9},
             {"format", "file", 4},
             {"file_mb", "MB", 8},
             {"dt_over_h2", "dt", 5},
             {"steps", "steps", 5},
             {"method", "method", 15},
             {"tolerance", "to", 6},
             {"all_s", "all", 8},
             {"ratio", "ratio", 6},
             {"us_per_vertex", "us/vertex", 9},
             {"bytes_per_vertex", "bytes/vertex", 12},
             {"peak_memory_mb", "MB", 8},
             {"v_mean", "V_mean", 9},
             {"v_max", "V_max", 9},
             {"read", "read", 8},
             {"cut", "cut", 8},
             {"analyse", "analyse", 8},
             {"steps_s", "steps", 8},
             {"write", "write", 8},
             {"rest", "rest", 8}}};
}

void add_whole_run(Table& table, const WholeRunInput& input, const FlowOptions& flow, double time_step_edges,
                   const GridOptions& options)
{
    GridOptions once = options;
    once.turns = 1;
    WholeRunner runner(input, flow, time_step_edges, once);
    for (int turn = 0; turn < options.turns; ++turn)
        runner.take_turn();
    const Json head{{"mesh", input.name},
                    {"vertices", input.mesh.n_vertices()},
                    {"format", input.format},
                    {"file_mb", 1e-6 * static_cast<double>(runner.file_bytes())},
                    {"dt_over_h2", time_step_edges},
                    {"steps", flow.steps}};
    const auto add = [&](const Json& row, const std::vector<double>& turns, double smooth) {
        Json json = head;
        json.update(row);
        json["all_s"] = median(turns);
        json["turns_s"] = turns;
        json["ratio"] = median(turns) / smooth;
        table.add(std::move(json));
    };
    Json phases = runner.phases();
    const Row& smooth = runner.smooth();
    const double seconds = smooth.seconds();
    const double bytes = static_cast<double>(smooth.result.peak_memory_bytes);
    const double n = input.mesh.n_vertices();
    Json json{{"method", "smooth"},
              {"us_per_vertex", 1e6 * seconds / n},
              {"bytes_per_vertex", bytes / n},
              {"peak_memory_mb", 1e-6 * bytes}};
    if (smooth.v_max)
        json.update(Json{{"v_mean", *smooth.v_mean}, {"v_max", *smooth.v_max}});
    json.update(phases);
    add(json, smooth.turns, seconds);
    for (const Row& peer : runner.peers())
        add(peer.json(), peer.turns, seconds);
    if (!runner.cholmod_steps().empty())
        add(Json{{"method", "step of cholmod"}}, runner.cholmod_steps(), seconds);
}

}  // namespace seamflow
