#pragma once
// The contact forces behind a forward result, phase 0, drive direction: for field solutions on the whole cup,
// decks and pictures. The coast direction is the mirror image φ → −φ.
//
// `forces` is complete for the whole ring: every force as a multiple of one functional of the unit responses
// (unit_responses.hpp) on one sector, both lobes, rows and contact heights already shared out. Loading a cup
// with these functionals must give back the displacements that the contact problem worked with.

#include "strainwave/model/contact/load_problem.hpp"
#include "strainwave/model/flexspline/responses.hpp"

#include <string>
#include <vector>

namespace strainwave {

/// N along functional `functional` (its place in UnitResponses) of sector 0 … sectors − 1.
struct FunctionalForce {
  int sector = 0;
  int functional = 0;
  double force_n = 0.0;
};

/// One place where the wall may touch the wave generator. Directions: outwards, towards larger φ.
struct WallContact {
  WallStation station;
  std::vector<FunctionalForce>
      average; ///< weights (in force_n) whose measurement is the station's circumferential
               ///< displacement; functional + 1 measures the radial one
  double radial_n = 0.0, circumferential_n = 0.0;   ///< on the flexspline
  double radial_mm = 0.0, circumferential_mm = 0.0; ///< displacement
};

struct ToothContact {
  LoadedPoint tooth;
  double force_n = 0.0;
};

/// The cup in one state. Wall and teeth are those of one lobe when both are alike, else of the whole ring.
struct ContactForces {
  std::string name; ///< "assembled", "loaded_7Nm", "loaded_0.00338rad"
  double torque_nm = 0.0;
  double rotation_rad = 0.0;
  std::vector<FunctionalForce> forces;
  std::vector<WallContact> wall;
  std::vector<ToothContact> teeth;
};

/// The assembled state first, then one state for each load of the gear.
struct ContactStates {
  ResponseRequest request; ///< of the cup that the forces belong to
  std::vector<ContactForces> states;
  std::vector<std::string> warnings;
};

/// Assembled: wall_force are the assembly's own forces and there are no teeth. tooth_force: one for each
/// tooth, N.
ContactForces contact_forces(std::string name, const RingCompliance& ring, const AssembledState& assembled,
                             const Eigen::MatrixX2d& wall_force, const std::vector<LoadedPoint>& teeth,
                             const std::vector<double>& tooth_force);

} // namespace strainwave
