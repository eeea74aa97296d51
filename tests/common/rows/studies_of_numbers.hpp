#pragma once
// Models to run: three random inputs, two outputs; some rows fail with a sentence.

#include "strainwave/common/rows/merge.hpp"
#include "strainwave/common/rows/run_rows.hpp"
#include "strainwave/common/sampling/counter_random.hpp"
#include "tests/support/temporary_folder.hpp"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>
#include <unistd.h>

namespace strainwave {

using testing_support::TemporaryFolder;

inline void random_inputs(std::uint64_t first, std::size_t count, std::span<double> rows) {
  for (std::size_t i = 0; i < count; ++i)
    random_uniforms({42, RandomPurpose::samples}, first + i, rows.subspan(3 * i, 3));
}

struct NumberModel : RowModel {
  double fail_above = 0.97; ///< of the first input
  std::uint64_t nan_at = ~0ULL;
  std::uint64_t throw_at = ~0ULL;
  std::chrono::microseconds pause{0};
  mutable std::atomic<std::uint64_t> evaluated{0};

  std::size_t inputs() const override { return 3; }
  std::size_t outputs() const override { return 2; }
  std::string_view status_name(std::uint8_t status) const override { return status == 0 ? "ok" : "no_wrap"; }
  std::unique_ptr<RowWorker> worker() const override {
    struct Worker : RowWorker {
      explicit Worker(const NumberModel& m) : model(m) {}
      void evaluate(RowSlice& slice) override {
        for (std::size_t i = 0; i < slice.rows; ++i) {
          const std::uint64_t row = slice.first + i;
          const double* x = &slice.inputs[3 * i];
          if (row == model.throw_at)
            throw std::runtime_error("a bug in the model");
          if (x[0] > model.fail_above)
            slice.fail(i, 4, "u0 = " + std::to_string(x[0]) + " mm admits no wrap angle");
          slice.outputs[2 * i] = std::sin(x[0]) + x[1];
          slice.outputs[2 * i + 1] = row == model.nan_at ? std::nan("") : x[2] * x[0];
          if (model.pause.count() > 0)
            std::this_thread::sleep_for(model.pause);
        }
        model.evaluated += slice.rows;
      }
      const NumberModel& model;
    };
    return std::make_unique<Worker>(*this);
  }
};

inline EnginePlan number_plan() {
  return {.rows = 10000,
          .block_rows = 128,
          .shard = 0,
          .shards = 1,
          .plan_hash = 11,
          .model_hash = 22,
          .origin = "test"};
}

inline bool same_rows(const RowTable& a, const RowTable& b) {
  return std::ranges::equal(a.status(), b.status()) && std::ranges::equal(a.values(), b.values()) &&
         a.messages() == b.messages();
}

} // namespace strainwave
