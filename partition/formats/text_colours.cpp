#include "partition/formats/text_colours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/text.h"

namespace seamflow {

namespace {

/// A number of a line as written.
struct WrittenNumber {
    std::string_view part;
    double value;
};

/// The numbers of a colour in the file, as far as they exist.
struct WrittenColour {
    std::array<WrittenNumber, colour_names.size()> numbers = {};
    /// The number of numbers where the colour should be, which may exceed the size of the array.
    std::size_t count = 0;
};

/// Reads the numbers up to the end of the line. A text that is no finite number becomes NaN.
/// @param n_behind the number of them that follow the colour.
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

bool is_colour(std::string_view name)
{
    return std::ranges::find(colour_names, name) != colour_names.end();
}

/// The largest value of a colour if colours are whole numbers; otherwise nothing (see NewColours).
std::optional<double> largest_whole(const TextColours& written)
{
    const auto is_whole = [](double value) { return std::trunc(value) == value; };
    if (written.maxCoeff() > 1.0 && std::ranges::all_of(written.reshaped(), is_whole))
        return std::max(written.maxCoeff(), 255.0);
    return {};
}

}  // namespace

void ColourReader::colour(Index v, TextScanner& scanner, std::size_t n_behind) const
{
    const WrittenColour colour = read_colour(scanner, n_behind);
    if (colour.count < usize(n_components) || colour.count > colour_names.size())
        scanner.fail("vertex {} (numbered from 0) has {} where the {} numbers of a colour should be; "
                     "give each vertex a colour, or name no colours",
                     v, counted(colour.count, "number", "numbers"), n_components);
    colours.row(v).setZero();
    for (std::size_t k = 0; k < colour.count; ++k) {
        if (std::isnan(colour.numbers[k].value))
            scanner.fail("expected a colour, but found {}; write a finite number such as 0.5 or 128",
                         in_quotes(colour.numbers[k].part));
        colours(v, static_cast<Index>(k)) = colour.numbers[k].value;
    }
}

FileFields fields_of_colours(const std::filesystem::path& path, std::span<const std::string> names,
                             const std::function<TextColours(Index n_components)>& read)
{
    FileFields fields{names_of_fields(path, names, is_colour)};
    for (const std::string& name : fields.names)
        if (!is_colour(name))
            throw InputError(fmt::format("{}: the vertices have no number {}, but at most the colours red, green, blue "
                                         "and alpha; name one of these, or convert the mesh and its data to PLY",
                                         path.string(), in_quotes(name)));
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

NewColours::NewColours(const std::filesystem::path& target, const FileFields& fields,
                       const std::function<TextColours(Index n_components)>& read)
    : fields_(fields)
{
    for (const std::string& name : fields.names)
        if (!is_colour(name))
            throw OutputError(fmt::format(
                "{}: cannot be written: the format has no place for the field {}; write a .ply file, which holds any",
                target.string(), in_quotes(name)));
    if (fields.values.hasNaN())
        throw OutputError(target.string() + ": cannot be written: a colour is not a number; give each vertex a colour");
    std::ranges::transform(colour_names, columns_.begin(), [&](auto name) { return fields.column(name); });
    if (has_any())
        largest_ = largest_whole(read(columns_.back() >= 0 ? 4 : 3));
}

std::vector<std::string> NewColours::remarks() const
{
    std::vector<std::string> remarks;
    for (std::size_t k = 0; k < columns_.size() && largest_; ++k) {
        if (columns_[k] < 0)
            continue;
        const auto values = fields_.values.col(columns_[k]);
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
        const double after = fields_.values(v, columns_[k]);
        if (!differ(colour.numbers[k].value, after))
            continue;
        ByteWriter& file = splicer.exchange(colour.numbers[k].part);
        // Adding 0 turns -0 into 0.
        if (largest_)
            file.number(std::clamp(std::round(after), 0.0, *largest_) + 0.0);
        else if (std::abs(after) <= double{std::numeric_limits<float>::max()})
            file.number(static_cast<float>(after));
        else
            file.number(after);
    }
}

}  // namespace seamflow
