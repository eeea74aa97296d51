#pragma once
// Rows of a gear with errors: one nominal mesh, whole ring, and for every row its own gaps, lever arms, discs
// and loads.
//
//     numbers of the row → errors of all teeth (tolerance_model.hpp) → c_i, R_i → contact
//     (sampled_contact.hpp) → outputs
//
// A row is one position of the wave generator, or with `positions` = N the worst of N positions q = ⌊j z1/N⌋,
// j = 0 … N − 1: of each output its worst value (largest force, least stiffness), over positions and load
// cases.
//
// c_i and R_i follow the errors by first derivatives of the direct geometry. With u0 or e among the sources
// the poses change by more than that: they are interpolated (disc_surface.hpp), moved by the errors, and the
// flanks of all teeth that are near contact are searched directly. Outside the box of the interpolant the
// row's discs are assembled.
//
// Only drive flanks carry. Where interference, or a thick tooth, would bring a coast flank into contact under
// load the row has no result: status coast_contact.

#include "strainwave/model/forward/ring_pair.hpp"
#include "strainwave/model/lcp/sampled_contact.hpp"
#include "strainwave/model/tolerance/tolerance_model.hpp"
#include "strainwave/studies/results/row_status.hpp"
#include "strainwave/studies/tables/row_study.hpp"
#include "strainwave/studies/tolerances/disc_surface.hpp"
#include "strainwave/studies/tolerances/outputs.hpp"
#include "strainwave/studies/tolerances/sources.hpp"

namespace strainwave {

/// Beside the status of row_status.hpp.
inline constexpr std::uint8_t row_coast_contact = row_no_value + 1;

/// One load case of the nominal gear.
struct SampledLoad {
  Control control = Control::torque;
  double value = 0.0; ///< N·m or rad
  LoadTangent tangent;
  SampledContact contact;
};

class SampledGear : public RowModel {
public:
  /// Throws FieldError for loads and keys that rows of samples do not have. `outputs`: names, empty for all.
  static Outcome<std::shared_ptr<const SampledGear>> make(const StudyFile& study,
                                                          const std::vector<std::string>& outputs,
                                                          int positions, const RunContext& context);

  std::size_t inputs() const override { return sources_.dimensions(); }
  std::size_t outputs() const override { return wanted_.size(); }
  std::string_view status_name(std::uint8_t status) const override;
  std::unique_ptr<RowWorker> worker() const override;

  /// Everything about one row as a JSON object: the numbers of all sources, and for every position and load
  /// the gap, lever arm and force of every tooth.
  std::string describe(std::uint64_t row, std::span<const double> values) const;

  static std::vector<std::string> status_names();
  const SampledSources& sources() const { return sources_; }
  const NominalMesh& mesh() const { return mesh_; }
  const ToleranceModel& tolerance() const { return tolerance_; }
  const std::vector<SampledLoad>& loads() const { return loads_; }
  const std::optional<DiscSurface>& discs() const { return discs_; }
  std::vector<TableColumn> output_columns() const;

private:
  friend class SampledGearWorker;
  SampledGear(SampledSources sources, NominalMesh mesh, ToleranceModel tolerance, FlankPair flanks)
      : sources_(std::move(sources)), mesh_(std::move(mesh)), tolerance_(std::move(tolerance)),
        flanks_(std::move(flanks)) {}
  std::optional<Failure> add_loads(const StudyFile& study);
  std::optional<Failure> add_discs();
  void find_near();

  SampledSources sources_;
  NominalMesh mesh_;
  ToleranceModel tolerance_;
  FlankPair flanks_;
  std::vector<SampledLoad> loads_;
  std::optional<DiscSurface> discs_;
  std::optional<MeshAtDiscs> nominal_discs_;
  std::vector<double> cosine_;      ///< of each tooth's local pressure angle
  std::vector<std::uint8_t> near_;  ///< teeth whose flanks are searched when the discs change
  std::vector<std::size_t> wanted_; ///< into sampled_responses()
  std::vector<int> positions_;
};

/// RowModel wants to own; rows share one gear.
class SharedRows : public RowModel {
public:
  explicit SharedRows(std::shared_ptr<const RowModel> rows) : rows_(std::move(rows)) {}
  std::size_t inputs() const override { return rows_->inputs(); }
  std::size_t outputs() const override { return rows_->outputs(); }
  std::string_view status_name(std::uint8_t status) const override { return rows_->status_name(status); }
  std::unique_ptr<RowWorker> worker() const override { return rows_->worker(); }

private:
  std::shared_ptr<const RowModel> rows_;
};

/// What monte_carlo and sensitivity rows have in common: columns, names, the model, what is said about a row.
SampledStudy study_of(const std::shared_ptr<const SampledGear>& gear, RowInputs inputs);

} // namespace strainwave
