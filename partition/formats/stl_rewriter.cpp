#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "partition/formats/splicing.h"
#include "partition/formats/stl.h"
#include "partition/formats/stl_facets.h"
#include "partition/io/byte_scanner.h"

namespace seamflow {

namespace {

/// A facet as written in a file.
struct WrittenFacet {
    WrittenNumbers normal;
    StlFacet corners;
    std::array<std::array<std::string_view, 3>, 3> parts;
};

bool is_other_facet(const StlFacet& a, const StlFacet& b)
{
    for (std::size_t corner = 0; corner < 3; ++corner)
        for (Index k = 0; k < 3; ++k)
            if (differ(a[corner][k], b[corner][k]))
                return true;
    return false;
}

Point read_floats(std::string_view bytes, std::array<std::string_view, 3>& parts)
{
    Point values;
    for (std::size_t k = 0; k < 3; ++k) {
        parts[k] = bytes.substr(k * sizeof(float), sizeof(float));
        values[static_cast<Index>(k)] = from_bytes<float>(parts[k].data(), std::endian::little);
    }
    return values;
}

/// Calls visit with each facet.
template <class Visit>
void walk_binary(std::string_view facets, Visit&& visit)
{
    for (; !facets.empty(); facets.remove_prefix(stl_facet_bytes)) {
        WrittenFacet facet;
        facet.normal.values = read_floats(facets, facet.normal.parts);
        for (std::size_t corner = 0; corner < 3; ++corner)
            facet.corners[corner] = read_floats(facets.substr(12 * (corner + 1)), facet.parts[corner]);
        visit(facet);
    }
}

template <class Visit>
void walk_text(TextScanner scanner, Visit&& visit)
{
    WrittenFacet facet;
    std::size_t n_corners = 0;
    while (scanner.next_line()) {
        const std::string_view keyword = scanner.token();
        if (is_keyword(keyword, "facet")) {
            scanner.token();
            facet.normal = read_normal(scanner);
            n_corners = 0;
        } else if (is_keyword(keyword, "vertex")) {
            for (std::size_t k = 0; k < 3; ++k) {
                facet.parts[n_corners][k] = scanner.peek();
                facet.corners[n_corners][static_cast<Index>(k)] = scanner.real("a coordinate");
            }
            if (++n_corners == 3)
                visit(facet);
        }
    }
}

}  // namespace

StlForm::StlForm(const std::filesystem::path& path, std::string_view content)
    : whole_(path, content, {.comment = '\0'})
    , content_(content)
    , is_text_(is_text_stl(content))
{
}

std::string_view StlForm::begin() const
{
    return content_.substr(0, is_text_ ? content_.size() - whole_.rest().size() : stl_header_bytes);
}

std::string_view StlForm::facets() const
{
    return is_text_ ? whole_.rest() : stl_facets(content_);
}

std::string_view StlForm::end() const
{
    return content_.substr(begin().size() + facets().size());
}

std::vector<std::string_view> StlForm::pieces(std::string_view facets, std::size_t bytes) const
{
    if (is_text_)
        return stl_slices_at_facets(TextScanner(whole_, facets), bytes);
    std::vector<std::string_view> pieces;
    const std::size_t size = std::max(bytes / stl_facet_bytes, std::size_t{1}) * stl_facet_bytes;
    for (std::size_t begin = 0; begin < facets.size(); begin += size)
        pieces.push_back(facets.substr(begin, size));
    return pieces;
}

template <class Visit>
void StlForm::walk(std::string_view piece, Visit&& visit) const
{
    is_text_ ? walk_text(TextScanner(whole_, piece), visit) : walk_binary(piece, visit);
}

Index StlForm::count(std::string_view piece) const
{
    Index n = 0;
    walk(piece, [&](const WrittenFacet& facet) { n += is_line(facet.corners) ? 0 : 1; });
    return n;
}

Index StlForm::rewrite(ByteWriter& file, std::string_view piece,
                       const std::function<StlFacet(Index facet)>& facet_of) const
{
    Splicer splicer(file, piece);
    const auto write = [&](std::string_view part, double before, double after) {
        if (!differ(before, after))
            return;
        ByteWriter& there = splicer.exchange(part);
        if (is_text_)
            there.number(after);
        else
            there.binary(static_cast<float>(after), std::endian::little);
    };
    Index n = 0;
    Index n_lines = 0;
    walk(piece, [&](const WrittenFacet& before) {
        if (is_line(before.corners))
            return;
        const StlFacet after = is_text_ ? facet_of(n++) : rounded(facet_of(n++));
        if (!is_other_facet(before.corners, after))
            return;
        n_lines += is_line(after) ? 1 : 0;
        const double side = before.normal.values.dot(normal_of_facet(before.corners)) < 0.0 ? -1.0 : 1.0;
        // The sum has no negative zeros, which nobody likes to read.
        const Point normal = side * normal_of_facet(after) + Point::Zero();
        for (std::size_t k = 0; k < 3; ++k)
            if (const std::string_view part = before.normal.parts[k]; !part.empty()) {
                ByteWriter& there = splicer.exchange(part);
                const auto value = static_cast<float>(normal[static_cast<Index>(k)]);
                is_text_ ? there.number(value) : there.binary(value, std::endian::little);
            }
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t k = 0; k < 3; ++k)
                write(before.parts[corner][k], before.corners[corner][static_cast<Index>(k)],
                      after[corner][static_cast<Index>(k)]);
    });
    splicer.finish();
    return n_lines;
}

