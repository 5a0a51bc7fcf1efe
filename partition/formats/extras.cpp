#include "partition/formats/extras.h"

#include <algorithm>
#include <array>
#include <utility>

#include "partition/formats/obj.h"
#include "partition/formats/off.h"
#include "partition/formats/off_header.h"
#include "partition/formats/ply_header.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

namespace {

/// A list without doubles, in order of appearance.
void add(std::vector<std::string>& list, std::string_view what)
{
    if (std::find(list.begin(), list.end(), what) == list.end())
        list.emplace_back(what);
}

std::size_t count_tokens(TextScanner& scanner)
{
    std::size_t n = 0;
    while (!scanner.token().empty())
        ++n;
    return n;
}

std::string_view extra_of_statement(std::string_view keyword)
{
    using Entry = std::pair<std::string_view, std::string_view>;
    constexpr std::array<Entry, 10> known = {Entry{"vt", "texture coordinates"},
                                             Entry{"vn", "normals"},
                                             Entry{"mtllib", "materials"},
                                             Entry{"usemtl", "materials"},
                                             Entry{"g", "groups"},
                                             Entry{"o", "groups"},
                                             Entry{"s", "smoothing groups"},
                                             Entry{"p", "points"},
                                             Entry{"l", "lines"},
                                             Entry{"vp", "curves"}};
    for (const auto& [name, extra] : known)
        if (keyword == name)
            return extra;
    return "other statements";
}

/// The kinds of the numbers after the coordinates, by the keyword of the file.
void add_extras_of_keyword(std::vector<std::string>& extras, const OffHeader& header)
{
    const std::string_view prefix = header.prefix;
    if (prefix.find("ST") != std::string_view::npos)
        add(extras, "texture coordinates");
    if (prefix.find('C') != std::string_view::npos)
        add(extras, "colours");
    if (header.has_normals())
        add(extras, "normals");
}

std::string properties_of(const PlyElement& element, const auto& is_read)
{
    std::string names;
    for (const PlyProperty& property : element.properties) {
        if (is_read(property.name))
            continue;
        names += names.empty() ? "" : " ";
        names += printable(property.name);
    }
    return names;
}

bool is_coordinate(std::string_view name)
{
    return name == "x" || name == "y" || name == "z";
}

bool is_list_of_corners(std::string_view name)
{
    return name == "vertex_indices" || name == "vertex_index";
}

}  // namespace

std::vector<std::string> extras_of_obj(const std::filesystem::path& path, std::string_view text)
{
    TextScanner scanner(path, text, obj_syntax);
    std::vector<std::string> extras;
    while (scanner.next_line()) {
        const std::string_view keyword = scanner.token();
        if (is_obj_face(keyword))
            continue;
        if (keyword != "v") {
            add(extras, extra_of_statement(keyword));
            continue;
        }
        const std::size_t n = count_tokens(scanner);
        if (n > 3)
            add(extras, n > 5 ? "colours" : "weights");
    }
    return extras;
}

std::vector<std::string> extras_of_off(const std::filesystem::path& path, std::string_view content)
{
    std::vector<std::string> extras;
    if (start_of_binary_off(content))
        return extras;
    TextScanner scanner(path, content);
    const OffHeader header = read_off_header(scanner);
    add_extras_of_keyword(extras, header);
    for (std::int64_t v = 0; v < header.n_vertices && scanner.next_line(); ++v)
        if (count_tokens(scanner) > 3 && header.prefix.empty())
            add(extras, "further numbers of vertices");
    for (std::int64_t f = 0; f < header.n_faces && scanner.next_line(); ++f)
        if (const std::int64_t n = scanner.integer("corners"); count_tokens(scanner) > static_cast<std::size_t>(n))
            add(extras, "colours of faces");
    return extras;
}

std::vector<std::string> extras_of_ply(const std::filesystem::path& path, std::string_view content)
{
    TextScanner scanner(path, content, ply_syntax);
    std::vector<std::string> extras;
    for (const PlyElement& element : read_ply_header(scanner).elements) {
        const bool of_vertices = element.name == "vertex";
        if (!of_vertices && element.name != "face") {
            add(extras, "the element " + printable(element.name));
            continue;
        }
        const std::string names =
            of_vertices ? properties_of(element, is_coordinate) : properties_of(element, is_list_of_corners);
        if (!names.empty())
            add(extras, (of_vertices ? "properties of vertices (" : "properties of faces (") + names + ")");
    }
    return extras;
}

}  // namespace seamflow
