#include "samples/figures/index_page.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samples/figures/embedded_files.h"
#include "samples/page/page_html.h"

namespace seamflow {

namespace {

constexpr std::string_view page_legend =
    R"(<p class="quiet">Tables: V_ and H_ are distances to the undecomposed flow by the same
Laplacian after the last step, in mean edge lengths, and drift is how far the texture slid along the surface; Γ is the length of
the interface, in lengths of the same edges of the undecomposed flow; roughness is the angle between neighbouring triangles,
root mean square and 95th percentile. dt is in length², p in 1/length, q has no unit. Each command, run in the folder of this
page, repeats its flow bit for bit; it ends with status 4 where vertices are thrown further than the mesh is wide, which is
shown here.</p>
)";

/// A number with three digits; a dash for NaN.
std::string short_number(double value)
{
    return std::isnan(value) ? "–" : fmt::format("{:.3g}", value);
}

std::string text_cell(std::string_view text)
{
    return "<td>" + escaped_for_html(std::string(text)) + "</td>";
}

std::string number_cell(const std::string& text)
{
    return "<td class=\"number\">" + (text.empty() ? "–" : text) + "</td>";
}

/// Whether all sub-meshes overlap, which draw.py shows.
bool has_overlap(const Table& table)
{
    return std::all_of(table.rows.begin(), table.rows.end(),
                       [](const Row& row) { return row.conditions == "undecomposed" || row.conditions == "schwarz"; });
}

/// The picture with that title. For a flow that ended early, the caption gives the step.
std::string picture(const FigureResult& result, const std::string& title)
{
    std::string caption = title;
    if (title == picture_of::input)
        caption = "input: " + result.table.mesh;
    else if (title == picture_of::cut)
        caption = has_overlap(result.table) ? "the two sub-meshes and their overlap" : "the two sub-meshes";
    else if (title == picture_of::part)
        caption = "one of the two sub-meshes";
    for (const Variant& variant : result.experiment->variants) {
        if (title_of(variant) != title)
            continue;
        caption = words_of(variant);
        int reached = result.table.steps;
        while (reached > 0 && result.table.find(variant, reached) == nullptr)
            --reached;
        if (reached < result.table.steps)
            caption +=
                ", which ended after step " + std::to_string(reached) + " of " + std::to_string(result.table.steps);
    }
    const std::string file = result.table.figure + "-" + title + ".png";
    return "<figure><img src=\"" + file + "\" alt=\"" + escaped_for_html(caption) + "\"><figcaption>" +
           escaped_for_html(caption) + "</figcaption></figure>\n";
}

/// Whether there are numbers of the authors for this mesh.
bool has_theirs(const FigureResult& result)
{
    return result.table.is_theirs && !result.table.theirs.empty();
}

/// The authors' measurements for a flow, "0.277 / 3.66"; empty: none, or on another mesh.
std::string theirs(const FigureResult& result, const Row& row)
{
    const AuthorsDistances one = result.table.theirs_of(row);
    return std::isnan(one.v_mean) ? "" : short_number(one.v_mean) + " / " + short_number(one.v_max);
}

/// Two rows: the numbers, and the command.
std::string flow_rows(const FigureResult& result, const Row& row, std::size_t columns)
{
    const bool compared = row.conditions != conditions_of({});
    std::string text = "<tr>" + text_cell(row.words) + number_cell(std::to_string(row.step));
    text += number_cell(short_number(result.table.time_step)) + number_cell(row.p) + number_cell(row.q);
    text += text_cell(row.cut);
    text += number_cell(compared ? short_number(row.v.mean) + " / " + short_number(row.v.max) : "");
    if (has_theirs(result))
        text += number_cell(theirs(result, row));
    text += number_cell(compared ? short_number(row.h.mean) + " / " + short_number(row.h.max) : "");
    text += number_cell(short_number(row.drift)) + number_cell(short_number(row.interface_length));
    text += number_cell(short_number(row.roughness.rms) + "° / " + short_number(row.roughness.percentile_95) + "°");
    return text + "</tr>\n<tr class=\"command\"><td colspan=\"" + std::to_string(columns) + "\"><code>" +
           escaped_for_html(row.command) + "</code></td></tr>\n";
}

std::string table_of(const FigureResult& result)
{
    const Roughness& input = result.table.roughness;
    std::vector<std::string> titles{"flow", "step", "dt", "p", "q", "cut", "V_mean / V_max"};
    if (has_theirs(result))
        titles.emplace_back("the authors'");
    titles.insert(titles.end(),
                  {"H_mean / H_max", "drift", "Γ",
                   "roughness (input " + short_number(input.rms) + "° / " + short_number(input.percentile_95) + "°)"});
    std::string text = "<div class=\"wide\"><table><tr>";
    for (const std::string& title : titles)
        text += "<th>" + title + "</th>";
    text += "</tr>\n";
    for (const Row& row : result.table.last_rows())
        text += flow_rows(result, row, titles.size());
    return text + "</table></div>\n";
}

std::string claims_table(const std::vector<Claim>& claims)
{
    std::string text = "<div class=\"wide\"><table><tr><th>claim</th><th>measured</th><th></th></tr>\n";
    for (const Claim& claim : claims) {
        text += "<tr>" + text_cell(claim.text) + text_cell(claim.measured);
        text += claim.holds ? "<td class=\"yes\">holds</td></tr>\n" : "<td class=\"no\">does not hold</td></tr>\n";
        if (!claim.holds && !claim.why.empty())
            text += "<tr><td colspan=\"3\" class=\"quiet\">" + escaped_for_html(claim.why) + "</td></tr>\n";
    }
    return text + "</table></div>\n";
}

std::string figure_section(const FigureResult& result, bool with_pages)
{
    const Experiment& experiment = *result.experiment;
    const Table& table = result.table;
    const std::string number = std::to_string(experiment.figure);
    std::string text = "<h2 id=\"figure-" + number + "\">Figure " + number + ". " +
                       escaped_for_html(std::string(experiment.heading)) + "</h2>\n";
    text += "<p>" + escaped_for_html(std::string(experiment.text)) + "</p>\n<p class=\"quiet\">" +
            escaped_for_html(table.mesh) + ", " + std::to_string(table.vertices) + " vertices; dt " +
            short_number(table.time_step) + ", " + std::to_string(table.steps) +
            (table.steps == 1 ? " step; " : " steps; ");
    text += "<a href=\"" + table.figure + ".csv\">all steps</a>";
    if (with_pages)
        text += "; <a href=\"" + table.figure + ".html\">step by step, in three dimensions</a>";
    text += "</p>\n";
    for (const std::vector<std::string>& row : experiment.pictures) {
        text += "<div class=\"row\">\n";
        for (const std::string& title : row)
            text += picture(result, title);
        text += "</div>\n";
    }
    if (table.has_curves())
        text += "<div class=\"curves\"><img src=\"" + table.figure +
                "-curves.svg\" alt=\"V and H of each decomposed flow by step, in mean edge lengths\"></div>\n";
    text += table_of(result);
    if (table.is_theirs && !experiment.difference.empty())
        text += "<p class=\"quiet\">" + escaped_for_html(std::string(experiment.difference)) + "</p>\n";
    for (const std::string& remark : table.remarks)
        text += "<p class=\"quiet\">" + escaped_for_html(remark) + "</p>\n";
    return text + claims_table(result.claims);
}

}  // namespace

