#include "samples/figures/figure_page.h"

#include <iterator>
#include <sstream>
#include <utility>

#include "samples/files/output_files.h"
#include "samples/page/page_html.h"
#include "samples/report/report_json.h"

namespace seamflow {

FigurePage::FigurePage(const FigureMesh& input)
    : mesh_name_(input.name)
    , mesh_(std::make_shared<const PageMesh>(input.mesh))
{
}

PageFlow FigurePage::begin(const std::string& title, Laplacian laplacian, int steps, bool compared) const
{
    return {mesh_, title, laplacian, steps, compared};
}

void FigurePage::add(PageFlow flow, const FlowReport& report, const std::string& command)
{
    std::istringstream words(command);
    std::string program;
    words >> program;
    const RunRecord run{.input = mesh_name_,
                        .output = flow.name(),
                        .arguments = {std::istream_iterator<std::string>(words), {}},
                        .laplacian = std::string(name_of(flow.laplacian())),
                        .scale = measure_scale(mesh_->mesh)};
    flow.finish(report, smooth_report_json(run, report));
    flows_.push_back(std::move(flow));
}

void FigurePage::write(const std::filesystem::path& path, const Experiment& experiment) const
{
    const std::string title = "Figure " + std::to_string(experiment.figure) + ": " + std::string(experiment.heading);
    if (!flows_.empty())
        write_text(path, page_html(title + " (" + mesh_name_ + ")", flows_));
}

}  // namespace seamflow
