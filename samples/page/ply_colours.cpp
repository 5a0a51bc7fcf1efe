#include "samples/page/ply_colours.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "partition/errors.h"
#include "partition/formats/ply_data.h"
#include "partition/formats/ply_source.h"
#include "partition/io/mesh_builder.h"
#include "samples/page/texture_images.h"

namespace seamflow {

namespace {

/// The meaning of a number of a vertex.
enum PlyColourRole : std::size_t { Red, Green, Blue, U, V, Other };

PlyColourRole colour_role_of(std::string_view name)
{
    constexpr std::array<std::array<std::string_view, 4>, 5> names = {{{"red", "diffuse_red", "r", ""},
                                                                       {"green", "diffuse_green", "g", ""},
                                                                       {"blue", "diffuse_blue", "b", ""},
                                                                       {"texture_u", "s", "u", "texture_s"},
                                                                       {"texture_v", "t", "v", "texture_t"}}};
    for (std::size_t role = 0; role < names.size(); ++role)
        if (std::find(names[role].begin(), names[role].end(), name) != names[role].end())
            return static_cast<PlyColourRole>(role);
    return Other;
}

/// A colour component as files of each type store it: of 255 or 65535, or from 0 to 1.
std::uint8_t eight_bits_of(double value, PlyType type)
{
    const double most = type == PlyType::UInt16 ? 65535.0 : is_integer(type) ? 255.0 : 1.0;
    return static_cast<std::uint8_t>(
        std::lround(255.0 * (std::isnan(value) ? 0.5 : std::clamp(value / most, 0.0, 1.0))));
}

bool has(const PlyElement& element, PlyColourRole role)
{
    return std::any_of(element.properties.begin(), element.properties.end(), [&](const PlyProperty& property) {
        return !property.length_type && colour_role_of(property.name) == role;
    });
}

bool is_list_of_corners(const PlyProperty& property)
{
    return property.length_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// The first image that comments of the header name; empty if there is none.
std::string texture_file(std::string_view header)
{
    constexpr std::string_view mark = "comment TextureFile ";
    const std::size_t place = header.find(mark);
    if (place == std::string_view::npos)
        return {};
    const std::string_view rest = header.substr(place + mark.size());
    const std::string_view name = rest.substr(0, rest.find_first_of("\r\n"));
    const std::size_t last = name.find_last_not_of(" \t");
    return std::string(name.substr(0, last == std::string_view::npos ? 0 : last + 1));
}

/// Reads the elements of one file one after another.
class PlyColourReader {
  public:
    PlyColourReader(const PolygonMesh& mesh, std::span<const Index> left_out, bool has_image)
        : mesh_(mesh)
        , left_out_(left_out)
        , has_image_(has_image)
    {
    }

    void read(PlySource source, const PlyHeader& header)
    {
        for (const PlyElement& element : header.elements)
            if (element.name == "vertex")
                read_vertices(source, element);
            else if (element.name == "face" && has_image_)
                read_faces(source, element);
            else
                source.pass_over(element, 0, element.count);
    }

    /// @throws InputError
    FileColours finish(const std::filesystem::path& path);

  private:
    void read_vertices(PlySource& source, const PlyElement& vertices)
    {
        std::array<std::uint8_t, 3> colour{};
        std::array<float, 2> place{};
        const bool have_colours = has(vertices, Red) && has(vertices, Green) && has(vertices, Blue);
        const bool have_places = has_image_ && has(vertices, U) && has(vertices, V);
        source.scan(
            vertices, 0, vertices.count,
            columns_of(vertices,
                       [](const PlyProperty& property) {
                           const PlyColourRole role = colour_role_of(property.name);
                           return property.length_type || role == Other ? -1 : static_cast<Index>(role);
                       }),
            [&](Index, Index role, const PlyProperty& property) {
                const double number = source.number(property.type);
                if (role < static_cast<Index>(U))
                    colour[role] = eight_bits_of(number, property.type);
                else
                    place[role - static_cast<Index>(U)] = static_cast<float>(number);
            },
            [&](Index) {
                source.end_element();
                if (have_colours)
                    result_.of_vertices.push_back(colour);
                if (have_places)
                    result_.places.push_back(place);
                ++n_vertices_;
            });
    }

    void read_faces(PlySource& source, const PlyElement& faces)
    {
        std::vector<std::int64_t> vertices;
        std::optional<std::vector<double>> numbers;
        const auto is_there = [this](Index f) { return !std::binary_search(left_out_.begin(), left_out_.end(), f); };
        source.scan(
            faces, 0, faces.count,
            columns_of(faces,
                       [](const PlyProperty& property) {
                           return property.length_type && property.name == "texcoord" ? 0
                                  : is_list_of_corners(property)                      ? 1
                                                                                      : -1;
                       }),
            [&](Index f, Index column, const PlyProperty& list) {
                if (!is_there(f))
                    return source.pass_over(list);
                if (column == 1)
                    return source.integers(list, [&](std::int64_t v) { vertices.push_back(v); });
                numbers.emplace();
                for (std::int64_t n = source.length(list); n > 0; --n)
                    numbers->push_back(source.number(list.type));
            },
            [&](Index f) {
                source.end_element();
                if (numbers)
                    add_places({vertices.begin(), vertices.end()}, std::move(*numbers));
                vertices.clear();
                numbers.reset();
                n_faces_ += is_there(f) ? 1 : 0;
            });
    }

    /// Adds the places of a face's corners, of those that the mesh has.
    /// @param numbers two for each corner; those that are missing are 0.
    void add_places(const std::vector<Index>& vertices, std::vector<double> numbers)
    {
        numbers.resize(2 * vertices.size());
        std::vector<Index> distinct;
        find_distinct_corners(vertices, distinct);
        for (const Index k : distinct)
            of_corners_.push_back(
                {static_cast<float>(numbers[2 * usize(k)]), static_cast<float>(numbers[2 * usize(k) + 1])});
    }

    void number_places_of_corners();

    const PolygonMesh& mesh_;
    std::span<const Index> left_out_;
    bool has_image_;
    FileColours result_;
    std::vector<std::array<float, 2>> of_corners_;
    Index n_vertices_ = 0;
    Index n_faces_ = 0;
};

/// Most corners around a vertex have the same place.
void PlyColourReader::number_places_of_corners()
{
    result_.places = of_corners_;
    std::sort(result_.places.begin(), result_.places.end());
    result_.places.erase(std::unique(result_.places.begin(), result_.places.end()), result_.places.end());
    for (const auto& place : of_corners_)
        result_.place_of_corner.push_back(static_cast<Index>(
            std::lower_bound(result_.places.begin(), result_.places.end(), place) - result_.places.begin()));
}

FileColours PlyColourReader::finish(const std::filesystem::path& path)
{
    if (n_vertices_ != mesh_.n_vertices() || (has_image_ && n_faces_ != mesh_.n_faces()))
        throw InputError(path.string() + ": the file is not that of the mesh");
    // NaN has no order.
    for (auto* places : {&result_.places, &of_corners_})
        for (auto& place : *places)
            for (float& part : place)
                part = std::isfinite(part) ? part : 0.0F;
    if (of_corners_.size() == usize(mesh_.n_corners()))
        number_places_of_corners();
    else if (!result_.places.empty())
        result_.place_of_corner = mesh_.face_vertices;
    return std::move(result_);
}

}  // namespace

FileColours read_ply_colours(const std::filesystem::path& path, std::string_view file, const PolygonMesh& mesh,
                             std::span<const Index> left_out)
{
    const PlyData data = ply_data_of(path, file, PlyUse::OtherData);
    const std::string name = texture_file(file.substr(0, file.size() - data.bytes.size()));
    PlyColourReader reader(mesh, left_out, !name.empty());
    reader.read(data.source(data.whole()), data.header);
    FileColours colours = reader.finish(path);
    if (colours.place_of_corner.empty())
        return colours;
    TextureImages images(path);
    if (const std::string image = images.data_url(name); !image.empty()) {
        colours.materials.push_back({.image = image});
        colours.material_of_face.assign(mesh.n_faces(), 0);
    } else {
        colours.places.clear();
        colours.place_of_corner.clear();
    }
    colours.remarks = images.remarks();
    return colours;
}

}  // namespace seamflow
