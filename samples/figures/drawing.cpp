#include "samples/figures/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>
#include <png.h>

#include "partition/errors.h"
#include "samples/files/output_files.h"

namespace seamflow {

namespace {

constexpr int picture_width = 480;
/// Samples along each side of a pixel.
constexpr int samples = 3;
/// Margin beside the mesh, in widths of the picture.
constexpr double margin = 0.03;

/// The usual upward direction of meshes of such extents: along a long one, across a flat one, else z.
int upwards(const Eigen::RowVector3d& extent)
{
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return extent[a] < extent[b]; });
    if (extent[order[2]] > 1.6 * extent[order[1]])
        return order[2];
    return extent[order[0]] < 0.6 * extent[order[1]] ? order[0] : 2;
}

/// The brightness of a triangle; 0.46 where no light falls on it.
double brightness(const Eigen::Vector3d& towards_the_eye)
{
    const Eigen::Vector3d key = Eigen::Vector3d(-0.45, -0.65, 0.75).normalized();
    const Eigen::Vector3d fill = Eigen::Vector3d(0.75, 0.2, 0.5).normalized();
    return 0.46 + 0.5 * std::max(key.dot(towards_the_eye), 0.0) + 0.2 * std::max(fill.dot(towards_the_eye), 0.0);
}

/// Nearest samples first, one after the other.
class Canvas {
  public:
    Canvas(int width, int height)
        : width_(samples * width)
        , height_(samples * height)
        , depths_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                  -std::numeric_limits<double>::infinity())
        , colours_(depths_.size())
    {
    }

    /// @param corners in pixels, as Viewpoint::seen gives them. @param values at the corners.
    void add(const Eigen::Matrix3d& corners, const Eigen::Vector3d& values, const std::function<Colour(double)>& paint)
    {
        const Eigen::Matrix3d c = corners * Eigen::Vector3d(samples, samples, 1.0).asDiagonal();
        const Eigen::RowVector3d u = c.row(1) - c.row(0);
        const Eigen::RowVector3d w = c.row(2) - c.row(0);
        const double area = u.x() * w.y() - u.y() * w.x();
        if (!corners.allFinite() || !std::isfinite(area) || area == 0.0)
            return;
        Eigen::Vector3d normal = Eigen::Vector3d(corners.row(1) - corners.row(0))
                                     .cross(Eigen::Vector3d(corners.row(2) - corners.row(0)))
                                     .normalized();
        const double light = brightness(normal.z() < 0.0 ? Eigen::Vector3d(-normal) : normal);
        const auto [left, right] = range(c.col(0), width_);
        const auto [top, bottom] = range(c.col(1), height_);
        for (int y = top; y < bottom; ++y) {
            // The second and third barycentric coordinate of the sample x is b₀ + b₁ x and d₀ + d₁ x.
            const double dy = y + 0.5 - c(0, 1);
            const double b1 = w.y() / area;
            const double d1 = -u.y() / area;
            const double b0 = (0.5 - c(0, 0)) * b1 - dy * w.x() / area;
            const double d0 = (0.5 - c(0, 0)) * d1 + dy * u.x() / area;
            double first = left;
            double last = right - 1;
            for (const auto& [start, slope] : {std::pair{b0, b1}, {d0, d1}, {1.0 - b0 - d0, -b1 - d1}})
                narrow(start, slope, first, last);
            if (!(first <= last))
                continue;
            for (int x = static_cast<int>(std::ceil(first)); x <= last; ++x)
                add_sample(x, y, c(0, 2) + (b0 + b1 * x) * u.z() + (d0 + d1 * x) * w.z(), [&] {
                    const double value =
                        values[0] + (b0 + b1 * x) * (values[1] - values[0]) + (d0 + d1 * x) * (values[2] - values[0]);
                    return lit(paint(value), light);
                });
        }
    }

    /// The mean of the samples of each pixel.
    [[nodiscard]] Image image() const
    {
        Image image{.width = width_ / samples, .height = height_ / samples, .pixels = {}};
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                add_pixel(x, y, image.pixels);
        return image;
    }

  private:
    static std::pair<int, int> range(const Eigen::Vector3d& places, int end)
    {
        return {static_cast<int>(std::clamp(std::floor(places.minCoeff()), 0.0, static_cast<double>(end))),
                static_cast<int>(std::clamp(std::ceil(places.maxCoeff()), 0.0, static_cast<double>(end)))};
    }

    /// Narrows an interval of x to where start + slope x is not negative.
    static void narrow(double start, double slope, double& first, double& last)
    {
        if (slope > 0.0)
            first = std::max(first, -start / slope);
        else if (slope < 0.0)
            last = std::min(last, -start / slope);
        else if (!(start >= 0.0))
            last = first - 1.0;
    }

    template <typename MakeColour>
    void add_sample(int x, int y, double depth, const MakeColour& make_colour)
    {
        const std::size_t place =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        if (!(depth > depths_[place]))
            return;
        depths_[place] = depth;
        colours_[place] = make_colour();
    }

    static Colour lit(Colour colour, double light)
    {
        for (std::uint8_t& part : colour)
            part = static_cast<std::uint8_t>(std::min(255.0, light * part));
        return colour;
    }

    void add_pixel(int x, int y, std::vector<std::uint8_t>& pixels) const
    {
        std::array<int, 3> sum{};
        int seen = 0;
        for (int k = 0; k < samples * samples; ++k) {
            const std::size_t place =
                static_cast<std::size_t>(samples * y + k / samples) * static_cast<std::size_t>(width_) +
                static_cast<std::size_t>(samples * x + k % samples);
            if (std::isinf(depths_[place]))
                continue;
            ++seen;
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += colours_[place][c];
        }
        for (const int part : sum)
            pixels.push_back(static_cast<std::uint8_t>(seen > 0 ? part / seen : 0));
        pixels.push_back(static_cast<std::uint8_t>(255 * seen / (samples * samples)));
    }

    int width_;
    int height_;
    std::vector<double> depths_;
    std::vector<Colour> colours_;
};

}  // namespace

