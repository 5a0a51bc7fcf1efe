#include "engine/flow_options.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "partition/errors.h"

namespace seamflow {

namespace {

template <class Value>
void require(bool holds, const char* field, Value value, const char* limits)
{
    if (holds)
        return;
    std::ostringstream message;
    message.precision(17);
    message << field << " is " << value << ", but must be " << limits;
    throw OptionError(message.str());
}

bool positive_and_finite(double value)
{
    return value > 0.0 && std::isfinite(value);
}

void require_valid_schwarz(const FlowOptions& options)
{
    if (options.sweep == Sweep::Alternating)
        throw OptionError("sweep is alternating, but with the Schwarz conditions sub-meshes overlap for one order of "
                          "solving only: leave the sweep fixed");
    if (options.p)
        throw OptionError("p is given, but the Schwarz conditions have no Robin parameter");
}

void require_valid_copies(const FlowOptions& options)
{
    if (is_classical(options.conditions) && options.correction == Correction::Centroid)
        throw OptionError(
            "correction is centroid, but with the classical conditions every sub-mesh has an interface of "
            "its own: leave it uncorrected");
    if (!options.keep_gaps)
        return;
    if (!is_classical(options.conditions))
        throw OptionError(
            "keep_gaps is for the classical Robin and Ventcell conditions; with others there are no gaps");
    if (options.scheme == Scheme::ExplicitEuler)
        throw OptionError("keep_gaps is for backward Euler steps; explicit ones are taken undecomposed, without gaps");
}

void require_valid_tolerance(const FlowOptions& options)
{
    require(options.converge_iterations >= 0, "converge_iterations", options.converge_iterations, "at least 0");
    if (!options.tolerance)
        return;
    require(positive_and_finite(*options.tolerance) && *options.tolerance < 1.0, "tolerance", *options.tolerance,
            "positive and below 1 (residual against that at the beginning of a step)");
    if (options.conditions != Conditions::AdaptedRobin || options.scheme == Scheme::ExplicitEuler)
        throw OptionError("tolerance is given, which leaves no room for other conditions or an explicit scheme");
}

void require_valid_constraints(const FlowOptions& options)
{
    if (options.boundary == Boundary::Free && options.laplacian == Laplacian::PtackovaVelho)
        throw OptionError("boundary is free, but the Laplacian ptackova-velho has no natural boundary conditions (its "
                          "rows there are one-sided and unstable): use fujiwara or alexa-wardetzky, or leave the "
                          "boundary fixed");
    if (options.rescale != Rescale::None && options.keep_gaps)
        throw OptionError("rescale is for results in one piece; keep_gaps leaves the sub-meshes unjoined");
    if (options.rescale != Rescale::None && !options.fixed_vertices.empty())
        throw OptionError("rescale moves every vertex, but fixed_vertices are to stay: leave one of them out");
}

bool has_tangential_derivative(Conditions conditions)
{
    return conditions == Conditions::AdaptedVentcell || conditions == Conditions::Ventcell;
}

}  // namespace

bool is_classical(Conditions conditions)
{
    return conditions == Conditions::Robin || conditions == Conditions::Ventcell;
}

FlowOptions FlowOptions::plain()
{
    FlowOptions options;
    options.approach = Approach::Sweep;
    options.sweep = Sweep::Fixed;
    options.transmission = Transmission::Derivative;
    options.p_edge = PEdge::Minimum;
    return options;
}

void require_valid(const FlowOptions& options)
{
    require(positive_and_finite(options.time_step), "time_step", options.time_step, "positive and finite (length²)");
    require(options.steps >= 0 && options.steps <= FlowOptions::most_steps, "steps", options.steps,
            "at least 0 and at most 1000000000");
    require(options.subdomains >= 0, "subdomains", options.subdomains, "at least 0 (0: chosen)");
    require(options.threads >= 0 && options.threads <= FlowOptions::most_threads, "threads", options.threads,
            "at least 0 and at most 1024 (0: as many as the calling TBB arena has)");
    if (options.p)
        require(positive_and_finite(*options.p), "p", *options.p, "positive and finite (1/length)");
    if (options.q)
        require(*options.q >= 0.0 && std::isfinite(*options.q), "q", *options.q, "at least 0 and finite");
    if (options.q.has_value() != has_tangential_derivative(options.conditions))
        throw OptionError(options.q ? "q is given, but belongs to the Ventcell conditions alone"
                                    : "q must be given with the Ventcell conditions");
    require(options.overlap >= 1, "overlap", options.overlap, "at least 1 (layers of faces)");
    if (options.memory_limit)
        require(*options.memory_limit >= 1, "memory_limit", *options.memory_limit, "at least 1 (byte)");
    require(options.largest_update > 0.0, "largest_update", options.largest_update,
            "positive (diagonals of the mesh's bounding box; infinite: no limit)");
    if (options.conditions == Conditions::Schwarz)
        require_valid_schwarz(options);
    require_valid_copies(options);
    require_valid_constraints(options);
    require_valid_tolerance(options);
    const auto negative =
        std::find_if(options.labels.begin(), options.labels.end(), [](Index label) { return label < 0; });
    if (negative != options.labels.end())
        throw InputError("the label of face " + std::to_string(negative - options.labels.begin()) + " is " +
                         std::to_string(*negative) + ", but labels must be at least 0");
}

}  // namespace seamflow
