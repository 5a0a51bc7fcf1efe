#include "engine/distributed/rows_of_others.h"

#include <algorithm>
#include <span>
#include <utility>

#include "engine/distributed/ranks/packing.h"

namespace seamflow {

namespace {

/// Vertices all of whose faces here repeat others: the ranks with those know their rows.
/// @param vertices ascending.
void ask_for(Communicator& comm, const MeshPart& part, const RankMesh& mesh, const Points& known,
             std::span<const Index> vertices, Points& rows)
{
    std::vector<std::int64_t> numbers;
    for (const Index v : vertices)
        numbers.push_back(part.vertex_numbers[v]);
    const Points found = RowsOfOthers(comm, mesh, numbers).fetch(known);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        rows.row(vertices[i]) = found.row(static_cast<Index>(i));
}

}  // namespace

RowsOfOthers::RowsOfOthers(Communicator& comm, const RankMesh& mesh, const std::vector<std::int64_t>& wanted)
    : comm_(&comm)
    , n_wanted_(static_cast<Index>(wanted.size()))
{
    const std::vector<std::int64_t>& known = mesh.part.vertex_numbers;
    std::vector<Bytes> answers;
    for (const Bytes& asked : comm.allgather(packed(wanted))) {
        const auto numbers = unpacked<std::int64_t>(asked);
        std::vector<Index>& rows = theirs_.emplace_back();
        std::vector<Index> places;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const Index v = position_in(known, numbers[i]);
            if (v < 0 || !mesh.has_own_faces(v))
                continue;
            rows.push_back(v);
            places.push_back(static_cast<Index>(i));
        }
        answers.push_back(packed(places));
    }
    for (const Bytes& answer : comm.exchange(std::move(answers)))
        ours_.push_back(unpacked<Index>(answer));
}

Points RowsOfOthers::fetch(const Points& rows) const
{
    std::vector<Bytes> to_each;
    for (const std::vector<Index>& wanted : theirs_) {
        std::vector<double> values;
        values.reserve(3 * wanted.size());
        for (const Index v : wanted)
            values.insert(values.end(), {rows(v, 0), rows(v, 1), rows(v, 2)});
        to_each.push_back(packed(values));
    }
    Points fetched = Points::Zero(n_wanted_, 3);
    const std::vector<Bytes> of_each = comm_->exchange(std::move(to_each));
    for (std::size_t rank = 0; rank < of_each.size(); ++rank) {
        const auto values = unpacked<double>(of_each[rank]);
        for (std::size_t i = 0; i < ours_[rank].size(); ++i)
            fetched.row(ours_[rank][i]) = Point(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    }
    return fetched;
}

Points rows_of_part(Communicator& comm, const MeshPart& part, const RankMesh& mesh, const Points& known, Points rows)
{
    std::vector<std::uint8_t> has_face(part.vertex_numbers.size(), 0);
    for (const Index v : part.mesh.face_vertices)
        has_face[v] = 1;
    std::vector<Index> elsewhere;
    auto found = mesh.part.vertex_numbers.begin();
    for (Index v = 0; v < part.mesh.n_vertices(); ++v) {
        if (has_face[v] == 0)
            continue;
        while (found != mesh.part.vertex_numbers.end() && *found < part.vertex_numbers[v])
            ++found;
        const auto row = static_cast<Index>(found - mesh.part.vertex_numbers.begin());
        if (found != mesh.part.vertex_numbers.end() && *found == part.vertex_numbers[v] &&
            (mesh.n_repeated == 0 || mesh.has_own_faces(row)))
            rows.row(v) = known.row(row);
        else
            elsewhere.push_back(v);
    }
    if (mesh.n_repeated > 0)
        ask_for(comm, part, mesh, known, elsewhere, rows);
    return rows;
}

std::function<void(Points& rows)> fetch_rows_of_others(Communicator& comm, const RankMesh& mesh,
                                                       std::vector<Index> vertices)
{
    std::vector<std::int64_t> numbers;
    for (const Index v : vertices)
        numbers.push_back(mesh.part.vertex_numbers[v]);
    return [vertices = std::move(vertices), others = RowsOfOthers(comm, mesh, numbers)](Points& rows) {
        const Points fetched = others.fetch(rows);
        for (std::size_t i = 0; i < vertices.size(); ++i)
            rows.row(vertices[i]) = fetched.row(static_cast<Index>(i));
    };
}

}  // namespace seamflow
