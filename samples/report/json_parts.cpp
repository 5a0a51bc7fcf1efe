#include "samples/report/json_parts.h"

#include <cmath>
#include <ctime>

#include <fmt/chrono.h>

#include "partition/version.h"
#include "samples/process/option_words.h"

namespace seamflow {

ReportJson begin_report(const RunRecord& run)
{
    return {{"schema", report_schema},
            {"version", version},
            {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
            {"input", run.input},
            {"output", run.output},
            {"arguments", run.arguments}};
}

ReportJson json_number(double value)
{
    return std::isfinite(value) ? ReportJson(value) : ReportJson(nullptr);
}

void add_lengths(ReportJson& json, const std::string& name, const LengthStatistics& lengths, double unit,
                 const char* ending)
{
    json[name + "_mean" + ending] = json_number(lengths.mean / unit);
    json[name + "_rms" + ending] = json_number(lengths.rms / unit);
    json[name + "_max" + ending] = json_number(lengths.max / unit);
}

void add_statistics(ReportJson& json, const std::string& name, const LengthStatistics& lengths, double mean_edge)
{
    add_lengths(json, name, lengths, mean_edge);
    add_lengths(json, name, lengths, 1.0, "_absolute");
}

void add_convergence(ReportJson& json, const ConvergenceReport& convergence)
{
    if (!convergence.tolerance)
        return;
    json["tolerance"] = json_number(*convergence.tolerance);
    json["steps_short_of_tolerance"] = convergence.steps_short_of_tolerance;
    json["steps_stagnated"] = convergence.steps_stagnated;
}

void add_ranks(ReportJson& json, const std::vector<RankRecord>& ranks)
{
    for (const RankRecord& rank : ranks)
        json["ranks"].push_back({{"vertices", rank.vertices},
                                 {"foreign_vertices", rank.foreign_vertices},
                                 {"messages", rank.messages},
                                 {"bytes", rank.bytes},
                                 {"threads", rank.threads},
                                 {"peak_memory_bytes", rank.peak_memory_bytes}});
}

ReportJson look_json(const SurfaceLook& look)
{
    ReportJson json{
        {"area", json_number(look.area)},
        {"volume", look.volume ? json_number(*look.volume) : ReportJson(nullptr)},
        {"roughness_rms", look.roughness ? json_number(look.roughness->rms) : ReportJson(nullptr)},
        {"roughness_percentile_95", look.roughness ? json_number(look.roughness->percentile_95) : ReportJson(nullptr)}};
    if (!look.cell_volumes.empty()) {
        ReportJson& list = json["cell_volumes"] = ReportJson::array();
        for (const double volume : look.cell_volumes)
            list.push_back(json_number(volume));
    }
    if (look.self_intersections)
        json["self_intersections"] = *look.self_intersections;
    return json;
}

ReportJson remarks_json(const std::vector<Remark>& remarks)
{
    ReportJson json = ReportJson::array();
    for (const Remark& remark : remarks) {
        ReportJson numbers = ReportJson::object();
        for (const auto& [name, value] : remark.numbers)
            numbers[name] = json_number(value);
        json.push_back({{"kind", remark.kind}, {"numbers", numbers}, {"text", sentence(remark, option_of_program)}});
    }
    return json;
}

std::string text_of(const ReportJson& json)
{
    return json.dump(2, ' ', false, ReportJson::error_handler_t::replace) + "\n";
}

}  // namespace seamflow
