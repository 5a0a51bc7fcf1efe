#include "engine/distributed/parts/joined_points.h"

#include <cstddef>
#include <utility>

#include <xxhash.h>

#include "engine/distributed/parts/element_ranges.h"

namespace seamflow {

namespace {

/// The first question for a point.
struct FirstQuestion {
    /// The rank that asked, and the point's home.
    int rank = 0;
    int home = 0;
    /// The number of the question among those from the one to the other.
    Index number = 0;
};

/// The same for both zeros.
std::size_t home_of_point(PointNumbers::Place point, int n_ranks)
{
    for (double& x : point)
        x += 0.0;
    return static_cast<std::size_t>(XXH3_64bits(point.data(), sizeof point) % static_cast<std::uint64_t>(n_ranks));
}

/// The answers to questions: those to a rank in the order in which it asked.
template <class Question, class Answer, class Find>
std::vector<std::vector<Answer>> ask(Communicator& comm, const std::vector<std::vector<Question>>& questions,
                                     Find&& find)
{
    std::vector<Bytes> to_each;
    for (const auto& list : questions)
        to_each.push_back(packed(list));
    std::vector<Bytes> replies;
    int from = 0;
    for (const Bytes& bytes : comm.exchange(std::move(to_each))) {
        std::vector<Answer> answers;
        for (const Question& question : unpacked<Question>(bytes))
            answers.push_back(find(from, static_cast<Index>(answers.size()), question));
        replies.push_back(packed(answers));
        ++from;
    }
    std::vector<std::vector<Answer>> answers;
    for (const Bytes& bytes : comm.exchange(std::move(replies)))
        answers.push_back(unpacked<Answer>(bytes));
    return answers;
}

/// The points of this rank by their homes.
struct PointsByHome {
    std::vector<std::vector<PointNumbers::Place>> points;
    /// Their numbers on this rank.
    std::vector<std::vector<Index>> numbers;

    PointsByHome(const Points& own, int n_ranks)
        : points(static_cast<std::size_t>(n_ranks))
        , numbers(static_cast<std::size_t>(n_ranks))
    {
        for (Index i = 0; i < static_cast<Index>(own.rows()); ++i) {
            const PointNumbers::Place point{own(i, 0), own(i, 1), own(i, 2)};
            const std::size_t home = home_of_point(point, n_ranks);
            points[home].push_back(point);
            numbers[home].push_back(i);
        }
    }
};

/// For each point, by its home, the first question for it, asked by the lowest rank that has it.
std::vector<std::vector<FirstQuestion>> find_firsts(Communicator& comm, const PointsByHome& own)
{
    PointNumbers known;
    std::vector<FirstQuestion> firsts;
    return ask<PointNumbers::Place, FirstQuestion>(comm, own.points,
                                                   [&](int from, Index i, const PointNumbers::Place& point) {
                                                       const auto number = static_cast<std::size_t>(known(point));
                                                       if (number == firsts.size())
                                                           firsts.push_back({from, comm.rank(), i});
                                                       return firsts[number];
                                                   });
}

}  // namespace

JoinedPoints join_points(Communicator& comm, const Points& own)
{
    const std::size_t n = at(static_cast<Index>(own.rows()));
    const PointsByHome by_home(own, comm.size());
    std::vector<FirstQuestion> first_of(n);
    const auto found = find_firsts(comm, by_home);
    for (std::size_t home = 0; home < found.size(); ++home)
        for (std::size_t k = 0; k < found[home].size(); ++k)
            first_of[by_home.numbers[home][k]] = found[home][k];

    JoinedPoints joined;
    joined.numbers.resize(n);
    std::vector<std::vector<FirstQuestion>> of_others(static_cast<std::size_t>(comm.size()));
    std::vector<double> firsts;
    for (std::size_t i = 0; i < n; ++i) {
        if (first_of[i].rank != comm.rank()) {
            of_others[first_of[i].rank].push_back(first_of[i]);
            continue;
        }
        joined.numbers[i] = static_cast<std::int64_t>(firsts.size() / 3);
        const Point point = own.row(static_cast<Index>(i));
        firsts.insert(firsts.end(), {point[0], point[1], point[2]});
    }
    const auto n_firsts = static_cast<Index>(firsts.size() / 3);
    joined.firsts = Eigen::Map<const Points>(firsts.data(), n_firsts, 3);
    const std::int64_t before = gather_bounds_of(comm, n_firsts)[comm.rank()];
    const auto numbers =
        ask<FirstQuestion, std::int64_t>(comm, of_others, [&](int, Index, const FirstQuestion& question) {
            return before + joined.numbers[by_home.numbers[question.home][question.number]];
        });
    std::vector<std::size_t> next(numbers.size(), 0);
    for (std::size_t i = 0; i < n; ++i) {
        const auto rank = static_cast<std::size_t>(first_of[i].rank);
        if (first_of[i].rank == comm.rank())
            joined.numbers[i] += before;
        else
            joined.numbers[i] = numbers[rank][next[rank]++];
    }
    return joined;
}

}  // namespace seamflow
