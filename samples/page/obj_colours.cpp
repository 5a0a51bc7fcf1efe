#include "samples/page/obj_colours.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/obj_scan.h"
#include "partition/io/input_file.h"
#include "partition/io/mesh_builder.h"
#include "samples/page/texture_images.h"

namespace seamflow {

namespace {

/// @param value from 0 to 1.
std::uint8_t eight_bits_of_part(double value)
{
    return static_cast<std::uint8_t>(std::lround(255.0 * (std::isnan(value) ? 0.5 : std::clamp(value, 0.0, 1.0))));
}

float finite_part(double value)
{
    const auto part = static_cast<float>(value);
    return std::isfinite(part) ? part : 0.0F;
}

/// The rest of a line, with one blank between its words: a name may contain blanks.
std::string rest_of(TextScanner& scanner)
{
    std::string rest;
    while (scanner.has_token())
        rest.append(rest.empty() ? "" : " ").append(scanner.token());
    return rest;
}

/// Skips the options of a map, such as `-s 1 1 1`: words that begin with a dash, and their arguments.
void pass_over_options(TextScanner& scanner)
{
    const auto is_number = [](std::string_view word) {
        double ignored = 0.0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), ignored);
        return error == std::errc{} && end == word.data() + word.size();
    };
    while (scanner.peek().starts_with('-')) {
        const std::string_view option = scanner.token();
        const bool takes_word = option != "-s" && option != "-o" && option != "-t" && option != "-mm";
        if (takes_word)
            scanner.token();
        for (int k = 0; k < 3 && !takes_word && is_number(scanner.peek()); ++k)
            scanner.token();
    }
}

/// A material as its file describes it.
struct Description {
    std::optional<Colour> colour;
    std::string image;
};

using Descriptions = std::map<std::string, Description>;

void read_material_file(const std::filesystem::path& path, Descriptions& known)
{
    const InputFile file{OpenFile(path)};
    TextScanner scanner(path, file.content());
    Description* material = nullptr;
    while (scanner.next_line()) {
        const std::string_view keyword = scanner.token();
        if (keyword == "newmtl") {
            material = &known[rest_of(scanner)];
        } else if (keyword == "Kd" && material != nullptr) {
            material->colour.emplace();
            for (std::uint8_t& part : *material->colour)
                part = eight_bits_of_part(scanner.number_or_nan());
        } else if (keyword == "map_Kd" && material != nullptr) {
            pass_over_options(scanner);
            material->image = rest_of(scanner);
        }
    }
}

/// Reads an OBJ file line by line.
class ObjColourReader {
  public:
    ObjColourReader(const std::filesystem::path& path, std::string_view text, const PolygonMesh& mesh,
                    std::span<const Index> left_out)
        : path_(path)
        , scanner_(path, text, obj_syntax)
        , mesh_(mesh)
        , left_out_(left_out)
    {
    }

    FileColours read();

    /// See scan_obj.
    void colour(Index v, TextScanner& scanner, std::size_t n_behind);
    void face(TextScanner& scanner, const ObjCounts& before);
    void other(std::string_view keyword);

  private:
    void read_library();
    [[nodiscard]] Index place_of(std::string_view attributes) const;
    void drop_what_is_not_shown();

    const std::filesystem::path& path_;
    TextScanner scanner_;
    const PolygonMesh& mesh_;
    std::span<const Index> left_out_;
    FileColours result_;
    std::vector<std::array<double, 3>> colours_;
    Index n_faces_of_file_ = 0;
    std::string material_;
    Descriptions descriptions_;
    std::map<std::string, Index> materials_;
    std::vector<std::string> names_;
};

void ObjColourReader::colour(Index /*v*/, TextScanner& scanner, std::size_t /*n_behind*/)
{
    std::vector<double> numbers;
    while (scanner.has_token())
        numbers.push_back(scanner.number_or_nan());
    if (numbers.size() >= 3)
        colours_.push_back({numbers[numbers.size() - 3], numbers[numbers.size() - 2], numbers[numbers.size() - 1]});
}

/// For a corner such as 7/2, 7/2/1 or 7/-1, the place behind its first slash; the first place if there is none.
Index ObjColourReader::place_of(std::string_view attributes) const
{
    std::int64_t number = 0;
    if (!attributes.empty())
        std::from_chars(attributes.data() + 1, attributes.data() + attributes.size(), number);
    const std::int64_t place = number < 0 ? static_cast<std::int64_t>(result_.places.size()) + number : number - 1;
    return place >= 0 && place < (std::int64_t{1} << 31) - 1 ? static_cast<Index>(place) : 0;
}

