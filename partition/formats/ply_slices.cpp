#include "partition/formats/ply_slices.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

#include "partition/errors.h"
#include "partition/formats/ply_source.h"

namespace seamflow {

namespace {

/// Throws an error that is never reported (see read_in_slices_if_faultless).
[[noreturn]] void refuse()
{
    throw InputError("not as the header says");
}

std::vector<PlySlice> slice_text(const TextScanner& after_header, const Slicing& slicing)
{
    const std::vector<std::string_view> bytes = after_header.slices(slicing.bytes);
    const std::vector<std::int64_t> first = count_lines(after_header, bytes, slicing.exec);
    std::vector<PlySlice> slices;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        slices.push_back({static_cast<std::uint64_t>(first[i]), static_cast<std::uint64_t>(first[i + 1]), bytes[i]});
    if (slices.empty())
        slices.push_back({0, 0, after_header.rest()});
    return slices;
}

/// A field of an element of a binary file: bytes, and then the numbers of a list.
struct Field {
    std::size_t n_bytes = 0;
    PlyType length_type = PlyType::UInt8;
    std::size_t number_bytes = 0;
};

/// The fields of an element, the last without a list.
std::vector<Field> fields_of(const PlyElement& element)
{
    std::vector<Field> fields(1);
    for (const PlyProperty& property : element.properties) {
        if (!property.length_type) {
            fields.back().n_bytes += size_in_bytes(property.type);
            continue;
        }
        if (!is_integer(*property.length_type))
            refuse();
        fields.back().length_type = *property.length_type;
        fields.back().number_bytes = size_in_bytes(property.type);
        fields.emplace_back();
    }
    return fields;
}

/// Finds where the elements of a binary file begin.
class BinarySlicer {
  public:
    BinarySlicer(std::string_view file, std::size_t offset, std::endian order)
        : file_(file)
        , offset_(offset)
        , order_(order)
    {
    }

    /// Passes over the elements of one kind.
    void add(const PlyElement& element, const Slicing& slicing);

    /// Passes over n elements whose fields are known.
    void pass_over(const std::vector<Field>& fields, std::uint64_t n);

    [[nodiscard]] std::size_t offset() const { return offset_; }

    [[nodiscard]] std::vector<PlySlice> take() { return std::move(slices_); }

  private:
    void pass_over(std::uint64_t n_bytes)
    {
        if (n_bytes > file_.size() - offset_)
            refuse();
        offset_ += static_cast<std::size_t>(n_bytes);
    }

    void pass_over(const Field& list);

    std::string_view file_;
    std::size_t offset_;
    std::endian order_;
    std::uint64_t n_elements_ = 0;
    std::vector<PlySlice> slices_;
};

/// Passes over the bytes before a list, and the list.
void BinarySlicer::pass_over(const Field& list)
{
    pass_over(list.n_bytes);
    const std::size_t length = offset_;
    pass_over(size_in_bytes(list.length_type));
    const auto n = with_type(list.length_type, [&](auto zero) {
        return static_cast<std::int64_t>(from_bytes<decltype(zero)>(file_.data() + length, order_));
    });
    if (n < 0)
        refuse();
    pass_over(static_cast<std::uint64_t>(n) * list.number_bytes);
}

void BinarySlicer::pass_over(const std::vector<Field>& fields, std::uint64_t n)
{
    const std::span<const Field> lists(fields.data(), fields.size() - 1);
    if (lists.empty())
        return pass_over(n * fields.back().n_bytes);
    for (std::uint64_t k = 0; k < n; ++k) {
        for (const Field& list : lists)
            pass_over(list);
        pass_over(fields.back().n_bytes);
    }
}

void BinarySlicer::add(const PlyElement& element, const Slicing& slicing)
{
    const std::vector<Field> fields = fields_of(element);
    const std::span<const Field> lists(fields.data(), fields.size() - 1);
    std::size_t typical_bytes = fields.back().n_bytes;
    for (const Field& list : lists)
        typical_bytes += list.n_bytes + 1 + 3 * list.number_bytes;
    const std::uint64_t per_slice = at(elements_per_slice(slicing, std::max<std::size_t>(typical_bytes, 1)));
    for (std::uint64_t i = 0; i < element.count;) {
        const std::size_t begin = offset_;
        const std::uint64_t n = std::min(per_slice, element.count - i);
        pass_over(fields, n);
        slices_.push_back({n_elements_ + i, n_elements_ + i + n, file_.substr(begin, offset_ - begin)});
        i += n;
    }
    n_elements_ += element.count;
}

}  // namespace

/// The number of elements of that name among the first `end` elements of a file.
std::uint64_t count_before(std::uint64_t end, const PlyHeader& header, std::string_view name)
{
    std::uint64_t n = 0;
    for_each_kind(header.elements, {0, end}, [&](const PlyElement& element, std::uint64_t, std::uint64_t n_here) {
        n = element.name == name ? n_here : n;
    });
    return n;
}

std::size_t pass_over_elements(std::string_view file, std::size_t offset, std::endian order, const PlyElement& element,
                               std::uint64_t n)
{
    BinarySlicer slicer(file, offset, order);
    slicer.pass_over(fields_of(element), n);
    return slicer.offset();
}

bool are_all_elements(std::string_view file, std::size_t begin, const PlyHeader& header)
{
    try {
        for (const PlyElement& element : header.elements)
            begin = pass_over_elements(file, begin, order_of(header.encoding), element, element.count);
    } catch (const InputError&) {
        return false;
    }
    return file.find_first_not_of(padding, begin) == std::string_view::npos;
}

std::vector<PlySlice> slice_elements(std::string_view file, std::size_t begin, Encoding encoding,
                                     std::span<const PlyElement> elements, const Slicing& slicing)
{
    BinarySlicer slicer(file, begin, order_of(encoding));
    for (const PlyElement& element : elements)
        slicer.add(element, slicing);
    std::vector<PlySlice> slices = slicer.take();
    if (slices.empty())
        slices.push_back({0, 0, file.substr(begin, 0)});
    return slices;
}

std::vector<PlySlice> slice_ply(std::string_view file, const TextScanner& after_header, Encoding encoding,
                                std::span<const PlyElement> elements, const Slicing& slicing)
{
    if (encoding == Encoding::Ascii)
        return slice_text(after_header, slicing);
    return slice_elements(file, file.size() - after_header.rest().size(), encoding, elements, slicing);
}

}  // namespace seamflow
