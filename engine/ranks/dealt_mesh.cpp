#include "engine/ranks/dealt_mesh.h"

#include <algorithm>
#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "partition/decomposition/decomposition.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// Calls visit(value) for all settings except those with one entry per vertex.
template <class Settings, class Visit>
void for_each_setting(Settings& settings, Visit&& visit)
{
    auto& equation = settings.equation;
    visit(equation.laplacian.kind);
    visit(equation.laplacian.edge_length);
    visit(equation.filter);
    visit(equation.time_step);
    visit(equation.terms.keeps_stiffness);
    visit(equation.terms.keeps_mass);
    visit(equation.terms.uniform_weight);
    visit(settings.factors);
}

/// Puts some entries of a list into a message; an empty list stays empty.
template <class Value>
void put_rows_of(std::span<const Value> all, std::span<const Index> rows, Packer& message)
{
    std::vector<Value> own;
    if (!all.empty())
        for (const Index row : rows)
            own.push_back(all[row]);
    message.put_all(std::span<const Value>(own));
}

/// In place of a rank, at a vertex whose faces belong to several ranks.
constexpr std::int32_t of_several = -2;

/// The indices of the entries that equal a value, ascending.
std::vector<Index> indices_of(const std::vector<std::int32_t>& values, int value)
{
    std::vector<Index> indices;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] == value)
            indices.push_back(static_cast<Index>(i));
    return indices;
}

}  // namespace

DealtMesh dealt_mesh(Unpacker& message)
{
    DealtMesh dealt;
    dealt.way = message.get<WayOfSteps>();
    for_each_setting(dealt.settings_without_arrays,
                     [&](auto& setting) { setting = message.get<std::decay_t<decltype(setting)>>(); });
    dealt.holders = message.get_all<Index>();
    dealt.known = message.get_all<Index>();
    dealt.first_faces = message.get_all<Index>();
    dealt.vertex_numbers = message.get_all<Index>();
    dealt.mesh.vertices = message.get_points();
    dealt.mesh.face_offsets = message.get_all<Index>();
    dealt.mesh.face_vertices = message.get_all<Index>();
    dealt.labels = message.get_all<Index>();
    const bool has_junctions = message.get<bool>();
    const bool is_oriented = message.get<bool>();
    dealt.topology = make_topology(dealt.mesh, run_in_parallel);
    if (has_junctions)
        free_junctions(dealt.mesh, dealt.topology, run_in_parallel);
    dealt.topology.oriented = is_oriented;
    dealt.topology.kind = message.get_all<VertexKind>();
    dealt.topology.fixed = message.get_all<std::uint8_t>();
    dealt.is_sent = message.get_all<std::uint8_t>();
    dealt.curvature = message.get_all<double>();
    dealt.step_scales = message.get_all<double>();
    dealt.weights = message.get_all<double>();
    return dealt;
}

StepSettings DealtMesh::settings() const
{
    StepSettings settings = settings_without_arrays;
    FlowTerms& terms = settings.equation.terms;
    terms.initial = &mesh.vertices;
    terms.weights = weights;
    terms.step_scales = step_scales;
    return settings;
}

Dealer::Dealer(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const WayOfSteps& way,
               const StepSettings& settings, std::vector<double> curvature, int n_ranks)
    : mesh_(&mesh)
    , topology_(&topology)
    , labels_(cut.labels)
    , way_(&way)
    , settings_(&settings)
    , curvature_(std::move(curvature))
    , faces_(faces_by_label(cut.labels, cut.n_parts, run_in_parallel))
    , holder_at_(usize(mesh.n_vertices()), -1)
    , sender_(holder_at_)
    , knows_face_(usize(mesh.n_faces()), -1)
    , visits_vertex_(usize(mesh.n_vertices()), -1)
    , knows_vertex_(usize(mesh.n_vertices()), -1)
    , local_index_(usize(mesh.n_vertices()), 0)
    , known_vertices_(static_cast<std::size_t>(n_ranks))
    , sent_vertices_(known_vertices_.size())
{
    // A sub-mesh goes to the rank that has its middle face, if faces are divided equally and in order among ranks.
    double before = 0.0;
    for (const std::vector<Index>& faces : faces_) {
        const double middle = before + 0.5 * static_cast<double>(faces.size());
        holders_.push_back(static_cast<Index>(n_ranks * middle / mesh.n_faces()));
        before += static_cast<double>(faces.size());
    }
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (const Index v : mesh.face(f)) {
            const Index holder = holders_[labels_[f]];
            holder_at_[v] = holder_at_[v] == -1 || holder_at_[v] == holder ? holder : of_several;
        }
}

