#pragma once
// Every number of a result, once: its key, unit, what it is, and where it is read. `analyze --json`, the HDF5
// file and the table in docs/results.md are made from it, so a number that is added here is in all of them.

#include "strainwave/model/results/result.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace strainwave {

/// Not asked for, or not reached.
struct Absent {};
/// Asked for, and there is none: flanks that share no radius, the zone of a load without contact.
struct Null {};

/// NaN stands for Null inside arrays. A matrix is row by row.
using ResultValue = std::variant<Absent, Null, bool, int, double, std::string, std::vector<int>,
                                 std::vector<double>, std::vector<std::vector<double>>>;

struct FieldText {
  std::string_view name;     ///< with its unit, as in JSON: "peak_force_n"
  std::string_view unit;     ///< as printed: "N", "µm", "°", "N·m/rad"; empty: a plain number or a text
  std::string_view sentence; ///< what it is; signs
  std::string_view rows;     ///< of arrays: the field of the same block that runs along the first axis
  std::string_view columns;  ///< of matrices: along the second
};

struct BlockText {
  std::string_view path;     ///< "load[].points"; the result itself: ""
  std::string_view sentence; ///< when it is there
  std::vector<FieldText> fields;
};

/// In the order in which results are written.
const std::vector<BlockText>& result_blocks();

/// Takes one block of a result.
class ResultWriter {
public:
  virtual ~ResultWriter() = default;
  virtual void put(const FieldText& field, const ResultValue& value) = 0;
  /// A block inside this one.
  virtual std::unique_ptr<ResultWriter> block(std::string_view name) = 0;
  /// An element of a list of blocks.
  virtual std::unique_ptr<ResultWriter> element(std::string_view list, std::size_t index) = 0;
  /// A block that was asked for, of which there is none.
  virtual void no_block(std::string_view name) = 0;
};

/// Blocks that were not asked for, or not reached, are left out.
void write_result(const ForwardResult& result, ResultWriter& root);

/// "peak_force" of "peak_force_n": the name without its unit, as in HDF5.
std::string_view name_without_unit(const FieldText& field);
/// In ASCII, as in the attribute "units" of HDF5: "N.m/rad", "um"; "1" for a plain number.
std::string_view ascii_unit(std::string_view unit);

/// The blocks as Markdown (docs/results.md).
std::string results_reference();

} // namespace strainwave
