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

constexpr std::size_t counts_bytes = binary_off_counts_bytes;
constexpr std::size_t vertex_bytes = 3 * word_size;
constexpr std::size_t typical_face_bytes = 4 * word_size;

/// Some faces, one behind the other.
struct FaceSlice {
    std::uint64_t n_faces;
    /// Where the first begins.
    std::size_t offset;
};

/// Passes over the data by their counts alone.
class Skimmer {
  public:
    /// @param per_slice how many faces a slice gets.
    Skimmer(std::string_view data, const Layout& layout, Index per_slice)
        : data_(data)
        , layout_(layout)
        , per_slice_(per_slice)
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
            if (slices_.empty() || slices_.back().n_faces == at(per_slice_))
                slices_.push_back({0, next_});
            ++slices_.back().n_faces;
            skip_words(count());
            if (layout_.colours_follow_faces)
                skip_words(count());
        }
        return fits_ && data_.find_first_not_of(std::string_view("\0 \t\r\n", 5), next_) == std::string_view::npos;
    }

    /// All faces that have been passed.
    [[nodiscard]] const std::vector<FaceSlice>& slices() const { return slices_; }

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
    Index per_slice_;
    std::vector<FaceSlice> slices_;
    std::size_t next_ = 0;
    bool fits_ = true;
};

double read_number(ByteScanner& scanner)
{
    const double value = scanner.read<float>();
    if (!std::isfinite(value))
        scanner.fault("a coordinate is not a finite number; remove the vertex or mend it");
    return value;
}

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

/// @throws InputError if there is any fault, not necessarily naming it.
PolygonMesh read_slices(const Layout& layout, std::string_view data, const Slicing& slicing)
{
    Skimmer skimmer(data, layout, elements_per_slice(slicing, typical_face_bytes));
    skimmer.fits();
    PolygonMesh mesh;
    mesh.vertices = uninitialised_points(sum_of_counts(0, from_bytes<std::uint32_t>(data.data(), layout.order)));
    if (mesh.n_vertices() == 0)
        throw InputError("there are no vertices");
    for_each(slicing.loop, mesh.n_vertices(), [&](Index v) {
        const char* const first = data.data() + counts_bytes + at(v) * vertex_bytes;
        for (Index k = 0; k < 3; ++k)
            mesh.vertices(v, k) = from_bytes<float>(first + at(k) * word_size, layout.order);
        if (!mesh.vertices.row(v).allFinite())
            throw InputError("a coordinate is not a finite number");
    });
    const NoPosition position;
    append_faces(mesh, static_cast<Index>(skimmer.slices().size()), slicing.loop, [&](Index i, PolygonMesh& faces) {
        const FaceSlice& slice = skimmer.slices()[i];
        ByteScanner scanner({}, data, slice.offset, layout.order);
        MeshBuilder builder(position, 0, {mesh.vertices, 0, faces});
        std::vector<Index> corners;
        for (std::uint64_t f = 0; f < slice.n_faces; ++f)
            read_face(scanner, layout, mesh.n_vertices(), builder, corners);
    });
    return mesh;
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
        const double x = read_number(scanner);
        const double y = read_number(scanner);
        const double z = read_number(scanner);
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
        if (Skimmer(data, layout, std::numeric_limits<Index>::max()).fits())
            return layout;
    return std::nullopt;
}

/// @param type of four bytes.
PlyProperty word_list(const char* name, PlyType type)
{
    PlyProperty property;
    property.name = name;
    property.type = type;
    property.length_type = PlyType::UInt32;
    return property;
}

}  // namespace

PolygonMesh read_binary_off(const std::filesystem::path& path, std::string_view file, std::size_t offset,
                            const Slicing& slicing, FaultLog* faults)
{
    if (const auto layout = layout_of(file.substr(offset))) {
        const auto in_one_go = [&] { return read_as(*layout, path, file, offset, faults); };
        if (file.size() <= slicing.bytes)
            return in_one_go();
        return read_in_slices_if_faultless([&] { return read_slices(*layout, file.substr(offset), slicing); },
                                           in_one_go);
    }
    refuse_binary_off(path, file, offset);
}

void refuse_binary_off(const std::filesystem::path& path, std::string_view file, std::size_t offset)
{
    ByteScanner(path, file, offset, std::endian::big)
        .fail("the binary data do not end where their counts say, in either byte order; the file has been cut off, or "
              "holds more "
              "than coordinates and faces: convert the mesh to text OFF or to PLY");
}

std::vector<PlyHeader> layouts_of_binary_off(std::string_view file, std::size_t offset)
{
    std::vector<PlyHeader> headers;
    if (file.size() < offset + counts_bytes)
        return headers;
    for (const Layout& layout : layouts) {
        const char* const counts = file.data() + offset;
        PlyElement vertices;
        vertices.name = "vertex";
        vertices.count = from_bytes<std::uint32_t>(counts, layout.order);
        for (const std::string name : {"x", "y", "z"})
            vertices.properties.emplace_back().name = name;
        PlyElement faces;
        faces.name = "face";
        faces.count = from_bytes<std::uint32_t>(counts + word_size, layout.order);
        faces.properties.push_back(word_list("vertex_indices", PlyType::Int32));
        if (layout.colours_follow_faces)
            faces.properties.push_back(word_list("colours", PlyType::Float32));
        const bool is_big = layout.order == std::endian::big;
        headers.push_back({is_big ? Encoding::BinaryBigEndian : Encoding::BinaryLittleEndian, {vertices, faces}});
    }
    return headers;
}

void require_fits_binary_off(const std::filesystem::path& path, const Points& vertices, Index first, const Loop& loop)
{
    const auto too_large = select(loop, static_cast<Index>(vertices.rows()), [&](Index v) {
        return vertices.row(v).cwiseAbs().maxCoeff() > double{std::numeric_limits<float>::max()};
    });
    if (!too_large.empty())
        throw OutputError(
            fmt::format("{}: cannot be written: vertex {} (numbered from 0) has a coordinate too large for the single "
                        "precision of binary OFF; write another format",
                        path.string(), first + too_large.front()));
}

bool rewrite_binary_off(OutputFile& output, std::string_view file, std::size_t offset, const PolygonMesh& mesh,
                        const Slicing& slicing)
{
    const std::endian order = layout_of(file.substr(offset)).value_or(Layout{}).order;
    require_fits_binary_off(output.path(), mesh.vertices, 0, slicing.loop);
    const std::size_t first = offset + counts_bytes;
    output.text(file.substr(0, first));
    write_elements(output, mesh.n_vertices(), elements_per_slice(slicing, vertex_bytes), slicing.loop,
                   [&](ByteWriter& slice, Index v) {
                       for (const double coordinate : mesh.vertices.row(v))
                           slice.binary(static_cast<float>(coordinate), order);
                   });
    output.text(file.substr(first + vertex_bytes * at(mesh.n_vertices())));
    return mesh.vertices.cast<float>().cast<double>() != mesh.vertices;
}

}  // namespace seamflow
