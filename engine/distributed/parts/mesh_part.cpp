#include "engine/distributed/parts/mesh_part.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "engine/distributed/parts/number_set.h"
#include "partition/errors.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

using Number = std::int64_t;

/// A vertex and a rank that has faces there, or asks for them.
struct VertexAtRank {
    Number vertex;
    std::int32_t rank;
    friend auto operator<=>(const VertexAtRank&, const VertexAtRank&) = default;
};

/// The rank that knows the owners of a vertex.
int home_of(Number vertex, int n_ranks)
{
    return static_cast<int>(vertex % n_ranks);
}

template <class Value>
std::vector<std::vector<Value>> exchange_lists(Communicator& comm, const std::vector<std::vector<Value>>& to_each)
{
    std::vector<Bytes> bytes;
    for (const auto& values : to_each)
        bytes.push_back(packed(values));
    std::vector<std::vector<Value>> from_each;
    for (const Bytes& received : comm.exchange(std::move(bytes)))
        from_each.push_back(unpacked<Value>(received));
    return from_each;
}

/// A vertex that a rank has met without all faces around it.
struct MetVertex {
    Number vertex;
    /// A rank that has it.
    std::int32_t rank;
};

/// Which ranks have which vertex; each rank is the home of some.
class VertexDirectory {
  public:
    /// @param own ascending.
    VertexDirectory(Communicator& comm, std::span<const Number> own)
        : comm_(&comm)
    {
        std::vector<std::vector<Number>> to_homes(comm.size());
        for (const Number vertex : own)
            to_homes[home_of(vertex, comm.size())].push_back(vertex);
        const auto from_each = exchange_lists(comm, to_homes);
        // The number of a vertex at home here, divided by the number of ranks, is its place.
        std::vector<std::uint8_t> n_owners;
        for (const std::vector<Number>& vertices : from_each)
            for (const Number vertex : vertices) {
                const auto place = static_cast<std::size_t>(vertex / comm.size());
                n_owners.resize(std::max(n_owners.size(), place + 1), 0);
                n_owners[place] = n_owners[place] > 0 ? 2 : 1;
            }
        for (int rank = 0; rank < comm.size(); ++rank)
            for (const Number vertex : from_each[rank])
                if (n_owners[static_cast<std::size_t>(vertex / comm.size())] > 1)
                    owners_.push_back({vertex, rank});
        std::ranges::sort(owners_);
    }

    /// For each rank, the vertices that it has in common with this one, ascending.
    std::vector<std::vector<Number>> shared_with_each()
    {
        std::vector<std::vector<VertexAtRank>> to_owners(comm_->size());
        for (const auto& [vertex, rank] : owners_)
            for (const VertexAtRank& other : owners_of(vertex))
                if (other.rank != rank)
                    to_owners[rank].push_back(other);
        return by_rank(to_owners);
    }

    /// For each rank, this rank's vertices that the former has met, ascending.
    /// @param met vertices met by this rank: none of its own.
    std::vector<std::vector<Number>> met_by_each(std::span<const MetVertex> met)
    {
        std::vector<std::vector<MetVertex>> to_homes(comm_->size());
        for (const MetVertex& one : met)
            to_homes[home_of(one.vertex, comm_->size())].push_back(one);
        std::vector<std::vector<VertexAtRank>> to_owners(comm_->size());
        const auto from_each = exchange_lists(*comm_, to_homes);
        for (int asking = 0; asking < comm_->size(); ++asking)
            for (const auto& [vertex, rank] : from_each[asking]) {
                const auto owners = owners_of(vertex);
                for (const VertexAtRank& owner : owners)
                    to_owners[owner.rank].push_back({vertex, asking});
                if (owners.empty())
                    to_owners[rank].push_back({vertex, asking});
            }
        return by_rank(to_owners);
    }

  private:
    /// All ranks that have a vertex at home here; nothing if there is only one.
    [[nodiscard]] std::span<const VertexAtRank> owners_of(Number vertex) const
    {
        return {std::ranges::lower_bound(owners_, vertex, {}, &VertexAtRank::vertex),
                std::ranges::upper_bound(owners_, vertex, {}, &VertexAtRank::vertex)};
    }

