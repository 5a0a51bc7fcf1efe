#include "solvers/laplacian/laplacian.h"

#include <array>

#include "partition/errors.h"
#include "solvers/laplacian/kernels.h"

namespace seamflow {

namespace {

constexpr std::array all_traits{Fujiwara::traits, AlexaWardetzky::traits, PtackovaVelho::traits};

}  // namespace

std::span<const LaplacianTraits> all_laplacian_traits()
{
    return all_traits;
}

const LaplacianTraits& traits_of(Laplacian laplacian)
{
    for (const LaplacianTraits& candidate : all_traits)
        if (candidate.laplacian == laplacian)
            return candidate;
    throw OptionError("no such Laplacian");
}

std::string_view name_of(Laplacian laplacian)
{
    return traits_of(laplacian).name;
}

bool is_symmetric(Laplacian laplacian)
{
    return traits_of(laplacian).is_symmetric;
}

}  // namespace seamflow
