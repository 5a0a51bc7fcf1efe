#include "samples/benchmark/benchmark_command.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "engine/options/valid_options.h"
#include "partition/errors.h"
#include "samples/command/command_line.h"
#include "samples/command/flow_choices.h"
#include "samples/files/output_files.h"
#include "samples/meshes/meshes.h"

namespace seamflow {

namespace {

struct Peer {
    std::string_view name;
    Method method;
};

constexpr std::array<Peer, 10> known_peers{{{"cholmod", Method::Cholmod},
                                            {"umfpack", Method::Umfpack},
                                            {"cg", Method::Krylov},
                                            {"cg-ic", Method::KrylovIncomplete},
                                            {"amg", Method::Amg},
                                            {"cgal", Method::SmoothShape},
                                            {"sweep", Method::OurSweep},
                                            {"converged", Method::OurConverged},
                                            {"our-cg", Method::OurCg},
                                            {"undecomposed", Method::Undecomposed}}};

constexpr Index smallest_of_scaling = 10'000;
constexpr Index largest_of_scaling = 10'000'000;
constexpr Index most_vertices = 100'000'000;

void add_mesh_options(CLI::App& app, BenchmarkCommand& command)
{
    auto* vertices = add_integer(app, "--vertices", command.vertices, 100,
                                 "about so many, of the mesh that is made; with --scaling and --grid of the largest "
                                 "one [100000; with --scaling 10000000]");
    std::vector<std::pair<std::string, std::string>> kinds;
    for (const MeshKind& kind : mesh_kinds())
        if (!kind.has_cells)
            kinds.emplace_back(kind.name, kind.name);
    auto* kind = add_choice<std::string>(app, "--kind", command.kind, kinds, "of mesh that is made [triangles]");
    kind->type_name("KIND");
    app.add_option("--mesh", command.mesh, "mesh to read instead: " + extensions_of())
        ->excludes(vertices)
        ->excludes(kind)
        ->type_name("FILE");
}

void add_flow_options(CLI::App& app, BenchmarkCommand& command)
{
    FlowOptions& flow = command.options.flow;
    add_field(app, flow, "--laplacian", "discrete Laplacian [fujiwara]");
    add_real(app, "--time-step-edges", command.time_step_edges, positive(), "in squared mean edge lengths [5]");
    add_integer(app, "--steps", flow.steps, 1, "number of steps [5]");
    add_field(app, flow, "--subdomains", "number of sub-meshes of ours; 0: chosen [0]");
    add_field(app, flow, "--conditions", "what holds between sub-meshes of ours [adapted-robin]");
    add_field(app, flow, "--q", "Ventcell parameter of ours, for adapted-ventcell and ventcell");
    add_field(app, flow, "--memory-limit",
              "most that the factorisations of ours may take at once: 500M, 2GiB [as much as is fast]\n"
              "In bytes or with K, M, G, KiB, MiB, GiB. Converged steps make twice what they cannot keep. By default "
              "sweeps take as little as keeps all threads busy; converged steps and --simulate-threads have no limit.");
    add_converge(app, flow,
                 "ours by converged steps, to this relative residual; never: by sweeps; auto: as the library decides "
                 "[auto]");
    add_field(app, flow, "--tune-for", "the number of cores for which ours chooses its approach [2]");
    add_field(app, flow, "--threads", "number of threads, at most 1024; 0: all cores [0; with --simulate-threads 1]");
}

void require_consistent(const CLI::App& app, const BenchmarkCommand& command)
{
    require_valid(command.options.flow);
    const bool has_sizes = app.count("--scaling") + app.count("--grid") > 0;
    if (has_sizes && app.count("--vertices") > 0 && command.vertices < smallest_of_scaling)
        throw OptionError("--scaling and --grid begin with " + std::to_string(smallest_of_scaling) +
                          " vertices; --vertices is the largest number and must be no less");
    const bool equals_accuracy =
        app.count("--grid") > 0 || (app.count("--whole-run") > 0 && !command.options.peers.empty());
    if (command.mode == BenchmarkMode::Explain && !is_symmetric(command.options.flow.laplacian))
        throw OptionError("--explain: there is no choice for a Laplacian that is not symmetric");
    if (equals_accuracy && command.options.reference == Reference::None)
        throw OptionError("peers of equal accuracy need a --reference");
    if (command.vertices > most_vertices)
        throw OptionError("--vertices must be at most " + std::to_string(most_vertices));
    if (!command.json.empty())
        require_writable(command.json);
    if (command.export_folder.empty())
        return;
    std::error_code error;
    std::filesystem::create_directories(command.export_folder, error);
    if (error)
        throw OutputError(command.export_folder.string() + ": cannot be created: " + error.message());
    require_writable(command.export_folder / "system.mtx");
}

/// More threads than cores would delay each other, as the recorded times would show. Tasks wait only for each other,
/// not for memory.
void prepare_simulation(const CLI::App& app, std::string_view threads, BenchmarkCommand& command)
{
    command.mode = BenchmarkMode::SimulateThreads;
    command.options.simulated_threads = numbers_named(threads, "--simulate-threads");
    FlowOptions& flow = command.options.flow;
    if (app.count("--threads") == 0)
        flow.resources.threads = 1;
    if (!flow.resources.memory_limit)
        flow.resources.memory_limit = std::numeric_limits<std::size_t>::max();
}

/// Ranks share sweeps.
void prepare_ranks(std::string_view ranks, BenchmarkCommand& command)
{
    command.mode = BenchmarkMode::SimulateRanks;
    command.simulated_ranks = numbers_named(ranks, "--simulate-ranks");
    AccuracyOptions& accuracy = command.options.flow.accuracy;
    accuracy.approach = accuracy.tolerance ? Approach::Converged : Approach::Sweep;
}

/// Δ_F has no areas for masses.
void prepare_k_harmonic(const CLI::App& app, std::string_view orders, BenchmarkCommand& command)
{
    command.mode = BenchmarkMode::KHarmonic;
    if (!orders.empty() && orders != "all")
        command.orders = numbers_named(orders, "--k-harmonic");
    if (std::ranges::any_of(command.orders, [](int k) { return k > 3; }))
        throw OptionError("--k-harmonic: k is 1, 2 or 3");
    Laplacian& laplacian = command.options.flow.laplacian;
    if (app.count("--laplacian") == 0)
        laplacian = Laplacian::AlexaWardetzky;
    if (laplacian != Laplacian::AlexaWardetzky && laplacian != Laplacian::VirtualRefinement)
        throw OptionError("--k-harmonic takes a Laplacian with areas for masses: alexa-wardetzky or "
                          "virtual-refinement");
}

/// A single value replaces an axis.
void prepare_grid(const CLI::App& app, BenchmarkCommand& command)
{
    command.mode = BenchmarkMode::Grid;
    // Without a file, the library supplies one without a name.
    std::erase(command.grid.files, std::filesystem::path());
    if (app.count("--kind") > 0)
        command.grid.kinds = {command.kind};
    if (app.count("--time-step-edges") > 0)
        command.grid.time_steps_edges = {command.time_step_edges};
    if (app.count("--steps") > 0)
        command.grid.steps = {command.options.flow.steps};
}

/// The peers of the comparison unless --peers is given.
const char* usual_peers(BenchmarkMode mode)
{
    if (mode == BenchmarkMode::Grid)
        return "cholmod,cg,amg";
    if (mode == BenchmarkMode::WholeRun)
        return "cholmod,cg";
    return mode == BenchmarkMode::Case ? "all" : "none";
}

}  // namespace

std::vector<Method> peers_named(std::string_view word)
{
    std::array<bool, known_peers.size()> wanted{};
    std::transform(known_peers.begin(), known_peers.end(), wanted.begin(),
                   [&](const Peer& peer) { return word == "all" && !is_ours(peer.method); });
    for (std::string_view rest = word; word != "all" && word != "none";) {
        const std::string_view name = rest.substr(0, rest.find(','));
        const auto found =
            std::find_if(known_peers.begin(), known_peers.end(), [&](const Peer& p) { return p.name == name; });
        if (found == known_peers.end())
            throw OptionError("--peers: \"" + std::string(name) +
                              "\" is not one of cholmod, umfpack, cg, cg-ic, amg, cgal, sweep, converged, our-cg, "
                              "undecomposed; or all, or none");
        wanted[static_cast<std::size_t>(found - known_peers.begin())] = true;
        if (name.size() == rest.size())
            break;
        rest.remove_prefix(name.size() + 1);
    }
    std::vector<Method> peers;
    for (std::size_t i = 0; i < known_peers.size(); ++i)
        if (wanted[i])
            peers.push_back(known_peers[i].method);
    return peers;
}

std::vector<int> numbers_named(std::string_view word, std::string_view option)
{
    std::vector<int> threads;
    if (word == "all") {
        for (int n = 1; n <= ResourceOptions::most_threads; n *= 2)
            threads.push_back(n);
        return threads;
    }
    try {
        for (std::size_t begin = 0, end = 0; end != std::string_view::npos; begin = end + 1) {
            end = word.find(',', begin);
            threads.push_back(
                static_cast<int>(parse_integer(word.substr(begin, end - begin), 1, ResourceOptions::most_threads)));
        }
    } catch (const OptionError& error) {
        throw OptionError(fmt::format("{}: {}; or all", option, error.what()));
    }
    return threads;
}

namespace {

/// The arguments for peers and modes, as given on the command line.
struct Words {
    std::string peers;
    std::string simulated_threads;
    std::string simulated_ranks;
    std::string orders;
};

void add_peers(CLI::App& app, Words& words, BenchmarkCommand& command)
{
    app.add_option("--peers", words.peers,
                   "all, none, or a list of those that ours is compared with [all but ours by name]\n"
                   "cholmod,umfpack,cg,cg-ic,amg,cgal, and of ours by an approach that is named: "
                   "sweep,converged,our-cg,undecomposed. By default with --grid cholmod,cg,amg, with --whole-run "
                   "cholmod,cg; none with --scaling, --threads-sweep, --simulate-threads and --simulate-ranks.")
        ->type_name("LIST");
    add_choice<Reference>(app, "--reference", command.options.reference,
                          {{"auto", Reference::Automatic},
                           {"direct", Reference::Direct},
                           {"iterative", Reference::Iterative},
                           {"none", Reference::None}},
                          "whose positions V_mean and V_max are measured from [auto]\n"
                          "direct: those of a factorisation of the whole mesh; iterative: of conjugate "
                          "gradients to 1e-12. auto: direct up to 2000000 vertices; none for sweeps "
                          "without peers.");
    app.add_option("--json", command.json, "also write the numbers")->type_name("FILE");
    app.add_option("--export", command.export_folder, "also write the first step's equations as Matrix Market files")
        ->type_name("DIR");
}

/// Adds the modes that replace a single case; each excludes the others, and options that have no meaning for it.
void add_modes(CLI::App& app, Words& words, BenchmarkCommand& command)
{
    const auto add_mode = [&](const std::string& name, BenchmarkMode mode, const std::string& text) {
        return app.add_flag_callback(
            name, [&command, mode] { command.mode = mode; }, text);
    };
    const auto exclude = [](CLI::Option* mode, std::initializer_list<std::string> others) {
        for (const std::string& other : others)
            mode->excludes(other);
    };
    exclude(add_mode("--scaling", BenchmarkMode::Scaling, "10^4, 10^5, … vertices"), {"--mesh", "--export"});
    exclude(add_mode("--threads-sweep", BenchmarkMode::ThreadsSweep, "ours with 1, 2, … threads"),
            {"--scaling", "--peers", "--export"});
    exclude(app.add_option("--simulate-threads", words.simulated_threads,
                           "ours, its tasks replayed with each of these numbers of threads: 1,2,8 or so, or all\n"
                           "The tasks are those of the median step; all: 1, 2, 4, … 1024. And what each approach would "
                           "take with as many cores.")
                ->type_name("LIST"),
            {"--scaling", "--threads-sweep", "--peers", "--export"});
    add_real(app, "--memory-bandwidth", command.memory_bandwidth, positive(),
             "with --simulate-threads: of the machine with those cores, in GB/s [as measured here]");
    exclude(app.add_option("--simulate-ranks", words.simulated_ranks,
                           "ours, shared by each of these numbers of ranks: their work and their messages\n"
                           "Ranks are threads of one process. A model predicts what follows for large meshes.")
                ->type_name("LIST"),
            {"--scaling", "--threads-sweep", "--simulate-threads", "--peers", "--export"});
    exclude(app.add_option("--grid", command.grid.files,
                           "which is the fastest at equal accuracy, set-up included, on many meshes and these\n"
                           "Triangles, quads, hexagons and mixed polygons (or --kind) of 10^4, 10^5, … vertices, and "
                           "these meshes; dt 1, 5, 50 and 500 (or --time-step-edges); 1, 3 and 10 steps (or --steps).")
                ->expected(0, -1)
                ->type_name("[FILE ...]"),
            {"--scaling", "--threads-sweep", "--simulate-threads", "--simulate-ranks", "--mesh", "--export"});
    exclude(add_mode("--explain", BenchmarkMode::Explain,
                     "the model of costs by which ours chooses how it takes its steps\n"
                     "Its constants, what it predicts for each approach, and what each takes."),
            {"--scaling", "--threads-sweep", "--grid", "--simulate-threads", "--simulate-ranks", "--peers",
             "--conditions", "--export"});
    exclude(
        app.add_option("--k-harmonic", words.orders,
                       "factor and solve time of k-harmonic steps for these k: 1,2 or so [1,2,3]\n"
                       "(M + dtᵏ K (M⁻¹ K)ᵏ⁻¹) u = M x, the problems of a public comparison of solvers for geometry, "
                       "with its measure of the error. Of alexa-wardetzky, unless --laplacian is "
                       "virtual-refinement.")
            ->expected(0, 1)
            ->type_name("[LIST]"),
        {"--scaling", "--threads-sweep", "--grid", "--explain", "--simulate-threads", "--simulate-ranks", "--peers",
         "--steps", "--converge", "--conditions", "--q", "--reference", "--export"});
    exclude(add_mode("--whole-run", BenchmarkMode::WholeRun,
                     "the program smooth from file to file, beside peers of equal accuracy and one step of cholmod\n"
                     "OBJ and PLY, or as --mesh is; peers go from file to file, too. With --scaling for 10^4, 10^5, … "
                     "vertices."),
            {"--threads-sweep", "--grid", "--explain", "--k-harmonic", "--simulate-threads", "--simulate-ranks",
             "--conditions", "--q", "--memory-limit", "--export"});
    add_integer(app, "--turns", command.turns, 1,
                "with --grid and --whole-run: how often what is compared is run, in turns [3]\n"
                "Medians count.");
}

/// Settles what follows from the options that were given.
void settle(const CLI::App& app, const Words& words, BenchmarkCommand& command)
{
    const auto is_given = [&](const char* option) { return app.count(option) > 0; };
    if (is_given("--simulate-threads"))
        prepare_simulation(app, words.simulated_threads, command);
    if (is_given("--simulate-ranks"))
        prepare_ranks(words.simulated_ranks, command);
    if (is_given("--k-harmonic"))
        prepare_k_harmonic(app, words.orders, command);
    if (is_given("--conditions"))
        command.options.flow.accuracy.approach = Approach::Sweep;
    if (is_given("--grid"))
        prepare_grid(app, command);
    if (is_given("--whole-run"))
        command.mode = is_given("--scaling") ? BenchmarkMode::WholeRunScaling : BenchmarkMode::WholeRun;
    if (is_given("--memory-bandwidth") && !is_given("--simulate-threads"))
        throw OptionError("--memory-bandwidth belongs to --simulate-threads");
    if (is_given("--turns") && !is_given("--grid") && !is_given("--whole-run"))
        throw OptionError("--turns belongs to --grid and --whole-run");
    command.options.peers = peers_named(!words.peers.empty() ? words.peers : usual_peers(command.mode));
    if (command.mode != BenchmarkMode::Case && command.mode != BenchmarkMode::Grid &&
        command.mode != BenchmarkMode::Explain && command.options.peers.empty() && !is_given("--reference"))
        command.options.reference = Reference::None;
    if (is_given("--scaling") && !is_given("--vertices"))
        command.vertices = largest_of_scaling;
    require_consistent(app, command);
    if (command.options.flow.resources.threads == 0)
        command.options.flow.resources.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace

std::optional<ExitStatus> parse_benchmark_command(int argc, char** argv, BenchmarkCommand& command)
{
    CLI::App app("Compares one implicit step of ours with what a user would run instead: time, memory and accuracy.",
                 "benchmark");
    Words words;
    command.options.flow.time_step = 1.0;
    command.options.flow.steps = 5;
    add_mesh_options(app, command);
    add_flow_options(app, command);
    add_peers(app, words, command);
    add_modes(app, words, command);
    app.footer("benchmark --vertices 100000             one step of ours beside CHOLMOD, UMFPACK, CG and others\n"
               "benchmark --whole-run --mesh scan.ply   whole programs from file to file\n"
               "benchmark --explain --mesh scan.ply     why smooth takes its steps as it does\n");
    if (const auto end = parse_command_line(app, argc, argv))
        return end;
    settle(app, words, command);
    return std::nullopt;
}

}  // namespace seamflow
