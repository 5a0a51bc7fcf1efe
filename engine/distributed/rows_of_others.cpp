#include "engine/distributed/rows_of_others.h"

#include <algorithm>
#include <utility>

#include "engine/distributed/ranks/packing.h"

namespace seamflow {

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
