#include "engine/distributed/mesh_part.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

using Number = std::int64_t;

/// A vertex and a rank that has faces there, or wants to know of them.
struct VertexAtRank {
    Number vertex;
    std::int32_t rank;
    friend auto operator<=>(const VertexAtRank&, const VertexAtRank&) = default;
};

/// The rank that knows who has a vertex.
int home_of(Number vertex, int n_ranks)
{
    return static_cast<int>(vertex % n_ranks);
}

template <class Value>
std::vector<std::vector<Value>> exchange_lists(Conversation& talk, const std::vector<std::vector<Value>>& to_each)
{
    std::vector<Bytes> bytes;
    for (const auto& values : to_each)
        bytes.push_back(packed(values));
    std::vector<std::vector<Value>> from_each;
    for (const Bytes& received : talk.exchange(std::move(bytes)))
        from_each.push_back(unpacked<Value>(received));
    return from_each;
}

/// Who has which vertex; each rank is the home of some of them.
class VertexDirectory {
  public:
    VertexDirectory(Conversation& talk, std::span<const Number> own)
        : talk_(&talk)
    {
        for (const auto& [vertex, rank] : sent_home(own))
            owners_.push_back({vertex, rank});
        std::ranges::sort(owners_);
    }

    /// For each rank, those of this rank's vertices that it wants to know of, ascending.
    /// @param wanted what this rank wants to know of.
    std::vector<std::vector<Number>> asked_of_this_rank(std::span<const Number> wanted)
    {
        std::vector<std::vector<VertexAtRank>> to_owners(talk_->size());
        for (const VertexAtRank& question : sent_home(wanted)) {
            auto owner = std::ranges::lower_bound(owners_, question.vertex, {}, &VertexAtRank::vertex);
            for (; owner != owners_.end() && owner->vertex == question.vertex; ++owner)
                if (owner->rank != question.rank)
                    to_owners[owner->rank].push_back(question);
        }
        std::vector<std::vector<Number>> of_ranks(talk_->size());
        for (const auto& questions : exchange_lists(*talk_, to_owners))
            for (const auto& [vertex, rank] : questions)
                of_ranks[rank].push_back(vertex);
        for (auto& vertices : of_ranks)
            sort_unique(vertices);
        return of_ranks;
    }

  private:
    /// What all ranks send to this one as the home of their vertices.
    std::vector<VertexAtRank> sent_home(std::span<const Number> vertices)
    {
        std::vector<std::vector<Number>> to_homes(talk_->size());
        for (const Number vertex : vertices)
            to_homes[home_of(vertex, talk_->size())].push_back(vertex);
        std::vector<VertexAtRank> arrived;
        const auto from_each = exchange_lists(*talk_, to_homes);
        for (int rank = 0; rank < talk_->size(); ++rank)
            for (const Number vertex : from_each[rank])
                arrived.push_back({vertex, rank});
        return arrived;
    }

    Conversation* talk_;
    /// Of the vertices at home here, ascending.
    std::vector<VertexAtRank> owners_;
};

Index local_number(std::span<const Number> numbers, Number number)
{
    return static_cast<Index>(std::ranges::lower_bound(numbers, number) - numbers.begin());
}

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
    return part;
}

/// Where something is: in which of several parts, and its number there.
struct Place {
    Number number;
    std::size_t part;
    Index index;
};

/// The places of what has a number in some parts, ascending, each number once.
std::vector<Place> merged(std::span<const MeshPart> parts, std::vector<Number> MeshPart::*numbers)
{
    std::vector<Place> places;
    std::size_t n_of_first = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        for (std::size_t i = 0; i < (parts[p].*numbers).size(); ++i)
            places.push_back({(parts[p].*numbers)[i], p, static_cast<Index>(i)});
        n_of_first = p == 0 ? places.size() : n_of_first;
    }
    // The first has most, in order.
    const auto others = places.begin() + static_cast<std::ptrdiff_t>(n_of_first);
    std::ranges::stable_sort(others, places.end(), {}, &Place::number);
    std::ranges::inplace_merge(places, others, {}, &Place::number);
    const auto are_same = [](const Place& one, const Place& other) { return one.number == other.number; };
    places.erase(std::unique(places.begin(), places.end(), are_same), places.end());
    return places;
}

