#include "solvers/denoising/place_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <unordered_map>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "solvers/denoising/random_number.h"

namespace seamflow {

namespace {

// A place is a vertex, its middle, with the vertices around it. At each of them, the displacement that a denoiser would
// remove is known. This file measures whether these displacements look like noise or like the shape of the surface.
// Their autocorrelation tells most: how like a displacement is to the one at a given distance (lag) in a given
// direction, from 1 (the same) to -1 (the opposite). For noise it falls and stays low. For a pattern it falls and rises
// again at the distance at which the pattern comes back. This rise is called revival here.

/// The radii of a place, in mean edge lengths: of the vertices near its middle, and of the vertices in its
/// autocorrelation, which must see a pattern of 16 edge lengths come back; and the most vertices of a place.
constexpr double near_radius = 7.0;
constexpr double far_radius = 13.0;
constexpr std::size_t most_of_place = 800;
/// The autocorrelation is bounded: displacements above this many medians are reduced to it, so that a sharp edge does
/// not outweigh its surroundings; and vertices do not count whose normal has a smaller cosine than this with the normal
/// of the middle.
constexpr float most_medians_of_height = 3.0F;
constexpr double least_cosine_to_middle = 0.5;
/// Directions in half a circle, because the autocorrelation is the same in opposite directions; and the distances at
/// which a revival is looked for, in edge lengths.
constexpr int n_directions = 12;
constexpr int first_lag = 3;
constexpr int last_lag = 18;
/// The fewest vertices of an autocorrelation; and the fewest pairs of vertices by which its value at one distance in
/// one direction counts, per vertex.
constexpr std::size_t fewest_in_correlation = 50;
constexpr float fewest_pairs = 0.35F;
/// The columns of TakenAway::displacements.
constexpr Index n_columns = 2;
constexpr Index of_denoiser = 0;
constexpr Index of_low_pass_filter = 1;
/// One height of each column.
using Heights = std::array<float, n_columns>;
/// Quadratic functions are fitted to the surface around some vertices: the number of these vertices; the two radii of
/// the fits around each, in edge lengths; and the fewest vertices of a fit.
constexpr std::size_t n_fits = 48;
constexpr double narrow_fit = 2.2;
constexpr double wide_fit = 5.0;
constexpr int fewest_of_fit = 9;

/// The median of numbers, whose order changes; 0 if there are none.
float median_of(std::vector<float>& numbers)
{
    if (numbers.empty())
        return 0.0F;
    const auto middle = numbers.begin() + std::ssize(numbers) / 2;
    std::ranges::nth_element(numbers, middle);
    return *middle;
}

/// The autocorrelations of columns of numbers at points of a plane: for each difference of two points, rounded to whole
/// numbers, the mean product of their numbers over the mean square. All columns are measured at once, because to find
/// the cell of a difference takes longest.
class Autocorrelations {
  public:
    Autocorrelations(std::span<const Eigen::Vector2f> points, std::span<const Heights> numbers)
        : n_points_(static_cast<float>(points.size()))
    {
        const std::size_t n = points.size();
        // Per point and column: the number, and half its square.
        std::vector<Sums> terms;
        std::vector<float> x;
        std::vector<float> y;
        for (std::size_t i = 0; i < n; ++i) {
            const Heights& number = numbers[i];
            terms.emplace_back(number[0], 0.5F * (number[0] * number[0]), number[1], 0.5F * (number[1] * number[1]));
            x.push_back(points[i].x());
            y.push_back(points[i].y());
        }
        std::vector<int> cells(n);
        for (std::size_t i = 0; i < n; ++i) {
            find_cells(x[i], y[i], x.data(), y.data(), i, cells.data());
            const Sums factor(numbers[i][0], 1.0F, numbers[i][1], 1.0F);
            const Sums square(0.0F, terms[i][1], 0.0F, terms[i][3]);
            for (std::size_t j = 0; j < i; ++j) {
                const auto cell = static_cast<std::size_t>(cells[j]);
                sums_[cell] += factor * terms[j] + square;
                pairs_[cell] += 1.0F;
            }
        }
    }

