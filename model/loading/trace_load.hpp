#pragma once
// The load path of one meshing phase (results/load_path.hpp): the contact problem of the chosen points, drive
// and coast, traced from event to event (lcp/path.hpp).
//
// Which points play is found as for a single load (phase_model.hpp): between two events the gap of every
// other point is a straight line in the rotation too, so one that penetrates anywhere does so at an event or
// at the end. Those join, and the path is traced again, until none is missed.

#include "strainwave/model/loading/phase_model.hpp"
#include "strainwave/model/results/load_path.hpp"

namespace strainwave {

/// How the wall and the loads of a path are solved: directly, wall gaps linearised about the assembled cup.
Contact traced_contact(const Contact& of_gear);

/// From rest (or the least rotation asked for, where that lies lower) to the load of the largest rotation;
/// the rated torque where no load is asked for. `model` has a traced_contact(); `exact`: the same teeth with
/// the exact disc gap, for comparison, or null. Failures: contradiction without any load; certificate_failed
/// when path and direct solution of a load differ by more than 1e-9. Throws NotPositiveDefinite.
Outcome<LoadPath> trace_load(const PhaseModel& model, const Load& load, const PhaseModel* exact = nullptr);

} // namespace strainwave