/// The own faces of a rank and two layers of faces around them: so the faces around the neighbours of the vertices of
/// its sub-meshes are known.
std::vector<Index> Dealer::known_faces(int rank)
{
    constexpr int layers = 2;
    std::vector<Index> further;
    const auto look_around = [&](Index v) {
        if (std::exchange(visits_vertex_[v], rank) == rank)
            return;
        for (const Index corner : topology_->corners_at(v)) {
            const Index f = topology_->face_of[usize(corner)];
            if (std::exchange(knows_face_[f], rank) != rank)
                further.push_back(f);
        }
    };
    for (std::size_t s = 0; s < faces_.size(); ++s)
        if (holders_[s] == rank)
            for (const Index f : faces_[s])
                knows_face_[f] = rank;
    // The first layer: faces at vertices that the rank shares with other ranks.
    for (std::size_t s = 0; s < faces_.size(); ++s)
        if (holders_[s] == rank)
            for (const Index f : faces_[s])
                for (const Index v : mesh_->face(f))
                    if (holder_at_[v] == of_several)
                        look_around(v);
    // The further layers: faces around the faces of the layer before.
    std::size_t begin = 0;
    for (int layer = 1; layer < layers; ++layer)
        for (const std::size_t end = further.size(); begin < end; ++begin)
            for (const Index v : mesh_->face(further[begin]))
                look_around(v);
    return indices_of(knows_face_, rank);
}

void Dealer::deal(int rank, Packer& message)
{
    const std::vector<Index> faces = known_faces(rank);
    std::vector<Index> sub_meshes;
    for (const Index f : faces) {
        if (sub_meshes.empty() || sub_meshes.back() != labels_[f])
            sub_meshes.push_back(labels_[f]);
        for (const Index v : mesh_->face(f)) {
            knows_vertex_[v] = rank;
            if (holders_[labels_[f]] == rank && sender_[v] < 0)
                sender_[v] = rank;
        }
    }
    sort_unique(sub_meshes);
    std::vector<Index> vertices = indices_of(knows_vertex_, rank);
    std::vector<Index> own_vertices;
    std::vector<std::uint8_t> is_sent;
    for (const Index v : vertices) {
        local_index_[v] = static_cast<Index>(is_sent.size());
        is_sent.push_back(sender_[v] == rank ? 1 : 0);
        if (is_sent.back() != 0)
            own_vertices.push_back(v);
    }

    message.put(*way_);
    for_each_setting(*settings_, [&](const auto& setting) { message.put(setting); });
    message.put_all(std::span<const Index>(holders_));
    message.put_all(std::span<const Index>(sub_meshes));
    std::vector<Index> first_faces;
    for (const Index s : sub_meshes)
        first_faces.push_back(faces_[s].front());
    message.put_all(std::span<const Index>(first_faces));
    message.put_all(std::span<const Index>(vertices));
    message.put_rows(mesh_->vertices, vertices);
    PolygonMesh part;
    std::vector<Index> labels;
    for (const Index f : faces) {
        for (const Index v : mesh_->face(f))
            part.face_vertices.push_back(local_index_[v]);
        part.face_offsets.push_back(part.n_corners());
        labels.push_back(find_in(sub_meshes, labels_[f]));
    }
    message.put_all(std::span<const Index>(part.face_offsets));
    message.put_all(std::span<const Index>(part.face_vertices));
    message.put_all(std::span<const Index>(labels));
    message.put(!topology_->junctions.empty());
    message.put(topology_->oriented);
    put_rows_of(std::span<const VertexKind>(topology_->kind), vertices, message);
    put_rows_of(std::span<const std::uint8_t>(topology_->fixed), vertices, message);
    message.put_all(std::span<const std::uint8_t>(is_sent));
    put_rows_of(std::span<const double>(curvature_), vertices, message);
    put_rows_of(settings_->equation.terms.step_scales, vertices, message);
    put_rows_of(settings_->equation.terms.weights, vertices, message);
    known_vertices_[rank] = std::move(vertices);
    sent_vertices_[rank] = std::move(own_vertices);
}

}  // namespace seamflow