std::vector<std::string> rewrite_stl(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh, const Slicing& slicing)
{
    const StlForm form(path, content);
    if (!form.is_text())
        require_floats(file.path(), mesh.vertices);
    const std::vector<std::string_view> pieces = form.pieces(form.facets(), slicing.bytes);
    const auto n = static_cast<Index>(pieces.size());
    std::vector<Index> first(pieces.size() + 1, 0);
    for_each(slicing.exec, n, [&](Index i) { first[i + 1] = form.count(pieces[i]); });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::atomic<Index> n_lines = 0;
    file.text(form.begin());
    file.slices(n, slicing.exec, [&](Index i, OutputBuffer& slice) {
        n_lines += form.rewrite(slice, pieces[i], [&](Index f) { return facet_of(mesh, first[i] + f); });
    });
    file.text(form.end());
    return remarks_on_lines(path, n_lines);
}

std::vector<std::string> remarks_on_lines(const std::filesystem::path& path, std::int64_t n)
{
    if (n == 0)
        return {};
    return {fmt::format("{} of {} {} become {}, because corners coincide in the file's precision; {} still there",
                        counted(static_cast<std::size_t>(n), "facet", "facets"), path.string(), n == 1 ? "has" : "have",
                        n == 1 ? "a line" : "lines", n == 1 ? "it is" : "they are")};
}

std::vector<std::string> extras_of_stl(const std::filesystem::path& path, std::string_view content,
                                       const Slicing& slicing)
{
    std::vector<std::string> extras;
    const StlForm form(path, content);
    if (form.is_text()) {
        const std::vector<std::string_view> pieces = form.pieces(form.facets(), slicing.bytes);
        std::vector<std::uint8_t> has_name(pieces.size(), 0);
        for_each(slicing.exec, static_cast<Index>(pieces.size()), [&](Index i) {
            TextScanner scanner(TextScanner(path, content, {.comment = '\0'}), pieces[i]);
            while (scanner.next_line())
                if (is_keyword(scanner.token(), "solid") && scanner.has_token())
                    has_name[i] = 1;
        });
        if (std::ranges::find(has_name, 1) != has_name.end())
            extras.emplace_back("names of solids");
        return extras;
    }
    if (form.begin().find("COLOR=") != std::string_view::npos ||
        form.begin().find("MATERIAL=") != std::string_view::npos)
        extras.emplace_back("colours of the header");
    const std::string_view facets = form.facets();
    for (std::size_t end = stl_facet_bytes; end <= facets.size(); end += stl_facet_bytes)
        if (facets[end - 2] != 0 || facets[end - 1] != 0) {
            extras.emplace_back("attributes of facets");
            break;
        }
    return extras;
}

}  // namespace seamflow
