#pragma once
// Studies whose rows are known in advance: what run_rows() needs, what
// results.h5 shows, and what is asked of the finished table. One maker for each kind; everything that follows
// (engine, journal, shards, statistics, reports) is the same for all of them.
//
//     monte_carlo    row k is sample k of `design`
//     sobol          blocks of (index_names + 2) rows as in statistics/sobol_indices.hpp: A, B, A with source
//     i of B morris         trajectories of (index_names + 1) rows local          whatever rows are wanted;
//     `elasticities` reads them
//
// A maker may take its time (the cup is solved here) and must give the same rows for the same StudyFile on
// every machine: no clock, no thread count, no order of evaluation enters a row. Its Failure: the nominal
// gear has no result (exit 3). It throws FieldError for keys of the study that do not fit the gear,
// std::system_error, std::bad_alloc.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/common/rows/row_model.hpp"
#include "strainwave/common/sampling/morris_points.hpp"
#include "strainwave/common/threads/run_context.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/studies/file/study.hpp"
#include "strainwave/studies/results/results_table.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace strainwave {

/// Local sensitivity: how an output follows an input.
struct LocalElasticity {
  std::string output, input;
  double derivative = 0.0; ///< unit of the output over unit of the input
  double elasticity = 0.0; ///< relative change over relative change; 0 where input or output is 0
};

struct SampledStudy {
  std::unique_ptr<RowModel> model;
  RowInputs inputs; ///< rows × model->inputs(): all that a row is made from, per-tooth errors included

  /// Named scalars of a row: results.h5, correlations. May be fewer or other numbers than the model's inputs
  /// (one of each source: the value of a scalar source, the amplitude of a harmonic, the spread of per-tooth
  /// errors).
  std::vector<TableColumn> input_columns;  ///< unit as HDF5 is told: "mm", "um", "N.m", "1"
  RowInputs input_values;                  ///< rows × input_columns
  std::vector<TableColumn> output_columns; ///< as many as model->outputs()

  std::uint64_t rows = 0;
  std::uint32_t block_rows = 1024; ///< rows of one journal record: about a second of work or 1024;
                                   ///< monte_carlo with `stop`: a power of two of at most 1024
  std::uint64_t cups = 1;          ///< finite-element solutions among the rows, for cost estimates
  std::size_t slice_rows = 64;     ///< rows between two looks at the stop flag: at most a second of work
  std::vector<std::string> status_names; ///< by status: [0] = "ok"
  std::string model_content; ///< what rows depend on beside the plan and the program's version: tables that
                             ///< were read, version number of the row model

  std::vector<std::string> index_names; ///< sensitivity: the inputs of the indices (one for each source)
  std::optional<MorrisPoints> morris;   ///< with index_names.size() inputs
  std::function<std::vector<LocalElasticity>(const RowTable&)> elasticities; ///< local

  /// The gear of one row with its loads, for `eval --gear`; may be absent (errors of single teeth are no
  /// keys). Throws FieldError where the row has none.
  std::function<std::optional<Gear>(std::uint64_t row)> gear_of_row;

  /// `eval --json`: everything about one row, drawn and computed again, as one JSON object (text). May be
  /// absent; then named inputs and outputs are all there is.
  std::function<std::string(std::uint64_t row)> describe_row;
};

} // namespace strainwave