    /// The largest rise of the autocorrelation of a column after it has fallen: the most, over all directions and lags,
    /// by which a value exceeds the least value at shorter lags in its direction.
    [[nodiscard]] float revival(std::size_t column) const
    {
        float most = 0.0F;
        for (int direction = 0; direction < n_directions; ++direction) {
            const float angle = std::numbers::pi_v<float> * static_cast<float>(direction) / n_directions;
            const Eigen::Vector2f way(std::cos(angle), std::sin(angle));
            float least = 1.0F;
            for (int lag = 1; lag <= last_lag; ++lag) {
                // The autocorrelation is the same at a difference and at its negative.
                const std::size_t here = cell_index(static_cast<float>(lag) * way);
                const std::size_t opposite = cell_index(static_cast<float>(-lag) * way);
                const Sums sums = sums_[here] + sums_[opposite];
                const float products = sums[static_cast<Eigen::Index>(2 * column)];
                const float squares = sums[static_cast<Eigen::Index>(2 * column + 1)];
                if (pairs_[here] + pairs_[opposite] < fewest_pairs * n_points_ || squares <= 0.0F)
                    continue;
                const float value = products / squares;
                if (lag >= first_lag)
                    most = std::max(most, value - least);
                least = std::min(least, value);
            }
        }
        return most;
    }

  private:
    /// Per column: the sum of products, and that of the mean squares, over the pairs of points whose difference rounds
    /// to one point of the grid.
    using Sums = Eigen::Array4f;

    static constexpr int width = 2 * last_lag + 1;
    static constexpr int n_cells = width * width;

    /// The nearest whole number as std::lround finds it, without a call and branches, so that compilers find several at
    /// once: of 0.5 and more the sum below rounds up, of less it does not.
    [[nodiscard]] static int nearest(float number)
    {
        constexpr float below_half = 0.49999997F;
        return static_cast<int>(number + std::copysign(below_half, number));
    }

    /// Finds the cells of the differences of one point from others.
    /// @param cells receives the indices, of differences beyond the last lag n_cells.
    static void find_cells(float x, float y, const float* xs, const float* ys, std::size_t n, int* cells)
    {
        for (std::size_t j = 0; j < n; ++j) {
            const int column = nearest(x - xs[j]) + last_lag;
            const int row = nearest(y - ys[j]) + last_lag;
            const bool is_beyond = (static_cast<unsigned>(column) >= static_cast<unsigned>(width)) |
                                   (static_cast<unsigned>(row) >= static_cast<unsigned>(width));
            cells[j] = is_beyond ? n_cells : row * width + column;
        }
    }

    /// The index of the grid point nearest to a difference.
    [[nodiscard]] static std::size_t cell_index(const Eigen::Vector2f& difference)
    {
        const int x = nearest(difference.x()) + last_lag;
        const int y = nearest(difference.y()) + last_lag;
        return static_cast<std::size_t>(std::clamp(y, 0, width - 1) * width + std::clamp(x, 0, width - 1));
    }

    float n_points_;
    /// The last cell has differences beyond the last lag.
    std::vector<Sums> sums_ = std::vector<Sums>(n_cells + 1, Sums::Zero());
    /// Per cell: the number of pairs.
    std::vector<float> pairs_ = std::vector<float>(n_cells + 1, 0.0F);
};

/// The surroundings of a place: the vertices around its middle, with their data.
class Place {
  public:
    Place(const TakenAway& taken, Index middle)
        : taken_(taken)
        , middle_(middle)
        , frame_(frame_at(middle))
    {
        collect(taken.edges[middle]);
        double total = 0.0;
        for (const Index v : vertices_)
            total += taken.edges[v];
        edge_ = total / static_cast<double>(vertices_.size());
        locate();
    }

