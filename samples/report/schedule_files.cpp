#include "samples/report/schedule_files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "partition/io/output_file.h"

namespace seamflow {

namespace {

/// Rounded once: slices that touch in the schedule touch in the file.
std::int64_t nanoseconds(double seconds)
{
    return std::llround(1e9 * seconds);
}

/// The unit of the format.
double microseconds(std::int64_t nanoseconds)
{
    return static_cast<double>(nanoseconds) / 1e3;
}

std::string name_of(const ScheduledTask& task)
{
    const std::string_view kind = name_of(task.kind);
    return task.sub_mesh >= 0 ? fmt::format("{} {}", kind, task.sub_mesh) : std::string(kind);
}

/// One event per line.
class TraceFile {
  public:
    using Event = nlohmann::ordered_json;

    explicit TraceFile(const std::filesystem::path& path)
        : file_(path)
    {
        file_.text("{\"displayTimeUnit\": \"ms\", \"traceEvents\": [");
    }

    /// @param kind the format's letter for it.
    /// @param further the data besides the row.
    void add(const char* kind, int row, const Event& further)
    {
        Event event = {{"ph", kind}, {"pid", 1}, {"tid", row}};
        event.update(further);
        file_.text(first_ ? "\n" : ",\n");
        first_ = false;
        file_.text(event.dump());
    }

    void add_slice(int row, double start, double end, const std::string& name, const char* category, const Event& args)
    {
        add("X", row,
            {{"ts", microseconds(nanoseconds(start))},
             {"dur", microseconds(nanoseconds(end) - nanoseconds(start))},
             {"cat", category},
             {"name", name},
             {"args", args}});
    }

    void commit()
    {
        file_.text("\n]}\n");
        file_.commit();
    }

  private:
    OutputFile file_;
    bool first_ = true;
};

/// Rows count from 1: viewers regard thread 0 as an idle processor.
int row_of(const TaskRecord& record)
{
    return record.thread + 1;
}

void write_rows(TraceFile& file, const Schedule& schedule, int row_of_steps)
{
    const auto add_row = [&](int row, const std::string& name, int place) {
        file.add("M", row, {{"name", "thread_name"}, {"args", {{"name", name}}}});
        file.add("M", row, {{"name", "thread_sort_index"}, {"args", {{"sort_index", place}}}});
    };
    file.add("M", 1, {{"name", "process_name"}, {"args", {{"name", "seamflow"}}}});
    add_row(row_of_steps, "steps", 0);
    std::vector<bool> used(row_of_steps, false);
    for (const TaskRecord& record : schedule.records)
        used[row_of(record)] = true;
    for (int row = 1; row < row_of_steps; ++row)
        if (used[row])
            add_row(row, "thread " + std::to_string(row - 1), row);
}

void write_steps(TraceFile& file, const Schedule& schedule, int row)
{
    std::vector<double> tasks_end;
    for (const StepRecord& step : schedule.steps)
        tasks_end.push_back(step.start);
    for (const TaskRecord& record : schedule.records)
        tasks_end[record.step - 1] = std::max(tasks_end[record.step - 1], record.end);
    const auto no_arguments = TraceFile::Event::object();
    for (std::size_t i = 0; i < schedule.steps.size(); ++i) {
        const auto [start, end] = schedule.steps[i];
        file.add_slice(row, start, end, "step " + std::to_string(i + 1), "step", no_arguments);
        file.add_slice(row, tasks_end[i], end, "join", "step", no_arguments);
    }
}

void write_tasks(TraceFile& file, const Schedule& schedule, const std::vector<SubMeshReport>& sub_meshes)
{
    for (const TaskRecord& record : schedule.records) {
        const ScheduledTask& task = schedule.tasks[record.task];
        TraceFile::Event arguments = {{"step", record.step}};
        if (task.sub_mesh >= 0)
            arguments.update({{"sub-mesh", task.sub_mesh}, {"vertices", sub_meshes[task.sub_mesh].vertices}});
        file.add_slice(row_of(record), record.start, record.end, name_of(task), "task", arguments);
    }
}

/// For each step that ran both tasks. An arrow leaves in the last nanosecond of its slice, since the next slice may
/// begin at its end.
void write_arrows(TraceFile& file, const Schedule& schedule)
{
    std::vector<const TaskRecord*> ran(schedule.tasks.size(), nullptr);
    std::int64_t id = 0;
    const auto add_end = [&](const char* kind, const TaskRecord& record, std::int64_t time, TraceFile::Event event) {
        event.update({{"ts", microseconds(time)}, {"cat", "dependency"}, {"name", "dependency"}, {"id", id}});
        file.add(kind, row_of(record), event);
    };
    auto record = schedule.records.begin();
    for (int step = 1; step <= static_cast<int>(schedule.steps.size()); ++step) {
        std::fill(ran.begin(), ran.end(), nullptr);
        for (; record != schedule.records.end() && record->step == step; ++record)
            ran[record->task] = &*record;
        for (const auto& [before, after] : schedule.dependencies) {
            const TaskRecord* from = ran[before];
            const TaskRecord* to = ran[after];
            if (from == nullptr || to == nullptr)
                continue;
            add_end("s", *from, std::max(nanoseconds(from->start), nanoseconds(from->end) - 1),
                    TraceFile::Event::object());
            add_end("f", *to, nanoseconds(to->start), {{"bp", "e"}});
            ++id;
        }
    }
}

}  // namespace

void write_schedule_trace(const std::filesystem::path& path, const FlowReport& report)
{
    const Schedule& schedule = report.schedule.value();
    int row_of_steps = 1;
    for (const TaskRecord& record : schedule.records)
        row_of_steps = std::max(row_of_steps, row_of(record) + 1);
    TraceFile file(path);
    write_rows(file, schedule, row_of_steps);
    write_steps(file, schedule, row_of_steps);
    write_tasks(file, schedule, report.cut.sub_meshes);
    write_arrows(file, schedule);
    file.commit();
}

void write_task_graph(const std::filesystem::path& path, const FlowReport& report)
{
    const Schedule& schedule = report.schedule.value();
    OutputFile file(path);
    file.text("digraph step {\n    node [shape=box]\n");
    for (std::size_t i = 0; i < schedule.tasks.size(); ++i)
        file.text(fmt::format("    {} [label=\"{}\"]\n", i, name_of(schedule.tasks[i])));
    for (const auto& [before, after] : schedule.dependencies)
        file.text(fmt::format("    {} -> {}\n", before, after));
    file.text("}\n");
    file.commit();
}

}  // namespace seamflow
