#include "partition/formats/text_colours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/obj.h"
#include "partition/formats/off_header.h"

namespace seamflow {

namespace {

/// A number of a line as written.
struct WrittenNumber {
    std::string_view part;
    double value;
};

/// A colour as written, as far as there are numbers.
struct WrittenColour {
    std::array<WrittenNumber, colour_names.size()> numbers = {};
    /// There may be more than fit above.
    std::size_t count = 0;
};

/// Reads the numbers up to the end of the line. What is no finite number is NaN.
/// @param n_behind how many of them follow the colour.
WrittenColour read_colour(TextScanner& scanner, std::size_t n_behind)
{
    WrittenColour colour;
    for (; scanner.has_token(); ++colour.count) {
        const WrittenNumber number{scanner.peek(), scanner.number_or_nan()};
        if (colour.count < colour.numbers.size())
            colour.numbers[colour.count] = number;
    }
    colour.count -= std::min(colour.count, n_behind);
    return colour;
}

/// Reads the colours of some lines.
class ColourReader {
  public:
    ColourReader(TextColours& colours, Index n_components, std::size_t n_behind)
        : colours_(colours)
        , n_components_(static_cast<std::size_t>(n_components))
        , n_behind_(n_behind)
    {
    }

    /// @param scanner stands before the colour of vertex v.
    void read(TextScanner& scanner, Index v)
    {
        const WrittenColour colour = read_colour(scanner, n_behind_);
        if (colour.count < n_components_ || colour.count > colour_names.size())
            scanner.fail(fmt::format("vertex {} (numbered from 0) has {} where the {} numbers of a colour should be; "
                                     "give each vertex a colour, or name no colours",
                                     v, counted(colour.count, "number", "numbers"), n_components_));
        colours_.row(v).setZero();
        for (std::size_t k = 0; k < colour.count; ++k) {
            if (std::isnan(colour.numbers[k].value))
                scanner.fail("expected a colour, but found " + in_quotes(colour.numbers[k].part) +
                             "; write a finite number such as 0.5 or 128");
            colours_(v, static_cast<Index>(k)) = colour.numbers[k].value;
        }
    }

