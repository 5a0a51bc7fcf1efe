#include "samples/runs/run_reports.h"

#include <filesystem>
#include <string>
#include <utility>

#include "samples/files/output_files.h"
#include "samples/page/page_html.h"
#include "samples/report/report_json.h"
#include "samples/report/schedule_files.h"

namespace seamflow {

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
