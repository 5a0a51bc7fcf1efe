#include "samples/benchmark/table.h"

#include <ostream>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace seamflow {

namespace {

std::string cell_text(const nlohmann::ordered_json& value)
{
    if (value.is_string())
        return value.get<std::string>();
    if (value.is_boolean())
        return value.get<bool>() ? "*" : "";
    return value.is_number_float() ? fmt::format("{:.3g}", value.get<double>()) : value.dump();
}

}  // namespace

Table::Table(std::ostream& out, std::vector<Column> columns)
    : out_(out)
    , columns_(std::move(columns))
{
    for (const Column& column : columns_)
        out_ << fmt::format("{:<{}} ", column.title, column.width);
    out_ << std::endl;
}

void Table::add(nlohmann::ordered_json row)
{
    const bool has_failed = row.contains("error");
    for (const Column& column : columns_) {
        const auto found = row.find(column.member);
        out_ << fmt::format("{:<{}} ", found != row.end() ? cell_text(*found) : "", column.width);
        if (has_failed && (column.member == "method" || column.member == "approach")) {
            out_ << row["error"].get<std::string>();
            break;
        }
    }
    out_ << std::endl;
    rows_.push_back(std::move(row));
}

}  // namespace seamflow