  private:
    TextColours& colours_;
    std::size_t n_components_;
    std::size_t n_behind_;
};

void pass_over_tokens(TextScanner& scanner, Index n)
{
    for (; n > 0; --n)
        scanner.token();
}

/// Reads slices several at a time; those with a fault in one go, which names the line.
/// @param read called with slices and an executor.
TextColours read_text(const TextScanner& after_header, const Slicing& slicing, const auto& read)
{
    return read_in_slices_if_faultless([&] { return read(after_header.slices(slicing.bytes), slicing.exec); },
                                       [&] { return read({after_header.rest()}, Executor(run_serially)); });
}

bool is_colour(std::string_view name)
{
    return std::ranges::find(colour_names, name) != colour_names.end();
}

/// The largest whole number of a colour, if that is what colours are: see NewColours::find_scale.
std::optional<double> largest_whole(const TextColours& written)
{
    const auto is_whole = [](double value) { return std::trunc(value) == value; };
    if (written.maxCoeff() > 1.0 && std::ranges::all_of(written.reshaped(), is_whole))
        return std::max(written.maxCoeff(), 255.0);
    return {};
}

/// @param read as in NewColours.
FileFields fields_of_colours(const std::filesystem::path& path, std::span<const std::string> names, const auto& read)
{
    FileFields fields{names_of_fields(path, names, is_colour)};
    for (const std::string& name : fields.names)
        if (!is_colour(name))
            throw InputError(path.string() + ": the vertices have no number " + in_quotes(name) +
                             ", but at most the colours red, green, blue and alpha; name one of these, or convert the "
                             "mesh and its data to PLY");
    const TextColours colours = read(fields.column(colour_names.back()) >= 0 ? 4 : 3);
    fields.values.resize(colours.rows(), static_cast<Index>(fields.names.size()));
    for (std::size_t k = 0; k < colour_names.size(); ++k)
        if (const Index column = fields.column(colour_names[k]); column >= 0)
            fields.values.col(column) = colours.col(static_cast<Index>(k));
    if (const std::optional<double> largest = largest_whole(colours))
        fields.whole.assign(fields.names.size(), WholeRange{0.0, *largest});
    else
        fields.decimals.assign(fields.names.size(), Decimals::SingleText);
    return fields;
}

}  // namespace

TextColours read_obj_colours(const std::filesystem::path& path, std::string_view text, Index n_components,
                             const Slicing& slicing)
{
    const TextScanner whole(path, text, obj_syntax);
    return read_text(whole, slicing, [&](const std::vector<std::string_view>& slices, const Executor& exec) {
        const std::vector<TextCounts> counts = count_obj(whole, slices, exec);
        TextColours colours(static_cast<Index>(counts.back().n_vertices), 4);
        for_each(exec, static_cast<Index>(slices.size()), [&](Index i) {
            TextScanner scanner(whole, slices[i]);
            ColourReader reader(colours, n_components, 0);
            auto v = static_cast<Index>(counts[i].n_vertices);
            while (scanner.next_line()) {
                if (scanner.token() != "v")
                    continue;
                pass_over_tokens(scanner, 3);
                reader.read(scanner, v++);
            }
        });
        return colours;
    });
}

TextColours read_off_colours(const std::filesystem::path& path, std::string_view text, Index n_components,
                             const Slicing& slicing)
{
    if (start_of_binary_off(text))
        throw InputError(path.string() + ": no colours of vertices can be read from binary OFF files; convert the mesh "
                                         "to text OFF or to PLY");
    TextScanner scanner(path, text);
    const OffHeader header = read_off_header(scanner);
    if (!header.has_colours())
        scanner.fail("the keyword " + in_quotes(std::string(header.prefix) + "OFF") +
                     " announces no colours of vertices; write them behind the coordinates, and the keyword COFF");
    const auto n_vertices = static_cast<Index>(header.n_vertices);
    return read_text(scanner, slicing, [&](const std::vector<std::string_view>& slices, const Executor& exec) {
        const std::vector<std::int64_t> lines_before = count_lines(scanner, slices, exec);
        TextColours colours(n_vertices, 4);
        for_each(exec, static_cast<Index>(slices.size()), [&](Index i) {
            TextScanner lines(scanner, slices[i], scanner.line());
            ColourReader reader(colours, n_components, at(header.n_numbers_behind_colour()));
            const auto end = static_cast<Index>(std::min(lines_before[i + 1], header.n_vertices));
            for (auto v = static_cast<Index>(lines_before[i]); v < end && lines.next_line(); ++v) {
                pass_over_tokens(lines, header.n_numbers_before_colour());
                reader.read(lines, v);
            }
        });
        return colours;
    });
}

FileFields read_obj_fields(const std::filesystem::path& path, std::string_view text, std::span<const std::string> names,
                           const Slicing& slicing)
{
    return fields_of_colours(path, names, [&](Index n) { return read_obj_colours(path, text, n, slicing); });
}

FileFields read_off_fields(const std::filesystem::path& path, std::string_view text, std::span<const std::string> names,
                           const Slicing& slicing)
{
    return fields_of_colours(path, names, [&](Index n) { return read_off_colours(path, text, n, slicing); });
}

void NewColours::require_colours(const std::filesystem::path& target, const FileFields& fields)
{
    for (const std::string& name : fields.names)
        if (!is_colour(name))
            throw OutputError(target.string() + ": cannot be written: the format has no place for the field " +
                              in_quotes(name) + "; write a .ply file, which holds any");
    if (fields.values.hasNaN())
        throw OutputError(target.string() + ": cannot be written: a colour is not a number; give each vertex a colour");
}

void NewColours::find_scale(const TextColours& written)
{
    largest_ = largest_whole(written);
}

std::vector<std::string> NewColours::remarks() const
{
    std::vector<std::string> remarks;
    for (std::size_t k = 0; k < columns_.size() && largest_; ++k) {
        if (columns_[k] < 0)
            continue;
        const auto values = fields_->values.col(columns_[k]);
        if (std::round(values.minCoeff()) < 0.0 || std::round(values.maxCoeff()) > *largest_)
            remarks.push_back(clamping_remark(colour_names[k], fmt::format("0 to {}", *largest_)));
    }
    return remarks;
}

void NewColours::exchange(TextScanner& scanner, Splicer& splicer, Index v, std::size_t n_behind) const
{
    if (!has_any())
        return;
    const WrittenColour colour = read_colour(scanner, n_behind);
    for (std::size_t k = 0; k < std::min(colour.count, columns_.size()); ++k) {
        if (columns_[k] < 0)
            continue;
        const double after = fields_->values(v, columns_[k]);
        if (!differ(colour.numbers[k].value, after))
            continue;
        ByteWriter& file = splicer.exchange(colour.numbers[k].part);
        // The sum is not -0.
        if (largest_)
            file.number(std::clamp(std::round(after), 0.0, *largest_) + 0.0);
        else if (std::abs(after) <= double{std::numeric_limits<float>::max()})
            file.number(static_cast<float>(after));
        else
            file.number(after);
    }
}

}  // namespace seamflow
