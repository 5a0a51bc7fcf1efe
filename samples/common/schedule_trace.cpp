#include "samples/common/schedule_trace.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <string_view>
#include <vector>

#include "partition/io/output_file.h"

namespace seamflow {

namespace {

/// Rounded once: slices that touch in the schedule touch in the file.
std::int64_t nanoseconds(double seconds)
{
    return std::llround(1e9 * seconds);
}

/// One event after the other; times are written in microseconds, the unit of the format.
class TraceFile {
  public:
    explicit TraceFile(const std::filesystem::path& path)
        : file_(path)
    {
        file_.text("{\"displayTimeUnit\": \"ms\", \"traceEvents\": [");
    }

    /// Says what the process (`what` is process_name) or a row (thread_name) is called.
    void name(std::string_view what, int row, std::string_view text, int number = -1)
    {
        begin_event("M", row);
        file_.text(", \"name\": \"");
        file_.text(what);
        file_.text("\", \"args\": {\"name\": \"");
        named(text, number);
        file_.text("}}");
    }

    void sort(int row, int place)
    {
        begin_event("M", row);
        file_.text(R"(, "name": "thread_sort_index", "args": {"sort_index": )");
        file_.number(place);
        file_.text("}}");
    }

    /// A slice; its arguments follow, then `end_slice`.
    void begin_slice(int row, double start, double end, std::string_view category, std::string_view text, int number)
    {
        begin_event("X", row);
        time("ts", nanoseconds(start));
        time("dur", nanoseconds(end) - nanoseconds(start));
        file_.text(", \"cat\": \"");
        file_.text(category);
        file_.text("\", \"name\": \"");
        named(text, number);
        file_.text(", \"args\": {");
    }

    void argument(std::string_view key, std::integral auto value, bool first = false)
    {
        file_.text(first ? "\"" : ", \"");
        file_.text(key);
        file_.text("\": ");
        file_.number(value);
    }

    void end_slice() { file_.text("}}"); }

    /// One end of an arrow, which belongs to the slice around that time.
    void arrow(bool starts, int row, std::int64_t nanosecond, std::int64_t id)
    {
        begin_event(starts ? "s" : "f", row);
        time("ts", nanosecond);
        file_.text(starts ? "" : R"(, "bp": "e")");
        file_.text(R"(, "cat": "dependency", "name": "dependency", "id": )");
        file_.number(id);
        file_.text("}");
    }

    void commit()
    {
        file_.text("\n]}\n");
        file_.commit();
    }

  private:
    void begin_event(std::string_view kind, int row)
    {
        file_.text(first_ ? "\n" : ",\n");
        first_ = false;
        file_.text("{\"ph\": \"");
        file_.text(kind);
        file_.text("\", \"pid\": 1, \"tid\": ");
        file_.number(row);
    }

    void time(std::string_view key, std::int64_t nanosecond)
    {
        file_.text(", \"");
        file_.text(key);
        file_.text("\": ");
        file_.number(static_cast<double>(nanosecond) / 1e3);
    }

    void named(std::string_view text, int number)
    {
        file_.text(text);
        if (number >= 0) {
            file_.text(" ");
            file_.number(number);
        }
        file_.text("\"");
    }

    OutputFile file_;
    bool first_ = true;
};

/// Rows count from 1: viewers take thread 0 for an idle processor.
int row_of(const TaskRecord& record)
{
    return record.thread + 1;
}

void write_rows(TraceFile& file, const Schedule& schedule, int row_of_steps)
{
    file.name("process_name", 1, "seamflow");
    file.name("thread_name", row_of_steps, "steps");
    file.sort(row_of_steps, 0);
    std::vector<bool> used(at(row_of_steps), false);
    for (const TaskRecord& record : schedule.records)
        used[at(row_of(record))] = true;
    for (int row = 1; row < row_of_steps; ++row)
        if (used[at(row)]) {
            file.name("thread_name", row, "thread", row - 1);
            file.sort(row, row);
        }
}

void write_steps(TraceFile& file, const Schedule& schedule, int row)
{
    std::vector<double> tasks_end;
    for (const StepRecord& step : schedule.steps)
        tasks_end.push_back(step.start);
    for (const TaskRecord& record : schedule.records)
        tasks_end[at(record.step - 1)] = std::max(tasks_end[at(record.step - 1)], record.end);
    for (int step = 1; step <= static_cast<int>(schedule.steps.size()); ++step) {
        const auto [start, end] = schedule.steps[at(step - 1)];
        file.begin_slice(row, start, end, "step", "step", step);
        file.end_slice();
        file.begin_slice(row, tasks_end[at(step - 1)], end, "step", "join", -1);
        file.end_slice();
    }
}

void write_tasks(TraceFile& file, const Schedule& schedule, const std::vector<Index>& vertices)
{
    for (const TaskRecord& record : schedule.records) {
        const ScheduledTask& task = schedule.tasks[at(record.task)];
        file.begin_slice(row_of(record), record.start, record.end, "task", name_of(task.phase), task.sub_mesh);
        file.argument("step", record.step, true);
        if (task.sub_mesh >= 0) {
            file.argument("sub-mesh", task.sub_mesh);
            file.argument("vertices", vertices[at(task.sub_mesh)]);
        }
        file.end_slice();
    }
}

/// For each step that ran both tasks. An arrow leaves in the last nanosecond of its slice, since with its end the next
/// slice may begin.
void write_arrows(TraceFile& file, const Schedule& schedule)
{
    std::vector<const TaskRecord*> ran(schedule.tasks.size(), nullptr);
    std::int64_t id = 0;
    auto record = schedule.records.begin();
    for (int step = 1; step <= static_cast<int>(schedule.steps.size()); ++step) {
        std::fill(ran.begin(), ran.end(), nullptr);
        for (; record != schedule.records.end() && record->step == step; ++record)
            ran[at(record->task)] = &*record;
        for (const auto& [before, after] : schedule.dependencies) {
            const TaskRecord* from = ran[at(before)];
            const TaskRecord* to = ran[at(after)];
            if (from == nullptr || to == nullptr)
                continue;
            file.arrow(true, row_of(*from), std::max(nanoseconds(from->start), nanoseconds(from->end) - 1), id);
            file.arrow(false, row_of(*to), nanoseconds(to->start), id++);
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
    write_tasks(file, schedule, report.subdomain_vertices);
    write_arrows(file, schedule);
    file.commit();
}

}  // namespace seamflow
