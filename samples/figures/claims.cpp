#include "samples/figures/claims.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include "partition/text.h"
#include "samples/figures/experiment.h"
#include "samples/figures/experiments.h"
#include "samples/figures/measured.h"
#include "samples/files/output_files.h"

namespace seamflow {

namespace {

constexpr Laplacian fujiwara_laplacian = Laplacian::Fujiwara;
constexpr Laplacian alexa_laplacian = Laplacian::AlexaWardetzky;
constexpr Laplacian velho_laplacian = Laplacian::PtackovaVelho;
constexpr std::string_view robin_name = "adapted-robin";
constexpr std::string_view ventcell_name = "adapted-ventcell";
constexpr std::string_view schwarz_name = "schwarz";
constexpr std::string_view undecomposed_name = "undecomposed";

using Laplacians = std::vector<Laplacian>;

/// Makes the claims of one figure.
class Claims {
  public:
    Claims(const Table& table, const ClaimLimits& limits)
        : table_(table)
        , limits_(limits)
    {
    }

    void teaser();
    void polygons();
    void schwarz_on_polygons();
    void hexagons();
    void triangles();
    void wavy_cylinder();
    void texture();

    std::vector<Claim> made;

  private:
    void add(std::string text, const std::vector<Measured>& values, bool holds)
    {
        Claim claim{.figure = table_.figure, .text = std::move(text), .measured = listed(values), .holds = holds};
        const bool is_missing =
            std::any_of(values.begin(), values.end(), [](const Measured& one) { return std::isnan(one.value); });
        if (!holds && is_missing)
            claim.why = "There is no number where a flow ended before its last step, or where nothing lies between the "
                        "sub-meshes.";
        made.push_back(std::move(claim));
    }

    /// After the last step the quantity is at most the limit for all of these flows.
    void add_at_most(const std::string& text, const Laplacians& laplacians, std::string_view conditions, Quantity what,
                     double limit)
    {
        const auto values = last_step(table_, laplacians, conditions, what);
        add(text + " ≤ " + csv_number(limit), values, at_most(values, limit));
    }

    void add_close(const std::string& text, const Laplacians& laplacians, std::string_view conditions)
    {
        add_at_most(text + ": V_mean", laplacians, conditions, v_mean, limits_.close_vertices);
        add_at_most(text + ": H_mean", laplacians, conditions, h_mean, limits_.close_surfaces);
    }

    /// Δ_F drags the texture, unlike the others.
    void add_drag(const std::string& where, const Laplacians& others, std::string_view conditions)
    {
        auto values = last_step(table_, others, conditions, drift);
        const double drag = quantity(table_, fujiwara_laplacian, conditions, table_.steps, drift);
        const bool holds = at_most(values, drag / limits_.drags);
        values.insert(values.begin(), {symbol_of(fujiwara_laplacian), drag});
        add("Δ_F shifts vertices tangentially" + where + ": drift of Δ_F ≥ " + csv_number(limits_.drags) +
                " times that of the others",
            values, holds);
    }

    /// The undecomposed flow ends in a spiky mesh.
    void add_spiky(Laplacian laplacian)
    {
        auto values = last_step(table_, {laplacian}, undecomposed_name, rough);
        const double input = table_.roughness.rms;
        const bool holds = values[0].value > std::max(limits_.spiky, input);
        values.push_back({"input", input});
        for (int step = 1; step <= table_.steps; ++step)
            if (quantity(table_, laplacian, undecomposed_name, step, rough) > limits_.spiky) {
                values.push_back({"first above in step", static_cast<double>(step)});
                break;
            }
        add(symbol_of(laplacian) + " flows into a spiky mesh without decomposition, too: roughness > " +
                csv_number(limits_.spiky) + "° and > that of the input",
            values, holds);
    }