/// All faces and vertices of several parts, each once.
MeshPart joined(std::span<const MeshPart> parts)
{
    MeshPart all;
    const std::vector<Place> vertices = merged(parts, &MeshPart::vertex_numbers);
    all.mesh.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
    for (const auto& [number, p, v] : vertices) {
        all.mesh.vertices.row(static_cast<Eigen::Index>(all.vertex_numbers.size())) = parts[p].mesh.vertices.row(v);
        all.vertex_numbers.push_back(number);
        all.fixed.push_back(parts[p].fixed.empty() ? 0 : parts[p].fixed[v]);
        if (!parts[p].attachment_weights.empty())
            all.attachment_weights.push_back(parts[p].attachment_weights[v]);
    }
    std::vector<Index> corners;
    for (const auto& [number, p, f] : merged(parts, &MeshPart::face_numbers)) {
        corners.clear();
        for (const Index v : parts[p].mesh.face(f))
            corners.push_back(local_number(all.vertex_numbers, parts[p].vertex_numbers[v]));
        all.mesh.add_face(corners);
        all.face_numbers.push_back(number);
        all.labels.push_back(parts[p].labels[f]);
    }
    return all;
}

/// The faces of a part around some vertices of the whole mesh, ascending.
std::vector<Index> faces_around(const MeshPart& part, const IndexLists& faces_at, std::span<const Number> vertices)
{
    std::vector<Index> faces;
    for (const Number vertex : vertices) {
        const auto around = faces_at[local_number(part.vertex_numbers, vertex)];
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
            throw InputError(fmt::format("the numbers of a part of a mesh have to ascend from 0 or more, but {} {} "
                                         "stands at place {}",
                                         what, numbers[i], i));
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
        throw InputError("a part of a mesh does not say of each vertex whether it is fixed");
    if (!part.attachment_weights.empty() && part.attachment_weights.size() != part.vertex_numbers.size())
        throw InputError("a part of a mesh does not say of each vertex how it is attached");
    const auto wrong = std::ranges::find_if_not(part.attachment_weights,
                                                [](double weight) { return weight >= 0.0 && std::isfinite(weight); });
    if (wrong != part.attachment_weights.end())
        throw InputError(fmt::format(
            "the attachment weight of vertex {} is {:.17g}, but must be at least 0 and finite (1/length²)",
            part.vertex_numbers[static_cast<std::size_t>(wrong - part.attachment_weights.begin())], *wrong));
    require_valid(part.mesh);
}

MeshPart some_faces(const MeshPart& part, std::span<const Index> faces)
{
    MeshPart some;
    std::vector<Index> vertices;
    for (const Index f : faces)
        vertices.insert(vertices.end(), part.mesh.face(f).begin(), part.mesh.face(f).end());
    sort_unique(vertices);
    some.mesh.vertices = part.mesh.vertices(vertices, Eigen::all);
    for (const Index v : vertices) {
        some.vertex_numbers.push_back(part.vertex_numbers[v]);
        some.fixed.push_back(part.fixed.empty() ? 0 : part.fixed[v]);
        if (!part.attachment_weights.empty())
            some.attachment_weights.push_back(part.attachment_weights[v]);
    }
    std::vector<Index> corners;
    for (const Index f : faces) {
        corners.clear();
        for (const Index v : part.mesh.face(f))
            corners.push_back(static_cast<Index>(std::ranges::lower_bound(vertices, v) - vertices.begin()));
        some.mesh.add_face(corners);
        some.face_numbers.push_back(part.face_numbers[f]);
        some.labels.push_back(part.labels[f]);
    }
    return some;
}

MeshPart grown_by_layers(Conversation& talk, const MeshPart& own, int layers)
{
    if (talk.size() == 1) {
        MeshPart all = own;
        all.fixed.resize(all.vertex_numbers.size(), 0);
        return all;
    }
    const IndexLists faces_at = make_lists(own.mesh.n_vertices(), [&](auto&& add) {
        for (Index f = 0; f < own.mesh.n_faces(); ++f)
            for (const Index v : own.mesh.face(f))
                add(v, f);
    });
    VertexDirectory directory(talk, own.vertex_numbers);
    std::vector<MeshPart> parts{own};
    std::vector<Number> wanted = own.vertex_numbers;
    std::vector<Number> known = own.vertex_numbers;
    for (int layer = 0; layer < layers; ++layer) {
        std::vector<Bytes> answers;
        for (const auto& vertices : directory.asked_of_this_rank(wanted))
            answers.push_back(packed_part(some_faces(own, faces_around(own, faces_at, vertices))));
        std::vector<Number> met;
        for (const Bytes& answer : talk.exchange(std::move(answers))) {
            const MeshPart& part = parts.emplace_back(unpacked_part(answer));
            met.insert(met.end(), part.vertex_numbers.begin(), part.vertex_numbers.end());
        }
        sort_unique(met);
        wanted.clear();
        std::ranges::set_difference(met, known, std::back_inserter(wanted));
        known.insert(known.end(), wanted.begin(), wanted.end());
        std::ranges::sort(known);
    }
    return joined(parts);
}

}  // namespace seamflow
