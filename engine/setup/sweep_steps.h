#pragma once

#include <memory>
#include <variant>

#include "engine/options/approach.h"
#include "partition/decomposition/sub_mesh.h"
#include "solvers/conditions/robin_edge.h"
#include "solvers/conditions/transmission_condition.h"

/// The settings of sweeps, as decided before the first step: nothing in them is left open.
namespace seamflow {

/// p* of the paper (eqs. 26 and 27), for each sub-mesh.
struct OptimalRobin {
    /// η of eq. 26.
    double eta = 1.0;
    PEdge edge = PEdge::Automatic;
};

/// The Robin parameter: a given one, in 1/length, or p*.
using RobinChoice = std::variant<OptimalRobin, double>;

/// Adapted Robin conditions with a prediction of the other side of Γ (see Transmission::Predicted).
struct PredictedTransmission {};

/// Adapted Robin or Ventcell conditions with derivatives at Vᵏ.
struct AdaptedConditions {
    RobinChoice p;
    /// The Ventcell parameter, without dimension; 0: Robin conditions.
    double q = 0.0;
};

/// Classical Robin or Ventcell conditions: every sub-mesh has its own copy of Γ.
struct ClassicalConditions {
    RobinChoice p;
    /// The Ventcell parameter, without dimension; 0: Robin conditions.
    double q = 0.0;
    /// See ReportOptions::keep_gaps.
    bool keeps_gaps = false;
};

/// The alternating Schwarz method.
struct SchwarzConditions {
    /// The layers of faces by which sub-meshes overlap.
    int overlap = 1;
};

/// Conditions that a caller supplies as a function. Sub-meshes share Γ, as with adapted conditions. Ranks do not share
/// the steps: a function has another address in each process.
struct OwnConditions {
    /// Makes the rows of a sub-mesh where it leads on Γ; not null. The sub-mesh outlives them; its `twin` is empty by
    /// then.
    std::unique_ptr<TransmissionCondition> (*make)(const SubMesh& sub_mesh);
    /// The parameter that the rows get (see TransmissionCondition::begin_step).
    RobinChoice p = 0.0;
};

/// Makes conditions of the class Condition, for OwnConditions.
template <class Condition>
std::unique_ptr<TransmissionCondition> make_condition(const SubMesh& sub_mesh)
{
    return std::make_unique<Condition>(sub_mesh);
}

/// The conditions on Γ in a sweep.
using InterfaceConditions =
    std::variant<PredictedTransmission, AdaptedConditions, ClassicalConditions, SchwarzConditions, OwnConditions>;

/// One sweep over the colours of the sub-meshes.
struct SweepSteps {
    static constexpr Approach approach = Approach::Sweep;
    static constexpr bool is_whole = false;

    InterfaceConditions conditions;
    /// Whether each sub-mesh has its own number as its colour, so that they solve one after another, 0 first; otherwise
    /// colours are chosen.
    bool solves_in_order_of_numbers = false;
    /// Whether every other sweep goes backward.
    bool alternates = false;
    /// Whether vertices of Γ move to the centroids of their neighbours after a step.
    bool corrects = false;
};

/// Whether every sub-mesh has its own copy of Γ.
inline bool have_copies(const InterfaceConditions& conditions)
{
    return std::holds_alternative<ClassicalConditions>(conditions);
}

/// Whether sub-meshes predict the other side of Γ.
inline bool predict(const InterfaceConditions& conditions)
{
    return std::holds_alternative<PredictedTransmission>(conditions);
}

}  // namespace seamflow
