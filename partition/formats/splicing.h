#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "partition/formats/text_vertices.h"
#include "partition/io/byte_writer.h"
#include "partition/io/text_scanner.h"
#include "partition/metrics/vertex_normals.h"
#include "partition/weld.h"

namespace seamflow {

/// Copies the content of a file, or a slice of it, with parts replaced.
class Splicer {
  public:
    /// @param writer, content must outlive the splicer.
    Splicer(ByteWriter& writer, std::string_view content)
        : writer_(writer)
        , rest_(content)
    {
    }

    /// Copies the content before `part`, which must follow all parts replaced so far, and omits `part`.
    /// @returns where to write its replacement.
    ByteWriter& exchange(std::string_view part);

    /// Copies the rest. To be called once, at the end.
    void finish() { writer_.text(rest_); }

  private:
    ByteWriter& writer_;
    std::string_view rest_;
};

/// Whether two numbers differ in any bit: 0 and -0 do, a NaN and itself do not.
bool differ(double a, double b);

/// Whether two data differ in any bit. All NaN are equal: they stand for missing data.
bool differ_as_data(double a, double b);

/// Reads the next three numbers of the line.
WrittenNumbers read_position(TextScanner& scanner);

/// Writes the coordinates that differ from the ones in the file.
void exchange_position(Splicer& splicer, const WrittenNumbers& before, const Point& after);

/// Reads the next three tokens of the line, whatever they are.
WrittenNumbers read_normal(TextScanner& scanner);

/// Writes a normal, in single precision, in place of another.
void exchange_normal(Splicer& splicer, const WrittenNumbers& before, const Point& after);

/// The new normals of a file after its vertices have moved. A normal that pointed to the back of its faces still does.
class MovedNormals {
  public:
    /// @param mesh with the new positions; must outlive this object.
    /// @param before #V by 3, the positions in the file. @param seam_distance within which vertices along a seam are
    /// joined (see weld); 0: at equal positions.
    MovedNormals(const PolygonMesh& mesh, Points before, const Executor& exec = run_serially,
                 double seam_distance = 0.0);
    MovedNormals(const MovedNormals&) = delete;
    MovedNormals& operator=(const MovedNormals&) = delete;

    /// The new normal of the faces of some corners at one vertex (see VertexNormals), of length 1.
    /// @param given the normal in the file; may be NaN.
    /// @returns nothing if the normal does not change: the faces have not moved, or have no normal now.
    [[nodiscard]] std::optional<Point> around_vertex(std::span<const Index> corners, const Point& given) const;

    /// The new normal of all faces at vertex v. Along a seam (see weld) the faces at all vertices joined with v count
    /// if the normal in the file was closer to their common normal than to that of v alone: shading that was continuous
    /// across the seam stays continuous.
    /// @returns nothing if the normal does not change.
    [[nodiscard]] std::optional<Point> around_vertex(Index v, const Point& given) const;

    /// The new normal of one face.
    /// @returns nothing if the normal does not change.
    [[nodiscard]] std::optional<Point> of_face(Index f, const Point& given) const;

    [[nodiscard]] Index face_of(Index corner) const { return topology_.face_of[corner]; }

    /// Whether any vertex has moved.
    [[nodiscard]] bool moved() const { return before_ != mesh_.vertices; }

  private:
    const PolygonMesh& mesh_;
    Points before_;
    Topology topology_;
    VertexNormals normals_;
    /// The welded mesh, if the mesh has seams.
    std::optional<Weld> welded_;
    std::optional<VertexNormals> across_seams_;
};

/// The message for a file changed since it was read.
std::string changed_since_read(const std::filesystem::path& source);

/// A sentence for the user on whole numbers that are too small or too large.
/// @param name of the field. @param range of the numbers, or the type that has it.
std::string clamping_remark(std::string_view name, std::string_view range);

/// A sentence for the user on a file that is less precise than the results.
/// @param source the file that determines the type.
std::string rounding_remark(const std::filesystem::path& source);

}  // namespace seamflow
