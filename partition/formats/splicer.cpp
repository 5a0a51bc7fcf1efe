#include "partition/formats/splicer.h"

#include <bit>
#include <cstdint>

#include "partition/formats/mesh_io.h"

namespace seamflow {

OutputFile& Splicer::exchange(std::string_view part)
{
    const auto before = static_cast<std::size_t>(part.data() - rest_.data());
    file_.text(rest_.substr(0, before));
    rest_.remove_prefix(before + part.size());
    return file_;
}

bool differ(double a, double b)
{
    return std::bit_cast<std::uint64_t>(a) != std::bit_cast<std::uint64_t>(b);
}

void exchange_position(TextScanner& scanner, Splicer& splicer, const Point& position)
{
    for (Index k = 0; k < 3; ++k) {
        const std::string_view part = scanner.peek();
        if (differ(scanner.real("a coordinate"), position[k]))
            splicer.exchange(part).number(position[k]);
    }
}

WrittenNormal read_normal(TextScanner& scanner)
{
    WrittenNormal normal;
    for (Index k = 0; k < 3; ++k) {
        normal.parts[k] = scanner.peek();
        normal.value[k] = scanner.number_or_nan();
    }
    return normal;
}

void exchange_normal(Splicer& splicer, const WrittenNormal& before, const Point& after)
{
    for (Index k = 0; k < 3; ++k)
        if (!before.parts[k].empty())
            splicer.exchange(before.parts[k]).number(static_cast<float>(after[k]));
}

std::string rounding_remark(const std::filesystem::path& source)
{
    return source.string() + " holds positions in single precision, and so does the result; text formats (" +
           extensions_of(FormatGroup::Text) + ") keep all digits";
}

}  // namespace seamflow
