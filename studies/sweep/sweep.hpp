#pragma once
// Sweeps: gears whose keys, and loads, run through lists of values.
//
//     kind = "sweep"
//     [[variable]]
//     path = "flexspline.cup_length_mm"           # any number of the gear, or "load_case[0].torque_nm"
//     values = [10.0, 12.5, 15.0]                 # or lower, upper and count
//     [sweep]
//     mode = "factorial"                          # every value with every other; "list": value i of all
//     outputs = ["peak_force_n"]                  # absent: all that the loads give

#include "strainwave/studies/tables/row_kind.hpp"

#include <optional>
#include <string>
#include <vector>

namespace strainwave {

/// `values`, or `lower`, `upper` and `count` (ends included).
struct SweepVariable {
  std::string path; ///< a number of the gear, or load_case[I].torque_nm, load_case[I].rotation_rad
  std::vector<double> values;
  std::optional<double> lower;
  std::optional<double> upper;
  std::optional<int> count;
  std::optional<VariableLink> link;
};

std::vector<double> sweep_values(const SweepVariable& variable);

enum class SweepMode {
  factorial, ///< every value with every other; the last variable moves fastest
  list       ///< value i of all variables together
};

struct StudySweep {
  SweepMode mode = SweepMode::factorial;
  std::vector<std::string> outputs; ///< empty: all that the loads give
};

struct SweepPart : StudyPart {
  std::vector<SweepVariable> variables; ///< never empty
  StudySweep sweep;
  std::unique_ptr<StudyPart> copy() const override { return std::make_unique<SweepPart>(*this); }
};

const RowKind& sweep_kind();

Outcome<SampledStudy> make_sweep_rows(const StudyFile& study, const RunContext& context);

} // namespace strainwave
