#include "tests/support/loose_mesh.h"

#include <algorithm>
#include <utility>

namespace seamflow::test {

namespace {

using Face = std::vector<Index>;

/// A place in a face.
struct Corner {
    Index face = -1;
    std::size_t place = 0;
};

Index after(const Face& face, std::size_t place)
{
    return face[(place + 1) % face.size()];
}

Index before(const Face& face, std::size_t place)
{
    return face[(place + face.size() - 1) % face.size()];
}

Corner random_corner(const LooseMesh& mesh, RandomNumbers& random)
{
    const Index f = random.below(mesh.n_faces());
    return {f, usize(random.below(static_cast<int>(mesh.faces[f].size())))};
}

/// All places at which an edge starts that joins a and b, in either direction.
std::vector<Corner> edges_between(const LooseMesh& mesh, Index a, Index b)
{
    std::vector<Corner> found;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const Face& face = mesh.faces[f];
        for (std::size_t k = 0; k < face.size(); ++k)
            if ((face[k] == a && after(face, k) == b) || (face[k] == b && after(face, k) == a))
                found.push_back({f, k});
    }
    return found;
}

/// The one other face at the edge that starts there, if it runs the other way; else face -1.
Corner across(const LooseMesh& mesh, Corner corner)
{
    const Face& face = mesh.faces[corner.face];
    const Index start = face[corner.place];
    const auto found = edges_between(mesh, start, after(face, corner.place));
    if (found.size() != 2)
        return {};
    const Corner other = found[0].face == corner.face ? found[1] : found[0];
    return mesh.faces[other.face][other.place] == start ? Corner{} : other;
}

/// The faces around a vertex in order, each with the place of the vertex, if they form one closed fan of faces that are
/// oriented alike; else none. Face i and the one after share the edge to the corner after the vertex in face i.
std::vector<Corner> closed_fan(const LooseMesh& mesh, Index v)
{
    std::vector<Corner> all;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const Face& face = mesh.faces[f];
        const auto found = std::find(face.begin(), face.end(), v);
        if (found != face.end())
            all.push_back({f, static_cast<std::size_t>(found - face.begin())});
    }
    std::vector<Corner> fan;
    if (all.empty())
        return fan;
    for (Corner now = all.front(); fan.size() < all.size();) {
        fan.push_back(now);
        const Corner next = across(mesh, now);
        if (next.face < 0)
            return {};
        // The edge runs from the neighbour to v there.
        now = {next.face, (next.place + 1) % mesh.faces[next.face].size()};
        if (now.face == all.front().face)
            break;
    }
    return fan.size() == all.size() && across(mesh, fan.back()).face == fan.front().face ? fan : std::vector<Corner>{};
}

Point middle_of(const LooseMesh& mesh, const Face& face)
{
    Point sum = Point::Zero();
    for (const Index v : face)
        sum += mesh.points[v];
    return sum / static_cast<double>(face.size());
}

Index add_point(LooseMesh& mesh, const Point& point)
{
    mesh.points.push_back(point);
    return mesh.n_points() - 1;
}

}  // namespace

LooseMesh loosened(const PolygonMesh& mesh)
{
    LooseMesh loose;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        loose.points.emplace_back(mesh.vertices.row(v));
    for (Index f = 0; f < mesh.n_faces(); ++f)
        loose.faces.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
    return loose;
}

PolygonMesh tightened(const LooseMesh& mesh)
{
    PolygonMesh tight;
    tight.vertices.resize(mesh.n_points(), 3);
    for (Index v = 0; v < mesh.n_points(); ++v)
        tight.vertices.row(v) = mesh.points[v];
    for (const Face& face : mesh.faces)
        tight.add_face(face);
    return tight;
}

void flip_edge(LooseMesh& mesh, RandomNumbers& random)
{
    const Corner here = random_corner(mesh, random);
    const Corner there = across(mesh, here);
    if (there.face < 0 || mesh.faces[here.face].size() != 3 || mesh.faces[there.face].size() != 3)
        return;
    const Index a = mesh.faces[here.face][here.place];
    const Index b = mesh.faces[there.face][there.place];
    const Index c = before(mesh.faces[here.face], here.place);
    const Index d = before(mesh.faces[there.face], there.place);
    if (c == d || !edges_between(mesh, c, d).empty())
        return;
    mesh.faces[here.face] = {a, d, c};
    mesh.faces[there.face] = {d, b, c};
}

void split_face(LooseMesh& mesh, RandomNumbers& random)
{
    const Index f = random.below(mesh.n_faces());
    const Face face = mesh.faces[f];
    const Index middle = add_point(mesh, middle_of(mesh, face));
    mesh.faces[f] = {face[0], face[1], middle};
    for (std::size_t k = 1; k < face.size(); ++k)
        mesh.faces.push_back({face[k], after(face, k), middle});
}

void split_edge(LooseMesh& mesh, RandomNumbers& random)
{
    const Corner corner = random_corner(mesh, random);
    const Index a = mesh.faces[corner.face][corner.place];
    const Index b = after(mesh.faces[corner.face], corner.place);
    const bool triangles_stay = random.unit() < 0.9;
    const Index middle = add_point(mesh, 0.5 * (mesh.points[a] + mesh.points[b]));
    for (const Corner& edge : edges_between(mesh, a, b)) {
        Face& face = mesh.faces[edge.face];
        if (face.size() == 3 && triangles_stay) {
            const Index tip = before(face, edge.place);
            const Index end = after(face, edge.place);
            face = {face[edge.place], middle, tip};
            mesh.faces.push_back({middle, end, tip});
        } else
            face.insert(face.begin() + static_cast<std::ptrdiff_t>(edge.place) + 1, middle);
    }
}

