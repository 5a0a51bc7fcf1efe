#include "partition/formats/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "partition/text.h"

namespace seamflow {

namespace {

struct NamedType {
    std::string_view name;
    PlyType type;
};

constexpr std::array<NamedType, 18> named_types = {{{"char", PlyType::Int8},
                                                    {"int8", PlyType::Int8},
                                                    {"uchar", PlyType::UInt8},
                                                    {"uint8", PlyType::UInt8},
                                                    {"short", PlyType::Int16},
                                                    {"int16", PlyType::Int16},
                                                    {"ushort", PlyType::UInt16},
                                                    {"uint16", PlyType::UInt16},
                                                    {"int", PlyType::Int32},
                                                    {"int32", PlyType::Int32},
                                                    {"uint", PlyType::UInt32},
                                                    {"uint32", PlyType::UInt32},
                                                    {"int64", PlyType::Int64},
                                                    {"uint64", PlyType::UInt64},
                                                    {"float", PlyType::Float32},
                                                    {"float32", PlyType::Float32},
                                                    {"double", PlyType::Float64},
                                                    {"float64", PlyType::Float64}}};

PlyType read_type(TextScanner& scanner)
{
    const auto name = scanner.token();
    const auto* const found =
        std::find_if(named_types.begin(), named_types.end(), [&](const NamedType& t) { return t.name == name; });
    if (found == named_types.end())
        scanner.fail(
            "expected a type (char, uchar, short, ushort, int, uint, float, double), but found {}; correct the header",
            in_quotes(name));
    return found->type;
}

/// Reads a name that is not yet in `declared`. @param what the word for the declared things.
std::string read_new_name(TextScanner& scanner, const auto& declared, const char* what)
{
    std::string name(scanner.token());
    if (name.empty())
        scanner.fail("expected the name of the {}, but the line ends; correct the header", what);
    if (std::any_of(declared.begin(), declared.end(), [&](const auto& d) { return d.name == name; }))
        scanner.fail("the {} {} is declared twice; remove or rename one", what, in_quotes(name));
    return name;
}

Encoding read_encoding(TextScanner& scanner)
{
    const auto name = scanner.token();
    if (const auto* const found = std::ranges::find(ply_encodings, name); found != ply_encodings.end())
        return static_cast<Encoding>(found - ply_encodings.begin());
    scanner.fail(
        "expected the format ascii, binary_little_endian or binary_big_endian, but found {}; correct the header",
        in_quotes(name));
}

PlyElement read_element(TextScanner& scanner, const PlyHeader& header)
{
    PlyElement element;
    element.name = read_new_name(scanner, header.elements, "element");
    element.line = scanner.line();
    const std::int64_t count = scanner.integer("the number of elements");
    if (count < 0)
        scanner.fail("the number of elements is {}; correct the header", count);
    element.count = static_cast<std::uint64_t>(count);
    return element;
}

PlyProperty read_property(TextScanner& scanner, PlyHeader& header)
{
    if (header.elements.empty())
        scanner.fail("a property stands before the first element; correct the header");
    PlyProperty property;
    property.line = scanner.line();
    if (scanner.peek() == "list") {
        scanner.token();
        property.length_type = read_type(scanner);
        if (!is_integer(*property.length_type))
            scanner.fail("the length of a list must have a whole-number type such as uchar; correct the header");
    }
    property.type_word = scanner.peek();
    property.type = read_type(scanner);
    property.name = read_new_name(scanner, header.elements.back().properties, "property");
    return property;
}

/// The fewest bytes of one element. In text a number takes two: a digit, and a blank or line end.
std::uint64_t shortest(const PlyElement& element, Encoding encoding)
{
    std::uint64_t result = 0;
    for (const PlyProperty& property : element.properties)
        result += encoding == Encoding::Ascii ? 2 : size_in_bytes(property.length_type.value_or(property.type));
    return result;
}

/// Checks that each kind of elements can fit into the rest of the file.
void require_room(const TextScanner& scanner, const PlyHeader& header)
{
    const std::uint64_t room = scanner.rest().size() + (header.encoding == Encoding::Ascii ? 1 : 0);
    for (const PlyElement& element : header.elements) {
        const std::uint64_t least = shortest(element, header.encoding);
        if (element.count > 0 && least == 0)
            scanner.fail_at(element.line, "the element {} has no properties; remove it or declare its properties",
                            in_quotes(element.name));
        if (element.count > 0 && element.count > room / least)
            scanner.fail_at(element.line,
                            "announces {} elements {}, but the {} bytes after the header cannot hold so many; the "
                            "file has been cut off, or the header is wrong: export or copy the mesh again",
                            element.count, in_quotes(element.name), scanner.rest().size());
    }
}

/// The names of the properties of an element that are skipped.
std::string properties_of(const PlyElement& element, const std::vector<Index>& columns)
{
    std::string names;
    for (std::size_t p = 0; p < columns.size(); ++p) {
        if (columns[p] >= 0)
            continue;
        names += names.empty() ? "" : " ";
        names += printable(element.properties[p].name);
    }
    return names;
}

}  // namespace

std::uint64_t PlyHeader::n_elements() const
{
    std::uint64_t n = 0;
    for (const PlyElement& element : elements)
        n += element.count;
    return n;
}

const PlyElement* PlyHeader::element(std::string_view name) const
{
    const auto found =
        std::find_if(elements.begin(), elements.end(), [&](const PlyElement& e) { return e.name == name; });
    return found != elements.end() ? &*found : nullptr;
}

const PlyProperty* PlyElement::property(std::string_view wanted) const
{
    const auto found = std::ranges::find(properties, wanted, &PlyProperty::name);
    return found != properties.end() ? &*found : nullptr;
}

std::vector<Index> columns_of(const PlyElement& element, std::initializer_list<std::string_view> names)
{
    return columns_of(element, [&](const PlyProperty& property) {
        const auto* const found = std::ranges::find(names, property.name);
        return found != names.end() ? static_cast<Index>(found - names.begin()) : -1;
    });
}

std::vector<Index> coordinates_in(const PlyElement& vertices)
{
    return columns_of(vertices, {"x", "y", "z"});
}

std::vector<Index> corners_in(const PlyElement& faces)
{
    return columns_of(faces, [](const PlyProperty& property) {
        return property.name == "vertex_indices" || property.name == "vertex_index" ? 0 : -1;
    });
}

void require_number(const TextScanner& scanner, const PlyElement& vertices, std::string_view name)
{
    const PlyProperty* const found = vertices.property(name);
    if (found != nullptr && !found->length_type)
        return;
    std::string names;
    for (const PlyProperty& p : vertices.properties)
        names += (names.empty() ? "" : ", ") + p.name;
    scanner.fail_at(found == nullptr ? vertices.line : found->line,
                    "the vertices have no number {}, but {}; name the property to use", in_quotes(name), names);
}

PlyHeader read_ply_header(TextScanner& scanner)
{
    PlyHeader header;
    bool has_format = false;
    if (!scanner.next_line() || scanner.peek() != "ply")
        scanner.fail(
            "the file begins with {} and not with ply; if it has another format, give it that format's extension",
            in_quotes(scanner.peek()));
    while (scanner.next_line()) {
        const auto keyword = scanner.token();
        if (keyword == "end_header") {
            if (!has_format)
                scanner.fail("the header has no line 'format'; add one, such as 'format ascii 1.0'");
            require_room(scanner, header);
            return header;
        }
        if (keyword == "format") {
            header.encoding = read_encoding(scanner);
            has_format = true;
        } else if (keyword == "element") {
            header.elements.push_back(read_element(scanner, header));
        } else if (keyword == "property") {
            auto property = read_property(scanner, header);
            header.elements.back().properties.push_back(std::move(property));
        } else if (keyword != "comment" && keyword != "obj_info") {
            scanner.fail("the header line {} is unknown; remove it, or write 'comment' in front of it",
                         in_quotes(keyword));
        }
    }
    scanner.fail("the file ends within its header, before the line end_header; export or copy the mesh again");
}

std::vector<std::string> extras_of_ply(const std::filesystem::path& path, std::string_view content)
{
    TextScanner scanner(path, content, ply_syntax);
    std::vector<std::string> extras;
    for (const PlyElement& element : read_ply_header(scanner).elements) {
        if (element.name == "tristrips")
            continue;
        const bool of_vertices = element.name == "vertex";
        if (!of_vertices && element.name != "face") {
            add_once(extras, "the element " + printable(element.name));
            continue;
        }
        const std::string names = properties_of(element, of_vertices ? coordinates_in(element) : corners_in(element));
        if (!names.empty())
            add_once(extras, (of_vertices ? "properties of vertices (" : "properties of faces (") + names + ")");
    }
    return extras;
}

}  // namespace seamflow
