#include "samples/figures/figure_page.h"

#include <utility>

#include "samples/common/output_files.h"
#include "samples/common/report_json.h"
#include "samples/page/page_html.h"

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

void FigurePage::add(PageFlow flow, const FlowReport& report, Laplacian laplacian)
{
    const RunRecord run{.input = mesh_name_,
                        .output = flow.name(),
                        .arguments = {},
                        .laplacian = std::string(name_of(laplacian)),
                        .scale = measure_scale(mesh_->mesh)};
    flow.finish(report, smooth_report_json(run, report));
    flows_.push_back(std::move(flow));
}

void FigurePage::write(const std::filesystem::path& path, const std::string& figure) const
{
    if (!flows_.empty())
        write_text(path, page_html(figure + ": " + mesh_name_, flows_));
}

}  // namespace seamflow
