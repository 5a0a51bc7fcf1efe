#include "tests/support/damage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace seamflow::test {

namespace {

using Face = std::vector<Index>;

Face& random_face(LooseMesh& mesh, RandomNumbers& random)
{
    return mesh.faces[random.below(mesh.n_faces())];
}

/// Moves vertices almost, or right, onto a neighbour of theirs.
void shorten_edges(LooseMesh& mesh, RandomNumbers& random)
{
    const double rest = random.unit() < 0.3 ? 0.0 : std::pow(10.0, -1.0 - 11.0 * random.unit());
    for (int i = 1 + random.below(5); i > 0; --i) {
        const Face& face = random_face(mesh, random);
        const Point target = mesh.points[face[1]];
        mesh.points[face[0]] = target + rest * (mesh.points[face[0]] - target);
    }
}

/// Presses faces almost, or exactly, onto a line.
void flatten_faces(LooseMesh& mesh, RandomNumbers& random)
{
    const double rest = random.unit() < 0.3 ? 0.0 : std::pow(10.0, -1.0 - 11.0 * random.unit());
    for (int i = 1 + random.below(5); i > 0; --i) {
        const Face& face = random_face(mesh, random);
        const Point begin = mesh.points[face[0]];
        const Point along = mesh.points[face[1]] - begin;
        for (std::size_t k = 2; k < face.size(); ++k) {
            const Point on_line = begin + random.unit() * along;
            mesh.points[face[k]] = on_line + rest * (mesh.points[face[k]] - on_line);
        }
    }
}

/// Further triangles on edges that have faces already.
void add_fins(LooseMesh& mesh, RandomNumbers& random)
{
    for (int i = 1 + random.below(4); i > 0; --i) {
        const Face face = random_face(mesh, random);
        const Point middle = 0.5 * (mesh.points[face[0]] + mesh.points[face[1]]);
        mesh.points.emplace_back(middle + Point(random.symmetric(), random.symmetric(), random.symmetric()));
        mesh.faces.push_back({face[0], face[1], mesh.n_points() - 1});
    }
}

/// Makes one vertex of two that no face has both of.
void pinch(LooseMesh& mesh, RandomNumbers& random)
{
    const Index a = random_face(mesh, random)[0];
    const Index b = random_face(mesh, random)[0];
    const auto has = [](const Face& face, Index v) { return std::find(face.begin(), face.end(), v) != face.end(); };
    if (a == b || std::any_of(mesh.faces.begin(), mesh.faces.end(),
                              [&](const Face& face) { return has(face, a) && has(face, b); }))
        return;
    for (Face& face : mesh.faces)
        std::replace(face.begin(), face.end(), b, a);
}

void turn_faces(LooseMesh& mesh, RandomNumbers& random)
{
    const double part = random.unit();
    for (Face& face : mesh.faces)
        if (random.unit() < part)
            std::reverse(face.begin(), face.end());
}

void repeat_faces(LooseMesh& mesh, RandomNumbers& random)
{
    const double part = random.unit() < 0.3 ? 1.0 : 0.3 * random.unit();
    const bool other_side = random.unit() < 0.5;
    const Index n = mesh.n_faces();
    for (Index f = 0; f < n; ++f)
        if (random.unit() < part) {
            Face face = mesh.faces[f];
            if (other_side)
                std::reverse(face.begin(), face.end());
            mesh.faces.push_back(face);
        }
}

/// A cone whose tip has up to 80 triangles.
void add_cone(LooseMesh& mesh, RandomNumbers& random)
{
    const Index n = 20 + random.below(60);
    const Index tip = mesh.n_points();
    mesh.points.emplace_back(-5.0, 0.0, random.symmetric());
    for (Index i = 0; i < 2 * n; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        const double radius = i < n ? 1.0 : 1.5;
        mesh.points.emplace_back(radius * std::cos(angle) - 5.0, radius * std::sin(angle), 0.1 * random.symmetric());
    }
    for (Index i = 0; i < n; ++i) {
        const Index j = (i + 1) % n;
        mesh.faces.push_back({tip, tip + 1 + i, tip + 1 + j});
        mesh.faces.push_back({tip + 1 + i, tip + 1 + n + i, tip + 1 + n + j, tip + 1 + j});
    }
}

}  // namespace

std::string damage(LooseMesh& mesh, RandomNumbers& random)
{
    struct Damage {
        const char* name;
        void (*apply)(LooseMesh&, RandomNumbers&);
    };
    static constexpr std::array all{Damage{"short edges", shorten_edges},
                                    Damage{"flat faces", flatten_faces},
                                    Damage{"fins", add_fins},
                                    Damage{"pinch", pinch},
                                    Damage{"turned faces", turn_faces},
                                    Damage{"repeated faces", repeat_faces},
                                    Damage{"cone", add_cone}};
    const Damage& chosen = all.at(usize(random.below(static_cast<int>(all.size()))));
    chosen.apply(mesh, random);
    return chosen.name;
}

}  // namespace seamflow::test
