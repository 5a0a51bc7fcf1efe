#include "tests/support/random_flows.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/explicit_flow.h"
#include "engine/flow_identity.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/topology.h"
#include "tests/support/flows.h"

namespace seamflow::test {

namespace {

template <class Value>
Value one_of(std::initializer_list<Value> values, RandomNumbers& random)
{
    return *(values.begin() + random.below(static_cast<int>(values.size())));
}

bool is_closed(const PolygonMesh& mesh)
{
    const Topology topology = make_topology(mesh);
    return std::none_of(topology.twin.begin(), topology.twin.end(), [](Index twin) { return twin < 0; });
}

void choose_cut(const PolygonMesh& mesh, RandomNumbers& random, FlowOptions& options)
{
    const double kind = random.unit();
    if (kind < 0.4)
        options.labels = random_cut(mesh, 2 + random.below(9), random);
    else
        options.subdomains = kind < 0.85 ? random.below(16) : 1;
    options.coloring = one_of({Coloring::Greedy, Coloring::Greedy, Coloring::Label}, random);
}

void choose_robin(RandomNumbers& random, FlowOptions& options)
{
    if (random.unit() < 0.5)
        options.p = power_of_ten(-1.0, 1.0, random) / std::sqrt(options.time_step);
    options.p_rule = one_of({PRule::Paper, PRule::InverseStep}, random);
    options.p_edge = one_of({PEdge::Automatic, PEdge::Minimum, PEdge::Mean}, random);
}

void choose_sweeps(RandomNumbers& random, FlowOptions& options)
{
    options.approach = Approach::Sweep;
    options.sweep = one_of({Sweep::Automatic, Sweep::Fixed, Sweep::Alternating}, random);
    options.correction = one_of({Correction::Automatic, Correction::None}, random);
    switch (random.below(6)) {
    case 0:
        options.conditions = Conditions::Schwarz;
        options.overlap = 1 + random.below(3);
        options.sweep = Sweep::Fixed;
        break;
    case 1:
        options.conditions = one_of({Conditions::Robin, Conditions::Ventcell}, random);
        options.keep_gaps = random.unit() < 0.3;
        choose_robin(random, options);
        break;
    case 2:
        options.conditions = Conditions::AdaptedVentcell;
        choose_robin(random, options);
        break;
    case 3:
        options.transmission = Transmission::Derivative;
        choose_robin(random, options);
        break;
    default:
        break;
    }
    if (options.conditions == Conditions::AdaptedVentcell || options.conditions == Conditions::Ventcell)
        options.q = power_of_ten(-2.0, 0.0, random);
}

void choose_approach(const PolygonMesh& mesh, RandomNumbers& random, FlowOptions& options)
{
    const double kind = random.unit();
    if (kind < 0.45)
        choose_sweeps(random, options);
    else if (kind < 0.75) {
        options.coloring = Coloring::Greedy;
        options.tolerance = power_of_ten(-11.0, -1.0, random);
        options.converge_iterations = random.unit() < 0.1 ? random.below(4) : 300;
    } else if (kind < 0.85) {
        options.scheme = Scheme::ExplicitEuler;
        const double limit = largest_explicit_step(mesh, make_topology(mesh), mesh.vertices);
        if (std::isfinite(limit))
            options.time_step = 0.25 * limit * power_of_ten(-2.0, 0.0, random);
    } else if (kind < 0.9) {
        FlowOptions plain = FlowOptions::plain();
        plain.laplacian = options.laplacian;
        plain.time_step = options.time_step;
        plain.steps = options.steps;
        plain.subdomains = options.subdomains;
        plain.labels = options.labels;
        options = plain;
    }
}

void choose_constraints(const PolygonMesh& mesh, RandomNumbers& random, FlowOptions& options)
{
    const bool can_be_free = options.laplacian != Laplacian::PtackovaVelho && options.approach == Approach::Automatic;
    if (random.unit() < (can_be_free ? 0.3 : 0.02))
        options.boundary = Boundary::Free;
    if (random.unit() < 0.15 && (options.boundary == Boundary::Free || is_closed(mesh) || random.unit() < 0.05))
        options.rescale = is_closed(mesh) && random.unit() < 0.5 ? Rescale::Volume : Rescale::Area;
    if (random.unit() < 0.2 && (options.rescale == Rescale::None || random.unit() < 0.05))
        for (int i = random.below(20); i >= 0; --i)
            options.fixed_vertices.push_back(random.below(mesh.n_vertices()));
    options.strict = random.unit() < 0.05;
    options.reference = random.unit() < 0.1;
    options.record_schedule = random.unit() < 0.1;
}

}  // namespace

FlowOptions random_options(const PolygonMesh& mesh, RandomNumbers& random)
{
    FlowOptions options;
    options.laplacian = all_laplacians.at(at(random.below(3)));
    const double edge = mean_edge_length(mesh, mesh.vertices);
    options.time_step = edge * edge * power_of_ten(-3.0, 3.0, random);
    options.steps = 1 + random.below(3);
    choose_cut(mesh, random, options);
    choose_approach(mesh, random, options);
    choose_constraints(mesh, random, options);
    return options;
}

RandomFlow random_flow(std::uint32_t seed)
{
    RandomNumbers random(seed);
    RandomFlow flow{.input = random_mesh(random), .options = {}};
    flow.options = random_options(flow.input.mesh, random);
    return flow;
}

std::string RandomFlow::description() const
{
    const auto is_sound = input.soundness == Soundness::Sound;
    std::string text = std::to_string(input.mesh.n_vertices()) + " vertices, " + std::to_string(input.mesh.n_faces()) +
                       " faces" + (is_sound ? "" : ", hard") + ": " + input.description + ";";
    const FlowIdentity here = identify(input.mesh, options);
    const FlowIdentity defaults = identify(input.mesh, FlowOptions{});
    for (std::size_t i = 0; i < here.entries.size(); ++i)
        if (here.entries[i].value != defaults.entries[i].value)
            text += " " + here.entries[i].name + " " + here.entries[i].value;
    return text + " steps " + std::to_string(options.steps) + (options.strict ? " strict" : "") +
           (options.keep_gaps ? " keep_gaps" : "");
}

}  // namespace seamflow::test
