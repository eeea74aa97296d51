#pragma once
// What the checks of a study use, once its keys have been read: places in the file, names against what is
// legal, numbers of the gear, loads.

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/gear_file/file_error.hpp"
#include "strainwave/studies/file/study.hpp"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

/// Where keys of the file stand: "variable[0].path" → place of its value. Keys that are absent are not in it.
using StudyPlaces = std::map<std::string, Place>;

class StudyChecker {
public:
  StudyChecker(const StudyFile& study, const StudyPlaces& places, std::vector<FileFault>& faults)
      : study_(study), places_(places), faults_(faults) {}

  const StudyFile& study() const { return study_; }
  bool given(const std::string& key) const { return places_.contains(key); }
  /// The place of the key, or of the table around it.
  Place place(std::string key) const;
  void fault(const std::string& key, std::string sentence, std::string nearest = "");
  /// Has something been said about a key that starts like this?
  bool faulty(std::string_view start) const;

  /// What no kind has of its own: the load cases.
  void check_loads();

  /// A name of another kind of study, and the one that comes nearest in meaning to it here, with its
  /// sentence.
  struct Counterpart {
    std::string_view name, here, sentence;
  };
  void check_name(const std::string& key, const std::string& name, std::span<const std::string_view> legal,
                  std::string_view what, std::span<const Counterpart> counterparts = {});
  /// An output of a forward result that this gear gives under these loads.
  void check_output(const std::string& key, const std::string& name);
  /// The outputs that a study records: names of `legal`, each once.
  void check_names(const std::string& key, const std::vector<std::string>& names,
                   std::span<const std::string_view> legal, std::span<const Counterpart> counterparts = {});

  /// The number of the gear that a path names; a fault if it names none that can vary continuously.
  std::optional<NumberPath> continuous_number(const std::string& key, const std::string& path,
                                              bool whole_allowed = false);
  void check_in_range(const std::string& key, const NumberPath& number, double value);
  /// Is this the path of a load, well spelt or not? Then the number of the gear is not to be looked for.
  static bool names_load(std::string_view path);
  /// The load that such a path names: there, and given by this very number. Nothing, and a fault, if not.
  std::optional<LoadKey> load(const std::string& key, const std::string& path);
  /// A number may vary once.
  void claim(const std::string& key, const std::string& path);

private:
  const StudyFile& study_;
  const StudyPlaces& places_;
  std::vector<FileFault>& faults_;
  std::map<std::string, int> claimed_; ///< numbers that vary, and the line that says so
};

} // namespace strainwave