void ObjColourReader::face(TextScanner& scanner, const ObjCounts& /*before*/)
{
    const Index number = n_faces_of_file_++;
    if (std::binary_search(left_out_.begin(), left_out_.end(), number))
        return;
    const auto f = static_cast<Index>(result_.material_of_face.size());
    std::vector<Index> vertices;
    std::vector<Index> places;
    while (scanner.has_token()) {
        const auto [vertex, attributes] = read_obj_corner(scanner, "a vertex number");
        vertices.push_back(static_cast<Index>(vertex));
        places.push_back(place_of(attributes));
    }
    std::vector<Index> distinct;
    find_distinct_corners(vertices, distinct);
    for (const Index k : distinct)
        result_.place_of_corner.push_back(places[k]);
    if (f >= mesh_.n_faces() || distinct.size() != mesh_.face(f).size())
        scanner_.fail("the face is not that of the mesh; leave the file unchanged while it is read");
    const auto [entry, is_new] = materials_.try_emplace(material_, static_cast<Index>(names_.size()));
    if (is_new)
        names_.push_back(material_);
    result_.material_of_face.push_back(entry->second);
}

void ObjColourReader::read_library()
{
    const std::string name = rest_of(scanner_);
    try {
        read_material_file(folder_of(path_) / name, descriptions_);
    } catch (const InputError& error) {
        result_.remarks.push_back(fmt::format("The page lacks the file's materials: {}.", error.what()));
    }
}

/// Only materials other than plain grey are worth a choice.
void ObjColourReader::drop_what_is_not_shown()
{
    const auto is_image = [](const FileMaterial& material) { return !material.image.empty(); };
    const bool has_images = std::any_of(result_.materials.begin(), result_.materials.end(), is_image);
    const bool is_described = std::any_of(names_.begin(), names_.end(), [&](const std::string& name) {
        const auto found = descriptions_.find(name);
        return found != descriptions_.end() && found->second.colour;
    });
    if (!has_images && !is_described) {
        result_.materials.clear();
        result_.material_of_face.clear();
    }
    if (!has_images) {
        result_.places.clear();
        result_.place_of_corner.clear();
        return;
    }
    if (result_.places.empty())
        result_.places.push_back({0.0F, 0.0F});
    for (Index& place : result_.place_of_corner)
        place = usize(place) < result_.places.size() ? place : 0;
}

void ObjColourReader::other(std::string_view keyword)
{
    if (keyword == "vt") {
        const float u = finite_part(scanner_.number_or_nan());
        const float v = scanner_.has_token() ? finite_part(scanner_.number_or_nan()) : 0.0F;
        result_.places.push_back({u, v});
    } else if (keyword == "usemtl") {
        material_ = rest_of(scanner_);
    } else if (keyword == "mtllib") {
        read_library();
    }
}

FileColours ObjColourReader::read()
{
    const std::int64_t n_vertices = scan_obj(scanner_, *this).n_vertices;
    if (n_vertices != mesh_.n_vertices() || usize(mesh_.n_faces()) != result_.material_of_face.size())
        throw InputError(path_.string() + ": the file is not that of the mesh");
    if (colours_.size() == usize(mesh_.n_vertices())) {
        const bool is_to_255 = std::any_of(colours_.begin(), colours_.end(), [](const auto& colour) {
            return std::any_of(colour.begin(), colour.end(), [](double part) { return part > 1.0; });
        });
        for (const auto& colour : colours_) {
            Colour& last = result_.of_vertices.emplace_back();
            for (std::size_t k = 0; k < 3; ++k)
                last[k] = eight_bits_of_part(is_to_255 ? colour[k] / 255.0 : colour[k]);
        }
    }
    TextureImages images(path_);
    for (const std::string& name : names_) {
        const Description& description = descriptions_[name];
        FileMaterial& material = result_.materials.emplace_back();
        if (!description.image.empty())
            material.image = images.data_url(description.image);
        // Images are used as they are: many files have a dark colour beside them, which viewers ignore.
        if (material.image.empty())
            material.colour = description.colour.value_or(Colour{219, 222, 226});
    }
    result_.remarks.insert(result_.remarks.end(), images.remarks().begin(), images.remarks().end());
    drop_what_is_not_shown();
    return std::move(result_);
}

}  // namespace

FileColours read_obj_colours(const std::filesystem::path& path, std::string_view text, const PolygonMesh& mesh,
                             std::span<const Index> left_out)
{
    return ObjColourReader(path, text, mesh, left_out).read();
}

}  // namespace seamflow
