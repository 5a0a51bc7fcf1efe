#pragma once

#include <cstddef>
#include <iosfwd>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace seamflow {

/// A table that is printed line by line as it grows, and whose rows are those of `--json`.
class Table {
  public:
    /// One column, with the member of a row that it shows.
    struct Column {
        std::string_view member;
        std::string_view title;
        std::size_t width;
    };

    /// Prints the head. The first columns, up to the one that is called "method" or "approach", name a row.
    Table(std::ostream& out, std::vector<Column> columns);

    /// Prints a row: numbers with three significant digits, what it lacks as a gap, and "error" behind its name.
    /// @param row may have further members, which are not printed.
    void add(nlohmann::ordered_json row);

    /// All rows so far.
    [[nodiscard]] const nlohmann::ordered_json& rows() const { return rows_; }

  private:
    std::ostream& out_;
    std::vector<Column> columns_;
    nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
};

}  // namespace seamflow