    /// At most as rough as the input, or `times` times as rough.
    void add_smoothed(const std::string& text, const Laplacians& laplacians, std::string_view conditions,
                      double times = 1.0)
    {
        auto values = last_step(table_, laplacians, conditions, rough);
        const bool holds = at_most(values, times * table_.roughness.rms);
        values.push_back({"input", table_.roughness.rms});
        add(text + ": roughness ≤ " + (times == 1.0 ? "" : csv_number(times) + " times ") + "that of the input", values,
            holds);
    }

    /// Rougher than the input by more than the limit for artifacts.
    void add_artifacts(const std::string& text, Laplacian laplacian)
    {
        auto values = last_step(table_, {laplacian}, undecomposed_name, rough);
        const bool holds = values[0].value > limits_.artifacts * table_.roughness.rms;
        values.push_back({"input", table_.roughness.rms});
        add(text + ": roughness > " + csv_number(limits_.artifacts) + " times that of the input", values, holds);
    }

    /// Explains why a claim does not hold, if it does not, and no reason is known yet.
    static void explain(Claim& claim, const std::string& why)
    {
        if (!claim.holds && claim.why.empty())
            claim.why = why;
    }

    void add_authors_last_step(std::string_view conditions);
    void add_authors_numbers();

    const Table& table_;
    const ClaimLimits& limits_;
};

/// The numbers of the authors' own code, to the digits given.
void Claims::add_authors_numbers()
{
    struct Known {
        Laplacian laplacian;
        int step;
        Quantity what;
        double value;
        double half_digit;
    };
    constexpr Known numbers[] = {
        {fujiwara_laplacian, 1, v_mean, 0.037, 5e-4}, {fujiwara_laplacian, 5, v_mean, 0.277, 5e-4},
        {alexa_laplacian, 1, v_mean, 0.0135, 5e-5},   {alexa_laplacian, 5, v_mean, 0.0241, 5e-5},
        {velho_laplacian, 1, v_mean, 0.0109, 5e-5},   {velho_laplacian, 5, v_mean, 0.0299, 5e-5},
        {fujiwara_laplacian, 1, v_max, 0.85, 5e-3},   {fujiwara_laplacian, 5, v_max, 3.66, 5e-3},
        {alexa_laplacian, 1, v_max, 0.233, 5e-4},     {alexa_laplacian, 5, v_max, 0.325, 5e-4},
        {velho_laplacian, 1, v_max, 0.199, 5e-4},     {velho_laplacian, 5, v_max, 0.326, 5e-4},
    };
    std::vector<Measured> values;
    bool holds = true;
    for (const Known& known : numbers) {
        const double value = quantity(table_, known.laplacian, robin_name, known.step, known.what);
        values.push_back({symbol_of(known.laplacian) + (known.what == v_max ? " V_max " : " V_mean ") + "step " +
                              std::to_string(known.step),
                          value});
        holds = holds && std::abs(value - known.value) <= known.half_digit;
    }
    add("the numbers of the authors' code in all their digits", values, holds);
}

void Claims::teaser()
{
    add_smoothed("two levels of detail are smoothed well with decomposition",
                 {fujiwara_laplacian, alexa_laplacian, velho_laplacian}, robin_name);
    add_close("decomposed and undecomposed meshes stay together", {alexa_laplacian, velho_laplacian}, robin_name);
    const std::vector<Measured> values{
        {"with", quantity(table_, fujiwara_laplacian, robin_name, table_.steps, drift)},
        {"without", quantity(table_, fujiwara_laplacian, undecomposed_name, table_.steps, drift)}};
    add("decomposition prevents tangential shifting by Δ_F: drift with decomposition < without", values,
        values[0].value < values[1].value);
    if (table_.is_theirs)
        add_authors_numbers();
}

/// The numbers of the authors' own code after the last step, to the digits given.
void Claims::add_authors_last_step(std::string_view conditions)
{
    std::vector<Measured> values;
    bool holds = true;
    for (const Experiment& experiment : experiments())
        for (const AuthorsDistances& one : experiment.theirs) {
            if (experiment.name != table_.figure ||
                conditions != conditions_of({.cut = CutKind::Halves, .conditions = one.conditions}))
                continue;
            const double mean = quantity(table_, one.laplacian, conditions, table_.steps, v_mean);
            const double largest = quantity(table_, one.laplacian, conditions, table_.steps, v_max);
            values.push_back({symbol_of(one.laplacian) + " V_mean", mean});
            values.push_back({symbol_of(one.laplacian) + " V_max", largest});
            holds = holds && std::abs(mean - one.v_mean) <= 5e-4 && std::abs(largest - one.v_max) <= 5e-3;
        }
    add("the numbers of the authors' code after the last step, V_mean to .001, V_max to .01", values, holds);
}

void Claims::polygons()
{
    add_drag("", {alexa_laplacian, velho_laplacian}, undecomposed_name);
    add_artifacts("Δ_A quickly develops artifacts", alexa_laplacian);
    add_smoothed("Δ_P performs well", {velho_laplacian}, undecomposed_name, limits_.artifacts);
}

void Claims::schwarz_on_polygons()
{
    add_at_most("Schwarz has good outcomes where the interface has small curvature: V_mean", {velho_laplacian},
                schwarz_name, v_mean, limits_.close_vertices);
    add_at_most("the same: H_mean", {velho_laplacian}, schwarz_name, h_mean, limits_.close_surfaces);
}

void Claims::hexagons()
{
    const std::size_t first = made.size();
    add_close("the distances of Δ_F and Δ_P are small", {fujiwara_laplacian, velho_laplacian}, robin_name);
    explain(made[first],
            "The paper gives no number for \"small\". On the authors' own mesh their code ends with V_mean "
            "0.299 for Δ_F and 0.67 for Δ_P.");
    add_spiky(alexa_laplacian);
}

void Claims::triangles()
{
    add_close("the distances of Δ_F and Δ_A are small", {fujiwara_laplacian, alexa_laplacian}, robin_name);
    add_spiky(velho_laplacian);
}

void Claims::wavy_cylinder()
{
    for (const Laplacian laplacian : {fujiwara_laplacian, velho_laplacian}) {
        const double times = laplacian == fujiwara_laplacian ? limits_.delays : limits_.delays_velho;
        const std::vector<Measured> values{{"Schwarz", quantity(table_, laplacian, schwarz_name, table_.steps, v_mean)},
                                           {"Robin", quantity(table_, laplacian, robin_name, table_.steps, v_mean)}};
        add("Schwarz delays the interface, adapted Robin does not, with " + symbol_of(laplacian) +
                ": V_mean of Schwarz ≥ " + csv_number(times) + " times that of Robin",
            values, values[0].value >= times * values[1].value);
    }
    add_at_most("adapted Robin works well: V_mean", {fujiwara_laplacian, velho_laplacian}, robin_name, v_mean,
                limits_.alike);
    add_drag(" without decomposition", {velho_laplacian}, undecomposed_name);
    add_drag(" with decomposition, too", {velho_laplacian}, robin_name);
    if (table_.is_theirs)
        add_authors_last_step(robin_name);
}

void Claims::texture()
{
    add_at_most("with and without decomposition hard to distinguish: V_mean",
                {fujiwara_laplacian, alexa_laplacian, velho_laplacian}, robin_name, v_mean, limits_.alike);
    add_at_most("the tangential derivative (q > 0) can be employed with Δ_F without artifacts: V_mean",
                {fujiwara_laplacian}, ventcell_name, v_mean, limits_.alike);
    add_smoothed("the same", {fujiwara_laplacian}, ventcell_name);
    std::vector<Measured> values;
    bool holds = true;
    for (const Laplacian laplacian : {fujiwara_laplacian, alexa_laplacian, velho_laplacian}) {
        const double with = quantity(table_, laplacian, ventcell_name, table_.steps, interface_length);
        const double without = quantity(table_, laplacian, robin_name, table_.steps, interface_length);
        values.push_back({symbol_of(laplacian) + " with", with});
        values.push_back({"without", without});
        holds = holds && with < without;
    }
    add("the tangential derivative straightens the interface: length with < without", values, holds);
}

/// V_mean of a flow after the last step; NaN if it ended before.
double final_distance(const Table& table, Variant variant, Settings settings)
{
    variant.settings = settings;
    const Row* row = table.find(variant, table.steps);
    return row == nullptr ? std::nan("") : row->v.mean;
}

/// @param others those for which it is false.
Claim counted(const std::string& text, Index count, std::size_t all, const std::vector<std::string>& others)
{
    std::string why;
    for (const std::string& other : others)
        why += (why.empty() ? "Not so: " : "; ") + other;
    return {.figure = std::string(many_sub_meshes),
            .text = text,
            .measured = std::to_string(count) + " of " + std::to_string(all),
            .holds = all > 0 && usize(count) == all,
            .why = why.empty() ? "" : why + "."};
}

}  // namespace

std::vector<Claim> claims_of(const Table& table, const ClaimLimits& limits)
{
    static const std::map<std::string, void (Claims::*)(), std::less<>> makers{
        {"teaser", &Claims::teaser},     {"polygons", &Claims::polygons},   {"schwarz", &Claims::schwarz_on_polygons},
        {"hexagons", &Claims::hexagons}, {"triangles", &Claims::triangles}, {"wavy-cylinder", &Claims::wavy_cylinder},
        {"texture", &Claims::texture},
    };
    Claims claims(table, limits);
    if (const auto maker = makers.find(table.figure); maker != makers.end())
        (claims.*maker->second)();
    return claims.made;
}

std::vector<Claim> claims_of_many(const std::vector<Table>& tables, const ClaimLimits& limits)
{
    std::size_t all = 0;
    Index closer = 0;
    Index close = 0;
    std::vector<std::string> not_closer;
    std::vector<std::string> not_close;
    for (const Table& table : tables)
        for (const Variant& variant : table.flows) {
            // There is nothing to stay close to if the undecomposed flow is no longer a smooth surface.
            const double roughness = quantity(table, variant.laplacian, undecomposed_name, table.steps, rough);
            if (variant.settings != Settings::Default || !(roughness <= limits.spiky))
                continue;
            ++all;
            const double plain = final_distance(table, variant, Settings::Plain);
            const double ours = final_distance(table, variant, Settings::Default);
            const std::string name = table.figure + ", " + symbol_of(variant.laplacian) + ", " +
                                     std::to_string(variant.subdomains) + " sub-meshes: ";
            if (ours <= plain || (std::isnan(plain) && !std::isnan(ours)))
                ++closer;
            else
                not_closer.push_back(listed({{name + "plain", plain}, {"default", ours}}));
            if (ours <= limits.close_vertices)
                ++close;
            else
                not_close.push_back(listed({{name + "V_mean", ours},
                                            {"roughness of the undecomposed flow", roughness},
                                            {"of the input", table.roughness.rms}}));
        }
    return {
        counted("not in the paper: the library's defaults keep as close as the plain method or closer, by V_mean",
                closer, all, not_closer),
        counted("not in the paper: they keep V_mean ≤ " + csv_number(limits.close_vertices), close, all, not_close)};
}

void write_claims(const std::filesystem::path& path, const std::vector<Claim>& claims)
{
    std::string text = "figure,claim,measured,holds,why\n";
    for (const Claim& claim : claims)
        text += csv_text(claim.figure) + "," + csv_text(claim.text) + "," + csv_text(claim.measured) + "," +
                (claim.holds ? "yes," : "no,") + csv_text(claim.why) + "\n";
    write_text(path, text);
}

void print_claims(std::ostream& out, const std::vector<Claim>& claims)
{
    for (const Claim& claim : claims) {
        out << (claim.holds ? "holds          " : "does not hold  ") << claim.figure << ": " << claim.text
            << "\n               " << claim.measured << '\n';
        if (!claim.holds && !claim.why.empty())
            out << "               " << claim.why << '\n';
    }
}

}  // namespace seamflow
