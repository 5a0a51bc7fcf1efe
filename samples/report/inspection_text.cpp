#include "samples/report/inspection_text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <vector>

#include <fmt/format.h>

#include "samples/process/option_words.h"
#include "solvers/rounding/rounded_surface.h"

namespace seamflow {

namespace {

/// A part of the vertices that is as good as all.
constexpr double all_but_few = 0.95;

std::string digits_of(double value)
{
    return fmt::format("{:.6g}", value);
}

std::string text_of(Index element)
{
    return fmt::to_string(element);
}

std::string text_of(const Edge& edge)
{
    return fmt::format("{}-{}", edge[0], edge[1]);
}

/// Prints the defects, one kind per paragraph.
class FindingsPrinter {
  public:
    FindingsPrinter(std::ostream& out, int most_listed)
        : out_(out)
        , most_listed_(static_cast<std::size_t>(most_listed))
    {
    }

    /// @param meaning what `smooth` does about it, or what the user may.
    template <class Element>
    void print(const std::vector<Element>& elements, const char* kind, const char* meaning)
    {
        if (elements.empty())
            return;
        begin(elements.size(), kind);
        const std::size_t n_listed = std::min(elements.size(), most_listed_);
        for (std::size_t i = 0; i < n_listed; ++i)
            out_ << (i == 0 ? ": " : " ") << text_of(elements[i]);
        out_ << (n_listed < elements.size() && n_listed > 0 ? " …" : "") << "\n    " << meaning << '\n';
    }

    void print(const FaultLog& faults)
    {
        if (faults.count == 0)
            return;
        begin(faults.count, "faults in the file");
        out_ << '\n';
        for (std::size_t i = 0; i < faults.messages.size() && i < most_listed_; ++i)
            out_ << "    " << faults.messages[i] << '\n';
        out_ << (faults.n_harmless == faults.count
                     ? "    smooth leaves such faces and numbers out of the flow, and refuses the file with --strict\n"
                     : "    smooth refuses the file until they are mended\n");
    }

    void print(const char* sentence)
    {
        out_ << sentence << '\n';
        any_ = true;
    }

    [[nodiscard]] bool any() const { return any_; }

  private:
    void begin(std::uint64_t count, const char* kind)
    {
        out_ << kind << " (" << count << ')';
        any_ = true;
    }

    std::ostream& out_;
    std::size_t most_listed_;
    bool any_ = false;
};

void print_sizes(std::ostream& out, const std::string& file, const MeshInspection& found,
                 const SurfaceRoughness& roughness)
{
    const std::optional<SurfaceNoise>& noise = roughness.noise;
    out << file << '\n'
        << "vertices   " << found.counts.vertices << '\n'
        << "edges      " << found.counts.edges << ", " << found.counts.boundary_edges
        << " of them on the boundary; shortest " << digits_of(found.edge_lengths.shortest) << ", mean "
        << digits_of(found.edge_lengths.mean) << ", longest " << digits_of(found.edge_lengths.longest) << '\n';
    if (found.counts.seam_edges > 0)
        out << "seams      " << found.counts.seam_edges << (found.counts.seam_edges == 1 ? " pair" : " pairs")
            << " of boundary edges lie on each other; smooth moves the " << found.counts.seam_vertices
            << " vertices along them as one\n";
    out << "faces      " << found.counts.faces;
    constexpr std::array<const char*, 5> names = {"triangles", "quads", "pentagons", "hexagons", "with more sides"};
    for (std::size_t k = 0; k < names.size(); ++k)
        if (found.counts.faces_by_sides[k] > 0)
            out << ", " << found.counts.faces_by_sides[k] << ' ' << names[k];
    out << '\n'
        << "components " << found.counts.components << '\n'
        << "box        " << digits_of(found.box.diagonal) << " from corner to corner, around ("
        << digits_of(found.box.middle[0]) << ", " << digits_of(found.box.middle[1]) << ", "
        << digits_of(found.box.middle[2]) << ")\n";
    if (noise && noise->part > 0.0)
        out << fmt::format("noise      {:.2g} edge lengths ({:.2g}) on {:.0f}% of the vertices{}\n",
                           noise->deviation / noise->edge, noise->deviation, 100.0 * noise->part,
                           noise->part < all_but_few ? ", none that can be told from the shape on the others" : "");
    else if (noise)
        out << "noise      none that can be told from the shape\n";
    else if (roughness.steps)
        out << "rounded    coordinates lie in steps of " << steps_in_words(*roughness.steps)
            << ", which makes the surface rough: smooth finds the smoothest one within half a step\n";
}

}  // namespace

void print_inspection(std::ostream& out, const std::string& file, const FaultLog& faults, const MeshInspection& found,
                      int most_listed, const SurfaceRoughness& roughness)
{
    print_sizes(out, file, found, roughness);
    FindingsPrinter printer(out, most_listed);
    printer.print(faults);
    printer.print(found.defects.vertices_not_finite, "vertices with coordinates that are not finite numbers",
                  "smooth refuses them: give them positions, or remove them and their faces");
    printer.print(found.defects.non_manifold_edges, "edges of three faces or more",
                  "smooth moves their vertices with all of these faces, or holds them (--junctions hold)");
    printer.print(found.defects.non_manifold_vertices, "vertices around which the mesh is not manifold",
                  "smooth holds those fixed that are on no edge of three faces or more");
    printer.print(found.defects.inconsistent_edges, "edges whose faces are oriented against each other",
                  found.orientable ? "smooth does not mind; normals that it writes do"
                                   : "smooth does not mind; no orientation fits all faces, as on a Möbius band");
    if (found.cracks)
        printer.print(
            (sentence(remark_on_cracks(*found.cracks), option_of_program) + " It is an option of smooth.").c_str());
    printer.print(found.defects.spikes, "vertices far from all of their neighbours",
                  "remove them, or give them the right positions; without an amount smooth holds them");
    printer.print(
        found.defects.duplicate_faces, "faces with the same vertices as an earlier face",
        "where they make the mesh not manifold smooth leaves them out of the flow, and keeps them in the file");
    if (found.defects.n_turned_round > 0)
        printer.print(
            fmt::format("    {} of them are turned round, as on surfaces with two sides: smooth lets one side "
                        "flow, and moves both",
                        found.defects.n_turned_round)
                .c_str());
    printer.print(found.defects.faces_without_area, "faces without area",
                  "with any Laplacian but fujiwara smooth cannot move their vertices");
    printer.print(found.defects.edges_without_length, "edges without length",
                  "with fujiwara smooth cannot move their ends");
    printer.print(found.defects.coincident_vertices, "vertices at the same place as an earlier vertex",
                  "smooth moves those along seams as one, and each of the others with its own faces");
    printer.print(found.defects.isolated_vertices, "vertices without faces", "they stay where they are");
    printer.print(found.defects.far_vertices, "of these, vertices further from the surface than it is large",
                  "they count in no length of smooth; other programs may take them for a part of the surface");
    printer.print(found.defects.self_intersections,
                  found.defects.self_intersections.size() < most_self_intersections
                      ? "pairs of faces that cross each other"
                      : "pairs of faces that cross each other, and no more were looked for",
                  "smooth moves them as if they did not; programs that fill or print the solid may mind");
    if (found.bits_for_detail < 30)
        printer.print("The mesh lies so far from the origin that its coordinates are coarse compared with its edges: "
                      "floats cannot hold it; move it to the origin.");
    if (!printer.any())
        out << "nothing wrong was found\n";
    out.flush();
}

}  // namespace seamflow