    /// Sends vertices to ranks that have them. @returns those of this rank, sorted by the ranks that they came with.
    std::vector<std::vector<Number>> by_rank(const std::vector<std::vector<VertexAtRank>>& to_owners)
    {
        std::vector<std::vector<Number>> of_ranks(comm_->size());
        for (const auto& vertices : exchange_lists(*comm_, to_owners))
            for (const auto& [vertex, rank] : vertices)
                of_ranks[rank].push_back(vertex);
        for (auto& vertices : of_ranks)
            sort_unique(vertices);
        return of_ranks;
    }

    Communicator* comm_;
    /// Owners of vertices at home here that several ranks have, ascending.
    std::vector<VertexAtRank> owners_;
};

Bytes packed_part(const MeshPart& part)
{
    Packer packer;
    const Points& positions = part.mesh.vertices;
    packer.put_all(std::span(positions.data(), static_cast<std::size_t>(positions.size())));
    packer.put_all(std::span(part.mesh.face_offsets));
    packer.put_all(std::span(part.mesh.face_vertices));
    packer.put_all(std::span(part.vertex_numbers));
    packer.put_all(std::span(part.face_numbers));
    packer.put_all(std::span(part.labels));
    packer.put_all(std::span(part.fixed));
    packer.put_all(std::span(part.attachment_weights));
    packer.put_all(std::span(part.strengths));
    return packer.take();
}

MeshPart unpacked_part(const Bytes& bytes)
{
    Unpacker unpacker(bytes);
    MeshPart part;
    const auto coordinates = unpacker.get_all<double>();
    part.mesh.vertices = Eigen::Map<const Points>(coordinates.data(), static_cast<Index>(coordinates.size() / 3), 3);
    part.mesh.face_offsets = unpacker.get_all<Index>();
    part.mesh.face_vertices = unpacker.get_all<Index>();
    part.vertex_numbers = unpacker.get_all<Number>();
    part.face_numbers = unpacker.get_all<Number>();
    part.labels = unpacker.get_all<Index>();
    part.fixed = unpacker.get_all<std::uint8_t>();
    part.attachment_weights = unpacker.get_all<double>();
    part.strengths = unpacker.get_all<double>();
    return part;
}

/// Where an element is: in which of several parts, and its index there.
struct Place {
    Number number;
    std::size_t part;
    Index index;
};

/// Elements with a number in some parts, but not in the own one: ascending, each number once.
std::vector<Place> places_of_new(std::span<const Number> own, std::span<const MeshPart> parts,
                                 std::vector<Number> MeshPart::*numbers)
{
    std::vector<Place> places;
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (std::size_t i = 0; i < (parts[p].*numbers).size(); ++i)
            if (const Number number = (parts[p].*numbers)[i]; !std::ranges::binary_search(own, number))
                places.push_back({number, p, static_cast<Index>(i)});
    std::ranges::stable_sort(places, {}, &Place::number);
    const auto are_same = [](const Place& one, const Place& other) { return one.number == other.number; };
    places.erase(std::unique(places.begin(), places.end(), are_same), places.end());
    return places;
}

/// Visits own and new elements in ascending order of their numbers.
template <class TakeOwn, class TakeNew>
void merge(std::span<const Number> own, std::span<const Place> places, TakeOwn&& take_own, TakeNew&& take_new)
{
    auto next = places.begin();
    for (std::size_t i = 0; i < own.size(); ++i) {
        for (; next != places.end() && next->number < own[i]; ++next)
            take_new(*next);
        take_own(static_cast<Index>(i));
    }
    for (; next != places.end(); ++next)
        take_new(*next);
}

