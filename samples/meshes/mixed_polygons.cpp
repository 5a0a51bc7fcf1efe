#include <algorithm>
#include <array>
#include <vector>

#include "samples/meshes/height_field.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow {

namespace {

/// Draws the faces, cell by cell. A face is a run of one to three cells to the right or upwards, with or without one
/// half of the cell after them.
class FaceDraw {
  public:
    FaceDraw(const Grid& grid, const MixedPolygonsShape& shape, RandomNumbers& random, PolygonMesh& mesh)
        : grid_(grid)
        , changed_(shape.changed)
        , random_(random)
        , mesh_(mesh)
        , used_(static_cast<std::size_t>(grid.size()), false)
        , lost_an_edge_(used_.size(), false)
    {
    }

    void draw_all()
    {
        for (Index j = 0; j + 1 < grid_.rows; ++j)
            for (Index i = 0; i + 1 < grid_.columns; ++i)
                if (!used_[index(i, j)])
                    draw(i, j);
    }

  private:
    static constexpr int longest_run = 3;

    [[nodiscard]] std::size_t index(Index i, Index j) const { return static_cast<std::size_t>(grid_.vertex(i, j)); }

    void draw(Index i, Index j)
    {
        upwards_ = random_.below(2) == 1;
        const bool changes = random_.unit() < changed_;
        const int choice = random_.below(2 * longest_run);
        take(i, j);
        if (!changes)
            return add_run(i, j, 1, false);
        if (choice == 0)
            return add_halves(i, j);
        Index run = 1;
        while (run <= choice / 2 && extend(i, j, run))
            ++run;
        const bool half = choice % 2 == 1 && extend(i, j, run);
        add_run(i, j, run, half);
    }

    void take(Index i, Index j) { used_[index(i, j)] = true; }

    /// A corner of the run: `along` cells from its start, on its one side (across = 0) or the other.
    [[nodiscard]] Index corner(Index i, Index j, Index along, Index across) const
    {
        return upwards_ ? grid_.vertex(i + across, j + along) : grid_.vertex(i + along, j + across);
    }

    /// Takes the cell after the run, if it is free and both ends of the edge before it can spare that edge.
    bool extend(Index i, Index j, Index run)
    {
        const Index next_i = upwards_ ? i : i + run;
        const Index next_j = upwards_ ? j + run : j;
        if (next_i + 1 >= grid_.columns || next_j + 1 >= grid_.rows || used_[index(next_i, next_j)])
            return false;
        const auto a = static_cast<std::size_t>(corner(i, j, run, 0));
        const auto b = static_cast<std::size_t>(corner(i, j, run, 1));
        if (lost_an_edge_[a] || lost_an_edge_[b])
            return false;
        lost_an_edge_[a] = lost_an_edge_[b] = true;
        take(next_i, next_j);
        return true;
    }

    /// Adds a face, given in order for a run to the right, mirrored for a run upwards.
    void add_oriented(std::span<Index> corners)
    {
        if (upwards_)
            std::reverse(corners.begin(), corners.end());
        mesh_.add_face(corners);
    }

    /// Adds one cell as two triangles.
    void add_halves(Index i, Index j)
    {
        std::array first{corner(i, j, 0, 0), corner(i, j, 1, 0), corner(i, j, 1, 1)};
        std::array second{corner(i, j, 0, 0), corner(i, j, 1, 1), corner(i, j, 0, 1)};
        add_oriented(first);
        add_oriented(second);
    }

    /// Adds the run as one face, with one half of the cell after it as part of that face, the other as a triangle.
    void add_run(Index i, Index j, Index run, bool half)
    {
        face_.clear();
        for (Index along = 0; along <= (half ? run + 1 : run); ++along)
            face_.push_back(corner(i, j, along, 0));
        for (Index along = run; along >= 0; --along)
            face_.push_back(corner(i, j, along, 1));
        add_oriented(face_);
        if (!half)
            return;
        std::array rest{corner(i, j, run + 1, 0), corner(i, j, run + 1, 1), corner(i, j, run, 1)};
        add_oriented(rest);
    }

    const Grid& grid_;
    double changed_;
    RandomNumbers& random_;
    PolygonMesh& mesh_;
    /// Indexed by a cell's lower left vertex.
    std::vector<bool> used_;
    std::vector<bool> lost_an_edge_;
    /// Direction of the run being drawn.
    bool upwards_ = false;
    std::vector<Index> face_;
};

/// Below a quarter of a cell, every half of a cell keeps its orientation, so that all unions of halves stay simple.
void jitter(PolygonMesh& mesh, const Grid& grid, double amount, RandomNumbers& random)
{
    for (Index j = 1; j + 1 < grid.rows; ++j)
        for (Index i = 1; i + 1 < grid.columns; ++i) {
            mesh.vertices(grid.vertex(i, j), 0) += amount * random.symmetric() / (grid.columns - 1);
            mesh.vertices(grid.vertex(i, j), 1) += amount * random.symmetric() / (grid.rows - 1);
        }
}

}  // namespace

PolygonMesh make_mixed_polygons(Index vertices, const MixedPolygonsShape& shape)
{
    require_vertices(vertices);
    require_valid(shape.surface);
    require_between("jitter", shape.jitter, 0.0, 0.24);
    require_between("changed", shape.changed, 0.0, 1.0);
    const Grid grid = grid_of(vertices, 1.0);
    const auto n = static_cast<std::size_t>(grid.size());
    PolygonMesh mesh = flat_grid(grid, 4 * n, n);
    RandomNumbers random(shape.surface.seed);
    jitter(mesh, grid, shape.jitter, random);
    FaceDraw(grid, shape, random, mesh).draw_all();
    raise(mesh, grid, shape.surface);
    return mesh;
}

}  // namespace seamflow