    /// The statistics of the vertices that count (see counts_).
    [[nodiscard]] PlaceStatistics statistics() const
    {
        PlaceStatistics found;
        std::vector<float> noise;
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            if (counts_[i] == 0)
                continue;
            ++found.n_vertices;
            if (is_near_[i] != 0)
                for (const Index corner : taken_.topology.corners_at(vertices_[i]))
                    noise.push_back(taken_.noise[taken_.topology.face_of[corner]]);
        }
        found.noise = median_of(noise);
        const std::array<float, n_columns> revivals = this->revivals();
        found.fine = statistics_of(of_denoiser);
        found.fine.revival = revivals[of_denoiser];
        found.wide = statistics_of(of_low_pass_filter);
        found.wide.revival = revivals[of_low_pass_filter];
        found.smoothness = smoothness();
        return found;
    }

  private:
    /// Rows: two directions along the surface, and its normal.
    [[nodiscard]] Eigen::Matrix3d frame_at(Index v) const
    {
        const Point normal = taken_.vertex_normals.row(v);
        Eigen::Matrix3d frame;
        frame.row(2) = normal;
        frame.row(0) = normal.isZero() ? Point(Point::UnitX()) : Point(normal.unitOrthogonal());
        frame.row(1) = normal.cross(Point(frame.row(0)));
        return frame;
    }

    /// Collects the vertices within far_radius of the middle, by rings. @param edge the length of the edges at the
    /// middle.
    void collect(double edge)
    {
        vertices_.push_back(middle_);
        index_of_.emplace(middle_, 0);
        const double squared = far_radius * far_radius * edge * edge;
        for (std::size_t i = 0; i < vertices_.size() && vertices_.size() < most_of_place; ++i)
            for (const Index w : taken_.neighbours[vertices_[i]])
                if ((taken_.positions.row(w) - taken_.positions.row(middle_)).squaredNorm() <= squared &&
                    index_of_.emplace(w, static_cast<Index>(vertices_.size())).second)
                    vertices_.push_back(w);
    }

    /// Fills the data of each collected vertex.
    void locate()
    {
        for (const Index v : vertices_) {
            const Point position = taken_.positions.row(v) - taken_.positions.row(middle_);
            const double cosine = taken_.vertex_normals.row(v).dot(taken_.vertex_normals.row(middle_));
            plane_.emplace_back((frame_.topRows<2>() * position.transpose() / edge_).cast<float>());
            signs_.push_back(cosine < 0.0 ? -1.0F : 1.0F);
            counts_.push_back(taken_.is_left_out[v] == 0 && taken_.topology.moves(v) ? 1 : 0);
            is_near_.push_back(position.norm() <= near_radius * edge_ ? 1 : 0);
            is_facing_.push_back(std::abs(cosine) >= least_cosine_to_middle ? 1 : 0);
        }
    }

    /// The displacement of a vertex of vertices_ as a height: towards the side to which the normal of the middle
    /// points. @param column of_denoiser or of_low_pass_filter.
    [[nodiscard]] float height(std::size_t i, Index column) const
    {
        return signs_[i] * taken_.displacements(vertices_[i], column);
    }

    /// The statistics of one column of displacements, but for the revival.
    [[nodiscard]] RemovalStatistics statistics_of(Index column) const
    {
        std::vector<float> heights;
        for (std::size_t i = 0; i < vertices_.size(); ++i)
            heights.push_back(height(i, column));
        std::vector<float> sizes;
        for (std::size_t i = 0; i < vertices_.size(); ++i)
            if (counts_[i] != 0 && is_near_[i] != 0)
                sizes.push_back(std::abs(heights[i]));
        return {.median = median_of(sizes),
                .correlation = correlation(heights),
                .revival = 0.0F,
                .kurtosis = kurtosis(heights)};
    }

