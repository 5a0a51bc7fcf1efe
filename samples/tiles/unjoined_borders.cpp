#include "samples/tiles/unjoined_borders.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "partition/index_lists.h"
#include "partition/point_numbers.h"
#include "samples/tiles/tile_union.h"

namespace seamflow {

namespace {

/// A tile and a vertex of it.
using Vertex = std::pair<Index, Index>;

PointNumbers::Place place_of(const Points& positions, Index v)
{
    return {positions(v, 0), positions(v, 1), positions(v, 2)};
}

/// The vertices of a tile that may be where surfaces meet.
std::vector<Index> suspects_of(const TileFolder& folder, Index tile, const TileOwners& owners)
{
    std::vector<Index> suspects = folder.read<TileBorder>(tile).non_manifold;
    suspects.insert(suspects.end(), owners.vertices.begin(), owners.vertices.end());
    sort_unique(suspects);
    return suspects;
}

/// What lies at the suspect places of one tile.
class SuspectPlaces {
  public:
    SuspectPlaces(const Points& positions, std::span<const Index> suspects)
    {
        Points places(std::ssize(suspects), 3);
        for (std::size_t i = 0; i < suspects.size(); ++i) {
            numbers_(place_of(positions, suspects[i]));
            places.row(static_cast<Eigen::Index>(i)) = positions.row(suspects[i]);
        }
        box_ = box_around(places);
        at_place_.resize(numbers_.points().size());
    }

    /// Takes note of the vertices of a tile at these places.
    void add(Index tile, const Points& positions, const TileOwners& owners)
    {
        for (Index v = 0; v < static_cast<Index>(positions.rows()); ++v) {
            if (const Point point = positions.row(v); !meet(box_, {point, point}))
                continue;
            if (const Index number = numbers_.find(place_of(positions, v)); number >= 0)
                at_place_[usize(number)].push_back({{tile, v}, owner_of(tile, v, owners)});
        }
    }

    /// Adds the vertices at places with several tiles and several owners.
    void select_unjoined(std::vector<std::vector<Index>>& held) const
    {
        for (const std::vector<Entry>& entries : at_place_) {
            const auto differs = [&](const Entry& e) { return e.owner != entries.front().owner; };
            const auto is_elsewhere = [&](const Entry& e) { return e.vertex.first != entries.front().vertex.first; };
            if (std::ranges::none_of(entries, differs) || std::ranges::none_of(entries, is_elsewhere))
                continue;
            for (const Entry& entry : entries)
                held[usize(entry.vertex.first)].push_back(entry.vertex.second);
        }
    }

  private:
    struct Entry {
        Vertex vertex;
        Vertex owner;
    };

    static Vertex owner_of(Index tile, Index v, const TileOwners& owners)
    {
        const auto found = std::ranges::lower_bound(owners.vertices, v);
        if (found == owners.vertices.end() || *found != v)
            return {tile, v};
        const auto i = static_cast<std::size_t>(found - owners.vertices.begin());
        return {owners.tiles[i], owners.numbers[i]};
    }

    PointNumbers numbers_;
    BoundingBox box_;
    std::vector<std::vector<Entry>> at_place_;
};

}  // namespace

std::int64_t hold_unjoined(const TileFolder& folder, std::span<const BoundingBox> boxes)
{
    std::vector<std::vector<Index>> held(boxes.size());
    for (Index tile = 0; std::cmp_less(tile, boxes.size()); ++tile) {
        const auto suspects = suspects_of(folder, tile, folder.read<TileOwners>(tile));
        if (suspects.empty())
            continue;
        SuspectPlaces places(folder.state(tile, 0), suspects);
        for (Index other = 0; std::cmp_less(other, boxes.size()); ++other)
            if (meet(boxes[usize(tile)], boxes[usize(other)]))
                places.add(other, folder.state(other, 0), folder.read<TileOwners>(other));
        places.select_unjoined(held);
    }
    std::int64_t n_held = 0;
    for (Index tile = 0; std::cmp_less(tile, boxes.size()); ++tile) {
        if (held[usize(tile)].empty())
            continue;
        TileOwners owners = folder.read<TileOwners>(tile);
        owners.held = std::move(held[usize(tile)]);
        sort_unique(owners.held);
        n_held += std::ssize(owners.held);
        folder.save(tile, owners);
    }
    return n_held;
}

}  // namespace seamflow
