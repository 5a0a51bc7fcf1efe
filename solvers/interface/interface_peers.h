#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// The peers that solve one equation on Γ together, each with some of the sub-meshes and with its own memory. A peer
/// also knows the sub-meshes around its own, the foreign ones. It numbers the sub-meshes that it knows; their places
/// among those of all peers are in the same order. All peers call the virtual functions in the same order, each with
/// its own data.
class InterfacePeers {
  public:
    /// Numbers that each peer gives or gets.
    using Numbers = std::vector<std::vector<double>>;

    /// @param self the number of this peer.
    /// @param holders per place, the number of the peer that has this sub-mesh.
    /// @param places per sub-mesh that this peer knows, ascending.
    InterfacePeers(Index self, std::vector<Index> holders, std::vector<Index> places)
        : self_(self)
        , holders_(std::move(holders))
        , places_(std::move(places))
    {
    }
    InterfacePeers(const InterfacePeers&) = delete;
    InterfacePeers& operator=(const InterfacePeers&) = delete;
    virtual ~InterfacePeers() = default;

    [[nodiscard]] Index self() const { return self_; }
    [[nodiscard]] const std::vector<Index>& holders() const { return holders_; }
    [[nodiscard]] const std::vector<Index>& places() const { return places_; }
    [[nodiscard]] Index n_places() const { return static_cast<Index>(holders_.size()); }

    /// The peer that has a sub-mesh known here, or whether it is this one.
    [[nodiscard]] Index holder_of(Index s) const { return holders_[places_[s]]; }
    [[nodiscard]] bool is_own(Index s) const { return holder_of(s) == self_; }

    /// Whether this peer knows only its own sub-meshes.
    [[nodiscard]] bool has_all() const
    {
        return std::ranges::all_of(places_, [&](Index place) { return holders_[place] == self_; });
    }

    /// The data of all peers, in the order of their numbers.
    virtual Numbers gather(const std::vector<double>& own) = 0;

    /// Sends numbers to some other peers, and receives theirs for this one.
    /// @param others ascending; they name this one, too. @param to_each one for each. @returns likewise.
    virtual Numbers exchange(std::span<const Index> others, const Numbers& to_each) = 0;

    /// The maximum over all peers, number by number; all of them call this together.
    std::vector<double> largest(std::vector<double> own)
    {
        for (const std::vector<double>& numbers : gather(own))
            std::ranges::transform(own, numbers, own.begin(), [](double a, double b) { return std::max(a, b); });
        return own;
    }

  private:
    Index self_;
    std::vector<Index> holders_;
    std::vector<Index> places_;
};

/// A peer with all sub-meshes.
class OnePeer final : public InterfacePeers {
  public:
    explicit OnePeer(Index n_sub_meshes)
        : InterfacePeers(0, std::vector<Index>(usize(n_sub_meshes), 0), numbers_below(n_sub_meshes))
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
