#pragma once
// Responses of the whole ring from one sector: a small problem for each circumferential harmonic.
//
// With displacements u^(j) = (1/N) Σ_h û_h e^{i h j 2π/N} of sector j, the right boundary is the left one
// times e^{iα}, α = 2πh/N, and the condensed sector (condensation.hpp) gives a Hermitian matrix for each
// harmonic:
//
//        K_h = S_ll + S_rr + e^{iα} S_lr + e^{−iα} S_rl     (Olson et al., Appl. Mech. Rev. 66 (2014) 040803)
//
// The sector is its own mirror image in φ → −φ: with Σ = diag(1, −1, 1) on (u_r, u_φ, u_z), S_rr = Σ S_ll Σ
// and S_rl = Σ S_lr Σ. Hence conj(K_h) = Σ K_h Σ, and with D = diag(1, i, 1) the matrix Dᴴ K_h D is *real*:
// one real dense Cholesky factorization a harmonic, a quarter of the complex one's work. Loads become f̂ =
// here + e^{−iα} next, then
//
//        Y = L⁻¹ Dᴴ (f̂_l + e^{−iα} f̂_r)      G_h = f̂ᴴ W f̂ + Yᴴ Y      G(k) = (1/N) Σ_h e^{iαk} G_h
//
// with G_{N−h} = conj(G_h), so only h = 0 … N/2 are solved, in parallel. Every harmonic fills its own place
// and the inverse transform adds them in the order of h: the same bits for any number of threads. The four
// lowest harmonics, in which the cup hardly resists, get G_h from the refined energy of condensation.hpp
// instead of Yᴴ Y.

#include "strainwave/model/flexspline/functionals.hpp"
#include "strainwave/model/flexspline/mesh.hpp"

#include <cstddef>
#include <vector>

namespace strainwave {

/// [offset k][response a][load b] of all functionals, mm/N; see UnitResponses::data. threads 0: as many as
/// cores. Throws NotPositiveStiffness (sparse.hpp) when rounding or the material leaves no positive
/// stiffness, std::logic_error when the sector is not its own mirror image.
std::vector<double> cyclic_responses(const SectorMesh& mesh, const Material& material,
                                     const std::vector<Functional>& functionals, int threads = 0);

} // namespace strainwave
