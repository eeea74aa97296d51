#include "studies/results_file.hpp"

#include "model/gear_file/gear_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <hdf5_hl.h>

#include <cerrno>
#include <limits>
#include <system_error>

namespace strainwave {

namespace {

template <class T>
T check(T code) {
  if (code < 0)
    throw std::system_error(EIO, std::generic_category(), "HDF5 refused to write the results");
  return code;
}

/// HDF5 has no units of its own and no micro sign in plain names.
std::string plain_unit(std::string_view unit) {
  if (unit == "µm")
    return "um";
  if (unit == "N·m")
    return "N.m";
  if (unit == "N·m/rad")
    return "N.m/rad";
  return unit.empty() ? "1" : std::string(unit);
}

void put_table(hid_t file, const char* name, std::size_t rows, const std::vector<double>& values,
               const std::string& names, const std::string& units) {
  const hsize_t shape[2] = {rows, rows > 0 ? values.size() / rows : 0};
  check(H5LTmake_dataset_double(file, name, 2, shape, values.data()));
  check(H5LTset_attribute_string(file, name, "names", names.c_str()));
  check(H5LTset_attribute_string(file, name, "units", units.c_str()));
}

void put_texts(hid_t file, const char* name, const std::vector<const char*>& texts) {
  const hid_t type = check(H5Tcopy(H5T_C_S1));
  check(H5Tset_size(type, H5T_VARIABLE));
  check(H5Tset_cset(type, H5T_CSET_UTF8));
  const hsize_t count = texts.size();
  const herr_t code = H5LTmake_dataset(file, name, 1, &count, type, texts.data());
  H5Tclose(type);
  check(code);
}

void put_all(const OptimisationReport& report, hid_t file) {
  const std::size_t rows = report.points.size();
  std::vector<double> inputs, outputs, seconds;
  std::vector<const char*> status, messages;
  for (const StoredPoint& point : report.points) {
    const Evaluation& e = *point.evaluation;
    inputs.insert(inputs.end(), point.x.begin(), point.x.end());
    if (e.ok)
      outputs.insert(outputs.end(), e.values.begin(), e.values.end());
    else
      outputs.insert(outputs.end(), gear_responses().size(), std::numeric_limits<double>::quiet_NaN());
    seconds.push_back(point.seconds);
    status.push_back(e.status.c_str());
    messages.push_back(e.message.c_str());
  }
  std::string names, units;
  const std::size_t variables = report.study.variables.size();
  for (std::size_t i = 0; i < variables; ++i) {
    names += fmt::format("{}{}", i ? "\n" : "", report.inputs[i].path);
    units += fmt::format("{}{}", i ? "\n" : "", plain_unit(report.inputs[i].unit));
  }
  put_table(file, "inputs", rows, inputs, names, units);
  names.clear();
  units.clear();
  for (const Response& response : gear_responses()) {
    names += fmt::format("{}{}", names.empty() ? "" : "\n", response.name);
    units += fmt::format("{}{}", units.empty() ? "" : "\n", plain_unit(response.unit));
  }
  put_table(file, "outputs", rows, outputs, names, units);
  put_texts(file, "status", status);
  put_texts(file, "messages", messages);
  const hsize_t count = rows;
  check(H5LTmake_dataset_double(file, "timing", 1, &count, seconds.data()));
  check(H5LTset_attribute_string(file, "timing", "units", "s"));
  check(H5LTmake_dataset_string(
      file, "config", (write_study(report.study) + "\n# gear\n" + write_gear(report.study.gear)).c_str()));
  check(H5LTmake_dataset_string(file, "version", STRAINWAVE_VERSION));
  check(H5Fflush(file, H5F_SCOPE_GLOBAL));
}

} // namespace

void write_results_file(const OptimisationReport& report, const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // errors are reported by exception, not printed
  if (report.points.empty())
    return; // stopped before the first evaluation
  const std::filesystem::path beside = path.string() + ".part";
  errno = 0;
  const hid_t file = H5Fcreate(beside.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (file < 0)
    throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(),
                            "cannot write " + path.string());
  try {
    put_all(report, file);
  } catch (...) {
    H5Fclose(file);
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw;
  }
  check(H5Fclose(file));
  std::filesystem::rename(beside, path);
}

} // namespace strainwave
