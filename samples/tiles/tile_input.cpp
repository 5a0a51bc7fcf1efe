#include "samples/tiles/tile_input.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/state/archive.h"
#include "engine/state/flow_identity.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/files/mesh_input.h"
#include "samples/tiles/tile_borders.h"
#include "samples/tiles/tile_union.h"
#include "samples/tiles/unjoined_borders.h"

namespace seamflow {

namespace {

/// Vertices at one place may be a chain of pairs within the distance of --weld, of several files.
constexpr double distances_of_chain = 8.0;

/// The borders of a tile and of those within some distance of it, ascending by tile.
std::vector<BorderOfTile> borders_near(const TileFolder& folder, std::span<const TileSummary> tiles, Index tile,
                                       double distance)
{
    std::vector<BorderOfTile> near;
    const BoundingBox box = inflated(tiles[usize(tile)].box, distances_of_chain * distance);
    for (Index other = 0; std::cmp_less(other, tiles.size()); ++other)
        if (meet(box, tiles[usize(other)].box))
            near.push_back(
                {other, folder.read<TileBorder>(other), other < tile ? folder.read<TileOwners>(other) : TileOwners{}});
    return near;
}

/// Puts vertices that have another owner to its place.
void place_on_owners(const TileFolder& folder, Index tile, const TileOwners& owners)
{
    const Points before = folder.state(tile, 0);
    Points positions = before;
    folder.take_from_owners(tile, owners, 0, positions);
    const std::span<const double> old(before.data(), static_cast<std::size_t>(before.size()));
    const std::span<const double> now(positions.data(), static_cast<std::size_t>(positions.size()));
    if (!std::ranges::equal(std::as_bytes(old), std::as_bytes(now)))
        folder.save_state(tile, 0, positions);
}

}  // namespace

TileInput read_tile(const std::filesystem::path& path, const Executor& exec)
{
    TileInput input;
    input.file = read_surface(path, &input.left_out, exec);
    return input;
}

TileSummary summary_of(const std::filesystem::path& path, const PolygonMesh& mesh, const Executor& exec)
{
    return {.path = path,
            .n_vertices = mesh.n_vertices(),
            .n_faces = mesh.n_faces(),
            .n_corners = mesh.n_corners(),
            .mean_edge = mean_edge_length(mesh, mesh.vertices, exec),
            .box = box_of_faces(mesh, exec),
            .checksum = checksum_of(mesh.vertices, mesh.face_offsets, mesh.face_vertices)};
}

MeshScale scale_of(std::span<const TileSummary> tiles)
{
    double sum_of_edges = 0.0;
    std::int64_t n_corners = 0;
    BoundingBox box = tiles.front().box;
    for (const TileSummary& tile : tiles) {
        sum_of_edges += tile.mean_edge * static_cast<double>(tile.n_corners);
        n_corners += tile.n_corners;
        box.low = box.low.cwiseMin(tile.box.low);
        box.high = box.high.cwiseMax(tile.box.high);
    }
    return {.mean_edge = sum_of_edges / static_cast<double>(n_corners), .diagonal = box.diagonal()};
}

void keep_input(const TileFolder& folder, Index tile, PolygonMesh& mesh, const Executor& exec)
{
    folder.save(tile, border_of(mesh, make_topology(mesh, exec), exec));
    folder.save_state(tile, 0, mesh.vertices);
    mesh.vertices.resize(0, 3);
    folder.save(tile, TileFaces{std::move(mesh.face_offsets), std::move(mesh.face_vertices)});
}

void join_tiles(const TileFolder& folder, std::span<const TileSummary> tiles, const std::optional<LengthOnMesh>& weld,
                TileRun& run, const Executor& exec)
{
    for (Index tile = 0; std::cmp_less(tile, tiles.size()); ++tile) {
        const TileOwners owners =
            weld ? owners_of(tile, borders_near(folder, tiles, tile, weld->value), weld->value, exec) : TileOwners{};
        folder.save(tile, owners);
        place_on_owners(folder, tile, owners);
        run.n_border += std::ssize(owners.vertices);
        run.n_shared += std::count(owners.is_shared.begin(), owners.is_shared.end(), 1);
    }
    if (!weld || tiles.size() == 1)
        return;
    std::vector<BoundingBox> boxes;
    for (const TileSummary& tile : tiles)
        boxes.push_back(inflated(tile.box, distances_of_chain * weld->value));
    run.n_held = hold_unjoined(folder, boxes);
}

std::uint64_t identify(std::span<const TileSummary> tiles, const FlowOptions& options)
{
    std::uint64_t identity = checksum_of(identify(PolygonMesh{}, options), options.steps);
    for (const TileSummary& tile : tiles)
        identity = checksum_of(identity, tile.path.filename().string(), tile.checksum);
    return identity;
}

}  // namespace seamflow
