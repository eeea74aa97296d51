#pragma once
// The loaded pair as the numbers that any solver can read: for checks by other programs, for global solvers
// (bench/shared_flank.py).
//
// HDF5, a group for each meshing phase ("phase_0", …), units in the attribute "units":
//
//     gap(θ) = q − θ r + M z ≥ 0,   z ≥ 0,   zᵀ gap = 0,        torque = lobes · r · z
//
//     compliance   M, mm/N, (points + wall)², points of the teeth first
//     gap          q, mm         lever   r, mm (0 for the wall)
//     tooth, flank_radius, z, contact_radius, backlash, pressure_angle    of the points
//     phase, lobes
//
// Conventions and signs: model/contact/load_problem.hpp. Wall gaps are linearised about the assembled state.

#include "strainwave/model/loading/phase_problem.hpp"

#include <filesystem>
#include <span>
#include <string>

namespace strainwave {

/// Whole or not at all. `config` is the gear file. Throws std::system_error "cannot write PATH".
void write_contact_file(std::span<const PhaseProblem> phases, const std::string& config,
                        const std::filesystem::path& path);

} // namespace strainwave
