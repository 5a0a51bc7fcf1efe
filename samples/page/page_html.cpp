#include "samples/page/page_html.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "partition/errors.h"
#include "samples/page/packed_array.h"
#include "samples/page/packed_mesh.h"
#include "samples/page/page_template.h"

namespace seamflow {

namespace {

using Json = nlohmann::ordered_json;

/// The data of a page: scripts that are not run, which the page's own script finds by their number.
class Blocks {
  public:
    /// @returns the number of the block.
    int add(std::string_view data)
    {
        text_.append("<script type=\"text/plain\" id=\"block-").append(std::to_string(count_)).append("\">");
        text_.append(data).append("</script>\n");
        return count_++;
    }

    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string text_;
    int count_ = 0;
};

void replace_all(std::string& text, std::string_view old, std::string_view now)
{
    for (std::size_t place = text.find(old); place != std::string::npos; place = text.find(old, place + now.size()))
        text.replace(place, old.size(), now);
}

/// JSON in which nothing looks like the end of a script: "<" occurs only in strings.
std::string escaped_for_script(const Json& json)
{
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    replace_all(text, "<", "\\u003c");
    return text;
}

Json number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json corner(const Eigen::RowVector3d& point)
{
    return {number(point.x()), number(point.y()), number(point.z())};
}

Json values_json(const PackedValues& values, Blocks& blocks)
{
    return {{"largest", number(values.largest)},
            {"percentile_99", number(values.percentile_99)},
            {"block", blocks.add(values.data)}};
}

Json points_json(const PackedPoints& points, Blocks& blocks)
{
    return {{"lower", corner(points.lower)}, {"upper", corner(points.upper)}, {"block", blocks.add(points.data)}};
}

Json surface_json(const PageSurface& surface, Blocks& blocks)
{
    return {{"positions", points_json(surface.positions, blocks)},
            {"curvature", values_json(surface.curvature, blocks)}};
}

Json flow_json(const PageFlow& flow, Blocks& blocks)
{
    Json json;
    json["name"] = flow.name();
    json["has_undecomposed"] = flow.has_undecomposed();
    json["remark"] = flow.remark();
    json["labels"] = blocks.add(flow.packed_labels());
    json["states"] = Json::array();
    for (const PageState& state : flow.states()) {
        Json& of_state = json["states"].emplace_back();
        of_state["step"] = state.step;
        of_state["surface"] = surface_json(state.surface, blocks);
        if (state.undecomposed)
            of_state["undecomposed"] = surface_json(*state.undecomposed, blocks);
        of_state["distance"] = values_json(state.distance, blocks);
    }
    json["report"] = Json::parse(flow.report_json());
    return json;
}

Json field_json(const PageField& field)
{
    return {{"name", field.name},
            {"is_colour", field.is_colour},
            {"has_data", field.has_data},
            {"has_gaps", field.has_gaps},
            {"least", number(field.least)},
            {"most", number(field.most)},
            {"percentile_1", number(field.percentile_1)},
            {"percentile_99", number(field.percentile_99)}};
}

/// A flow with the surface in the same place in all its states.
Json fields_json(const PageMesh& mesh, const PageFields& fields, Blocks& blocks)
{
    Json json;
    json["has_undecomposed"] = false;
    json["are_distances"] = fields.are_distances;
    json["labels"] = blocks.add(packed(std::span<const std::uint32_t>{}, 1));
    for (const PageField& field : fields.fields)
        json["fields"].push_back(field_json(field));
    const Json surface = {{"positions", points_json(mesh.pack(mesh.mesh.vertices), blocks)}};
    for (const bool is_after : {false, true}) {
        if (!is_after && fields.are_distances)
            continue;
        Json state = {{"step", is_after ? fields.steps : 0}, {"surface", surface}};
        for (const PageField& field : fields.fields)
            state["fields"].push_back(values_json(is_after ? field.after : field.before, blocks));
        json["states"].push_back(state);
    }
    json["report"] = Json::parse(fields.report_json);
    return json;
}

Json colours_json(const FileColours& colours, const PackedMesh& packed_mesh, Blocks& blocks)
{
    Json json;
    if (!colours.of_vertices.empty())
        json["vertices"] = blocks.add(packed_mesh.colours_of_vertices);
    if (colours.materials.empty())
        return json;
    std::map<std::string_view, int> images;
    for (const FileMaterial& material : colours.materials) {
        Json& of_material = json["materials"].emplace_back();
        of_material["colour"] = material.colour;
        if (!material.image.empty() && !images.contains(material.image))
            images[material.image] = blocks.add(material.image);
        if (!material.image.empty())
            of_material["image"] = images[material.image];
    }
    json["material_of_face"] = blocks.add(packed_mesh.material_of_face);
    if (colours.place_of_corner.empty())
        return json;
    json["places"] = points_json(packed_mesh.places, blocks);
    json["place_of_corner"] = blocks.add(packed_mesh.place_of_corner);
    return json;
}

Json mesh_json(const PageMesh& page, const PackedMesh& packed_mesh, Blocks& blocks)
{
    return {{"colours", colours_json(page.colours, packed_mesh, blocks)},
            {"remarks", page.colours.remarks},
            {"vertices", page.mesh.n_vertices()},
            {"faces", page.mesh.n_faces()},
            {"mean_edge", number(page.mean_edge)},
            {"triangles", packed_mesh.n_triangles},
            {"corners", blocks.add(packed_mesh.corners)},
            {"edges", blocks.add(packed_mesh.edges)},
            {"per_face", blocks.add(packed_mesh.per_face)}};
}

Json begin_facts(const std::string& title, const PageMesh& mesh, Blocks& blocks)
{
    return {{"title", title}, {"mesh", mesh_json(mesh, pack_mesh(mesh), blocks)}};
}

/// The page with everything in it.
std::string filled_template(const std::string& title, const Json& facts, const Blocks& blocks)
{
    constexpr std::string_view title_mark = "{{title}}";
    constexpr std::string_view data_mark = "{{data}}";
    const std::string_view form = page_template();
    const std::size_t title_place = form.find(title_mark);
    const std::size_t data_place = form.find(data_mark);
    std::string html(form.substr(0, title_place));
    html.append(escaped_for_html(title));
    html.append(form.substr(title_place + title_mark.size(), data_place - title_place - title_mark.size()));
    html.append("<script type=\"application/json\" id=\"facts\">").append(escaped_for_script(facts));
    html.append("</script>\n").append(blocks.text()).append(form.substr(data_place + data_mark.size()));
    return html;
}

}  // namespace

std::string escaped_for_html(std::string text)
{
    replace_all(text, "&", "&amp;");
    replace_all(text, "<", "&lt;");
    replace_all(text, ">", "&gt;");
    replace_all(text, "\"", "&quot;");
    return text;
}

std::string page_html(const std::string& title, std::span<const PageFlow> flows)
{
    require_page();
    Blocks blocks;
    Json facts = begin_facts(title, flows.front().mesh(), blocks);
    for (const PageFlow& flow : flows)
        facts["flows"].push_back(flow_json(flow, blocks));
    return filled_template(title, facts, blocks);
}

std::string page_html(const std::string& title, const PageMesh& mesh, const PageFields& fields)
{
    require_page();
    Blocks blocks;
    Json facts = begin_facts(title, mesh, blocks);
    facts["flows"].push_back(fields_json(mesh, fields, blocks));
    return filled_template(title, facts, blocks);
}

void require_page()
{
    if (page_template().empty())
        throw OptionError(
            "--html: this program was built without the page, which needs npm; install it (Debian: apt-get install "
            "nodejs npm), configure again where the npm registry can be reached (cmake --preset release), and build");
}

}  // namespace seamflow
