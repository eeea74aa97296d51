#pragma once
// Sensitivity: which source makes which share of an output's spread.
//
//     kind = "sensitivity"
//     [[source]] …                                # uncertain.hpp
//     [sensitivity]
//     method = "sobol"
//     samples = 1024                              # blocks (sobol) or trajectories (morris)

#include "strainwave/studies/tables/row_kind.hpp"
#include "strainwave/studies/tolerances/uncertain.hpp"

namespace strainwave {

enum class SensitivityMethod { sobol, morris, local };

struct StudySensitivity {
  SensitivityMethod method = SensitivityMethod::sobol;
  int samples = 1024; ///< blocks of (sources + 2) rows, or trajectories of (sources + 1) rows
  int positions = 1;
  int levels = 4; ///< morris: levels of each source
  std::vector<std::string> outputs;
};

struct SensitivityPart : UncertainPart {
  StudySensitivity sensitivity;
  std::unique_ptr<StudyPart> copy() const override { return std::make_unique<SensitivityPart>(*this); }
};

const RowKind& sensitivity_kind();

Outcome<SampledStudy> make_sensitivity_rows(const StudyFile& study, const RunContext& context);

} // namespace strainwave
