#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// The ranks that solve one equation on Γ together. A rank is a process, or a thread in place of one, that owns some of
/// the sub-meshes and has memory of its own. A rank also knows the remote sub-meshes, which other ranks own, around its
/// own. It numbers the sub-meshes that it knows in the order of their global numbers. All ranks call the virtual
/// functions in the same order, each with its own data.
class InterfaceRanks {
  public:
    /// The numbers that each rank sends or receives: one list per rank.
    using Numbers = std::vector<std::vector<double>>;

    /// @param own_rank the number of this rank.
    /// @param holders per sub-mesh of all ranks, the number of the rank that owns the sub-mesh.
    /// @param global_numbers per sub-mesh that this rank knows, its number among the sub-meshes of all ranks;
    /// ascending.
    InterfaceRanks(Index own_rank, std::vector<Index> holders, std::vector<Index> global_numbers)
        : own_rank_(own_rank)
        , holders_(std::move(holders))
        , global_numbers_(std::move(global_numbers))
    {
    }
    InterfaceRanks(const InterfaceRanks&) = delete;
    InterfaceRanks& operator=(const InterfaceRanks&) = delete;
    virtual ~InterfaceRanks() = default;

    [[nodiscard]] Index own_rank() const { return own_rank_; }
    [[nodiscard]] const std::vector<Index>& holders() const { return holders_; }
    [[nodiscard]] const std::vector<Index>& global_numbers() const { return global_numbers_; }

    /// The number of sub-meshes of all ranks.
    [[nodiscard]] Index n_sub_meshes() const { return static_cast<Index>(holders_.size()); }

    /// The rank that owns the sub-mesh with local number s, and whether that is this rank.
    [[nodiscard]] Index holder_of(Index s) const { return holders_[global_numbers_[s]]; }
    [[nodiscard]] bool is_own(Index s) const { return holder_of(s) == own_rank_; }

    /// Whether this rank knows only its own sub-meshes.
    [[nodiscard]] bool has_all() const
    {
        return std::ranges::all_of(global_numbers_, [&](Index s) { return holders_[s] == own_rank_; });
    }

    /// The data of all ranks, in the order of their numbers.
    virtual Numbers gather(const std::vector<double>& own) = 0;

    /// Sends numbers to some other ranks, and receives the numbers that these send to this rank.
    /// @param others ascending; each of these ranks also has this rank among its `others`.
    /// @param to_each one list per rank in `others`. @returns one list from each rank in `others`.
    virtual Numbers exchange(std::span<const Index> others, const Numbers& to_each) = 0;

    /// The maximum over all ranks, number by number; all ranks call this together.
    std::vector<double> largest(std::vector<double> own)
    {
        for (const std::vector<double>& numbers : gather(own))
            std::ranges::transform(own, numbers, own.begin(), [](double a, double b) { return std::max(a, b); });
        return own;
    }

  private:
    Index own_rank_;
    std::vector<Index> holders_;
    std::vector<Index> global_numbers_;
};

/// A single rank, which owns all sub-meshes.
class OneRank final : public InterfaceRanks {
  public:
    explicit OneRank(Index n_sub_meshes)
        : InterfaceRanks(0, std::vector<Index>(usize(n_sub_meshes), 0), numbers_below(n_sub_meshes))
    {
    }

    Numbers gather(const std::vector<double>& own) override { return {own}; }
    Numbers exchange(std::span<const Index>, const Numbers&) override { return {}; }

  private:
    static std::vector<Index> numbers_below(Index n)
    {
        std::vector<Index> numbers(usize(n));
        std::iota(numbers.begin(), numbers.end(), 0);
        return numbers;
    }
};

}  // namespace seamflow
