#include "samples/benchmark/benchmark_command.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <iterator>
#include <thread>

#include <fmt/format.h>

#include "engine/options/option_rules.h"
#include "engine/options/option_table.h"
#include "engine/options/valid_options.h"
#include "partition/errors.h"
#include "samples/command/command_line.h"
#include "samples/files/output_files.h"
#include "samples/meshes/meshes.h"
#include "samples/options/smooth_request.h"

namespace seamflow {

namespace {

constexpr std::array known_peers{Method::Cholmod, Method::Gradients, Method::Amg};
constexpr Index most_vertices = 100'000'000;

/// The words of the command line that stand for lists, and single values of axes.
struct Words {
    std::string kind = "triangles";
    std::filesystem::path mesh;
    double time_step_edges = 5.0;
    std::string peers;
    std::string orders;
};

void add_mesh_options(CLI::App& app, Words& words, BenchmarkCommand& command)
{
    auto* vertices = add_integer(app, "--vertices", command.vertices, 100,
                                 "about so many, of the mesh that is made; with --grid of the largest one [100000]");
    std::vector<std::pair<std::string, std::string>> kinds;
    for (const MeshKind& kind : mesh_kinds())
        if (!kind.has_cells)
            kinds.emplace_back(kind.name, kind.name);
    auto* kind = add_choice<std::string>(app, "--kind", words.kind, kinds, "of mesh that is made [triangles]");
    kind->type_name("KIND");
    app.add_option("--mesh", words.mesh, "mesh to read instead: " + extensions_of())
        ->excludes(vertices)
        ->excludes(kind)
        ->type_name("FILE");
}

/// Adds an option of a flow with another description.
/// @param name in the table of options, "--steps".
void add_field(CLI::App& app, FlowOptions& options, std::string_view name, const std::string& description)
{
    for_each_option(options, [&]<class Value>(const OptionRow<Value>& row) {
        if constexpr (IsReadable<Value>)
            if (row.option == name)
                add_reader(app, std::string(name), reader_of(*row.value, row.limits), description);
    });
}

void add_flow_options(CLI::App& app, Words& words, BenchmarkCommand& command)
{
    FlowOptions& flow = command.flow;
    NamedValues<Laplacian> laplacians;
    std::ranges::copy_if(laplacian_words(), std::back_inserter(laplacians), [](const auto& choice) {
        return choice.second == Laplacian::Fujiwara || choice.second == Laplacian::AlexaWardetzky ||
               choice.second == Laplacian::VirtualRefinement;
    });
    add_choice<Laplacian>(app, "--laplacian", flow.laplacian, laplacians, "discrete Laplacian [fujiwara]");
    add_real(app, "--time-step-edges", words.time_step_edges, positive(), "in squared mean edge lengths [5]");
    add_integer(app, "--steps", flow.steps, 1, "number of steps [5]");
    add_field(app, flow, "--subdomains", "number of sub-meshes of ours; 0: chosen [0]");
    add_field(app, flow, "--memory-limit",
              "most that the factorisations of ours may take at once: 500M, 2GiB [as much as is fast]\n"
              "In bytes or with K, M, G, KiB, MiB, GiB. Converged steps make twice what they cannot keep. By default "
              "sweeps take as little as keeps all threads busy; converged steps have no limit.");
    add_reader(app, "--converge", reader_of_convergence(flow.accuracy),
               "ours by converged steps, to this relative residual; never: by sweeps; auto: as the library decides "
               "[auto]\n"
               "Iterative peers then go to the same residual, without --grid and --whole-run.");
    add_field(app, flow, "--tune-for", "the number of cores for which ours chooses its approach [2]");
    add_field(app, flow, "--threads", "number of threads, at most 1024; 0: all cores [0]");
}

void add_peers(CLI::App& app, Words& words, BenchmarkCommand& command)
{
    app.add_option("--peers", words.peers,
                   "all, none, or a list of those that ours is compared with: cholmod,cg,amg [all]\n"
                   "By default with --whole-run cholmod,cg. With none the distance to the undecomposed flow is not "
                   "measured.")
        ->type_name("LIST");
    app.add_option("--json", command.json, "also write the rows of the table")->type_name("FILE");
}

/// Adds the modes; each excludes the others, and options that have no meaning for it.
void add_modes(CLI::App& app, Words& words, BenchmarkCommand& command)
{
    const auto exclude = [](CLI::Option* mode, std::initializer_list<std::string> others) {
        for (const std::string& other : others)
            mode->excludes(other);
    };
    const auto add_mode = [&](const std::string& name, BenchmarkMode mode, const std::string& text) {
        return app.add_flag_callback(
            name, [&command, mode] { command.mode = mode; }, text);
    };
    exclude(app.add_option("--grid", command.files,
                           "which is the fastest at equal accuracy, set-up included, on many meshes and these\n"
                           "Triangles, quads, hexagons and mixed polygons (or --kind) of 10^4, 10^5, … vertices, and "
                           "these meshes; dt 1, 5, 50 and 500 (or --time-step-edges); 1, 3 and 10 steps (or --steps).")
                ->expected(0, -1)
                ->type_name("[FILE ...]"),
            {"--mesh"});
    exclude(add_mode("--explain", BenchmarkMode::Explain,
                     "the model of costs by which ours chooses how it takes its steps\n"
                     "Its constants, what it predicts for each approach, and what each takes."),
            {"--grid", "--peers"});
    exclude(
        app.add_option("--k-harmonic", words.orders,
                       "factor and solve time of k-harmonic steps for these k: 1,2 or so [1,2,3]\n"
                       "(M + dtᵏ K (M⁻¹ K)ᵏ⁻¹) u = M x, the problems of a public comparison of solvers for geometry, "
                       "with its measure of the error. Of alexa-wardetzky, unless --laplacian is "
                       "virtual-refinement.")
            ->expected(0, 1)
            ->type_name("[LIST]"),
        {"--grid", "--explain", "--peers", "--steps", "--converge"});
    exclude(add_mode("--whole-run", BenchmarkMode::WholeRun,
                     "the program smooth from file to file, beside peers of equal accuracy and one step of cholmod\n"
                     "OBJ and PLY, or as --mesh is; peers go from file to file, too."),
            {"--grid", "--explain", "--k-harmonic", "--memory-limit"});
    add_integer(app, "--turns", command.turns, 1,
                "with --grid and --whole-run: how often what is compared is run, in turns [3]\n"
                "Medians count.");
}

/// The values of k that a word stands for. Δ_F has no areas for masses.
void settle_k_harmonic(const CLI::App& app, std::string_view orders, BenchmarkCommand& command)
{
    command.mode = BenchmarkMode::KHarmonic;
    command.steps = {1};
    if (!orders.empty())
        command.orders.clear();
    try {
        for (std::size_t begin = 0, end = 0; !orders.empty() && end != std::string_view::npos; begin = end + 1) {
            end = orders.find(',', begin);
            command.orders.push_back(static_cast<int>(parse_integer(orders.substr(begin, end - begin), 1, 3)));
        }
    } catch (const OptionError& error) {
        throw OptionError(fmt::format("--k-harmonic: {}", error.what()));
    }
    Laplacian& laplacian = command.flow.laplacian;
    if (app.count("--laplacian") == 0)
        laplacian = Laplacian::AlexaWardetzky;
}

/// A single value replaces an axis.
void settle_grid(const CLI::App& app, BenchmarkCommand& command)
{
    command.mode = BenchmarkMode::Grid;
    // Without a file, the library supplies one without a name.
    std::erase(command.files, std::filesystem::path());
    if (app.count("--kind") == 0)
        command.kinds = {"triangles", "quads", "hexagons", "mixed"};
    if (app.count("--time-step-edges") == 0)
        command.time_steps_edges = {1.0, 5.0, 50.0, 500.0};
    if (app.count("--steps") == 0)
        command.steps = {1, 3, 10};
}

bool takes_turns(const BenchmarkCommand& c)
{
    return c.mode == BenchmarkMode::Grid || c.mode == BenchmarkMode::WholeRun;
}

constexpr OptionRule<BenchmarkCommand> rules[]{
    {[](const BenchmarkCommand& c, const AskedOptions&) {
         return c.mode == BenchmarkMode::KHarmonic && c.flow.laplacian == Laplacian::Fujiwara;
     },
     0, "--k-harmonic takes a Laplacian with areas for masses: alexa-wardetzky or virtual-refinement"},
    {[](const BenchmarkCommand& c, const AskedOptions&) {
         return c.mode == BenchmarkMode::Grid && c.vertices < smallest_of_grid;
     },
     0, "--grid begins with 10000 vertices; --vertices is the largest number and must be no less"},
    {[](const BenchmarkCommand& c, const AskedOptions& asked) { return asked.has("--turns") && !takes_turns(c); }, 0,
     "--turns belongs to --grid and --whole-run"},
    {[](const BenchmarkCommand& c, const AskedOptions&) { return c.vertices > most_vertices; }, 0,
     "--vertices must be at most 100000000"},
};

/// Settles what follows from the options that were given.
void settle(const CLI::App& app, const Words& words, BenchmarkCommand& command)
{
    const auto is_given = [&](const char* option) { return app.count(option) > 0; };
    FlowOptions& flow = command.flow;
    command.time_steps_edges = {words.time_step_edges};
    command.steps = {flow.steps};
    command.kinds = {words.kind};
    if (is_given("--mesh")) {
        command.kinds.clear();
        command.files = {words.mesh};
    }
    if (is_given("--k-harmonic"))
        settle_k_harmonic(app, words.orders, command);
    if (is_given("--grid"))
        settle_grid(app, command);
    const AskedOptions asked{[&](std::string_view option) { return app.count(std::string(option)) > 0; }, {}};
    require_none_broken<BenchmarkCommand>(rules, command, asked, fill_other);
    if (!takes_turns(command))
        command.turns = 1;
    const char* const usual_peers = command.mode == BenchmarkMode::WholeRun ? "cholmod,cg" : "all";
    command.peers = peers_named(!words.peers.empty() ? words.peers : usual_peers);
    require_valid(flow);
    if (!command.json.empty())
        require_writable(command.json);
    if (flow.resources.threads == 0)
        flow.resources.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace

std::vector<Method> peers_named(std::string_view word)
{
    if (word == "none")
        return {};
    std::vector<Method> peers(known_peers.begin(), known_peers.end());
    if (word == "all")
        return peers;
    std::vector<Method> named;
    for (std::size_t begin = 0, end = 0; end != std::string_view::npos; begin = end + 1) {
        end = word.find(',', begin);
        const std::string_view name = word.substr(begin, end - begin);
        const auto found = std::ranges::find(known_peers, name, [](Method method) { return name_of(method); });
        if (found == known_peers.end())
            throw OptionError(fmt::format("--peers: \"{}\" is not one of cholmod, cg, amg; or all, or none", name));
        named.push_back(*found);
    }
    std::erase_if(peers, [&](Method peer) { return std::ranges::find(named, peer) == named.end(); });
    return peers;
}

std::optional<ExitStatus> parse_benchmark_command(int argc, char** argv, BenchmarkCommand& command)
{
    CLI::App app("Compares one implicit step of ours with what a user would run instead: time, memory and accuracy.",
                 "benchmark");
    Words words;
    command.flow.time_step = 1.0;
    command.flow.steps = 5;
    add_mesh_options(app, words, command);
    add_flow_options(app, words, command);
    add_peers(app, words, command);
    add_modes(app, words, command);
    app.footer("benchmark --vertices 100000             steps of ours beside CHOLMOD and conjugate gradients\n"
               "benchmark --whole-run --mesh scan.ply   whole programs from file to file\n"
               "benchmark --explain --mesh scan.ply     why smooth takes its steps as it does\n");
    if (const auto end = parse_command_line(app, argc, argv))
        return end;
    settle(app, words, command);
    return std::nullopt;
}

}  // namespace seamflow
