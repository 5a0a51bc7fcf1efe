#include "samples/runs/run_reports.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "samples/files/output_files.h"
#include "samples/page/page_html.h"
#include "samples/page/read_file_colours.h"
#include "samples/page/shown_steps.h"
#include "samples/report/report_json.h"
#include "samples/report/schedule_files.h"

namespace seamflow {

std::optional<PageFlow> begin_page(const SmoothCommand& command, const MeshFile& file,
                                   const std::vector<Index>& left_out, Workers& workers)
{
    std::optional<PageFlow> page;
    if (command.html.empty())
        return page;
    require_showable(file.mesh, command.html);
    workers.execute([&] {
        page.emplace(std::make_shared<const PageMesh>(file.mesh, read_file_colours(command.input, file, left_out)),
                     command.output.filename().string(), command.options.laplacian, command.options.steps,
                     command.options.report.reference);
    });
    return page;
}

void write_reports(const SmoothCommand& command, const RunRecord& run, const SmoothReport& report,
                   std::optional<PageFlow>& page)
{
    std::string json;
    if (page || !command.report.empty() || !command.csv.empty())
        json = smooth_report_json(run, command.options, report);
    std::vector<std::pair<std::filesystem::path, std::string>> texts;
    if (!command.csv.empty())
        texts.emplace_back(command.csv, steps_csv(json));
    if (page) {
        page->finish(report, json);
        texts.emplace_back(command.html, page_html(command.input.filename().string(), {&*page, 1}));
    }
    if (!command.report.empty())
        texts.emplace_back(command.report, std::move(json));
    for (const auto& [path, text] : texts)
        write_text(path, text);
    if (!command.trace.empty())
        write_schedule_trace(command.trace, report);
    if (!command.task_graph.empty())
        write_task_graph(command.task_graph, report);
}

}  // namespace seamflow
