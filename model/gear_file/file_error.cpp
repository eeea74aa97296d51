#include "strainwave/model/gear_file/file_error.hpp"

#include <algorithm>

namespace strainwave {

namespace {

void sort_by_place(std::vector<FileFault>& faults) {
  std::stable_sort(faults.begin(), faults.end(),
                   [](const FileFault& a, const FileFault& b) { return a.place < b.place; });
}

std::string lines(const std::string& file, std::vector<FileFault> faults) {
  sort_by_place(faults);
  std::string text;
  for (const FileFault& fault : faults) {
    if (!text.empty())
      text += '\n';
    text += file + ":";
    if (fault.place.line > 0)
      text += std::to_string(fault.place.line) + ":" + std::to_string(fault.place.column) + ":";
    if (!fault.key.empty())
      text += " " + fault.key + ":";
    text += " " + fault.sentence;
  }
  return text;
}

} // namespace

FileError::FileError(std::string file, std::vector<FileFault> faults)
    : std::runtime_error(lines(file, faults)), file_(std::move(file)), faults_(std::move(faults)) {
  sort_by_place(faults_);
}

} // namespace strainwave