Viewpoint::Viewpoint(const PolygonMesh& mesh)
{
    const Points positions = mesh.vertices(mesh.face_vertices, Eigen::all);
    const Eigen::RowVector3d extent = positions.colwise().maxCoeff() - positions.colwise().minCoeff();
    const int up = upwards(extent);
    Eigen::Vector3d to_the_eye = Eigen::Vector3d::Zero();
    to_the_eye[up] = 0.62;
    to_the_eye[(up + 1) % 3] = 0.62;
    to_the_eye[(up + 2) % 3] = -1.0;
    to_the_eye.normalize();
    const Eigen::Vector3d right = Eigen::Vector3d::Unit(up).cross(to_the_eye).normalized();
    axes_ << right, right.cross(to_the_eye), to_the_eye;
    const Points seen = positions * axes_;
    const Eigen::RowVector3d low = seen.colwise().minCoeff();
    const Eigen::RowVector3d size = seen.colwise().maxCoeff() - low;
    width_ = picture_width;
    scale_ = (1.0 - 2.0 * margin) * picture_width / std::max({size.x(), 0.7 * size.y(), 1e-300});
    height_ = static_cast<int>(scale_ * size.y() + 2.0 * margin * picture_width);
    corner_ = low;
    corner_.x() -= (width_ / scale_ - size.x()) / 2.0;
    corner_.y() -= (height_ / scale_ - size.y()) / 2.0;
}

Points Viewpoint::seen(const Points& positions) const
{
    return scale_ * ((positions * axes_).rowwise() - corner_);
}

Image draw(const PolygonMesh& triangles, std::span<const double> values, const Paint& paint, const Viewpoint& viewpoint)
{
    Canvas canvas(viewpoint.width(), viewpoint.height());
    const Points seen = viewpoint.seen(triangles.vertices);
    for (Index t = 0; t < triangles.n_faces(); ++t) {
        const auto corners = triangles.face(t);
        Eigen::Matrix3d places;
        Eigen::Vector3d at_corners;
        for (Eigen::Index k = 0; k < 3; ++k) {
            const Index v = corners[static_cast<std::size_t>(k)];
            places.row(k) = seen.row(v);
            at_corners[k] = values[v];
        }
        canvas.add(places, at_corners, [&](double value) { return paint(t, value); });
    }
    return canvas.image();
}

void write_png(const std::filesystem::path& path, const Image& image)
{
    png_image form{};
    form.version = PNG_IMAGE_VERSION;
    form.width = static_cast<png_uint_32>(image.width);
    form.height = static_cast<png_uint_32>(image.height);
    form.format = PNG_FORMAT_RGBA;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(form);
    std::string file(size, '\0');
    if (png_image_write_to_memory(&form, file.data(), &size, 0, image.pixels.data(), 0, nullptr) == 0)
        throw OutputError(path.string() + ": cannot be written: " + form.message);
    file.resize(size);
    write_text(path, file);
}

}  // namespace seamflow
