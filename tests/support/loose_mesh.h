#pragma once

#include <vector>

#include "partition/vector_area.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow::test {

/// A mesh whose faces are easy to exchange. The changes below keep it valid (see require_valid): what they draw but
/// cannot be done is passed over. Each searches all faces, so they are for meshes of some hundred.
struct LooseMesh {
    std::vector<Point> points;
    std::vector<std::vector<Index>> faces;

    [[nodiscard]] Index n_points() const { return static_cast<Index>(points.size()); }
    [[nodiscard]] Index n_faces() const { return static_cast<Index>(faces.size()); }
};

LooseMesh loosened(const PolygonMesh& mesh);
PolygonMesh tightened(const LooseMesh& mesh);

/// Exchanges the edge between two triangles for the one between their other two corners, where there is none yet.
void flip_edge(LooseMesh& mesh, RandomNumbers& random);

/// Puts a new vertex into the middle of a face, which becomes a fan of triangles.
void split_face(LooseMesh& mesh, RandomNumbers& random);

/// Puts a new vertex on an edge; the faces at it get a corner more, or, if they are triangles, mostly become two.
void split_edge(LooseMesh& mesh, RandomNumbers& random);

/// Doubles an interior vertex: part of its faces go over to the new one, and two triangles fill the gap.
void split_vertex(LooseMesh& mesh, RandomNumbers& random);

/// Cuts a face of four sides or more along a diagonal.
void cut_face(LooseMesh& mesh, RandomNumbers& random);

/// Makes one face of two that share one edge and nothing else.
void merge_faces(LooseMesh& mesh, RandomNumbers& random);

/// Takes out a face and some of those around it.
void make_hole(LooseMesh& mesh, RandomNumbers& random);

/// A vertex in the middle of every face, a face around every vertex that has a closed fan of three faces or more.
LooseMesh dual_of(const LooseMesh& mesh);

/// Joins two meshes along a triangle of each, which both lose: of two tori it makes a surface of genus 2. Without a
/// triangle in one of them they only lie side by side.
LooseMesh glued(const LooseMesh& a, LooseMesh b, RandomNumbers& random);

/// Both in one, sharing nothing, `b` moved by `shift`.
LooseMesh beside(LooseMesh a, const LooseMesh& b, const Point& shift);

}  // namespace seamflow::test
