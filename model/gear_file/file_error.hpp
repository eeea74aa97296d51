#pragma once
// A file that the user has to correct: what is wrong, and where. All faults of a file come in one exception,
// in the order of their places, and what() has one line for each, in the form that editors can jump to:
//     seed.toml:12:1: flexspline.modul_mm: no such key; did you mean module_mm?

#include <stdexcept>
#include <string>
#include <vector>

namespace strainwave {

/// Counted from 1; line 0: the file as a whole.
struct Place {
  int line = 0;
  int column = 0;
  auto operator<=>(const Place&) const = default;
};

struct FileFault {
  Place place;
  std::string key;      ///< full path; empty where no key is meant
  std::string sentence; ///< what is wrong, what was expected
  std::string nearest;  ///< the legal key meant by a misspelt one; empty for other faults
};

class FileError : public std::runtime_error {
public:
  FileError(std::string file, std::vector<FileFault> faults);

  const std::string& file() const { return file_; }
  /// Never empty.
  const std::vector<FileFault>& faults() const { return faults_; }

private:
  std::string file_;
  std::vector<FileFault> faults_;
};

} // namespace strainwave
