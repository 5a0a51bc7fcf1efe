#include "samples/figures/experiment.h"

#include "engine/options/option_names.h"

namespace seamflow {

std::string conditions_of(const Variant& variant)
{
    if (variant.cut == CutKind::Uncut)
        return "undecomposed";
    return std::string(option_name(variant.conditions));
}

std::string_view name_of(Settings settings)
{
    return settings == Settings::Plain ? "plain" : "default";
}

std::string title_of(const Variant& variant)
{
    std::string text(name_of(variant.laplacian));
    text.append("-").append(conditions_of(variant));
    if (variant.cut == CutKind::Metis)
        text.append("-").append(std::to_string(variant.subdomains)).append("-").append(name_of(variant.settings));
    return text;
}

std::string words_of(const Variant& variant)
{
    const std::string symbol(traits_of(variant.laplacian).symbol);
    if (variant.cut == CutKind::Uncut)
        return symbol + ", undecomposed";
    const std::string parts = variant.cut == CutKind::Halves ? "two" : std::to_string(variant.subdomains);
    std::string conditions = "adapted Robin";
    if (variant.conditions == Conditions::Schwarz)
        conditions = "Schwarz";
    if (variant.conditions == Conditions::AdaptedVentcell)
        conditions = "adapted Ventcell";
    if (variant.settings == Settings::Default)
        conditions = "the library's defaults";
    return symbol + " in " + parts + " sub-meshes, " + conditions;
}

}  // namespace seamflow
