#include "samples/figures/table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "samples/files/output_files.h"

namespace seamflow {

namespace {

constexpr std::string_view header = "figure,mesh,vertices,laplacian,conditions,subdomains,step,v_mean,v_rms,v_max,"
                                    "h_mean,h_rms,h_max,seconds,options,drift_mean,roughness,roughness_95,"
                                    "interface_length,area,leading,authors_v_mean,authors_v_max,dt,p,q,cut,command\n";

std::string text_of(const LengthStatistics& lengths)
{
    return fmt::format("{},{},{}", csv_number(lengths.mean), csv_number(lengths.rms), csv_number(lengths.max));
}

std::string text_of(const Table& table, const Row& row)
{
    const AuthorsDistances theirs = table.theirs_of(row);
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                       csv_text(table.figure), csv_text(table.mesh), table.vertices, name_of(row.laplacian),
                       row.conditions, row.subdomains, row.step, text_of(row.v), text_of(row.h),
                       csv_number(row.seconds), row.settings, csv_number(row.drift), csv_number(row.roughness.rms),
                       csv_number(row.roughness.percentile_95), csv_number(row.interface_length),
                       csv_number(table.area), row.leading, csv_number(theirs.v_mean), csv_number(theirs.v_max),
                       csv_number(table.time_step), row.p, row.q, csv_text(row.cut), csv_text(row.command));
}

}  // namespace

const Row* Table::find(Laplacian laplacian, std::string_view conditions, int step) const
{
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
        return row.laplacian == laplacian && row.conditions == conditions && row.step == step;
    });
    return found == rows.end() ? nullptr : &*found;
}

const Row* Table::find(const Variant& variant, int step) const
{
    const std::string title = title_of(variant);
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.title == title && row.step == step; });
    return found == rows.end() ? nullptr : &*found;
}

AuthorsDistances Table::theirs_of(const Row& row) const
{
    for (const AuthorsDistances& one : theirs)
        if (is_theirs && row.laplacian == one.laplacian && row.settings == name_of(Settings::Plain) &&
            row.conditions == conditions_of({.cut = CutKind::Halves, .conditions = one.conditions}))
            return one;
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    return {.v_mean = unknown, .v_max = unknown};
}

bool Table::has_curves() const
{
    return std::ranges::any_of(rows, [](const Row& row) { return row.step > 1; }) &&
           std::ranges::any_of(rows, [](const Row& row) { return row.conditions != conditions_of({}); });
}

std::vector<Row> Table::last_rows() const
{
    std::vector<Row> last;
    for (const Row& row : rows) {
        if (last.empty() || last.back().title != row.title)
            last.push_back(row);
        last.back() = row;
    }
    return last;
}

void write_csv(const std::filesystem::path& path, const std::vector<Table>& tables)
{
    std::string text(header);
    for (const Table& table : tables)
        for (const Row& row : table.rows)
            text += text_of(table, row);
    write_text(path, text);
}

std::string csv_number(double value)
{
    return std::isnan(value) ? "nan" : fmt::format("{:.6g}", value);
}

std::string csv_text(std::string_view text)
{
    if (text.find_first_of(",\"\n") == std::string_view::npos)
        return std::string(text);
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

}  // namespace seamflow
