#include "solvers/laplacian/laplacian.h"

#include <array>
#include <utility>

namespace seamflow {

namespace {

constexpr std::array<std::pair<Laplacian, std::string_view>, 3> names{{
    {Laplacian::Fujiwara, "fujiwara"},
    {Laplacian::AlexaWardetzky, "alexa-wardetzky"},
    {Laplacian::PtackovaVelho, "ptackova-velho"},
}};

}  // namespace

std::string_view name_of(Laplacian laplacian)
{
    for (const auto& [value, name] : names)
        if (value == laplacian)
            return name;
    return "unknown";
}

std::optional<Laplacian> laplacian_named(std::string_view name)
{
    for (const auto& [value, known] : names)
        if (known == name)
            return value;
    return std::nullopt;
}

}  // namespace seamflow
