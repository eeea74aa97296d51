#pragma once
// What the engine evaluates: rows of numbers in, rows of numbers and a status out.
//
// The answer of a row must be a function of that row alone: not of the rows before it, not of the worker.
// Then any number of threads, any sharding and any restart give the same bits.

#include "strainwave/common/rows/row_block.hpp"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace strainwave {

/// Status of a row whose model said ok but gave a number that is not finite. Set by the engine.
inline constexpr std::uint8_t row_not_finite = 254;

/// Neighbouring rows, handed to a worker together.
struct RowSlice {
  std::uint64_t first = 0; ///< index of the first row in the study
  std::size_t rows = 0;
  std::span<const double> inputs; ///< rows × inputs
  std::span<double> outputs;      ///< rows × outputs, zero on entry
  std::span<std::uint8_t> status; ///< rows, row_ok on entry
  std::vector<RowMessage>* messages = nullptr;
  std::uint32_t row_offset = 0; ///< of the slice within its block

  /// Row i has no result: a reason of the model (1 … 253) and one sentence with the offending numbers.
  void fail(std::size_t i, std::uint8_t reason, std::string sentence) const {
    status[i] = reason;
    messages->push_back({row_offset + static_cast<std::uint32_t>(i), std::move(sentence)});
  }
};

/// One thread's own workspace. An exception is no failed row: it ends the run (our bug, or no memory).
class RowWorker {
public:
  virtual ~RowWorker() = default;
  virtual void evaluate(RowSlice&) = 0;
};

class RowModel {
public:
  virtual ~RowModel() = default;
  virtual std::size_t inputs() const = 0;
  virtual std::size_t outputs() const = 0;
  virtual std::string_view status_name(std::uint8_t status) const = 0; ///< for sentences
  virtual std::unique_ptr<RowWorker> worker() const = 0;               ///< called once in every thread
};

/// Fills rows first … first + count − 1 of the inputs; called from all threads at once.
using RowInputs = std::function<void(std::uint64_t first, std::size_t count, std::span<double> rows)>;

} // namespace strainwave
