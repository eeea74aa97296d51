#pragma once
// Reads the tables of a study file into a StudyFile; faults are collected. Internal to the room.

#include "strainwave/common/core/nearest.hpp"
#include "strainwave/model/gear_file/field_reader.hpp"
#include "strainwave/studies/file/checker.hpp"
#include "strainwave/studies/file/kind.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

namespace strainwave {

class StudyReader {
public:
  /// `gear_text`: instead of the gear file that the study names.
  StudyReader(const std::string& name, StudyKinds kinds, bool reduced,
              std::optional<std::string_view> gear_text = {});
  StudyFile read(const toml::table& root);

private:
  void fault(Place place, std::string key, std::string sentence, std::string nearest = "") {
    faults_.push_back({place, std::move(key), std::move(sentence), std::move(nearest)});
  }

  // Tables and keys: `table` is the struct that the keys belong to.

  /// `prefix`: "method." or "variable[0].".
  void read_key(StudyKeys keys, void* table, const std::string& prefix, const std::string& name,
                Place key_place, const toml::node& node);
  void read_table(StudyKeys keys, void* table, const std::string& path, Place key_place,
                  const toml::node& node);
  void read_tables(const StudyTable& tables, Place key_place, const toml::node& node);
  /// Keys that are tables or lists of texts.
  void read_compound(const StudyKey& key, void* table, const std::string& path, Place key_place,
                     const toml::node& node);
  void read_inner(const StudyShape& shape, void* table, const std::string& path, std::string_view expected,
                  const toml::node& node);
  void read_one_of(const StudyKey& key, void* table, const std::string& path, const toml::node& node);
  void read_names(std::vector<std::string>& names, const std::string& path, Place key_place,
                  const toml::node& node);
  void demand(StudyKeys keys, const std::string& prefix, Place place);

  void read_top(const std::string& name, const toml::key& key, const toml::node& node);
  void read_kind(const toml::table& root);
  void demand_tables(const toml::table& root);
  void read_gear(const toml::table& root);
  void take_loads_from_gear();
  const StudyTable* find_study_table(std::string_view name) const;

  // reduced.cpp
  void read_reduced(const toml::table& table);
  void settle_reduced_changes();
  void apply_below(const std::string& prefix, const toml::table& table);
  void reduce(const std::string& path, Place key_place, const toml::node& node);
  void reduce_item(const StudyTable& tables, const std::string& indexed, const std::string& key,
                   Place key_place, const toml::node& node);

  StudyFile study_;
  std::filesystem::path folder_;
  StudyKinds kinds_;
  std::vector<std::string_view> kind_names_;
  std::vector<StudyKey> top_;
  std::vector<StudyTable> tables_; ///< of the study's kind
  std::optional<std::string_view> gear_text_;
  std::vector<FileFault> faults_;
  std::map<std::string, Place> given_; ///< keys that the file gives, right or wrong
  StudyPlaces places_;                 ///< values that were read, and tables
  std::set<std::string> meant_;        ///< legal keys that misspelt ones stand for
};

/// Every plain value below `table`, with its path.
void note_changes(std::vector<StudyChange>& changes, const toml::table& table, const std::string& prefix);

} // namespace strainwave