/// All faces and vertices of the own part and of others, each once.
MeshPart joined(const MeshPart& own, std::span<const MeshPart> parts)
{
    MeshPart all;
    const std::vector<Place> vertices = places_of_new(own.vertex_numbers, parts, &MeshPart::vertex_numbers);
    const std::vector<Place> faces = places_of_new(own.face_numbers, parts, &MeshPart::face_numbers);
    const std::size_t n_vertices = own.vertex_numbers.size() + vertices.size();
    const std::size_t n_faces = own.face_numbers.size() + faces.size();
    all.mesh.vertices.resize(static_cast<Eigen::Index>(n_vertices), 3);
    all.vertex_numbers.reserve(n_vertices);
    all.fixed.reserve(n_vertices);
    all.mesh.face_offsets.reserve(n_faces + 1);
    all.mesh.face_vertices.reserve(own.mesh.face_vertices.size());
    all.face_numbers.reserve(n_faces);
    all.labels.reserve(n_faces);

    const auto add_vertex = [&](const MeshPart& part, Index v) {
        all.mesh.vertices.row(static_cast<Eigen::Index>(all.vertex_numbers.size())) = part.mesh.vertices.row(v);
        all.vertex_numbers.push_back(part.vertex_numbers[v]);
        all.fixed.push_back(part.fixed.empty() ? 0 : part.fixed[v]);
        if (!part.attachment_weights.empty())
            all.attachment_weights.push_back(part.attachment_weights[v]);
        if (!part.strengths.empty())
            all.strengths.push_back(part.strengths[v]);
    };
    std::vector<Index> place_of_own;
    place_of_own.reserve(own.vertex_numbers.size());
    merge(
        own.vertex_numbers, vertices,
        [&](Index v) {
            place_of_own.push_back(static_cast<Index>(all.vertex_numbers.size()));
            add_vertex(own, v);
        },
        [&](const Place& place) { add_vertex(parts[place.part], place.index); });

    const auto add_face = [&](const MeshPart& part, Index f, auto&& place_of) {
        for (const Index v : part.mesh.face(f))
            all.mesh.face_vertices.push_back(place_of(v));
        all.mesh.face_offsets.push_back(all.mesh.n_corners());
        all.face_numbers.push_back(part.face_numbers[f]);
        all.labels.push_back(part.labels[f]);
    };
    merge(
        own.face_numbers, faces, [&](Index f) { add_face(own, f, [&](Index v) { return place_of_own[v]; }); },
        [&](const Place& place) {
            const MeshPart& part = parts[place.part];
            add_face(part, place.index, [&](Index v) { return place_in(all.vertex_numbers, part.vertex_numbers[v]); });
        });
    return all;
}

/// The faces of a part around some vertices of the whole mesh, ascending.
std::vector<Index> faces_around(const MeshPart& part, const IndexLists& faces_at, std::span<const Number> vertices)
{
    std::vector<Index> faces;
    for (const Number vertex : vertices) {
        const auto around = faces_at[place_in(part.vertex_numbers, vertex)];
        faces.insert(faces.end(), around.begin(), around.end());
    }
    sort_unique(faces);
    return faces;
}

/// @param what "vertex" or "face".
void require_ascending(std::span<const Number> numbers, Index expected, const char* what)
{
    if (numbers.size() != at(expected))
        throw InputError(fmt::format("a part of a mesh has {} numbers for {} of kind {}: give one for each",
                                     numbers.size(), expected, what));
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i] < 0 || (i > 0 && numbers[i] <= numbers[i - 1]))
            throw InputError(
                fmt::format("the numbers of a part of a mesh must ascend from 0 or more, but {} {} is at place {}",
                            what, numbers[i], i));
}

/// @param what the numbers are: of the vertices, or none. @param needed what each must be.
template <class IsValid>
void require_each(const MeshPart& part, std::span<const double> numbers, const char* what, IsValid&& is_valid,
                  const char* needed)
{
    const auto wrong = std::ranges::find_if_not(numbers, is_valid);
    if (wrong != numbers.end())
        throw InputError(fmt::format("the {} of vertex {} is {:.17g}, but must be {}", what,
                                     part.vertex_numbers[static_cast<std::size_t>(wrong - numbers.begin())], *wrong,
                                     needed));
}

}  // namespace

