#pragma once

#include <optional>
#include <string_view>

namespace seamflow {

/// The discrete Laplacians Δ (Laplace-de Rham sign: positive semi-definite, the negative of Laplace-Beltrami; unit
/// 1/length²).
enum class Laplacian {
    /// Δ_F, the scale-dependent umbrella operator of Fujiwara times the valence (paper, eq. umbrellaLaplace). Positive
    /// diagonal times symmetric positive semi-definite. Drags vertices along the surface on irregular meshes.
    Fujiwara,
    /// Δ_A of Alexa and Wardetzky, the cotan Laplacian on triangles (paper, eq. AWLaplace). Positive diagonal times
    /// symmetric positive semi-definite.
    AlexaWardetzky,
    /// Δ_P of Ptáčková and Velho (paper, eq. PVLaplace). Two-ring stencil, not symmetric.
    PtackovaVelho,
};

/// "fujiwara", "alexa-wardetzky" or "ptackova-velho".
std::string_view name_of(Laplacian laplacian);

/// The Laplacian of that name, if there is one.
std::optional<Laplacian> laplacian_named(std::string_view name);

}  // namespace seamflow
