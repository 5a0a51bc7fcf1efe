#pragma once

#include <string_view>

namespace seamflow {

/// The discrete Laplacians Δ (Laplace-de Rham sign: positive semi-definite, the negative of Laplace-Beltrami; unit
/// 1/length²). In the formulas d₀ takes the differences along half-edges, d₁ sums over the half-edges of a face, f_v is
/// the mean over the corners of a face, A combines the two half-edges of an edge, R the half-edges of a face, W₁ has
/// their scalar products over the face's area, and W_V the inverse areas of vertices.
enum class Laplacian {
    /// Δ_F, the scale-dependent umbrella operator of Fujiwara times the valence (paper, eq. 14):
    ///
    /// \f[ (\Delta_F V)_v = \frac{n_v}{\sum_j \|v - v_j\|} \sum_j \frac{v - v_j}{\|v - v_j\|} , \f]
    ///
    /// sums over the n_v edges at v. Positive diagonal times symmetric positive semi-definite. Drags vertices along the
    /// surface on irregular meshes.
    Fujiwara,
    /// Δ_A of Alexa and Wardetzky, the cotan Laplacian on triangles (paper, eq. 15):
    ///
    /// \f[ \Delta_A = W_V\, d_0^\top R\, W_1 R^\top d_0 . \f]
    ///
    /// Positive diagonal times symmetric positive semi-definite.
    AlexaWardetzky,
    /// Δ_B of Bunge, Herholz, Kazhdan and Botsch (Polygon Laplacian Made Simple, 2020): the cotan Laplacian after each
    /// polygon is split into a triangle fan around a virtual vertex, then expressed as a mean of the corners; on
    /// triangles, Δ_A. Positive diagonal times symmetric positive semi-definite, 0 for constants alone: unlike Δ_A, it
    /// grows no spikes on polygons.
    VirtualRefinement,
    /// Δ_P of Ptáčková and Velho (paper, eq. 16):
    ///
    /// \f[ \Delta_P = -W_V\, f_v^\top d_1 A\, W_1 R^\top d_0 . \f]
    ///
    /// Two-ring stencil, not symmetric.
    PtackovaVelho,
    /// Δ_U, with uniform weights: the mean over the edges at v of v - v_j, times 4/h² with one length h for all
    /// vertices (see ScaledLaplacian), the mean edge length of the mesh:
    ///
    /// \f[ (\Delta_U V)_v = \frac{4}{h^2 n_v} \sum_j (v - v_j) . \f]
    ///
    /// Positive diagonal times symmetric positive semi-definite, and the same for any positions. On regular grids of
    /// edges of length h it is the Laplacian of the surface. It ignores the size of triangles, as noise does: features
    /// as narrow as the edges are smoothed alike everywhere. Drags vertices along the surface.
    Uniform,
};

/// A Laplacian with its parameter.
struct ScaledLaplacian {
    ScaledLaplacian(Laplacian laplacian, double edge = 1.0)
        : kind(laplacian)
        , edge_length(edge)
    {
    }
    operator Laplacian() const { return kind; }

    Laplacian kind;
    /// h of Δ_U, in length, above 0; not used by other Laplacians.
    double edge_length;
};

/// The vertices that the row of a vertex reaches.
enum class Reach {
    /// The other ends of its edges.
    Edges,
    /// The vertices of its faces; for triangles, these are the other ends of its edges.
    Faces,
    /// Also the vertices of the faces next to its faces.
    TwoRings,
};

/// The divisors of the coefficients, which must not be 0.
enum class Divisor {
    EdgeLengths,
    FaceAreas,
    /// None: the coefficients do not depend on positions.
    Nothing,
};

/// Properties of a Laplacian for the rest of the library.
struct LaplacianTraits {
    Laplacian laplacian;
    /// In lower case, with hyphens.
    std::string_view name;
    /// The symbol in formulas, such as "Δ_F".
    std::string_view symbol;
    Reach reach;
    Divisor divisor;
    /// Whether the Laplacian is M⁻¹ K (see SymmetricLaplacian).
    bool is_symmetric;
    /// Whether M is a length and K the inverse of one; otherwise M is an area, and K has no unit.
    bool mass_is_length = false;
};

}  // namespace seamflow
