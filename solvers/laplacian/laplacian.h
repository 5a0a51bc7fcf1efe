#pragma once

#include <span>
#include <string>
#include <string_view>

#include "solvers/laplacian/laplacian_kind.h"

namespace seamflow {

/// The traits of all Laplacians.
std::span<const LaplacianTraits> all_laplacian_traits();

/// @throws OptionError for an unknown Laplacian.
const LaplacianTraits& traits_of(Laplacian laplacian);

/// The name, such as "virtual-refinement".
std::string_view name_of(Laplacian laplacian);

/// The names of the Laplacians that are M⁻¹ K, for messages: "fujiwara, alexa-wardetzky, virtual-refinement or
/// uniform".
std::string names_of_symmetric_laplacians();

/// Whether a Laplacian is M⁻¹ K.
bool is_symmetric(Laplacian laplacian);

}  // namespace seamflow
