#pragma once

#include <string_view>
#include <utility>

#include "engine/options/flow_options.h"
#include "partition/errors.h"

/// The names of the values of FlowOptions in command lines. There is no other list of them: a new value needs one line
/// here.
namespace seamflow {

template <class Option>
using NamedOption = std::pair<std::string_view, Option>;

/// A list for each option, in the order of `--help`.
template <class Option>
struct OptionNames;

template <>
struct OptionNames<Colouring> {
    static constexpr NamedOption<Colouring> list[]{{"greedy", Colouring::Greedy}, {"label", Colouring::Label}};
};

template <>
struct OptionNames<Conditions> {
    static constexpr NamedOption<Conditions> list[]{{"adapted-robin", Conditions::AdaptedRobin},
                                                    {"adapted-ventcell", Conditions::AdaptedVentcell},
                                                    {"robin", Conditions::Robin},
                                                    {"ventcell", Conditions::Ventcell},
                                                    {"schwarz", Conditions::Schwarz}};
};

template <>
struct OptionNames<FlowEquation> {
    static constexpr NamedOption<FlowEquation> list[]{{"mean-curvature", FlowEquation::MeanCurvature},
                                                      {"conformalized", FlowEquation::Conformalized},
                                                      {"linear", FlowEquation::Linear}};
};

template <>
struct OptionNames<Filter> {
    static constexpr NamedOption<Filter> list[]{{"diffusion", Filter::Diffusion}, {"low-pass", Filter::LowPass}};
};

template <>
struct OptionNames<Scheme> {
    static constexpr NamedOption<Scheme> list[]{{"implicit", Scheme::BackwardEuler},
                                                {"explicit", Scheme::ExplicitEuler}};
};

template <>
struct OptionNames<PRule> {
    static constexpr NamedOption<PRule> list[]{{"paper", PRule::Paper}, {"inverse-step", PRule::InverseStep}};
};

template <>
struct OptionNames<PEdge> {
    static constexpr NamedOption<PEdge> list[]{
        {"auto", PEdge::Automatic}, {"min", PEdge::Minimum}, {"percentile", PEdge::Percentile}, {"mean", PEdge::Mean}};
};

template <>
struct OptionNames<Transmission> {
    static constexpr NamedOption<Transmission> list[]{{"predicted", Transmission::Predicted},
                                                      {"derivative", Transmission::Derivative}};
};

template <>
struct OptionNames<Sweep> {
    static constexpr NamedOption<Sweep> list[]{
        {"auto", Sweep::Automatic}, {"fixed", Sweep::Fixed}, {"alternating", Sweep::Alternating}};
};

template <>
struct OptionNames<Correction> {
    static constexpr NamedOption<Correction> list[]{
        {"auto", Correction::Automatic}, {"centroid", Correction::Centroid}, {"none", Correction::None}};
};

template <>
struct OptionNames<Boundary> {
    static constexpr NamedOption<Boundary> list[]{{"fixed", Boundary::Fixed}, {"free", Boundary::Free}};
};

template <>
struct OptionNames<Junctions> {
    static constexpr NamedOption<Junctions> list[]{{"flow", Junctions::Flow}, {"hold", Junctions::Hold}};
};

template <>
struct OptionNames<Rescale> {
    static constexpr NamedOption<Rescale> list[]{
        {"none", Rescale::None}, {"area", Rescale::Area}, {"volume", Rescale::Volume}};
};

template <>
struct OptionNames<Approach> {
    static constexpr NamedOption<Approach> list[]{
        {"auto", Approach::Automatic},        {"decomposed", Approach::Decomposed},
        {"sweep", Approach::Sweep},           {"converged", Approach::Converged},
        {"cg", Approach::ConjugateGradients}, {"undecomposed", Approach::Undecomposed}};
};

template <>
struct OptionNames<Factorisation> {
    static constexpr NamedOption<Factorisation> list[]{{"auto", Factorisation::Automatic},
                                                       {"own", Factorisation::Own},
                                                       {"cholmod", Factorisation::Cholmod},
                                                       {"umfpack", Factorisation::Umfpack}};
};

template <>
struct OptionNames<Precision> {
    static constexpr NamedOption<Precision> list[]{
        {"auto", Precision::Automatic}, {"single", Precision::Single}, {"double", Precision::Double}};
};

/// The name of a value.
/// @throws OptionError for an invalid value.
template <class Option>
std::string_view option_name(Option value)
{
    for (const auto& [name, named] : OptionNames<Option>::list)
        if (named == value)
            return name;
    throw OptionError("an option has a value that has no name");
}

}  // namespace seamflow
