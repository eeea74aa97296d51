#pragma once
// What a study will cost, from a few evaluations of it: asked before a night is spent on it.

#include "strainwave/studies/tables/run.hpp"

namespace strainwave {

struct PilotEstimate {
  std::uint64_t evaluations = 0; ///< rows, or the budget of a search
  std::uint64_t cups = 0;        ///< finite-element solutions among them; 0: not counted beforehand
  int threads = 1;
  int tried = 0;          ///< evaluations of the pilot
  double prepare_s = 0.0; ///< before the first row
  double first_s = 0.0;   ///< an evaluation that has to solve its cup
  double each_s = 0.0;    ///< any other one
  double seconds = 0.0;   ///< of the whole study
  double journal_bytes = 0.0, results_bytes = 0.0, memory_bytes = 0.0;
  std::vector<std::string> failures; ///< sentences of evaluations of the pilot that failed
};

/// Throws FieldError, std::system_error. Failure: the gear has no result.
/// No cup comes from the cache: what it costs is asked.
Outcome<PilotEstimate> pilot(const StudyFile& study, RunContext context);

} // namespace strainwave
