#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "engine/state/archive.h"
#include "partition/polygon_mesh.h"

/// What a run over tiles keeps on the disk, so that it holds one tile at a time and can resume. A tile is one of
/// several mesh files whose borders coincide; tiles are numbered from 0.
namespace seamflow {

/// The faces of a tile.
struct TileFaces {
    /// In the names of its files.
    static constexpr const char* name = "faces";
    /// As in PolygonMesh, with the numbers of vertices in the file.
    std::vector<Index> face_offsets{0};
    std::vector<Index> face_vertices;
};

/// The faces around the border of a tile: all those with a vertex at an edge of one face.
struct TileBorder {
    /// In the names of its files.
    static constexpr const char* name = "border";
    /// #B, ascending: the number of each vertex in the tile.
    std::vector<Index> vertices;
    /// #B: 1 for the vertices at edges of one face.
    std::vector<Index> is_on_border;
    /// #B by 3, in units of length.
    Points positions = Points(0, 3);
    /// Ascending: the vertices of the tile where its surface is not manifold.
    std::vector<Index> non_manifold;
    /// As in PolygonMesh; corners are positions in `vertices`.
    std::vector<Index> face_offsets{0};
    std::vector<Index> face_vertices;
};

/// Which vertices of the borders are one vertex of the surface. Each vertex of a border has an owner, a vertex of the
/// same or of another tile, which is its own owner: that one is computed, and the others take its position.
struct TileOwners {
    /// In the names of its files.
    static constexpr const char* name = "owners";
    /// The vertices of the border, ascending.
    std::vector<Index> vertices;
    /// The tile of the owner, at most this one, and its number there.
    std::vector<Index> tiles;
    std::vector<Index> numbers;
    /// 1 where another tile has a copy of the vertex.
    std::vector<Index> is_shared;
    /// Ascending: vertices that are held, see hold_unjoined.
    std::vector<Index> held;
};

/// The run that the files belong to.
struct TileRun {
    /// See identify.
    std::uint64_t identity = 0;
    /// How many vertices all borders have, and how many of these another tile has, too.
    std::int64_t n_border = 0;
    std::int64_t n_shared = 0;
    /// How many vertices are held because borders meet there but cannot be joined.
    std::int64_t n_held = 0;
};

auto fields(Is<TileFaces> auto& of)
{
    auto& [face_offsets, face_vertices] = of;
    return std::tie(face_offsets, face_vertices);
}

auto fields(Is<TileBorder> auto& of)
{
    auto& [vertices, is_on_border, positions, non_manifold, face_offsets, face_vertices] = of;
    return std::tie(vertices, is_on_border, positions, non_manifold, face_offsets, face_vertices);
}

auto fields(Is<TileOwners> auto& of)
{
    auto& [vertices, tiles, numbers, is_shared, held] = of;
    return std::tie(vertices, tiles, numbers, is_shared, held);
}

auto fields(Is<TileRun> auto& of)
{
    auto& [identity, n_border, n_shared, n_held] = of;
    return std::tie(identity, n_border, n_shared, n_held);
}

/// The working files of a run. Each appears whole or not at all, and has a checksum. Functions that read throw
/// InputError, functions that write OutputError, naming the file.
class TileFolder {
  public:
    /// @param folder created by `make`.
    explicit TileFolder(std::filesystem::path folder);

    ~TileFolder();
    TileFolder(const TileFolder&) = delete;
    TileFolder& operator=(const TileFolder&) = delete;

    /// Makes the folder if there is none, locks it, and empties it unless it has a run to resume.
    /// @throws OutputError if another process has locked it.
    void make();
    /// Removes it with all files.
    void remove() const;

    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
    [[nodiscard]] std::filesystem::path run_file() const { return folder_ / "run"; }
    [[nodiscard]] bool has_run() const;
    [[nodiscard]] TileRun run() const;
    /// To be called when all files of step 0 are there.
    void save(const TileRun& run) const;

    /// TileFaces, TileBorder or TileOwners.
    template <class Data>
    [[nodiscard]] Data read(Index tile) const
    {
        return read_archive<Data>(file(tile, Data::name), line_of(Data::name));
    }
    template <class Data>
    void save(Index tile, const Data& data) const
    {
        write_archive(file(tile, Data::name), line_of(Data::name), data);
    }

    /// The positions after a step; step 0 is the input.
    [[nodiscard]] bool has_state(Index tile, int step) const;
    [[nodiscard]] Points state(Index tile, int step) const;
    void save_state(Index tile, int step, const Points& positions) const;
    /// The last step that all tiles have, from 0.
    /// @throws InputError if there is none.
    [[nodiscard]] int latest_step(Index n_tiles) const;
    void remove_state(Index tile, int step) const;

    /// Replaces the positions of vertices that have another owner by those of the owners at that step, bit for bit.
    /// @param positions #V by 3, of this tile, with owners of its own already at that step; so are tiles before it.
    void take_from_owners(Index tile, const TileOwners& owners, int step, Points& positions) const;

  private:
    [[nodiscard]] std::filesystem::path file(Index tile, const std::string& name) const;
    [[nodiscard]] std::filesystem::path state_file(Index tile, int step) const;
    [[nodiscard]] static std::string line_of(const std::string& name);

    /// @throws OutputError.
    void lock();

    std::filesystem::path folder_;
    /// The descriptor of a locked file, -1 if there is none.
    int lock_ = -1;
};

}  // namespace seamflow