    /// The correlation of heights at the two ends of edges near the middle. @param heights one per vertex of vertices_.
    [[nodiscard]] float correlation(std::span<const float> heights) const
    {
        float products = 0.0F;
        float squares = 0.0F;
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            if (counts_[i] == 0 || is_near_[i] == 0)
                continue;
            for (const Index w : taken_.neighbours[vertices_[i]]) {
                const auto found = index_of_.find(w);
                if (found == index_of_.end() || counts_[found->second] == 0)
                    continue;
                const float there = heights[found->second];
                products += heights[i] * there;
                squares += 0.5F * (heights[i] * heights[i] + there * there);
            }
        }
        return squares > 0.0F ? products / squares : 0.0F;
    }

    /// The revival of the heights of each column (see Autocorrelations::revival) at vertices whose normals are near the
    /// normal of the middle, or near its opposite; 0 if there are too few.
    [[nodiscard]] std::array<float, n_columns> revivals() const
    {
        std::vector<Eigen::Vector2f> points;
        std::vector<Heights> numbers;
        for (std::size_t i = 0; i < vertices_.size(); ++i)
            if (counts_[i] != 0 && is_facing_[i] != 0) {
                points.push_back(plane_[i]);
                numbers.push_back({height(i, of_denoiser), height(i, of_low_pass_filter)});
            }
        std::array<float, n_columns> found{};
        if (points.size() < fewest_in_correlation)
            return found;
        for (std::size_t column = 0; column < n_columns; ++column)
            bound(numbers, column);
        const Autocorrelations correlations(points, numbers);
        for (std::size_t column = 0; column < n_columns; ++column)
            found[column] = correlations.revival(column);
        return found;
    }

    /// Bounds the heights of a column, and subtracts their mean.
    static void bound(std::vector<Heights>& numbers, std::size_t column)
    {
        std::vector<float> sizes;
        for (const Heights& number : numbers)
            sizes.push_back(std::abs(number[column]));
        const float most = most_medians_of_height * median_of(sizes);
        float mean = 0.0F;
        for (Heights& number : numbers) {
            number[column] = std::clamp(number[column], -most, most);
            mean += number[column] / static_cast<float>(numbers.size());
        }
        for (Heights& number : numbers)
            number[column] -= mean;
    }

    /// The kurtosis of the heights: the mean fourth power over the square of the mean square, both about the mean.
    [[nodiscard]] float kurtosis(std::span<const float> heights) const
    {
        double n = 0.0;
        double mean = 0.0;
        for (std::size_t i = 0; i < heights.size(); ++i)
            if (counts_[i] != 0) {
                mean += heights[i];
                ++n;
            }
        mean /= std::max(n, 1.0);
        double squares = 0.0;
        double fourths = 0.0;
        for (std::size_t i = 0; i < heights.size(); ++i)
            if (counts_[i] != 0) {
                const double square = (heights[i] - mean) * (heights[i] - mean);
                squares += square;
                fourths += square * square;
            }
        return squares > 0.0 ? static_cast<float>(n * fourths / (squares * squares)) : 0.0F;
    }

    /// The root mean square residual of the quadratic height function that fits the vertices around v best, in edge
    /// lengths; -1 if there are too few vertices.
    /// @param radius in edge lengths.
    [[nodiscard]] double residual(Index v, double radius) const
    {
        using Row = Eigen::Matrix<double, 6, 1>;
        const Eigen::Matrix3d frame = frame_at(v);
        const Point origin = taken_.positions.row(v);
        Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
        Row right = Row::Zero();
        double squares = 0.0;
        int n = 0;
        for (const Index w : vertices_) {
            const Point difference = taken_.positions.row(w) - origin;
            if (difference.squaredNorm() > radius * radius * edge_ * edge_)
                continue;
            const Eigen::Vector3d p = frame * difference.transpose() / (radius * edge_);
            const Row row(1.0, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y());
            normal += row * row.transpose();
            right += p.z() * row;
            squares += p.z() * p.z();
            ++n;
        }
        if (n < fewest_of_fit)
            return -1.0;
        const double rest = squares - right.dot(normal.ldlt().solve(right));
        // Six of the n degrees of freedom are those of the fitted coefficients.
        return radius * std::sqrt(std::max(rest, 0.0) / (n - 6));
    }

