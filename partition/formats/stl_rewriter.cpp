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
#include "partition/formats/stl_scan.h"
#include "partition/formats/writing_checks.h"
#include "partition/io/byte_order.h"
#include "partition/text.h"

namespace seamflow {

namespace {

/// A facet as written in a file.
struct WrittenFacet {
    WrittenNumbers normal;
    std::array<WrittenNumbers, 3> corners;

    [[nodiscard]] StlFacet values() const { return {corners[0].values, corners[1].values, corners[2].values}; }
};

/// The first three floats of some bytes.
WrittenNumbers floats_at(std::string_view bytes)
{
    WrittenNumbers floats;
    for (std::size_t k = 0; k < 3; ++k) {
        floats.parts[k] = bytes.substr(k * sizeof(float), sizeof(float));
        floats.values[static_cast<Index>(k)] = from_bytes<float>(floats.parts[k].data(), std::endian::little);
    }
    return floats;
}

/// A visitor for scan_text_stl that reads each facet with its normal and calls `visit` with it.
template <class Visit>
struct TextFacetVisitor {
    Visit& visit;
    WrittenFacet facet_so_far = {};

    void normal(TextScanner& scanner)
    {
        // Passes over the word `normal`.
        scanner.token();
        facet_so_far.normal = read_normal(scanner);
    }
    void corner(std::size_t k, TextScanner& scanner) { facet_so_far.corners[k] = read_position(scanner); }
    void facet() { visit(facet_so_far); }
};

/// A visitor for scan_text_stl that finds solids with names.
struct NameFinder {
    bool has_name = false;

    void solid(TextScanner& scanner) { has_name |= scanner.has_token(); }
};

/// A file read by read_stl, in pieces of whole facets, as the template for a file with other positions.
struct StlForm {
    StlForm(const std::filesystem::path& path, std::string_view content, const Slicing& slicing)
        : whole(path, content, stl_syntax)
        , is_text(is_text_stl(content))
        , facets(is_text ? whole.rest() : stl_facets(content))
    {
        if (is_text)
            pieces = stl_slices_at_facets(whole, slicing.bytes);
        const std::size_t size = std::max(slicing.bytes / stl_facet_bytes, std::size_t{1}) * stl_facet_bytes;
        for (std::size_t begin = 0; !is_text && begin < facets.size(); begin += size)
            pieces.push_back(facets.substr(begin, size));
    }

    [[nodiscard]] Index n_pieces() const { return static_cast<Index>(pieces.size()); }

    /// Calls visit with each facet of a piece.
    template <class Visit>
    void for_each_facet(Index piece, Visit&& visit) const
    {
        std::string_view rest = pieces[piece];
        if (is_text) {
            TextScanner scanner(whole, rest);
            TextFacetVisitor<Visit> visitor{visit};
            const bool begins_in_solid = piece > 0;
            scan_text_stl(scanner, begins_in_solid, visitor);
            return;
        }
        for (constexpr std::size_t size = 3 * sizeof(float); !rest.empty(); rest.remove_prefix(stl_facet_bytes))
            visit(WrittenFacet{
                floats_at(rest),
                {floats_at(rest.substr(size)), floats_at(rest.substr(2 * size)), floats_at(rest.substr(3 * size))}});
    }

    TextScanner whole;
    bool is_text;
    /// The facets: in text, everything except a byte order mark; and pieces of whole facets.
    std::string_view facets;
    std::vector<std::string_view> pieces = {};
};

/// Writes a facet with other corners in place of one in the file.
void exchange_facet(Splicer& splicer, const WrittenFacet& before, const StlFacet& after, bool is_text)
{
    const auto exchange = [&](std::string_view part, auto value) {
        ByteWriter& there = splicer.exchange(part);
        if (is_text)
            there.number(value);
        else
            there.binary(static_cast<float>(value), std::endian::little);
    };
    const double side = before.normal.values.dot(normal_of_facet(before.values())) < 0.0 ? -1.0 : 1.0;
    // Adding 0 turns -0 into 0, which is easier to read.
    const Point normal = side * normal_of_facet(after) + Point::Zero();
    for (Index k = 0; k < 3; ++k)
        if (!before.normal.parts[k].empty())
            exchange(before.normal.parts[k], static_cast<float>(normal[k]));
    for (std::size_t corner = 0; corner < 3; ++corner)
        for (Index k = 0; k < 3; ++k)
            if (differ(before.corners[corner].values[k], after[corner][k]))
                exchange(before.corners[corner].parts[k], after[corner][k]);
}

/// Whether two facets differ in any bit of a coordinate.
bool is_other_facet(const StlFacet& a, const StlFacet& b)
{
    for (std::size_t corner = 0; corner < 3; ++corner)
        for (Index k = 0; k < 3; ++k)
            if (differ(a[corner][k], b[corner][k]))
                return true;
    return false;
}

}  // namespace

std::vector<std::string> rewrite_stl(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh, const Slicing& slicing)
{
    const StlForm form(path, content, slicing);
    if (!form.is_text)
        require_floats(file.path(), mesh.vertices, slicing.exec, "binary STL");
    // The number of facets before each piece that are triangles, and so faces of the mesh.
    std::vector<Index> first(form.pieces.size() + 1, 0);
    for_each(slicing.exec, form.n_pieces(), [&](Index i) {
        form.for_each_facet(i, [&](const WrittenFacet& facet) { first[i + 1] += is_line(facet.values()) ? 0 : 1; });
    });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::atomic<Index> n_lines = 0;
    file.text(content.substr(0, static_cast<std::size_t>(form.facets.data() - content.data())));
    file.slices(form.n_pieces(), slicing.exec, [&](Index i, OutputBuffer& slice) {
        Splicer splicer(slice, form.pieces[i]);
        form.for_each_facet(i, [&, f = first[i]](const WrittenFacet& before) mutable {
            if (is_line(before.values()))
                return;
            const StlFacet given = facet_of(mesh, f++);
            const StlFacet after = form.is_text ? given : rounded(given);
            if (!is_other_facet(before.values(), after))
                return;
            n_lines += is_line(after) ? 1 : 0;
            exchange_facet(splicer, before, after, form.is_text);
        });
        splicer.finish();
    });
    const char* const end = form.facets.data() + form.facets.size();
    file.text({end, static_cast<std::size_t>(content.data() + content.size() - end)});
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
    const StlForm form(path, content, slicing);
    if (form.is_text) {
        std::vector<NameFinder> finders(form.pieces.size());
        for_each(slicing.exec, form.n_pieces(), [&](Index i) {
            TextScanner scanner(form.whole, form.pieces[i]);
            scan_text_stl(scanner, i > 0, finders[i]);
        });
        if (std::ranges::find(finders, true, &NameFinder::has_name) != finders.end())
            extras.emplace_back("names of solids");
        return extras;
    }
    const std::string_view header = content.substr(0, stl_header_bytes);
    if (header.find("COLOR=") != std::string_view::npos || header.find("MATERIAL=") != std::string_view::npos)
        extras.emplace_back("colours of the header");
    for (std::size_t end = stl_facet_bytes; end <= form.facets.size(); end += stl_facet_bytes)
        if (form.facets[end - 2] != 0 || form.facets[end - 1] != 0) {
            extras.emplace_back("attributes of facets");
            break;
        }
    return extras;
}

}  // namespace seamflow
