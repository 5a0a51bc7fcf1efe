#include "samples/tiles/tile_files.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "engine/state/checkpoint.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

constexpr const char* name_of_lock = "lock";
constexpr std::string_view line_of_run = "seamflow run over tiles\n";

}  // namespace

TileFolder::TileFolder(std::filesystem::path folder)
    : folder_(std::move(folder))
{
}

TileFolder::~TileFolder()
{
    if (lock_ >= 0)
        close(lock_);
}

void TileFolder::make()
{
    make_checkpoint_folder(folder_);
    lock();
    if (has_run())
        return;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
        if (entry.path().filename() != name_of_lock)
            std::filesystem::remove_all(entry.path(), ignored);
}

void TileFolder::lock()
{
    lock_ = open((folder_ / name_of_lock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    // Some network file systems have no locks.
    if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        throw OutputError(folder_.string() + ": another run works in this folder: wait for it, or name another folder");
}

void TileFolder::remove() const
{
    std::error_code ignored;
    // First, so that a kill leaves no run that lacks files.
    std::filesystem::remove(run_file(), ignored);
    std::filesystem::remove_all(folder_, ignored);
}

bool TileFolder::has_run() const
{
    std::error_code ignored;
    return std::filesystem::exists(run_file(), ignored);
}

TileRun TileFolder::run() const
{
    return read_archive<TileRun>(run_file(), line_of_run);
}

void TileFolder::save(const TileRun& run) const
{
    write_archive(run_file(), line_of_run, run);
}

bool TileFolder::has_state(Index tile, int step) const
{
    std::error_code ignored;
    return std::filesystem::exists(state_file(tile, step), ignored);
}

Points TileFolder::state(Index tile, int step) const
{
    return read_archive<Points>(state_file(tile, step), line_of("positions"));
}

void TileFolder::save_state(Index tile, int step, const Points& positions) const
{
    write_archive(state_file(tile, step), line_of("positions"), positions);
}

int TileFolder::latest_step(Index n_tiles) const
{
    const std::string before = state_file(0, 0).stem().string() + ".step-";
    std::vector<int> steps;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
        if (const std::string name = entry.path().filename().string(); name.starts_with(before))
            steps.push_back(std::atoi(name.c_str() + before.size()));
    std::ranges::sort(steps, std::greater<>());
    for (const int step : steps) {
        Index tile = 0;
        while (tile < n_tiles && has_state(tile, step))
            ++tile;
        if (tile == n_tiles)
            return step;
    }
    refuse_archive(run_file(), "misses positions of some files");
}

void TileFolder::remove_state(Index tile, int step) const
{
    std::error_code ignored;
    std::filesystem::remove(state_file(tile, step), ignored);
}

void TileFolder::take_from_owners(Index tile, const TileOwners& owners, int step, Points& positions) const
{
    // By the tile of the owner: one is held at a time.
    std::map<Index, std::vector<std::size_t>> by_tile;
    for (std::size_t i = 0; i < owners.vertices.size(); ++i)
        if (owners.tiles[i] != tile || owners.numbers[i] != owners.vertices[i])
            by_tile[owners.tiles[i]].push_back(i);
    for (const auto& [other, taken] : by_tile) {
        const Points of_other = other == tile ? positions : state(other, step);
        for (const std::size_t i : taken)
            positions.row(owners.vertices[i]) = of_other.row(owners.numbers[i]);
    }
}

std::filesystem::path TileFolder::file(Index tile, const std::string& name) const
{
    return folder_ / fmt::format("tile-{}.{}", tile, name);
}

std::filesystem::path TileFolder::state_file(Index tile, int step) const
{
    return file(tile, fmt::format("step-{}", step));
}

std::string TileFolder::line_of(const std::string& name)
{
    return fmt::format("seamflow {} of a tile\n", name);
}

}  // namespace seamflow
