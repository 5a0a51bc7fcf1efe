#include "engine/distributed/cut/seams_of_fields.h"

#include <algorithm>
#include <vector>

#include "engine/distributed/parts/field_rows.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// The vertices of seams that are joined with others: each with the first of them.
std::vector<SeamVertex> joined_with_others(const JoinedSeams& seams)
{
    std::vector<SeamVertex> joined = seams.vertices;
    std::erase_if(joined, [](const SeamVertex& one) { return one.vertex == one.first; });
    return joined;
}

/// Their first vertices, ascending.
std::vector<std::int64_t> firsts_of(const std::vector<SeamVertex>& joined)
{
    std::vector<std::int64_t> firsts;
    for (const SeamVertex& one : joined)
        firsts.push_back(one.first);
    sort_unique(firsts);
    return firsts;
}

}  // namespace

void join_fields(Communicator& comm, const JoinedSeams& seams, std::span<const std::int64_t> bounds,
                 Eigen::MatrixXd& fields)
{
    const std::vector<SeamVertex> joined = joined_with_others(seams);
    if (joined.empty())
        return;
    const std::vector<std::int64_t> firsts = firsts_of(joined);
    std::vector<std::int64_t> others;
    for (const SeamVertex& one : joined)
        others.push_back(one.vertex);
    Eigen::MatrixXd means = fetch_fields(comm, fields, firsts, bounds);
    const Eigen::MatrixXd rows = fetch_fields(comm, fields, others, bounds);
    std::vector<double> n(firsts.size(), 1.0);
    for (std::size_t i = 0; i < joined.size(); ++i) {
        const Index place = place_in(firsts, joined[i].first);
        // Equal rows stay the same, bit for bit.
        means.row(place) += (rows.row(static_cast<Eigen::Index>(i)) - means.row(place)) / ++n[place];
    }
    const std::int64_t begin = bounds[static_cast<std::size_t>(comm.rank())];
    for (std::size_t i = 0; i < firsts.size(); ++i)
        if (firsts[i] >= begin && firsts[i] < begin + fields.rows())
            fields.row(firsts[i] - begin) = means.row(static_cast<Eigen::Index>(i));
    bring_back_fields(comm, seams, bounds, fields);
}

void bring_back_fields(Communicator& comm, const JoinedSeams& seams, std::span<const std::int64_t> bounds,
                       Eigen::MatrixXd& fields)
{
    std::vector<SeamVertex> own = joined_with_others(seams);
    if (own.empty())
        return;
    const std::int64_t begin = bounds[static_cast<std::size_t>(comm.rank())];
    std::erase_if(own,
                  [&](const SeamVertex& one) { return one.vertex < begin || one.vertex >= begin + fields.rows(); });
    const std::vector<std::int64_t> firsts = firsts_of(own);
    const Eigen::MatrixXd rows = fetch_fields(comm, fields, firsts, bounds);
    for (const SeamVertex& one : own)
        fields.row(one.vertex - begin) = rows.row(place_in(firsts, one.first));
}

}  // namespace seamflow
