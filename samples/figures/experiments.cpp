#include "samples/figures/experiments.h"

#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "samples/figures/measured.h"
#include "samples/figures/surfaces.h"

namespace seamflow {

namespace {

constexpr Laplacian fujiwara = Laplacian::Fujiwara;
constexpr Laplacian alexa = Laplacian::AlexaWardetzky;
constexpr Laplacian velho = Laplacian::PtackovaVelho;
constexpr Conditions robin = Conditions::AdaptedRobin;
constexpr Conditions ventcell = Conditions::AdaptedVentcell;
constexpr Conditions schwarz = Conditions::Schwarz;
constexpr std::array all_laplacians{fujiwara, alexa, velho};
const double unknown = std::numeric_limits<double>::quiet_NaN();

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
            variants.push_back({.laplacian = laplacian, .cut = CutKind::Halves, .conditions = conditions});
    return variants;
}

std::string alone(Laplacian laplacian)
{
    return title_of({.laplacian = laplacian});
}

std::string halves(Laplacian laplacian, Conditions conditions = robin)
{
    return title_of({.laplacian = laplacian, .cut = CutKind::Halves, .conditions = conditions});
}

const std::string input_picture(picture_of::input);
const std::string cut_picture(picture_of::cut);
const std::string part_picture(picture_of::part);

Experiment teaser()
{
    return {.name = "teaser",
            .figure = 1,
            .heading = "Two levels of detail",
            .text = "The upper part of the mesh is twice as fine as the lower one, and the seam between them a curved "
                    "line. The paper: all three Laplacians smooth it well with decomposition, and the decomposition "
                    "prevents the tangential shifting that Δ_F shows without it.",
            .source = {.file = "quad_cili_7280_23_65.obj",
                       .authors = AuthorsRun{.first_part = 1430, .p = 6.2993055940947205, .uncorrected = true},
                       .generate = bulging_two_level_cylinder,
                       .vertices = 7280,
                       .axis = 2},
            .time_step = 0.05,
            .steps = 5,
            .variants = in_halves(all_laplacians, {robin}),
            .pictures = {{input_picture, halves(alexa), halves(velho), halves(fujiwara), alone(fujiwara)}},
            .theirs = {{fujiwara, robin, 0.277, 3.66}, {alexa, robin, 0.024, 0.325}, {velho, robin, 0.030, 0.326}},
            .difference = "They do not correct Γ in this figure, and neither is it corrected here on their mesh."};
}

Experiment polygons()
{
    return {.name = "polygons",
            .figure = 2,
            .heading = "Bumps on general polygons",
            .text = "One step without decomposition. The paper: Δ_F shifts vertices along the surface and deforms the "
                    "texture, Δ_A quickly develops artifacts, Δ_P does better.",
            .source = {.file = "poly_F_tex_6558.obj", .authors = {}, .generate = polygons_with_bumps, .vertices = 6558},
            .time_step = 0.01,
            .steps = 1,
            .variants = undecomposed(all_laplacians),
            .pictures = {{input_picture, alone(fujiwara), alone(alexa), alone(velho)}},
            .theirs = {},
            .difference = {}};
}

/// Cut like the authors' own two files of its sub-meshes: the lower one has 1,609 faces, the upper one overlaps it.
Experiment schwarz_on_polygons()
{
    return {.name = "schwarz",
            .figure = 5,
            .heading = "Alternating Schwarz on general polygons",
            .text = "Two sub-meshes that overlap by a layer of faces. The paper: where the interface has small "
                    "curvature, the alternating Schwarz method has good outcomes.",
            .source = {.file = "poly_C1_scaled_6558.obj",
                       .authors = AuthorsRun{.first_part = 1609, .p = {}},
                       .generate = polygons_with_hill_and_hollow,
                       .vertices = 6558},
            .time_step = 0.05,
            .steps = 2,
            .variants = in_halves(std::array{velho}, {schwarz}),
            .pictures = {{input_picture, cut_picture}, {alone(velho), halves(velho, schwarz)}},
            .theirs = {},
            .difference = {}};
}

Experiment hexagons()
{
    return {
        .name = "hexagons",
        .figure = 7,
        .heading = "A mesh of hexagons",
        .text = "Distances between the decomposed and the undecomposed flow, step by step. The paper: they are small "
                "but for Δ_A, which flows into a spiky mesh without decomposition, too, from step 5 on.",
        .source = {.file = "hex_F_tex_6118_102.obj",
                   .authors = AuthorsRun{.first_part = 1427, .p = 54.2606704480561},
                   .generate = hexagons_with_bumps,
                   .vertices = 6118},
        .time_step = 0.01,
        .steps = 10,
        .variants = in_halves(all_laplacians, {robin}),
        .pictures = {{input_picture, alone(fujiwara), alone(alexa), alone(velho)},
                     {cut_picture, halves(fujiwara), halves(alexa), halves(velho)}},
        .theirs = {{fujiwara, robin, 0.299, 1.93}, {alexa, robin, 1.82, 34.0}, {velho, robin, 0.67, 3.7}},
        .difference = "Their correction of Γ takes other neighbours than edge neighbours on hexagons: from the second "
                      "step on their flow is another."};
}

Experiment triangles()
{
    return {.name = "triangles",
            .figure = 8,
            .heading = "A mesh of triangles",
            .text =
                "Distances between the decomposed and the undecomposed flow, step by step. The paper: they are small "
                "for Δ_F and Δ_A; Δ_P flows into a spiky mesh without decomposition, too, from step 3 on.",
            .source = {.file = "tri_Shrek_3721.obj",
                       .authors = AuthorsRun{.first_part = 3600, .p = 17.270984261742612},
                       .generate = triangles_with_bumps,
                       .vertices = 3721},
            .time_step = 0.05,
            .steps = 10,
            .variants = in_halves(all_laplacians, {robin}),
            .pictures = {{input_picture, alone(fujiwara), alone(alexa), alone(velho)},
                         {cut_picture, halves(fujiwara), halves(alexa), halves(velho)}},
            .theirs = {{fujiwara, robin, 0.167, 0.55}, {alexa, robin, 0.111, 0.65}, {velho, robin, 0.85, 29.0}},
            .difference = "Their correction of Γ takes other neighbours than edge neighbours on triangles: from the "
                          "second step on their flow is another."};
}

Experiment wavy_tube()
{
    return {
        .name = "wavy-cylinder",
        .figure = 9,
        .heading = "An interface on a peak",
        .text = "The two sub-meshes meet where the tube is widest. The paper: with the alternating Schwarz method the "
                "vertices on the interface move much slower than the others, with the adapted Robin conditions they "
                "do not.",
        .source = {.file = "quad_cilinder_wavy_10200_120.obj",
                   .authors = AuthorsRun{.first_part = 5040, .p = 8.68135640790926},
                   .generate = wavy_cylinder,
                   .vertices = 10'200,
                   .axis = 2},
        .time_step = 0.05,
        .steps = 5,
        .variants = in_halves(std::array{fujiwara, velho}, {robin, schwarz}),
        .pictures = {{input_picture, halves(fujiwara), halves(velho), halves(fujiwara, schwarz),
                      halves(velho, schwarz)}},
        .theirs = {{fujiwara, robin, 0.011, 0.20},
                   {velho, robin, 0.028, 0.30},
                   {fujiwara, schwarz, 0.201, unknown},
                   {velho, schwarz, 0.237, unknown}},
        .difference = "Their Schwarz method uses values of the overlap from the step before, from the second step on."};
}

Experiment texture()
{
    std::vector<Variant> variants = in_halves(all_laplacians, {robin, ventcell});
    return {.name = "texture",
            .figure = 10,
            .heading = "The texture, with and without decomposition",
            .text =
                "One step. The paper: with appropriate conditions on the interface it is hard to distinguish the "
                "decomposed from the undecomposed flow. On meshes like grids, as here, the tangential derivative of "
                "the Ventcell conditions (q > 0), which straightens the curve of the interface, can be used with Δ_F "
                "without introducing artifacts.",
            .source = {.file = "quad_F_tex_wavy_3721.obj",
                       .authors = AuthorsRun{.first_part = 2520, .p = 29.777021258217662},
                       .generate = quads_with_bumps,
                       .vertices = 3721},
            .time_step = 0.05,
            .steps = 1,
            .variants = std::move(variants),
            .pictures = {{input_picture, alone(fujiwara), alone(alexa), alone(velho)},
                         {part_picture, halves(fujiwara), halves(alexa), halves(velho)},
                         {cut_picture, halves(fujiwara, ventcell), halves(alexa, ventcell), halves(velho, ventcell)}},
            .theirs = {},
            .difference = {}};
}

/// The authors' options on their own mesh, and the cut.
void cut_in_two(FlowOptions& options, const FigureMesh& mesh)
{
    options.cut.labels = mesh.labels;
    if (!mesh.authors || options.interface.conditions == schwarz)
        return;
    options.interface.p = mesh.authors->p;
    if (!mesh.authors->uncorrected)
        return;
    options.interface.colouring = Colouring::Label;
    options.interface.correction = Correction::None;
}

/// The command line of a flow of the paper, relative to --plain.
std::string plain_arguments(const FlowOptions& options)
{
    std::string text = " --plain";
    if (options.interface.conditions != robin)
        text += fmt::format(" --conditions {}", option_name(options.interface.conditions));
    if (options.interface.p)
        text += fmt::format(" --p {}", *options.interface.p);
    if (options.interface.q)
        text += fmt::format(" --q {}", *options.interface.q);
    if (options.interface.colouring == Colouring::Label)
        text += " --coloring label";
    if (options.interface.correction == Correction::None)
        text += " --no-correction";
    return text;
}

}  // namespace

