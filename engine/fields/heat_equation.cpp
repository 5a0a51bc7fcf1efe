#include "engine/fields/heat_equation.h"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "engine/fields/heat_steps.h"
#include "engine/options/option_rule.h"
#include "engine/options/valid_options.h"
#include "engine/setup/resolved_options.h"
#include "engine/tasks/failure_guard.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"

namespace seamflow {

/// The steps, on threads of their own.
class HeatEquation::Session {
  public:
    Session(PolygonMesh& surface, const FlowOptions& options, Weights weights, const FlowControl& control,
            FlowReport& report)
        : workers_(options.resources.threads)
        , progress_(control)
    {
        report.resources.threads = workers_.threads();
        workers_.execute([&] { steps_.emplace(surface, options, weights, control, progress_, report); });
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Destroyed on the threads on which the members were made, because each thread has memory of its own.
    ~Session()
    {
        workers_.execute([&] { steps_.reset(); });
    }

    /// Calls action(steps). If the action throws OptionError or InputError, it has changed nothing.
    template <class Action>
    void change(Action&& action)
    {
        guard_.run_checked([&] { workers_.execute([&] { action(*steps_); }); });
    }

    void complete(FlowReport& report)
    {
        workers_.execute([&] { steps_->complete(report); });
    }

  private:
    Workers workers_;
    Progress progress_;
    std::optional<HeatSteps> steps_;
    FailureGuard guard_;
};

HeatEquation::HeatEquation(PolygonMesh surface, const FlowOptions& options, Weights weights, FlowControl control)
    : surface_(std::move(surface))
    , control_(std::move(control))
{
    if (options.flow != FlowEquation::Linear)
        throw OptionError("only linear flows are applied to fields: their matrix stays the same");
    if (control_.resume != nullptr)
        refuse("fields have no state to resume from: leave it out");
    require_valid(options);
    session_ = std::make_unique<Session>(surface_, resolved(options, surface_), weights, control_, report_);
}

HeatEquation::~HeatEquation() = default;

/// @throws InputError if the fields cannot be used.
void HeatEquation::require_fields(const Eigen::Ref<const Eigen::MatrixXd>& fields) const
{
    if (fields.rows() != report_.mesh.vertices)
        throw InputError(fmt::format("the fields have {} rows, but the mesh has {} vertices: give one for each",
                                     fields.rows(), report_.mesh.vertices));
    for (Eigen::Index c = 0; c < fields.cols(); ++c)
        for (Eigen::Index v = 0; v < fields.rows(); ++v)
            if (!std::isfinite(fields(v, c)))
                throw InputError(fmt::format("column {} of the fields is not finite at vertex {} (both numbered from "
                                             "0): fields need a finite number at each",
                                             c, v));
}

void HeatEquation::take_steps(Eigen::Ref<Eigen::MatrixXd> fields, int n)
{
    require_fields(fields);
    session_->change([&](HeatSteps& steps) { steps.take(fields, n); });
}

void HeatEquation::keep_field_edges(const Eigen::Ref<const Eigen::MatrixXd>& fields, double difference)
{
    require_fields(fields);
    if (!(difference > 0.0))
        throw OptionError(fmt::format("the difference of fields to keep is {}, but must be positive", difference));
    // A copy by rows, because the rows of two vertices are compared.
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = fields / difference;
    session_->change([&](HeatSteps& steps) {
        steps.weigh([&](Index v, Index w) { return (rows.row(v) - rows.row(w)).squaredNorm(); });
    });
}

FlowReport HeatEquation::report() const
{
    FlowReport report = report_;
    session_->complete(report);
    return report;
}

}  // namespace seamflow
