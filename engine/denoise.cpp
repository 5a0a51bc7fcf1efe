#include "engine/denoise.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "engine/denoise/denoise_identity.h"
#include "engine/denoise/denoise_run.h"
#include "engine/denoise/resolved_denoise.h"
#include "engine/measure/length_scale.h"
#include "engine/measure/remarks.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// The fraction of the call that setup takes: about as long as three steps.
double fraction_of_setup(int steps_to_do)
{
    constexpr double as_steps = 3.0;
    return as_steps / (as_steps + steps_to_do);
}

/// The condition with which vertices at junctions would move, for a remark; empty if they move, or if the options hold
/// them.
std::string_view need_of_junctions(const DenoiseOptions& options)
{
    if (options.motion.junctions == Junctions::Hold)
        return {};
    if (std::holds_alternative<SmoothBetweenEdges>(options.method))
        return "Without edges that are kept";
    // Vertices at junctions have no normal.
    return options.motion.direction.kind == MotionDirection::Kind::Normal ? "In any direction but normals" : "";
}

/// A call of denoise(), on its own threads.
class Denoising {
  public:
    Denoising(DenoiseOptions options, const StepObserver& on_step, const FlowControl& control)
        : options_(std::move(options))
        , on_step_(on_step)
        , control_(control)
        , progress_(control)
    {
    }

    void run(PolygonMesh& mesh, DenoiseReport& report)
    {
        Stopwatch watch;
        const int n_taken = control_.resume != nullptr ? control_.resume->n_steps() : 0;
        const double setup = fraction_of_setup(options_.steps - n_taken);
        progress_.set_steps(options_.steps);
        // An estimate: 0.6 of the setup comes before the stepper is made.
        progress_.enter(FlowPhase::Cut, 0, 0.0, 0.6 * setup);
        FlowingMesh flowing(mesh);
        require_valid(flowing.mesh(), progress_.exec());
        const std::uint64_t identity = identify_if_needed(flowing.mesh());
        const std::string_view need = need_of_junctions(options_);
        if (!need.empty())
            options_.motion.junctions = Junctions::Hold;
        auto [surface, motion] = make_surface(std::move(flowing), std::move(options_.motion), {}, progress_);
        options_.motion = std::move(motion);
        begin_report(surface, need, report);
        report.seconds.cut = watch.lap();
        DenoiseRun run(surface, options_, identity, setup, progress_, report, control_);
        for (auto step = static_cast<int>(report.steps.size()); step < options_.steps; ++step)
            run.take_step(on_step_);
        progress_.finish();
        run.complete(report);
    }

  private:
    /// The identity of the run, for a state to resume from or for states that an observer captures; 0 if there is
    /// neither.
    /// @throws InputError if the state to resume from has another identity.
    [[nodiscard]] std::uint64_t identify_if_needed(const PolygonMesh& mesh) const
    {
        const FlowState* const resume = control_.resume.get();
        if (resume == nullptr && !on_step_)
            return 0;
        const std::uint64_t identity = identify(mesh, options_);
        if (resume != nullptr)
            require_identity(*resume, identity);
        return identity;
    }

    /// Fills in the report on the mesh, and the remarks on its surface. @param need the condition under which vertices
    /// at junctions would move (see need_of_junctions).
    void begin_report(const Surface& surface, std::string_view need, DenoiseReport& report)
    {
        report.mesh = report_on(surface, options_.motion.strength);
        if (const SmoothingAmount* const amount = amount_of(options_.method))
            report.time_step = amount->time_step;
        report.choices = surface.choices;
        report.remarks = surface.remarks;
        if (report.mesh.non_manifold_vertices > 0)
            report.remarks.push_back(remark_on_non_manifold_vertices(report.mesh.non_manifold_vertices, need));
        if (report.mesh.junction_vertices > 0)
            report.remarks.push_back(remark_on_junctions(report.mesh.junction_vertices, Laplacian::Fujiwara));
    }

    DenoiseOptions options_;
    const StepObserver& on_step_;
    const FlowControl& control_;
    Progress progress_;
};

}  // namespace

DenoiseReport denoise(PolygonMesh& mesh, const DenoiseOptions& options, const StepObserver& on_step,
                      const FlowControl& control)
{
    require_valid(options);
    if (control.resume != nullptr)
        require_not_beyond(*control.resume, options.steps);
    Workers workers(options.threads);
    DenoiseReport report;
    report.threads = workers.threads();
    workers.execute([&] {
        std::vector<Remark> remarks;
        LengthScale scale(mesh, run_in_parallel);
        DenoiseOptions own = resolved(options, mesh, scale, run_in_parallel, remarks);
        Denoising(std::move(own), on_step, control).run(mesh, report);
        report.remarks.insert(report.remarks.begin(), remarks.begin(), remarks.end());
    });
    return report;
}

}  // namespace seamflow