void require_valid(const MeshPart& part)
{
    require_ascending(part.vertex_numbers, part.mesh.n_vertices(), "vertex");
    require_ascending(part.face_numbers, part.mesh.n_faces(), "face");
    if (part.labels.size() != part.face_numbers.size())
        throw InputError(fmt::format("a part of a mesh has {} labels for {} faces: give one for each",
                                     part.labels.size(), part.face_numbers.size()));
    const auto negative = std::ranges::find_if(part.labels, [](Index label) { return label < 0; });
    if (negative != part.labels.end())
        throw InputError(fmt::format("face {} has the label {}: labels must be at least 0",
                                     part.face_numbers[static_cast<std::size_t>(negative - part.labels.begin())],
                                     *negative));
    if (!part.fixed.empty() && part.fixed.size() != part.vertex_numbers.size())
        throw InputError("a part of a mesh does not say for each vertex whether it is fixed");
    if (!part.attachment_weights.empty() && part.attachment_weights.size() != part.vertex_numbers.size())
        throw InputError("a part of a mesh does not say for each vertex how it is attached");
    if (!part.strengths.empty() && part.strengths.size() != part.vertex_numbers.size())
        throw InputError("a part of a mesh does not say for each vertex how strong its steps are");
    require_each(
        part, part.attachment_weights, "attachment weight",
        [](double weight) { return weight >= 0.0 && std::isfinite(weight); }, "at least 0 and finite (1/length²)");
    require_each(
        part, part.strengths, "strength", [](double strength) { return strength >= 0.0 && strength <= 1.0; },
        "from 0 to 1");
    require_valid(part.mesh);
}

MeshPart some_faces(const MeshPart& part, std::span<const Index> faces)
{
    MeshPart some;
    for (const Index f : faces)
        some.mesh.face_vertices.insert(some.mesh.face_vertices.end(), part.mesh.face(f).begin(),
                                       part.mesh.face(f).end());
    const NumberSet places(some.mesh.face_vertices);
    const std::vector<Index> vertices = places.numbers();
    some.mesh.vertices = part.mesh.vertices(vertices, Eigen::all);
    for (const Index v : vertices) {
        some.vertex_numbers.push_back(part.vertex_numbers[v]);
        some.fixed.push_back(part.fixed.empty() ? 0 : part.fixed[v]);
        if (!part.attachment_weights.empty())
            some.attachment_weights.push_back(part.attachment_weights[v]);
        if (!part.strengths.empty())
            some.strengths.push_back(part.strengths[v]);
    }
    for (Index& v : some.mesh.face_vertices)
        v = places.place_of(v);
    for (const Index f : faces) {
        some.mesh.face_offsets.push_back(some.mesh.face_offsets.back() + static_cast<Index>(part.mesh.face(f).size()));
        some.face_numbers.push_back(part.face_numbers[f]);
        some.labels.push_back(part.labels[f]);
    }
    return some;
}

MeshPart grown_by_layers(Communicator& comm, const MeshPart& own, int layers)
{
    if (comm.size() == 1) {
        MeshPart all = own;
        all.fixed.resize(all.vertex_numbers.size(), 0);
        return all;
    }
    const IndexLists faces_at = make_lists(own.mesh.n_vertices(), [&](auto&& add) {
        for (Index f = 0; f < own.mesh.n_faces(); ++f)
            for (const Index v : own.mesh.face(f))
                add(v, f);
    });
    VertexDirectory directory(comm, own.vertex_numbers);
    std::vector<MeshPart> parts;
    std::vector<Number> known;
    std::vector<std::vector<Number>> asked = directory.shared_with_each();
    for (int layer = 1;; ++layer) {
        std::vector<Bytes> answers;
        for (const auto& vertices : asked)
            answers.push_back(packed_part(some_faces(own, faces_around(own, faces_at, vertices))));
        std::vector<MetVertex> met;
        const std::vector<Bytes> of_ranks = comm.exchange(std::move(answers));
        for (int rank = 0; rank < comm.size(); ++rank) {
            const MeshPart& part = parts.emplace_back(unpacked_part(of_ranks[rank]));
            for (const Number vertex : part.vertex_numbers)
                if (!std::ranges::binary_search(own.vertex_numbers, vertex) &&
                    !std::ranges::binary_search(known, vertex))
                    met.push_back({vertex, rank});
        }
        if (layer == layers)
            return joined(own, parts);
        for (const MetVertex& one : met)
            known.push_back(one.vertex);
        sort_unique(known);
        asked = directory.met_by_each(met);
    }
}

}  // namespace seamflow
