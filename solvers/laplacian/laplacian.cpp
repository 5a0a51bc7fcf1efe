#include "solvers/laplacian/laplacian.h"

#include <array>

#include "partition/errors.h"

namespace seamflow {

namespace {

constexpr std::array traits{
    LaplacianTraits{Laplacian::Fujiwara, "fujiwara", Reach::Edges, Divisor::EdgeLengths, true},
    LaplacianTraits{Laplacian::AlexaWardetzky, "alexa-wardetzky", Reach::Faces, Divisor::FaceAreas, true},
    LaplacianTraits{Laplacian::PtackovaVelho, "ptackova-velho", Reach::TwoRings, Divisor::FaceAreas, false},
};

}  // namespace

std::span<const LaplacianTraits> all_laplacian_traits()
{
    return traits;
}

const LaplacianTraits& traits_of(Laplacian laplacian)
{
    for (const LaplacianTraits& candidate : traits)
        if (candidate.laplacian == laplacian)
            return candidate;
    throw OptionError("no such Laplacian");
}

std::string_view name_of(Laplacian laplacian)
{
    return traits_of(laplacian).name;
}

std::optional<Laplacian> laplacian_named(std::string_view name)
{
    for (const LaplacianTraits& candidate : traits)
        if (candidate.name == name)
            return candidate.laplacian;
    return std::nullopt;
}

}  // namespace seamflow
