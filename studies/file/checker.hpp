#pragma once
// What all checks of studies use: places in the file, names against what is legal, numbers of the gear.
// Internal to the room.

#include "strainwave/common/core/nearest.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/studies/file/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace strainwave {

class StudyChecker {
public:
  StudyChecker(const StudyFile& study, const StudyPlaces& places, const StudyVocabulary& vocabulary,
               std::vector<FileFault>& faults)
      : study_(study), places_(places), vocabulary_(vocabulary), faults_(faults) {}

protected:
  bool given(const std::string& key) const { return places_.contains(key); }

  /// The place of the key, or of the table around it.
  Place place(std::string key) const {
    while (true) {
      const auto found = places_.find(key);
      if (found != places_.end())
        return found->second;
      const std::size_t dot = key.rfind('.');
      if (dot == std::string::npos)
        return {1, 1};
      key.resize(dot);
    }
  }

  void fault(const std::string& key, std::string sentence, std::string nearest = "") {
    faults_.push_back({place(key), key, std::move(sentence), std::move(nearest)});
  }

  void check_name(const std::string& key, const std::string& name, std::span<const std::string_view> legal,
                  std::string_view what) {
    if (!given(key) || legal.empty() || std::find(legal.begin(), legal.end(), name) != legal.end())
      return;
    const Nearest nearest = nearest_name(name, legal);
    fault(key,
          fmt::format(fmt::runtime(nearest.close ? "there is no {} \"{}\"; did you mean \"{}\"?"
                                                 : "there is no {} \"{}\"; the nearest legal one is \"{}\""),
                      what, name, nearest.name),
          std::string(nearest.name));
  }

  void check_output(const std::string& key, const std::string& name) {
    check_name(key, name, vocabulary_.outputs, "output");
    if (!given(key) || !vocabulary_.unavailable)
      return;
    if (const auto sentence = vocabulary_.unavailable(name, study_))
      fault(key, fmt::format("{} {}", name, *sentence));
  }

  /// The number that a path names; a fault if it names none that can vary continuously.
  std::optional<NumberPath> continuous_number(const std::string& key, const std::string& path,
                                              bool whole_allowed = false) {
    if (!given(key))
      return std::nullopt;
    try {
      NumberPath number(path);
      if (number.field().kind == FieldKind::integer && !whole_allowed) {
        fault(key, fmt::format("{} is a whole number; only continuous numbers can vary here", path));
        return std::nullopt;
      }
      if (number.field().kind == FieldKind::number_list && !study_.gear_file.empty())
        (void)number.get(study_.gear); // the item has to exist
      return number;
    } catch (const FieldError& error) {
      fault(key, fmt::format("{}: {}", error.path, error.sentence));
      return std::nullopt;
    }
  }

  void check_in_range(const std::string& key, const NumberPath& number, double value) {
    const Field& field = number.field();
    if (field.range.contains(value) || !given(key))
      return;
    Field one = field;
    if (one.kind == FieldKind::number_list)
      one.kind = FieldKind::number;
    fault(key, fmt::format("{} {}", number.path(), find_complaint(one, value)->sentence));
  }

  void claim(const std::string& key, const std::string& path) {
    const auto [first, is_new] = claimed_.emplace(path, place(key).line);
    if (!is_new)
      fault(key, fmt::format("{} varies already (line {})", path, first->second));
  }

  const StudyFile& study_;
  const StudyPlaces& places_;
  const StudyVocabulary& vocabulary_;
  std::vector<FileFault>& faults_;
  std::map<std::string, int> claimed_; ///< numbers that vary, and the line that says so
};

/// sweep, monte_carlo, sensitivity.
void check_sampled_study(const StudyFile& study, const StudyPlaces& places, const StudyVocabulary& vocabulary,
                         std::vector<FileFault>& faults);

} // namespace strainwave
