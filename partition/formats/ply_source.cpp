#include "partition/formats/ply_source.h"

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace seamflow {

std::vector<PlySlot> slots_of(const PlyElement& element, const std::vector<Index>& columns)
{
    std::vector<PlySlot> slots;
    PlySlot slot;
    const PlyProperty* first = element.properties.data();
    for (std::size_t p = 0; const PlyProperty& property : element.properties) {
        slot.column = columns[p++];
        if (slot.column < 0 && !property.length_type) {
            slot.passed_over = {first, &property + 1};
            slot.n_bytes += size_in_bytes(property.type);
            continue;
        }
        slot.property = &property;
        slots.push_back(std::exchange(slot, {}));
        first = &property + 1;
    }
    slot.column = -1;
    slots.push_back(slot);
    return slots;
}

const InputPosition& PlySource::position() const
{
    return std::visit([](const auto& scanner) -> const InputPosition& { return scanner; }, scanner_);
}

void PlySource::note_faults_in(FaultLog* log)
{
    std::visit([log](auto& scanner) { scanner.note_faults_in(log); }, scanner_);
}

void PlySource::pass_over(const PlyElement& element, std::uint64_t begin, std::uint64_t end)
{
    // Elements without lists, whose only slot is the end, all have the same number of bytes.
    const std::vector<Index> columns(element.properties.size(), -1);
    if (const PlySlot first = slots_of(element, columns).front(); !is_text() && first.property == nullptr &&
                                                                  first.n_bytes > 0 &&
                                                                  end - begin <= bytes().remaining() / first.n_bytes)
        return bytes().skip(static_cast<std::size_t>(end - begin) * first.n_bytes,
                            size_in_bytes(first.passed_over.back().type));
    scan(
        element, begin, end, columns, [](Index, Index, const PlyProperty&) {}, [this](Index) { end_element(); });
}

/// Goes to the line of element i in a text file.
void PlySource::begin_line(const PlyElement& element, std::uint64_t i)
{
    if (!text().next_line())
        text().fail("the file ends after {} of {} elements {}; it has been cut off, or the header is wrong: export or "
                    "copy the mesh again",
                    i, element.count, in_quotes(element.name));
}

/// Checks that the line ends; further words are a harmless fault, and are passed over.
void PlySource::end_line()
{
    if (text().crosses_lines() || !text().has_token())
        return;
    text().harmless_fault(fmt::format(
        "the line continues with {} after all the properties that the header declares; correct the header or the line",
        in_quotes(text().peek())));
    text().pass_over_rest();
}

void PlySource::finish()
{
    if (!is_text())
        return bytes().require_end();
    if (text().next_line())
        text().fail(
            "the file continues after all the elements that its header announces; correct the counts in the header");
}

double PlySource::field(PlyType type, const char* name)
{
    if (is_text())
        return text().real_or_nan(name);
    const double value = number(type);
    if (std::isinf(value))
        bytes().fail("{} is infinite; write a finite number, or NaN where there is none", name);
    return value;
}

void PlySource::pass_over_tokens(std::int64_t n)
{
    for (; n > 0; --n)
        if (text().token().empty())
            text().fail("the line has fewer numbers than the header declares; add what is missing or export the mesh "
                        "again");
}

std::string_view PlySource::behind()
{
    return is_text() ? text().rest_of_token().substr(0, 0) : bytes().peek(0);
}

void PlySource::refuse_length(const PlyProperty& list, std::int64_t n) const
{
    position().fail("the length of the list {} is {}; export the {} again", in_quotes(list.name), n, what_);
}

void PlySource::refuse_room(std::int64_t n) const
{
    position().fail("a list of {} numbers goes past the end of the file; it has been cut off, or the "
                    "length is wrong: export or copy the mesh again",
                    n);
}

}  // namespace seamflow
