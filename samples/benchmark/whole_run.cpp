#include "samples/benchmark/whole_run.h"

#include <algorithm>
#include <fstream>
#include <ostream>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "samples/benchmark/case_json.h"
#include "samples/benchmark/grid_report.h"
#include "samples/benchmark/process.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The program in the folder of this one.
std::string path_of_smooth()
{
    return (fs::read_symlink("/proc/self/exe").parent_path() / "smooth").string();
}

std::vector<std::string> words_of_smooth(const fs::path& input, const fs::path& output, const WholeRun& run)
{
    const FlowOptions& flow = run.flow;
    std::vector<std::string> words{"smooth",
                                   input.string(),
                                   output.string(),
                                   "--laplacian",
                                   std::string(name_of(flow.laplacian)),
                                   "--time-step-edges",
                                   fmt::format("{}", run.time_step_edges),
                                   "--steps",
                                   std::to_string(flow.steps),
                                   "--threads",
                                   std::to_string(flow.resources.threads)};
    if (flow.cut.subdomains > 0)
        words.insert(words.end(), {"--subdomains", std::to_string(flow.cut.subdomains)});
    if (flow.accuracy.tolerance)
        words.insert(words.end(), {"--converge", fmt::format("{}", *flow.accuracy.tolerance)});
    else if (flow.accuracy.approach == Approach::Sweep)
        words.insert(words.end(), {"--converge", "never"});
    return words;
}

/// One run from file to file, in turn after turn.
class WholeRunner {
  public:
    WholeRunner(const GridRunner& grid, const fs::path& given, WholeRun& run)
        : grid_(grid)
        , run_(run)
        , input_(given.empty() ? grid.rows().scratch().path() / ("input." + run.format) : given)
        , output_(grid.rows().scratch().path() / ("output." + run.format))
    {
        if (given.empty())
            write_mesh(input_, grid.rows().mesh(), kind_for_writing(input_, FileKind{}));
        run_.file_bytes = fs::file_size(input_);
    }

    /// Leaves the output of `smooth`.
    void take_turn()
    {
        for (Row& peer : run_.peers) {
            if (peer.task.method == Method::Cholmod)
                run_cholmod_step();
            const Row row = grid_.rows().run(peer.task);
            require_success(row);
            peer.turns.seconds.push_back(row.result.process_seconds);
        }
        const ProcessEnd end = run_smooth({});
        run_.smooth.seconds.push_back(end.seconds);
        run_.peak_memory_bytes = end.peak_memory_bytes;
    }

    /// Phases of one more run, for a report. What that measures besides takes its time, so that the rest is that of the
    /// runs before.
    void note_phases()
    {
        const fs::path file = grid_.rows().scratch().path() / "report.json";
        run_smooth({"--report", file.string()});
        const Json seconds = Json::parse(std::ifstream(file)).at("seconds");
        WholeRunPhases& phases = run_.phases;
        seconds.at("read").get_to(phases.read);
        seconds.at("cut").get_to(phases.cut);
        seconds.at("analyse").get_to(phases.analyse);
        seconds.at("step").get_to(phases.steps);
        seconds.at("write").get_to(phases.write);
        phases.rest = std::max(
            run_.smooth.median() - phases.read - phases.cut - phases.analyse - phases.steps - phases.write, 0.0);
    }

    void add_peer(Row row)
    {
        row.task.input = input_;
        row.task.output = output_;
        row.turns.seconds.clear();
        run_.peers.push_back(std::move(row));
    }

    /// How close the output of `smooth` is to the undecomposed flow.
    void measure_output()
    {
        Row row;
        row.result.positions = read_mesh(output_).mesh.vertices;
        grid_.rows().measure(row);
        run_.v_max = row.v_max;
        run_.v_mean = row.v_mean;
    }

  private:
    ProcessEnd run_smooth(const std::vector<std::string>& further)
    {
        std::vector<std::string> words = words_of_smooth(input_, output_, run_);
        words.insert(words.end(), further.begin(), further.end());
        ProcessEnd end = run_process(path_of_smooth(), words, run_.flow.resources.threads);
        if (!end.failure.empty())
            throw ComputationError("smooth: " + end.failure);
        return end;
    }

    void run_cholmod_step()
    {
        FlowOptions flow = run_.flow;
        flow.steps = 1;
        const Row row = grid_.rows().run(MethodRows::task_of(Method::Cholmod, flow));
        require_success(row);
        run_.cholmod_step.seconds.push_back(row.result.step_seconds());
    }

    const GridRunner& grid_;
    WholeRun& run_;
    fs::path input_;
    fs::path output_;
};

