#include "partition/formats/splicing.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "partition/formats/mesh_file.h"

namespace seamflow {

namespace {

/// The normal `after`, turned round if `given` pointed to the other side of the surface than `before`.
/// @param given the normal in the file. @param before, after those of the old and of the new positions.
/// @returns nothing if the normal is the same before and after, or there is none after.
std::optional<Point> on_the_side_of(const Point& given, const Point& before, const Point& after)
{
    if (after == before || after == Point::Zero())
        return std::nullopt;
    const double side = given.dot(before) < 0.0 ? -1.0 : 1.0;
    // Adding 0 turns -0 into 0, which is easier to read.
    return Point(side * after + Point::Zero());
}

}  // namespace

ByteWriter& Splicer::exchange(std::string_view part)
{
    const auto before = static_cast<std::size_t>(part.data() - rest_.data());
    writer_.text(rest_.substr(0, before));
    rest_.remove_prefix(before + part.size());
    return writer_;
}

bool differ(double a, double b)
{
    return std::bit_cast<std::uint64_t>(a) != std::bit_cast<std::uint64_t>(b);
}

bool differ_as_data(double a, double b)
{
    return differ(a, b) && !(std::isnan(a) && std::isnan(b));
}

WrittenNumbers read_position(TextScanner& scanner)
{
    WrittenNumbers position;
    for (Index k = 0; k < 3; ++k) {
        position.parts[k] = scanner.peek();
        position.values[k] = scanner.real("a coordinate");
    }
    return position;
}

void exchange_position(Splicer& splicer, const WrittenNumbers& before, const Point& after)
{
    for (Index k = 0; k < 3; ++k)
        if (differ(before.values[k], after[k]))
            splicer.exchange(before.parts[k]).number(after[k]);
}

WrittenNumbers read_normal(TextScanner& scanner)
{
    WrittenNumbers normal;
    for (Index k = 0; k < 3; ++k) {
        normal.parts[k] = scanner.peek();
        normal.values[k] = scanner.number_or_nan();
    }
    return normal;
}

void exchange_normal(Splicer& splicer, const WrittenNumbers& before, const Point& after)
{
    for (Index k = 0; k < 3; ++k)
        if (!before.parts[k].empty())
            splicer.exchange(before.parts[k]).number(static_cast<float>(after[k]));
}

MovedNormals::MovedNormals(const PolygonMesh& mesh, Points before, const Executor& exec, double seam_distance)
    : mesh_(mesh)
    , before_(std::move(before))
    , topology_(make_topology(mesh, exec))
    , normals_(mesh, topology_)
    , welded_(weld(mesh, topology_, seam_distance, exec))
{
    if (welded_)
        across_seams_.emplace(welded_->mesh, welded_->topology);
}

std::optional<Point> MovedNormals::around_vertex(Index v, const Point& given) const
{
    if (welded_) {
        const Index first = welded_->representative[v];
        const Point across = (*across_seams_)(first, before_);
        if (std::abs(given.dot(across)) > std::abs(given.dot(normals_(v, before_))))
            return on_the_side_of(given, across, (*across_seams_)(first, mesh_.vertices));
    }
    return around_vertex(topology_.corners_at(v), given);
}

std::optional<Point> MovedNormals::around_vertex(std::span<const Index> corners, const Point& given) const
{
    return on_the_side_of(given, normals_(corners, before_), normals_(corners, mesh_.vertices));
}

std::optional<Point> MovedNormals::of_face(Index f, const Point& given) const
{
    const auto normal = [&](const Points& positions) {
        Point area = vector_area(mesh_.face(f), positions);
        area.stableNormalize();
        return area;
    };
    return on_the_side_of(given, normal(before_), normal(mesh_.vertices));
}

std::string changed_since_read(const std::filesystem::path& source)
{
    return source.string() + ": the file has been changed since it was read, so its data besides positions cannot be "
                             "copied; leave it alone until the result is written";
}

std::string clamping_remark(std::string_view name, std::string_view range)
{
    return fmt::format("some values of {} are beyond the range {} and are written as its least or largest number",
                       in_quotes(name), range);
}

std::string rounding_remark(const std::filesystem::path& source)
{
    return source.string() + " holds positions in single precision, and so does the result; text formats (" +
           extensions_of(FormatGroup::Text) + ") keep all digits";
}

}  // namespace seamflow
