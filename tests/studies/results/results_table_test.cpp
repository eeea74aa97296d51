#include "tests/common/rows/journals.hpp"

#include "strainwave/studies/results/results_table.hpp"

#include <cmath>
#include <csignal>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>

namespace strainwave {
namespace {

RowTable some_rows() {
  RowTable table(1000, 2, 10);
  for (std::uint64_t b = 0; b < 100; ++b)
    if (b != 50)
      table.insert(test_block(b));
  return table;
}

ResultsTable some_results() {
  ResultsTable results;
  results.inputs = {{"u0", "mm"}, {"x2", "1"}, {"pitch error", "um"}};
  results.outputs = {{"peak_force_n", "N"}, {"rotation_rad", "rad"}};
  results.input_rows = [](std::uint64_t first, std::size_t count, std::span<double> rows) {
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        rows[3 * i + j] = static_cast<double>(first + i) * 10.0 + static_cast<double>(j);
  };
  results.status_names = {"ok", "contradiction", "no_wrap"};
  results.config = "kind = \"monte_carlo\"\n";
  results.version = "0.1.0";
  return results;
}

TEST(ResultsTable, HoldsInputsOutputsStatusAndMessages) {
  const TemporaryFolder folder;
  const RowTable table = some_rows();
  write_results_table(some_results(), table, folder.path / "results.h5");
  const hid_t file = H5Fopen(folder.file("results.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  hsize_t shape[2] = {};
  H5LTget_dataset_info(file, "inputs", shape, nullptr, nullptr);
  EXPECT_EQ(shape[0], 1000U);
  EXPECT_EQ(shape[1], 3U);
  std::vector<double> inputs(3000), outputs(2000);
  H5LTread_dataset_double(file, "inputs", inputs.data());
  EXPECT_EQ(inputs[3 * 777 + 2], 7772.0);
  H5LTread_dataset_double(file, "outputs", outputs.data());
  for (std::size_t row = 0; row < 1000; ++row)
    for (std::size_t j = 0; j < 2; ++j) {
      if (table.status()[row] == row_ok)
        EXPECT_EQ(outputs[2 * row + j], table.values()[2 * row + j]) << row;
      else
        EXPECT_TRUE(std::isnan(outputs[2 * row + j])) << row;
    }
  std::vector<int> status(1000);
  H5LTread_dataset_int(file, "status", status.data());
  EXPECT_EQ(status[3], 2);
  EXPECT_EQ(status[500], 255);
  unsigned long long missing = 0;
  H5LTget_attribute(file, "/", "missing_rows", H5T_NATIVE_ULLONG, &missing);
  EXPECT_EQ(missing, 10U);
  hsize_t messages = 0;
  H5LTget_dataset_info(file, "messages", &messages, nullptr, nullptr);
  EXPECT_EQ(messages, table.messages().size());
  H5Fclose(file);
}

TEST(ResultsTable, AFullDiskLeavesTheOldFileAndNothingBeside) {
  const TemporaryFolder folder;
  put_bytes(folder.file("results.h5"), "old");
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int code = 1;
    try {
      write_results_table(some_results(), some_rows(), folder.path / "results.h5");
    } catch (const std::system_error&) {
      code = 0;
    }
    ::_exit(code);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(bytes_of(folder.file("results.h5")), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 1);
}

} // namespace
} // namespace strainwave
