#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/off.h"
#include "partition/io/byte_scanner.h"
#include "partition/io/mesh_builder.h"

namespace seamflow {

namespace {

/// How the numbers of one file are stored.
struct Layout {
    std::endian order = std::endian::big;
    bool colours_follow_faces = true;
};

constexpr Layout layouts[] = {
    {std::endian::big, true}, {std::endian::little, false}, {std::endian::big, false}, {std::endian::little, true}};

constexpr std::size_t word_size = 4;

/// Passes over the data by their counts alone.
class Skimmer {
  public:
    Skimmer(std::string_view data, const Layout& layout)
        : data_(data)
        , layout_(layout)
    {
    }

    /// Whether the data end where the counts say.
    bool fits()
    {
        const std::uint64_t n_vertices = count();
        const std::uint64_t n_faces = count();
        count();
        skip_words(3 * n_vertices);
        for (std::uint64_t f = 0; f < n_faces && fits_; ++f) {
            skip_words(count());
            if (layout_.colours_follow_faces)
                skip_words(count());
        }
        return fits_ && data_.find_first_not_of(std::string_view("\0 \t\r\n", 5), next_) == std::string_view::npos;
    }

  private:
    std::uint64_t count()
    {
        const std::size_t begin = next_;
        skip_words(1);
        return fits_ ? from_bytes<std::uint32_t>(data_.data() + begin, layout_.order) : 0;
    }

    void skip_words(std::uint64_t n)
    {
        fits_ = fits_ && n <= (data_.size() - next_) / word_size;
        if (fits_)
            next_ += static_cast<std::size_t>(n) * word_size;
    }

    std::string_view data_;
    Layout layout_;
    std::size_t next_ = 0;
    bool fits_ = true;
};

void read_face(ByteScanner& scanner, const Layout& layout, std::int64_t n_vertices, MeshBuilder& builder,
               std::vector<Index>& corners)
{
    corners.clear();
    const auto n = scanner.read<std::uint32_t>();
    for (std::uint32_t k = 0; k < n; ++k)
        corners.push_back(builder.vertex(scanner.read<std::int32_t>(), n_vertices));
    if (layout.colours_follow_faces)
        scanner.take(word_size * scanner.read<std::uint32_t>());
    builder.add_face(corners);
}

PolygonMesh read_as(const Layout& layout, const std::filesystem::path& path, std::string_view file, std::size_t offset,
                    FaultLog* faults)
{
    ByteScanner scanner(path, file, offset, layout.order);
    scanner.note_faults_in(faults);
    MeshBuilder builder(scanner);
    const auto n_vertices = scanner.read<std::uint32_t>();
    const auto n_faces = scanner.read<std::uint32_t>();
    scanner.read<std::uint32_t>();
    builder.reserve(n_vertices, n_faces);
    for (std::uint32_t v = 0; v < n_vertices; ++v) {
        scanner.enter("vertex", v);
        const auto x = scanner.read<float>();
        const auto y = scanner.read<float>();
        const auto z = scanner.read<float>();
        if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
            scanner.fault("a coordinate is not a finite number; mend or remove the vertex");
        builder.add_vertex({x, y, z});
    }
    std::vector<Index> corners;
    for (std::uint32_t f = 0; f < n_faces; ++f) {
        scanner.enter("face", f);
        read_face(scanner, layout, n_vertices, builder, corners);
    }
    return builder.finish();
}

/// The first layout that fits the length of the data.
std::optional<Layout> layout_of(std::string_view data)
{
    for (const Layout& layout : layouts)
        if (Skimmer(data, layout).fits())
            return layout;
    return std::nullopt;
}

}  // namespace

PolygonMesh read_binary_off(const std::filesystem::path& path, std::string_view file, std::size_t offset,
                            const Slicing&, FaultLog* faults)
{
    if (const auto layout = layout_of(file.substr(offset)))
        return read_as(*layout, path, file, offset, faults);
    ByteScanner(path, file, offset, std::endian::big)
        .fail("the binary data do not end where their counts say, in either byte order; the file has been cut off, or "
              "holds more "
              "than coordinates and faces: convert the mesh to text OFF or to PLY");
}

bool rewrite_binary_off(OutputFile& output, std::string_view file, std::size_t offset, const PolygonMesh& mesh,
                        const Slicing&)
{
    const std::endian order = layout_of(file.substr(offset)).value_or(Layout{}).order;
    const std::size_t first = offset + 3 * word_size;
    bool rounded = false;
    output.text(file.substr(0, first));
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        for (const double coordinate : mesh.vertices.row(v)) {
            if (std::abs(coordinate) > std::numeric_limits<float>::max())
                throw OutputError(
                    fmt::format("{}: cannot be written: vertex {} (numbered from 0) has a coordinate too large for the "
                                "single precision of binary OFF; write another format",
                                output.path().string(), v));
            const auto number = static_cast<float>(coordinate);
            rounded = rounded || static_cast<double>(number) != coordinate;
            output.binary(number, order);
        }
    output.text(file.substr(first + 3 * word_size * at(mesh.n_vertices())));
    return rounded;
}

}  // namespace seamflow
