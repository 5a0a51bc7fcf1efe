#include "engine/steppers/switching_stepper.h"

#include <new>
#include <utility>

#include <fmt/format.h>

#include "engine/steppers/undecomposed_stepper.h"
#include "partition/errors.h"

namespace seamflow {

SwitchingStepper::SwitchingStepper(const PolygonMesh& mesh, const Topology& topology, const StepSettings& settings,
                                   const GradientSteps& gradients, Progress& progress)
    : mesh_(&mesh)
    , topology_(&topology)
    , settings_(settings)
    , size_(gradients.costs.value())
    , progress_(&progress)
    , gradients_(mesh, topology, settings, gradients.stop, progress)
    , iterations_{.most = gradients.stop.iterations}
{
}

/// Makes the factors of the whole mesh. If memory is lacking, the stepper continues without factors.
void SwitchingStepper::make_factors()
{
    try {
        try_to_make_factors();
    } catch (const ComputationError&) {
        leave_factors();
    } catch (const MemoryLimitError&) {
        leave_factors();
    } catch (const std::bad_alloc&) {
        leave_factors();
    }
}

/// Frees the factors, and records that making or using them failed in this step.
void SwitchingStepper::leave_factors()
{
    failed_ = n_taken_ + 1;
    factors_.reset();
    complete_ = {};
}

void SwitchingStepper::try_to_make_factors()
{
    // The flow has freed the twins of its topology: they are made again.
    complete_ = *topology_;
    complete_.twin = make_topology(*mesh_, progress_->exec()).twin;
    factors_ =
        make_undecomposed_stepper(*mesh_, complete_, settings_, {.most_iterations = iterations_.most}, *progress_);
}

/// Solves the step by the factors.
/// @returns the solution; null without factors.
const Points* SwitchingStepper::solve_by_factors(const Points& before)
{
    if (!factors_)
        return nullptr;
    try {
        factors_->set_positions(before, {});
        factors_->step(before);
        return &factors_->positions();
    } catch (const ComputationError&) {
        leave_factors();
        return nullptr;
    }
}

void SwitchingStepper::step(const Points& before)
{
    if (first_with_factors_ == 0 && n_taken_ >= 2 && pays_to_factorise(size_, iterations_)) {
        first_with_factors_ = n_taken_ + 1;
        make_factors();
    }
    gradients_.begin_with(solve_by_factors(before));
    gradients_.step(before);
    gradients_.begin_with(nullptr);
    ++n_taken_;
    StepReport report;
    gradients_.report_to(report);
    iterations_.before = std::exchange(iterations_.last, *report.iterations);
}

void SwitchingStepper::set_positions(const Points& image, const SimilarityOfComponents& similarity)
{
    gradients_.set_positions(image, similarity);
}

void SwitchingStepper::save(StepMemory& memory) const
{
    gradients_.save(memory);
    for (const int number : {iterations_.before, iterations_.last, n_taken_, first_with_factors_, failed_})
        memory.numbers.push_back(number);
}

void SwitchingStepper::restore(const StepMemory& memory)
{
    // `save` has appended the numbers of this class to those of gradients_.
    constexpr std::size_t n_own = 5;
    StepMemory of_gradients = memory;
    StepMemory own;
    while (own.numbers.size() < n_own && !of_gradients.numbers.empty()) {
        own.numbers.insert(own.numbers.begin(), of_gradients.numbers.back());
        of_gradients.numbers.pop_back();
    }
    gradients_.restore(of_gradients);
    StepMemoryReader reader(own);
    for (int* number : {&iterations_.before, &iterations_.last, &n_taken_, &first_with_factors_, &failed_})
        *number = reader.count();
    if (first_with_factors_ > 0 && failed_ == 0)
        make_factors();
}

void SwitchingStepper::add_seconds(PhaseSeconds& seconds) const
{
    gradients_.add_seconds(seconds);
    if (factors_)
        factors_->add_seconds(seconds);
}

void SwitchingStepper::report_to(FlowReport& report) const
{
    gradients_.report_to(report);
    if (factors_)
        factors_->add_seconds(report.seconds);
    if (first_with_factors_ > 0)
        report.choices.push_back(
            {"factorised from a step on",
             {{"step", first_with_factors_}},
             {fmt::format("From step {} on, conjugate gradients began with the solution by one factorisation: they had "
                          "come to need more and more iterations.",
                          first_with_factors_)}});
    if (failed_ > 0)
        report.choices.push_back(
            {"no factorisation",
             {{"step", failed_}},
             {fmt::format("In step {} there was none, because edges have shrunk to nothing or memory is too small: "
                          "conjugate gradients went on without it.",
                          failed_)}});
}

}  // namespace seamflow
