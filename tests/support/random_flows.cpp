#include "tests/support/random_flows.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "engine/options/option_table.h"
#include "engine/steppers/explicit_stepper.h"
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
        options.cut.labels = random_cut(mesh, 2 + random.below(9), random);
    else
        options.cut.subdomains = kind < 0.85 ? random.below(16) : 1;
    options.interface.colouring = one_of({Colouring::Greedy, Colouring::Greedy, Colouring::Label}, random);
}

void choose_robin(RandomNumbers& random, FlowOptions& options)
{
    if (random.unit() < 0.5)
        options.interface.p = power_of_ten(-1.0, 1.0, random) / std::sqrt(options.time_step);
    options.interface.p_rule = one_of({PRule::Paper, PRule::InverseStep}, random);
    options.interface.p_edge = one_of({PEdge::Automatic, PEdge::Minimum, PEdge::Mean}, random);
}

void choose_sweeps(RandomNumbers& random, FlowOptions& options)
{
    options.accuracy.approach = Approach::Sweep;
    options.interface.sweep = one_of({Sweep::Automatic, Sweep::Fixed, Sweep::Alternating}, random);
    options.interface.correction = one_of({Correction::Automatic, Correction::None}, random);
    switch (random.below(6)) {
    case 0:
        options.interface.conditions = Conditions::Schwarz;
        options.interface.overlap = 1 + random.below(3);
        options.interface.sweep = Sweep::Fixed;
        break;
    case 1:
        options.interface.conditions = one_of({Conditions::Robin, Conditions::Ventcell}, random);
        options.report.keep_gaps = random.unit() < 0.3;
        choose_robin(random, options);
        break;
    case 2:
        options.interface.conditions = Conditions::AdaptedVentcell;
        choose_robin(random, options);
        break;
    case 3:
        options.interface.transmission = Transmission::Derivative;
        choose_robin(random, options);
        break;
    default:
        break;
    }
    if (options.interface.conditions == Conditions::AdaptedVentcell ||
        options.interface.conditions == Conditions::Ventcell)
        options.interface.q = power_of_ten(-2.0, 0.0, random);
}

void choose_approach(const PolygonMesh& mesh, RandomNumbers& random, FlowOptions& options)
{
    const double kind = random.unit();
    if (kind < 0.45)
        choose_sweeps(random, options);
    else if (kind < 0.75) {
        options.interface.colouring = Colouring::Greedy;
        options.accuracy.tolerance = power_of_ten(-11.0, -1.0, random);
        options.accuracy.converge_iterations = random.unit() < 0.1 ? random.below(4) : 300;
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
        plain.cut.subdomains = options.cut.subdomains;
        plain.cut.labels = options.cut.labels;
        options = plain;
    }
}

void choose_constraints(const PolygonMesh& mesh, RandomNumbers& random, FlowOptions& options)
{
    const bool can_be_free =
        options.laplacian != Laplacian::PtackovaVelho && options.accuracy.approach == Approach::Automatic;
    if (random.unit() < (can_be_free ? 0.3 : 0.02))
        options.motion.boundary = Boundary::Free;
    if (random.unit() < 0.15 && (options.motion.boundary == Boundary::Free || is_closed(mesh) || random.unit() < 0.05))
        options.motion.rescale = is_closed(mesh) && random.unit() < 0.5 ? Rescale::Volume : Rescale::Area;
    if (random.unit() < 0.2 && (options.motion.rescale == Rescale::None || random.unit() < 0.05))
        for (int i = random.below(20); i >= 0; --i)
            options.motion.fixed_vertices.push_back(random.below(mesh.n_vertices()));
    options.motion.strict = random.unit() < 0.05;
    options.report.reference = random.unit() < 0.1;
    options.report.record_schedule = random.unit() < 0.1;
    if (random.unit() < 0.2)
        options.motion.junctions = Junctions::Hold;
}

}  // namespace

FlowOptions random_options(const PolygonMesh& mesh, RandomNumbers& random)
{
    FlowOptions options;
    options.laplacian = all_laplacians.at(usize(random.below(3)));
    const double edge = mean_edge_length(mesh, mesh.vertices);
    options.time_step = edge * edge * power_of_ten(-3.0, 3.0, random);
    options.steps = 1 + random.below(3);
    choose_cut(mesh, random, options);
    choose_approach(mesh, random, options);
    choose_constraints(mesh, random, options);
    return options;
}

/// The number of values of an array.
template <class Value>
std::string text_of(const Value& value)
{
    if constexpr (std::is_same_v<Value, Laplacian>)
        return std::string(name_of(value));
    else if constexpr (std::is_enum_v<Value>)
        return std::string(option_name(value));
    else if constexpr (std::is_arithmetic_v<Value>)
        return fmt::format("{}", value);
    else if constexpr (requires { value.value(); })
        return value ? text_of(*value) : "none";
    else if constexpr (requires { value.size(); })
        return fmt::format("({})", value.size());
    else
        return "set";
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
    for_each_option(options, FlowOptions{}, [&](const auto& row, const auto& by_default) {
        if (*row.value != *by_default.value)
            text += fmt::format(" {} {}", row.field, text_of(*row.value));
    });
    return text;
}

}  // namespace seamflow::test
