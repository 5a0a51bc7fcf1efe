#include "samples/page/page_html.h"

#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "partition/errors.h"
#include "samples/page/packed_array.h"
#include "samples/page/page_template.h"
#include "samples/page/page_triangles.h"

namespace seamflow {

namespace {

using Json = nlohmann::ordered_json;

/// What a browser has shown so far is a quarter of this.
constexpr Index most_faces = 5'000'000;

/// The data of a page: scripts that are none, which the page's own script finds by their number.
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

/// JSON in which nothing looks like the end of a script: "<" occurs in strings alone.
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

Json surface_json(const PageSurface& surface, Blocks& blocks)
{
    return {{"positions",
             {{"lower", corner(surface.positions.lower)},
              {"upper", corner(surface.positions.upper)},
              {"block", blocks.add(surface.positions.data)}}},
            {"curvature", values_json(surface.curvature, blocks)}};
}

Json flow_json(const PageFlow& flow, Blocks& blocks)
{
    Json json;
    json["name"] = flow.name();
    json["has_undecomposed"] = flow.has_undecomposed();
    json["remark"] = flow.remark();
    const std::vector<std::uint32_t> labels(flow.labels().begin(), flow.labels().end());
    json["labels"] = blocks.add(packed(std::span<const std::uint32_t>(labels), 1));
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

Json mesh_json(const PageMesh& page, Blocks& blocks)
{
    const PageTriangles triangles = page_triangles(page.mesh, page.topology);
    return {{"vertices", page.mesh.n_vertices()},
            {"faces", page.mesh.n_faces()},
            {"triangles", triangles.edges.size()},
            {"corners", blocks.add(packed(std::span<const std::uint32_t>(triangles.corners), 3))},
            {"edges", blocks.add(packed(std::span<const std::uint8_t>(triangles.edges)))},
            {"per_face", blocks.add(packed(std::span<const std::uint32_t>(triangles.per_face), 1))}};
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
    Json facts;
    facts["title"] = title;
    facts["mesh"] = mesh_json(flows.front().mesh(), blocks);
    facts["flows"] = Json::array();
    for (const PageFlow& flow : flows)
        facts["flows"].push_back(flow_json(flow, blocks));

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

void require_page()
{
    if (page_template().empty())
        throw OptionError(
            "--html: this program was built without the page, which takes npm; install it (Debian: apt-get install "
            "nodejs npm), configure again where the npm registry can be reached (cmake --preset release), and build");
}

void require_showable(const PolygonMesh& mesh, const std::filesystem::path& path)
{
    if (mesh.n_faces() > most_faces)
        throw OutputError(path.string() + ": cannot be written, for a browser shows at most " +
                          std::to_string(most_faces) + " faces, and the mesh has " + std::to_string(mesh.n_faces()));
}

}  // namespace seamflow
