#include "samples/figures/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "samples/files/output_files.h"

namespace seamflow {

namespace {

constexpr std::string_view header = "figure,mesh,vertices,laplacian,conditions,subdomains,step,v_mean,v_rms,v_max,"
                                    "h_mean,h_rms,h_max,seconds,options,drift_mean,roughness,roughness_95,"
                                    "interface_length,dt,p,q,cut,command\n";

void append_lengths(std::string& text, const LengthStatistics& lengths)
{
    for (const double length : {lengths.mean, lengths.rms, lengths.max})
        text += csv_number(length) + ",";
}

void append_row(std::string& text, const Row& row, double time_step)
{
    text += csv_text(row.figure) + "," + csv_text(row.mesh) + "," + std::to_string(row.vertices) + ",";
    text += std::string(name_of(row.laplacian)) + "," + row.conditions + "," + std::to_string(row.subdomains) + ",";
    text += std::to_string(row.step) + ",";
    append_lengths(text, row.v);
    append_lengths(text, row.h);
    text += csv_number(row.seconds) + "," + row.settings + "," + csv_number(row.drift) + ",";
    text += csv_number(row.roughness.rms) + "," + csv_number(row.roughness.percentile_95) + ",";
    text += csv_number(row.interface_length) + "," + csv_number(time_step) + "," + row.p + "," + row.q + ",";
    text += csv_text(row.cut) + "," + csv_text(row.command) + "\n";
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
            append_row(text, row, table.time_step);
    write_text(path, text);
}

std::string csv_number(double value)
{
    if (std::isnan(value))
        return "nan";
    char text[64];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
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