    /// The power of the radius with which the least residuals of quadratic fits grow: 0 for noise, 3 for smooth
    /// surfaces.
    [[nodiscard]] float smoothness() const
    {
        constexpr double rounding = 1e-9;
        /// The residuals of the fits of both radii around one vertex.
        struct Residuals {
            double wide;
            double narrow;
        };
        std::vector<Residuals> found;
        // About a quarter of the vertices are near the middle and have fits.
        const std::size_t stride = std::max<std::size_t>(1, vertices_.size() / (4 * n_fits));
        for (std::size_t i = 0; i < vertices_.size() && found.size() < n_fits; i += stride) {
            if (counts_[i] == 0 || is_near_[i] == 0)
                continue;
            const double narrow = residual(vertices_[i], narrow_fit);
            const double wide = residual(vertices_[i], wide_fit);
            if (narrow >= 0.0 && wide >= 0.0)
                found.push_back({wide, narrow});
        }
        std::ranges::sort(found, {},
                          [](const Residuals& of_vertex) { return std::pair(of_vertex.wide, of_vertex.narrow); });
        Residuals totals{rounding, rounding};
        // The quarter of the vertices with the least residuals of the wider fits.
        for (std::size_t i = 0; i < (found.size() + 3) / 4; ++i) {
            totals.wide += found[i].wide;
            totals.narrow += found[i].narrow;
        }
        return static_cast<float>(std::log(totals.wide / totals.narrow) / std::log(wide_fit / narrow_fit));
    }

    const TakenAway& taken_;
    Index middle_;
    Eigen::Matrix3d frame_;
    double edge_ = 0.0;
    /// The middle, then the vertices around it.
    std::vector<Index> vertices_;
    /// The index in vertices_ of each vertex of the place.
    std::unordered_map<Index, Index> index_of_;
    /// One per vertex of vertices_, as in the following members: its position in the plane of the frame, in edge
    /// lengths.
    std::vector<Eigen::Vector2f> plane_;
    /// -1 if the normal points to the other side than the normal of the middle, otherwise 1.
    std::vector<float> signs_;
    /// Whether the vertex counts: it moves and is not left out; whether it is within near_radius of the middle; and
    /// whether its normal is near the normal of the middle or its opposite.
    std::vector<std::uint8_t> counts_;
    std::vector<std::uint8_t> is_near_;
    std::vector<std::uint8_t> is_facing_;
};

}  // namespace

PlaceStatistics measure_place(const TakenAway& taken, Index middle)
{
    return Place(taken, middle).statistics();
}

std::vector<Index> spread_places(const Topology& topology, const IndexLists& neighbours, const Points& positions,
                                 int rings)
{
    std::vector<std::pair<std::uint64_t, Index>> order;
    for (Index v = 0; v < neighbours.size(); ++v)
        if (!topology.corners_at(v).empty())
            order.emplace_back(random_number_of(positions.row(v), 0), v);
    std::ranges::sort(order);
    std::vector<Index> reached_from(usize(neighbours.size()), -1);
    std::vector<Index> places;
    std::vector<Index> front;
    std::vector<Index> next;
    for (const auto& [number, v] : order) {
        if (reached_from[v] >= 0)
            continue;
        places.push_back(v);
        front.assign(1, v);
        reached_from[v] = v;
        for (int ring = 0; ring < rings; ++ring) {
            next.clear();
            for (const Index w : front)
                for (const Index x : neighbours[w])
                    // Rings pass through vertices that were reached from earlier places.
                    if (reached_from[x] != v) {
                        reached_from[x] = v;
                        next.push_back(x);
                    }
            front.swap(next);
        }
    }
    std::ranges::sort(places);
    return places;
}

}  // namespace seamflow
