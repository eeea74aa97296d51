#pragma once
// How a contact state answers small changes of what it stands on, its closed teeth and wall stations staying
// closed.
//
// At each closed station n is the contact normal, τ = (−n_c, n_r) the tangent (components: radial,
// circumferential). The force change has a part dλ along n and a part f along τ, because the normal turns: dn
// = ν τ, f = λ ν. On a curved rigid surface the normal also turns with the displacement, ν = ν₀ + κ τ·du (κ:
// curvature of the surface of equal gap, 1/distance from a disc's centre), which makes the geometric
// stiffness σ = λ κ. With G the free cup's compliance (teeth t, stations n and τ):
//
//     du_n = G_nn dλ + G_nτ f − G_nt dF + v_n          0 = du_n + dg
//     du_τ = G_τn dλ + G_ττ f − G_τt dF + v_τ          f = σ du_τ + f₀
//     0 = t + G_tt dF − G_tn dλ − G_tτ f − r dθ          r · dF = m      (or dθ = 0)
//
// v: displacement of the wall, t: change of the teeth's gaps, dg: change of the wall's gap, f₀ = λ ν₀, m:
// torque's own change, all with the forces held. M = [G_tt −G_tn; −G_nt G_nn] is factorized once; f is found
// by repeated substitution, which contracts by σ‖G‖ (some 1e-3: a force of 10 N turns by 1 µm/13 mm), or by a
// full solve should it ever not contract.

#include <Eigen/Dense>

namespace strainwave {

/// Compliances of the closed points, mm/N; stations come as a block along n and a block along τ.
struct ClosedCompliance {
  Eigen::MatrixXd wall_wall;   ///< 2W × 2W
  Eigen::MatrixXd wall_tooth;  ///< 2W × T, tooth loads along their functionals
  Eigen::MatrixXd tooth_tooth; ///< T × T
};

/// One column for each change.
struct StateChange {
  Eigen::MatrixXd wall_displacement; ///< v, 2W lines, mm
  Eigen::MatrixXd wall_gap;          ///< dg, W
  Eigen::MatrixXd wall_turn_force;   ///< f₀, W, N
  Eigen::MatrixXd tooth_gap;         ///< t, T
  Eigen::RowVectorXd torque;         ///< m, N·mm; ignored where the rotation is held
};

struct StateAnswer {
  Eigen::MatrixXd tooth_force;  ///< dF, T
  Eigen::MatrixXd wall_normal;  ///< dλ, W
  Eigen::MatrixXd wall_tangent; ///< f, W
  Eigen::RowVectorXd rotation;  ///< dθ
};

class ContactTangent {
public:
  /// r: lever arms of the teeth (T), signed; stiffness: σ of the stations (W), N/mm.
  ContactTangent(ClosedCompliance compliance, Eigen::VectorXd r, Eigen::VectorXd stiffness);

  enum class Held { rotation, torque };
  StateAnswer solve(const StateChange& change, Held held) const;

  /// M⁻¹ (r, 0): forces per rotation without geometric stiffness; teeth first, then stations. N/rad.
  const Eigen::VectorXd& rate() const { return rate_; }

private:
  StateAnswer from_turn(const StateChange& change, const Eigen::MatrixXd& turn, Held held) const;
  Eigen::MatrixXd tangential(const StateChange& change, const StateAnswer& answer) const;

  ClosedCompliance g_;
  Eigen::VectorXd r_, stiffness_;
  Eigen::Index teeth_, stations_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd rate_;
};

} // namespace strainwave