const std::vector<Experiment>& experiments()
{
    static const std::vector<Experiment> all{teaser(),    polygons(), schwarz_on_polygons(), hexagons(), triangles(),
                                             wavy_tube(), texture()};
    return all;
}

Experiment with_many_sub_meshes(const Experiment& experiment)
{
    Experiment many = experiment;
    many.pictures.clear();
    std::erase_if(many.variants, [](const Variant& variant) { return variant.cut != CutKind::Uncut; });
    for (const Variant& variant : experiment.variants) {
        if (variant.cut != CutKind::Halves || variant.conditions == ventcell)
            continue;
        for (const int subdomains : {2, 4, 8, 16, 32})
            for (const Settings settings : {Settings::Plain, Settings::Default})
                if (settings == Settings::Plain || variant.conditions == robin)
                    many.variants.push_back({.laplacian = variant.laplacian,
                                             .cut = CutKind::Metis,
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
    // All that the paper shows is shown, spikes included.
    options.accuracy.largest_update = std::numeric_limits<double>::infinity();
    if (variant.settings == Settings::Plain && variant.cut != CutKind::Uncut) {
        options.interface.conditions = variant.conditions;
        if (variant.conditions == ventcell)
            options.interface.q = ventcell_q;
    }
    options.cut.subdomains = variant.cut == CutKind::Metis ? variant.subdomains : 1;
    if (variant.cut == CutKind::Halves)
        cut_in_two(options, mesh);
    return options;
}

std::string command_of(const Experiment& experiment, const Variant& variant, const FigureMesh& mesh)
{
    const FlowOptions options = options_of(experiment, variant, mesh);
    const std::string cut = variant.cut == CutKind::Halves ? fmt::format("--labels {}-cut.txt", experiment.name)
                                                           : fmt::format("--subdomains {}", options.cut.subdomains);
    return fmt::format("smooth {}-input.ply out.ply --laplacian {} --time-step {} --steps {} {}{}", experiment.name,
                       name_of(options.laplacian), options.time_step, options.steps, cut,
                       variant.settings == Settings::Plain ? plain_arguments(options) : "");
}

}  // namespace seamflow
