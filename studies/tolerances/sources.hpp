#pragma once
// The sources of a tolerance study as numbers of a row: where each source's numbers stand, how they are
// drawn, and the one named number by which results and correlations know each source.
//
// A row holds first all numbers of tolerance/tolerance_model.hpp, then those of the wave generator and the
// loads. Of a source that is an amplitude A and a phase, A has the study's distribution and the phase is
// uniform over a turn; of errors of single teeth every tooth has it by itself; x and y of a centre offset
// too.
//
//     kind                              named number
//     one number                        itself
//     cumulative_pitch, run_out, ovality   the amplitude A
//     centre_offset                     the distance √(x² + y²)
//     adjacent_pitch, backlash_noise    the root mean square over the teeth

#include "strainwave/common/sampling/sources.hpp"
#include "strainwave/model/tolerance/tolerance_source.hpp"
#include "strainwave/studies/tolerances/uncertain.hpp"

#include <string>
#include <vector>

namespace strainwave {

/// What a source moves.
enum class SourceRole { flank, radial_deformation, eccentricity, torque };

class SampledSources {
public:
  /// Throws FieldError for keys that cannot be a source of samples.
  explicit SampledSources(const StudyFile& study);

  struct Source {
    std::string name;
    SourceRole role = SourceRole::flank;
    ToleranceSource tolerance; ///< of role flank
    std::size_t load_case = 0; ///< of role torque
    std::size_t first = 0;     ///< its numbers in a row
    std::size_t count = 1;
    std::string unit; ///< of its named number, as HDF5 is told
    Distribution distribution;
    double mean = 0.0, std = 0.0; ///< of its distribution
    bool one_number() const { return count == 1; }
  };

  std::size_t dimensions() const { return dimensions_; }
  std::size_t flank_dimensions() const { return flank_dimensions_; }
  const std::vector<Source>& sources() const { return sources_; } ///< in the study's order
  /// Those of role flank in the order of their numbers: what ToleranceModel is made with.
  std::vector<ToleranceSource> flank_sources() const;
  const Source* find(SourceRole role, std::size_t load_case = 0) const;

  /// In place: uniforms of a row become its numbers, in the units of the study file (µm, rad, the key's own).
  void transform(std::span<double> row) const { values_->transform(row); }
  /// The row in which every source is at its mean and every error of a tooth at the mean of its distribution.
  std::vector<double> mean_row() const;
  void named_values(std::span<const double> row, std::span<double> named) const;

private:
  void place(const StudyFile& study);
  void draw(const StudyFile& study);
  std::vector<Source> sources_;
  std::size_t dimensions_ = 0, flank_dimensions_ = 0;
  std::optional<SourceValues> values_;
};

} // namespace strainwave