std::string index_html(const std::vector<FigureResult>& results, const std::vector<Claim>& many, bool with_pages,
                       const std::string& to_come, const std::string& remark)
{
    std::string text(index_head());
    text += "<nav>";
    for (const FigureResult& result : results) {
        const std::string number = std::to_string(result.experiment->figure);
        text += "<a href=\"#figure-" + number + "\">Figure " + number + "</a>";
    }
    if (!many.empty())
        text += "<a href=\"#many\">More sub-meshes</a>";
    text += "</nav>\n";
    if (!to_come.empty())
        text +=
            "<p><strong>Still to come, load this page again then: " + escaped_for_html(to_come) + ".</strong></p>\n";
    if (!remark.empty())
        text += "<p><strong>" + escaped_for_html(remark) + "</strong></p>\n";
    text += page_legend;
    for (const FigureResult& result : results)
        text += figure_section(result, with_pages);
    if (!many.empty())
        text += "<h2 id=\"many\">More sub-meshes</h2>\n<p>Not in the paper: 2, 4, 8, 16 and 32 sub-meshes by METIS. "
                "<a href=\"subdomains.csv\">The table</a></p>\n"
                "<div class=\"curves\"><img src=\"subdomains-curves.svg\" alt=\"Distances by number of "
                "sub-meshes\"></div>\n"
                "<p>Sub-meshes have to be wide against √dt, over which a step smooths.</p>\n"
                "<div class=\"curves\"><img src=\"subdomains-width.svg\" alt=\"Distances by width of "
                "sub-meshes\"></div>\n" +
                claims_table(many);
    return text + "</body>\n</html>\n";
}

}  // namespace seamflow
