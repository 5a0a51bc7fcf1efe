#include "solvers/rounding/uncrossed_faces.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "partition/metrics/flipped_faces.h"
#include "partition/metrics/self_intersections.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// In each round, wrong vertices go back towards the fair surface: this fraction of their distance from it is left. A
/// smaller fraction makes kinks in lines (with 0.5, 23 in place of 10 degrees from edge to edge).
constexpr double kept_of_fair = 0.95;
/// In the rounds after these, they go back towards the input: this fraction of their distance from it is left, and 0 in
/// the last round.
constexpr double kept_of_input = 0.5;
constexpr int rounds_to_fair = 40;
constexpr int rounds_to_input = 6;
/// Faces are looked at up to this many rings around such lines, points and edges.
constexpr int rings = 2;
/// Vertices of more faces are crowded: each round would compare all pairs of these.
constexpr std::size_t crowded = 200;
/// The largest cosine between the normals of two faces at a sharp edge.
constexpr double sharp = 0.5;

/// Whether two faces meet at half-edge h at a sharp angle, or one of them has no area.
bool is_sharp(const PolygonMesh& mesh, const Topology& topology, const Points& normals, Index h)
{
    const Index twin = topology.twin[h];
    if (twin < h)
        return false;
    const double sense = mesh.face_vertices[twin] == mesh.face_vertices[h] ? -1.0 : 1.0;
    return !(sense * normals.row(topology.face_of[h]).dot(normals.row(topology.face_of[twin])) > sharp);
}

/// The vertices that have moved, on lines of several sheets, points where bodies touch, and sharp edges; but for
/// crowded ones.
std::vector<Index> doubtful_vertices(const PolygonMesh& mesh, const Topology& topology, const Points& before,
                                     const Points& positions, const Executor& exec)
{
    Points normals(mesh.n_faces(), 3);
    for_each(exec, mesh.n_faces(),
             [&](Index f) { normals.row(f) = vector_area(mesh.face(f), positions).stableNormalized(); });
    std::vector<Index> found =
        select(exec, mesh.n_vertices(), [&](Index v) { return topology.kind[v] == VertexKind::NonManifold; });
    const auto add_ends = [&](Index h) {
        found.push_back(mesh.face_vertices[h]);
        found.push_back(mesh.face_vertices[topology.next(mesh, h)]);
    };
    for (const JunctionLink& link : topology.junctions)
        add_ends(link.halfedge);
    std::ranges::for_each(select(exec, mesh.n_corners(), [&](Index h) { return is_sharp(mesh, topology, normals, h); }),
                          add_ends);
    std::erase_if(
        found, [&](Index v) { return positions.row(v) == before.row(v) || topology.corners_at(v).size() > crowded; });
    return found;
}

/// The faces up to a few rings around vertices, ascending.
std::vector<Index> faces_around(const PolygonMesh& mesh, const Topology& topology, std::vector<Index> vertices)
{
    std::vector<Index> faces;
    for (int ring = 0; ring < rings; ++ring) {
        sort_unique(vertices);
        for (const Index v : vertices)
            for (const Index corner : topology.corners_at(v))
                faces.push_back(topology.face_of[corner]);
        sort_unique(faces);
        for (const Index f : faces)
            vertices.insert(vertices.end(), mesh.face(f).begin(), mesh.face(f).end());
    }
    return faces;
}

/// Finds what is wrong with some faces.
class WrongFaces {
  public:
    /// @param faces ascending. @param before #V by 3; it and exec must outlive the object.
    WrongFaces(const PolygonMesh& mesh, const std::vector<Index>& faces, const Points& before, const Executor& exec)
        : before_(before)
        , exec_(exec)
    {
        for (const Index f : faces)
            only_these_.add_face(mesh.face(f));
        crossing_before_ = self_intersections(only_these_, before, exec);
    }

    /// The vertices of faces that cross others and did not before, or have turned by more than 90°, ascending.
    [[nodiscard]] std::vector<Index> vertices(const Points& positions) const
    {
        std::vector<Index> found;
        const auto add_face = [&](Index i) {
            const auto corners = only_these_.face(i);
            found.insert(found.end(), corners.begin(), corners.end());
        };
        std::vector<FacePair> pairs;
        std::ranges::set_difference(self_intersections(only_these_, positions, exec_), crossing_before_,
                                    std::back_inserter(pairs));
        for (const FacePair& pair : pairs)
            std::ranges::for_each(pair, add_face);
        std::ranges::for_each(flipped_faces(only_these_, before_, positions, exec_), add_face);
        sort_unique(found);
        return found;
    }

  private:
    const Points& before_;
    const Executor& exec_;
    /// The faces, numbered anew; vertices have their numbers.
    PolygonMesh only_these_;
    std::vector<FacePair> crossing_before_;
};

}  // namespace

void uncross_faces(const PolygonMesh& mesh, const Topology& topology, const Points& fair, const Boxes& boxes,
                   Points& positions, const Executor& exec)
{
    const WrongFaces of_all(
        mesh, faces_around(mesh, topology, doubtful_vertices(mesh, topology, boxes.middles, positions, exec)),
        boxes.middles, exec);
    std::vector<Index> wrong = of_all.vertices(positions);
    for (int round = 0; round < rounds_to_fair + rounds_to_input && !wrong.empty(); ++round) {
        const bool is_to_fair = round < rounds_to_fair;
        const bool is_last = round + 1 == rounds_to_fair + rounds_to_input;
        const Points& towards = is_to_fair ? fair : boxes.middles;
        const double kept = is_to_fair ? kept_of_fair : is_last ? 0.0 : kept_of_input;
        for (const Index v : wrong)
            positions.row(v) = boxes.nearest(v, towards.row(v) + kept * (positions.row(v) - towards.row(v)));
        // Where nothing has moved, nothing is new.
        wrong = WrongFaces(mesh, faces_around(mesh, topology, wrong), boxes.middles, exec).vertices(positions);
        if (wrong.empty())
            wrong = of_all.vertices(positions);
    }
}

}  // namespace seamflow