Json phases_json(const WholeRunPhases& phases)
{
    return {{"read", phases.read},   {"cut", phases.cut},     {"analyse", phases.analyse},
            {"steps", phases.steps}, {"write", phases.write}, {"rest", phases.rest}};
}

void print_turns(std::ostream& out, const std::string& name, const Turns& turns, const Turns& smooth)
{
    out << fmt::format("{:<34} {:>9.4f} {:>9.4f} {:>9.2f}\n", name, turns.least(), turns.median(),
                       turns.median() / smooth.median());
}

}  // namespace

double WholeRun::ratio_to_cholmod_step() const
{
    return smooth.median() / cholmod_step.median();
}

WholeRun run_whole(const PolygonMesh& mesh, const fs::path& given, const std::string& format, const FlowOptions& flow,
                   double time_step_edges, const GridOptions& options)
{
    WholeRun run;
    run.vertices = mesh.n_vertices();
    run.flow = flow;
    run.time_step_edges = time_step_edges;
    run.format = format;
    GridOptions once = options;
    once.turns = 1;
    GridRunner grid(mesh, once);
    WholeRunner runner(grid, given, run);
    if (!options.peers.empty()) {
        const GridCell cell = grid.run(flow);
        for (const Row& peer : cell.peers)
            if (is_as_near(peer, cell.ours))
                runner.add_peer(peer);
    }
    for (int turn = 0; turn < options.turns; ++turn)
        runner.take_turn();
    runner.note_phases();
    runner.measure_output();
    return run;
}

void print_whole_run(std::ostream& out, const WholeRun& run)
{
    out << fmt::format("{}, {} vertices, {} of {:.1f} MB, {}, dt {} squared mean edge lengths, steps: {}, threads: {}, "
                       "turns: {}\n{:<34} {:>9} {:>9} {:>9}\n",
                       run.mesh, run.vertices, run.format, static_cast<double>(run.file_bytes) / 1e6,
                       name_of(run.flow.laplacian), run.time_step_edges, run.flow.steps, run.flow.resources.threads,
                       run.smooth.seconds.size(), "seconds, from file to file", "least", "median", "ratio");
    print_turns(out, "smooth", run.smooth, run.smooth);
    const WholeRunPhases& p = run.phases;
    for (const auto& [name, value] :
         {std::pair{"read", p.read}, std::pair{"cut", p.cut}, std::pair{"analyse", p.analyse},
          std::pair{"steps", p.steps}, std::pair{"write", p.write}, std::pair{"rest", p.rest}})
        out << fmt::format("  {:<32} {:>9.4f}\n", name, value);
    for (const Row& peer : run.peers)
        print_turns(out, name_with_tolerance(peer), peer.turns, run.smooth);
    if (!run.cholmod_step.seconds.empty()) {
        print_turns(out, "one step of cholmod, no files", run.cholmod_step, run.smooth);
        out << fmt::format("smooth takes {:.2f} of one step of cholmod\n", run.ratio_to_cholmod_step());
    }
    if (run.v_max)
        out << fmt::format("V_max {:.1e}, V_mean {:.1e} mean edge lengths; peers are at least as near\n", *run.v_max,
                           *run.v_mean);
    out << fmt::format("peak memory of smooth: {:.0f} MB\n", static_cast<double>(run.peak_memory_bytes) / 1e6)
        << std::endl;
}

Json whole_run_json(const WholeRun& run)
{
    Json json{{"mesh", run.mesh},
              {"vertices", run.vertices},
              {"format", run.format},
              {"file_bytes", run.file_bytes},
              {"laplacian", name_of(run.flow.laplacian)},
              {"dt_over_h2", run.time_step_edges},
              {"steps", run.flow.steps},
              {"threads", run.flow.resources.threads},
              {"smooth", turns_json(run.smooth)},
              {"phases", phases_json(run.phases)},
              {"peak_memory_bytes", run.peak_memory_bytes}};
    if (run.v_max) {
        json["v_max"] = *run.v_max;
        json["v_mean"] = *run.v_mean;
    }
    if (!run.cholmod_step.seconds.empty()) {
        json["cholmod_step"] = turns_json(run.cholmod_step);
        json["ratio_to_cholmod_step"] = run.ratio_to_cholmod_step();
    }
    json["peers"] = Json::object();
    for (const Row& peer : run.peers) {
        Json& row = json["peers"][peer.name] = row_json(peer);
        row["whole"] = turns_json(peer.turns);
    }
    return json;
}

}  // namespace seamflow
