#include "solvers/laplacian/laplacian.h"

#include <array>
#include <tuple>

#include "partition/errors.h"
#include "solvers/laplacian/kernels.h"

namespace seamflow {

namespace {

template <class... Kernel>
constexpr std::array<LaplacianTraits, sizeof...(Kernel)> traits_of_all(const std::tuple<Kernel...>*)
{
    return {Kernel::traits...};
}

constexpr std::array all_traits = traits_of_all(static_cast<const Kernels*>(nullptr));

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

std::string names_of_symmetric_laplacians()
{
    std::string names;
    std::string_view last;
    for (const LaplacianTraits& traits : all_traits)
        if (traits.is_symmetric) {
            if (!last.empty())
                names.append(names.empty() ? "" : ", ").append(last);
            last = traits.name;
        }
    return names.append(names.empty() ? "" : " or ").append(last);
}

bool is_symmetric(Laplacian laplacian)
{
    return traits_of(laplacian).is_symmetric;
}

}  // namespace seamflow