void split_vertex(LooseMesh& mesh, RandomNumbers& random)
{
    const Corner corner = random_corner(mesh, random);
    const Index v = mesh.faces[corner.face][corner.place];
    const std::vector<Corner> fan = closed_fan(mesh, v);
    const auto n = static_cast<int>(fan.size());
    if (n < 4)
        return;
    const auto first = usize(random.below(n));
    const auto count = usize(1 + random.below(n - 2));
    const auto face_at = [&](std::size_t i) -> const Corner& { return fan[i % fan.size()]; };
    // The new vertex gets `count` faces from `first` on.
    const Index begin = before(mesh.faces[face_at(first).face], face_at(first).place);
    const Index end = after(mesh.faces[face_at(first + count - 1).face], face_at(first + count - 1).place);
    if (begin == end)
        return;
    const Point inside = middle_of(mesh, mesh.faces[face_at(first + count / 2).face]);
    const Index twin = add_point(mesh, 0.7 * mesh.points[v] + 0.3 * inside);
    for (std::size_t i = first; i < first + count; ++i)
        mesh.faces[face_at(i).face][face_at(i).place] = twin;
    mesh.faces.push_back({begin, v, twin});
    mesh.faces.push_back({end, twin, v});
}

void cut_face(LooseMesh& mesh, RandomNumbers& random)
{
    const Corner corner = random_corner(mesh, random);
    Face face = mesh.faces[corner.face];
    const auto n = static_cast<int>(face.size());
    if (n < 4)
        return;
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(corner.place), face.end());
    const auto other = 2 + random.below(n - 3);
    if (!edges_between(mesh, face[0], face[other]).empty())
        return;
    mesh.faces[corner.face] = Face(face.begin(), face.begin() + other + 1);
    Face rest(face.begin() + other, face.end());
    rest.push_back(face[0]);
    mesh.faces.push_back(std::move(rest));
}

void merge_faces(LooseMesh& mesh, RandomNumbers& random)
{
    const Corner here = random_corner(mesh, random);
    const Corner there = across(mesh, here);
    if (there.face < 0 || there.face == here.face)
        return;
    Face first = mesh.faces[here.face];
    Face second = mesh.faces[there.face];
    const auto is_in_second = [&](Index v) { return std::find(second.begin(), second.end(), v) != second.end(); };
    if (std::count_if(first.begin(), first.end(), is_in_second) != 2)
        return;
    // first: a b …, second: b a …
    std::rotate(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(here.place), first.end());
    std::rotate(second.begin(), second.begin() + static_cast<std::ptrdiff_t>(there.place), second.end());
    first.insert(first.begin() + 1, second.begin() + 2, second.end());
    mesh.faces[here.face] = std::move(first);
    mesh.faces.erase(mesh.faces.begin() + there.face);
}

void make_hole(LooseMesh& mesh, RandomNumbers& random)
{
    const Index v = mesh.faces[random.below(mesh.n_faces())][0];
    const double part = random.unit();
    Face open;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const Face& face = mesh.faces[f];
        if (std::find(face.begin(), face.end(), v) != face.end() && (open.empty() || random.unit() < part))
            open.push_back(f);
    }
    if (static_cast<Index>(open.size()) == mesh.n_faces())
        return;
    for (auto f = open.rbegin(); f != open.rend(); ++f)
        mesh.faces.erase(mesh.faces.begin() + *f);
}

LooseMesh dual_of(const LooseMesh& mesh)
{
    LooseMesh dual;
    for (const Face& face : mesh.faces)
        dual.points.push_back(middle_of(mesh, face));
    for (Index v = 0; v < mesh.n_points(); ++v) {
        const std::vector<Corner> fan = closed_fan(mesh, v);
        if (fan.size() < 3)
            continue;
        Face face;
        for (const Corner& corner : fan)
            face.push_back(corner.face);
        dual.faces.push_back(std::move(face));
    }
    return dual;
}

LooseMesh beside(LooseMesh a, const LooseMesh& b, const Point& shift)
{
    const Index first = a.n_points();
    for (const Point& point : b.points)
        a.points.emplace_back(point + shift);
    for (Face face : b.faces) {
        std::for_each(face.begin(), face.end(), [&](Index& v) { v += first; });
        a.faces.push_back(std::move(face));
    }
    return a;
}

LooseMesh glued(const LooseMesh& a, LooseMesh b, RandomNumbers& random)
{
    const auto is_triangle = [](const Face& face) { return face.size() == 3; };
    const auto of_a = std::find_if(a.faces.begin(), a.faces.end(), is_triangle);
    auto of_b = std::find_if(b.faces.begin() + random.below(b.n_faces()), b.faces.end(), is_triangle);
    if (of_b == b.faces.end())
        of_b = std::find_if(b.faces.begin(), b.faces.end(), is_triangle);
    const Point aside(2.0 + random.unit(), random.symmetric(), random.symmetric());
    if (of_a == a.faces.end() || of_b == b.faces.end())
        return beside(a, b, aside);
    const Face rim_of_a = *of_a;
    const Face rim_of_b = *of_b;
    b.faces.erase(of_b);
    LooseMesh both = beside(a, b, aside);
    both.faces.erase(both.faces.begin() + (of_a - a.faces.begin()));
    // The other way round, so that the orientation goes on. The corners of b that are left over have no faces then.
    for (std::size_t k = 0; k < 3; ++k) {
        const Index kept = rim_of_a[k];
        const Index left = rim_of_b[2 - k] + a.n_points();
        both.points[kept] = 0.5 * (both.points[kept] + both.points[left]);
        for (Face& face : both.faces)
            std::replace(face.begin(), face.end(), left, kept);
    }
    return both;
}

}  // namespace seamflow::test
