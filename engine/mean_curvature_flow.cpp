#include "engine/mean_curvature_flow.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "engine/flow.h"
#include "engine/flow/flow_run.h"
#include "engine/options/valid_options.h"
#include "engine/setup/prepared_flow.h"
#include "engine/setup/resolved_options.h"
#include "engine/surface/flowing_mesh.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// The fraction of the call that setup takes: about as long as this many steps.
double fraction_of_setup(const FlowOptions& options, const FlowState* resume)
{
    const bool is_simple = options.scheme == Scheme::ExplicitEuler;
    const double as_steps = options.accuracy.tolerance ? 4.0 : is_simple ? 3.0 : 6.0;
    const double to_do = options.steps - (resume != nullptr ? resume->n_steps() : 0);
    return as_steps / (as_steps + to_do);
}

}  // namespace

/// A flow with everything that it works with, on its own threads.
class Flow::Session {
  public:
    Session(PolygonMesh& mesh, FlowOptions options, const FlowControl& control, bool is_observed, FlowReport& report)
        : n_expected_(options.steps)
        , workers_(options.resources.threads)
        , progress_(control)
    {
        workers_.execute([&] { set_up(mesh, std::move(options), control, is_observed, report); });
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Destroyed on the threads on which the members were made, because each thread has memory of its own.
    ~Session()
    {
        workers_.execute([&] { run_.reset(); });
    }

    /// Calls action(run) on the threads of the flow.
    template <class Action>
    void change(Action&& action)
    {
        require_sound();
        has_failed_ = true;
        try {
            workers_.execute([&] { action(*run_); });
        } catch (const OptionError&) {
            // Options that cannot be used are refused before anything changes.
            has_failed_ = false;
            throw;
        } catch (const InputError&) {
            has_failed_ = false;
            throw;
        }
        has_failed_ = false;
    }

    void step(int n, const StepObserver& on_step, const FlowReport& report)
    {
        require_sound();
        has_failed_ = true;
        workers_.execute([&] {
            for (int i = 0; i < n; ++i)
                run_->take_step(on_step);
        });
        has_failed_ = false;
        if (std::ssize(report.steps) >= n_expected_)
            progress_.finish();
    }

    void complete(FlowReport& report)
    {
        workers_.execute([&] { run_->complete(report); });
    }

  private:
    void require_sound() const
    {
        if (has_failed_)
            throw ComputationError(
                "an earlier step has failed, which leaves nothing to continue from: begin a new flow");
    }

    void set_up(PolygonMesh& mesh, FlowOptions given, const FlowControl& control, bool is_observed, FlowReport& report)
    {
        Stopwatch watch;
        LengthScale scale(mesh, progress_.exec());
        std::vector<Remark> remarks;
        FlowOptions options = resolved(std::move(given), mesh, scale, progress_.exec(), remarks);
        progress_.set_steps(options.steps);
        const double setup = fraction_of_setup(options, control.resume.get());
        progress_.enter(FlowPhase::Cut, 0, 0.0, 0.6 * setup);
        progress_.expect(8.0);
        flowing_.emplace(mesh);
        auto prepared = prepare(*flowing_, std::move(options), is_observed, control, progress_);
        report.resources.threads = workers_.threads();
        report.seconds.cut = watch.lap();
        run_.emplace(*flowing_, std::move(prepared), progress_, setup, report, control);
        report.remarks.insert(report.remarks.begin(), remarks.begin(), remarks.end());
    }

    int n_expected_;
    Workers workers_;
    Progress progress_;
    std::optional<FlowingMesh> flowing_;
    std::optional<FlowRun> run_;
    bool has_failed_ = false;
};

Flow::Flow(PolygonMesh& mesh, const FlowOptions& options, StepObserver on_step, FlowControl control)
    : is_linear_(options.flow == FlowEquation::Linear)
    , on_step_(std::move(on_step))
    , control_(std::move(control))
{
    require_valid(options);
    if (control_.resume != nullptr)
        require_not_beyond(*control_.resume, options.steps);
    session_ = std::make_unique<Session>(mesh, options, control_, static_cast<bool>(on_step_), report_);
}

Flow::~Flow() = default;

void Flow::step(int n)
{
    session_->step(n, on_step_, report_);
}

void Flow::hold(std::span<const Index> vertices)
{
    session_->change([&](FlowRun& run) { run.set_fixed(vertices, true); });
}

void Flow::release(std::span<const Index> vertices)
{
    session_->change([&](FlowRun& run) { run.set_fixed(vertices, false); });
}

void Flow::move(std::span<const Index> vertices, const Points& to)
{
    session_->change([&](FlowRun& run) { run.move_vertices(vertices, to); });
}

void Flow::attach(std::span<const Index> vertices, std::span<const double> weights)
{
    session_->change([&](FlowRun& run) { run.attach(vertices, weights); });
}

/// @throws OptionError if the flow is not linear; InputError if the fields cannot be used.
void Flow::require_fields(const Eigen::Ref<const Eigen::MatrixXd>& fields) const
{
    if (!is_linear_)
        throw OptionError("only linear flows are applied to fields: their matrix stays the same");
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

void Flow::diffuse(Eigen::Ref<Eigen::MatrixXd> fields, int n)
{
    require_fields(fields);
    session_->change([&](FlowRun& run) {
        constexpr Eigen::Index width = 3;
        for (Eigen::Index c = 0; c < fields.cols(); c += width) {
            const Eigen::Index n_columns = std::min(width, fields.cols() - c);
            Points block = Points::Zero(fields.rows(), width);
            block.leftCols(n_columns) = fields.middleCols(c, n_columns);
            run.diffuse(block, n, c == 0 ? DataSteps::Further : DataSteps::Again);
            fields.middleCols(c, n_columns) = block.leftCols(n_columns);
            if (c == 0 && run.diffuse_further(fields.rightCols(fields.cols() - n_columns), n))
                break;
        }
    });
}

void Flow::keep_field_edges(const Eigen::Ref<const Eigen::MatrixXd>& fields, double difference)
{
    require_fields(fields);
    if (!(difference > 0.0))
        throw OptionError(fmt::format("the difference of fields to keep is {}, but must be positive", difference));
    // A copy by rows, because the rows of two vertices are compared.
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = fields / difference;
    session_->change(
        [&](FlowRun& run) { run.weigh([&](Index v, Index w) { return (rows.row(v) - rows.row(w)).squaredNorm(); }); });
}

FlowReport Flow::report() const
{
    FlowReport report = report_;
    session_->complete(report);
    return report;
}

FlowReport mean_curvature_flow(PolygonMesh& mesh, const FlowOptions& options, const StepObserver& on_step,
                               const FlowControl& control)
{
    Flow flow(mesh, options, on_step, control);
    flow.step(options.steps - flow.n_steps());
    flow.session_->complete(flow.report_);
    return std::move(flow.report_);
}

}  // namespace seamflow
