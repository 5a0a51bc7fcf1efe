#include "samples/figures/experiment.h"

#include <array>
#include <limits>

#include "samples/figures/surfaces.h"

namespace seamflow {

namespace {

constexpr std::array all_laplacians{Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::PtackovaVelho};

/// A flow without decomposition for each Laplacian.
std::vector<Variant> undecomposed(std::span<const Laplacian> laplacians)
{
    std::vector<Variant> variants;
    for (const Laplacian laplacian : laplacians)
        variants.push_back({.laplacian = laplacian});
    return variants;
}

/// For each Laplacian the reference, and a flow in two halves for each of the conditions.
std::vector<Variant> in_halves(std::span<const Laplacian> laplacians, std::initializer_list<Conditions> all_conditions)
{
    std::vector<Variant> variants = undecomposed(laplacians);
    for (const Conditions conditions : all_conditions)
        for (const Laplacian laplacian : laplacians)
            variants.push_back({.laplacian = laplacian, .pieces = Pieces::Halves, .conditions = conditions});
    return variants;
}

FigureSource teaser_source()
{
    return {.file = "quad_cili_7280_23_65.obj",
            .authors = AuthorsRun{.faces = 7150, .first_part = 1430, .p = 6.2993055940947205},
            .generate = bulging_two_level_cylinder,
            .vertices = 7280,
            .axis = 2};
}

/// Cut as the authors' own two files of its sub-meshes are: the lower one has 1,609 faces, the upper one overlaps it.
FigureSource schwarz_source()
{
    return {.file = "poly_C1_scaled_6558.obj",
            .authors = AuthorsRun{.faces = 3221, .first_part = 1609, .p = {}},
            .generate = polygons_with_hill_and_hollow,
            .vertices = 6558};
}

FigureSource source(std::string_view file, PolygonMesh (*generate)(Index), Index vertices, Eigen::Index axis = 1)
{
    return {.file = file, .authors = {}, .generate = generate, .vertices = vertices, .axis = axis};
}

std::vector<Experiment> make_experiments()
{
    constexpr Conditions robin = Conditions::AdaptedRobin;
    constexpr Conditions schwarz = Conditions::Schwarz;
    constexpr std::array velho{Laplacian::PtackovaVelho};
    constexpr std::array fujiwara_and_velho{Laplacian::Fujiwara, Laplacian::PtackovaVelho};
    return {
        {"teaser", teaser_source(), 0.05, 5, in_halves(all_laplacians, {robin})},
        {"polygons", source("poly_F_tex_6558.obj", polygons_with_bumps, 6558), 0.01, 1, undecomposed(all_laplacians)},
        {"schwarz", schwarz_source(), 0.05, 2, in_halves(velho, {schwarz})},
        {"hexagons", source("hex_F_tex_6118_102.obj", hexagons_with_bumps, 6118), 0.01, 10,
         in_halves(all_laplacians, {robin})},
        {"triangles", source("tri_Shrek_3721.obj", triangles_with_bumps, 3721), 0.05, 10,
         in_halves(all_laplacians, {robin})},
        {"wavy-cylinder", source("quad_cilinder_wavy_10200_120.obj", wavy_cylinder, 10'200, 2), 0.05, 5,
         in_halves(fujiwara_and_velho, {robin, schwarz})},
        {"texture", source("quad_F_tex_wavy_3721.obj", quads_with_bumps, 3721), 0.05, 1,
         in_halves(all_laplacians, {robin})},
    };
}

/// The options that stand for the paper's text on a mesh cut in two, or for what the authors did.
void cut_in_two(FlowOptions& options, const FigureMesh& mesh)
{
    options.labels = mesh.labels;
    if (!mesh.authors || !mesh.authors->p || options.conditions != Conditions::AdaptedRobin)
        return;
    options.coloring = Coloring::Label;
    options.p = mesh.authors->p;
    options.correction = Correction::None;
}

}  // namespace

std::string conditions_of(const Variant& variant)
{
    if (variant.pieces == Pieces::One)
        return "undecomposed";
    return variant.conditions == Conditions::Schwarz ? "schwarz" : "adapted-robin";
}

std::string_view name_of(Settings settings)
{
    return settings == Settings::Plain ? "plain" : "default";
}

const std::vector<Experiment>& experiments()
{
    static const std::vector<Experiment> all = make_experiments();
    return all;
}

Experiment with_many_sub_meshes(const Experiment& experiment)
{
    Experiment many = experiment;
    std::erase_if(many.variants, [](const Variant& variant) { return variant.pieces != Pieces::One; });
    for (const Variant& variant : experiment.variants)
        for (const int subdomains : {2, 4, 8, 16, 32})
            for (const Settings settings : {Settings::Plain, Settings::Default}) {
                const bool robin = variant.conditions == Conditions::AdaptedRobin;
                if (variant.pieces == Pieces::Halves && (settings == Settings::Plain || robin))
                    many.variants.push_back({.laplacian = variant.laplacian,
                                             .pieces = Pieces::Metis,
                                             .subdomains = subdomains,
                                             .conditions = variant.conditions,
                                             .settings = settings});
            }
    return many;
}

FlowOptions options_of(const Experiment& experiment, const Variant& variant, const FigureMesh& mesh)
{
    FlowOptions options = variant.settings == Settings::Plain ? FlowOptions::plain() : FlowOptions{};
    options.laplacian = variant.laplacian;
    options.time_step = experiment.time_step;
    options.steps = experiment.steps;
    // What the paper shows is shown, spikes included.
    options.largest_update = std::numeric_limits<double>::infinity();
    if (variant.settings == Settings::Plain)
        options.conditions = variant.conditions;
    options.subdomains = variant.pieces == Pieces::Metis ? variant.subdomains : 1;
    if (variant.pieces == Pieces::Halves)
        cut_in_two(options, mesh);
    return options;
}

}  // namespace seamflow
