#pragma once
// Reads the tables of a study file into a StudyFile; faults are collected. Internal to the room.

#include "strainwave/common/core/nearest.hpp"
#include "strainwave/model/gear_file/field_reader.hpp"
#include "strainwave/studies/file/checks.hpp"
#include "strainwave/studies/file/keys.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

namespace strainwave {

class StudyReader {
public:
  /// `gear_text`: instead of the gear file that the study names.
  StudyReader(const std::string& name, bool reduced, const StudyVocabulary& vocabulary,
              std::optional<std::string_view> gear_text = {});
  StudyFile read(const toml::table& root);

private:
  void fault(Place place, std::string key, std::string sentence, std::string nearest = "") {
    faults_.push_back({place, std::move(key), std::move(sentence), std::move(nearest)});
  }

  /// One key of a table that is held in `table`. `prefix`: "method." or "variable[0].".
  template <class Table>
  void read_key(Table& table, const std::string& prefix, const std::string& name, Place key_place,
                const toml::node& node) {
    std::vector<std::string_view> legal;
    for (const auto& key : study_keys(table)) {
      legal.push_back(key.field.path);
      if (key.field.path != name)
        continue;
      const std::string path = prefix + name;
      given_.emplace(path, key_place);
      if (const auto value = read_value(key.field, path, node, faults_)) {
        key.write(table, *value);
        places_[path] = place_of(node);
      }
      return;
    }
    if (read_compound(table, prefix, name, key_place, node))
      return;
    for (const std::string_view compound : compound_keys<Table>())
      legal.push_back(compound);
    const Nearest nearest = nearest_name(name, legal);
    fault(key_place, prefix + name,
          fmt::format(fmt::runtime(nearest.close ? "no such key; did you mean {}?"
                                                 : "no such key; the nearest legal key is {}"),
                      nearest.name),
          prefix + std::string(nearest.name));
    meant_.insert(prefix + std::string(nearest.name));
  }

  template <class Table>
  void read_table(Table& table, const std::string& path, Place key_place, const toml::node& node) {
    const toml::table* inside = node.as_table();
    if (!inside)
      return fault(key_place, path,
                   fmt::format("expected a table, opened by [{}], got {}", path, node_words(node)));
    places_[path] = place_of(node);
    for (const auto& [key, value] : *inside)
      read_key(table, path + ".", std::string(key.str()), place_of(key), value);
    demand(table, path + ".", place_of(node));
  }

  template <class Table>
  void read_tables(std::vector<Table>& tables, const std::string& name, Place key_place,
                   const toml::node& node) {
    const toml::array* array = node.as_array();
    if (!array)
      return fault(
          key_place, name,
          node.is_table()
              ? fmt::format("there may be several of these, so each is opened by [[{}]]", name)
              : fmt::format("expected tables, each opened by [[{}]], got {}", name, node_words(node)));
    for (std::size_t i = 0; i < array->size(); ++i) {
      tables.emplace_back();
      read_table(tables.back(), fmt::format("{}[{}]", name, i), place_of(*array->get(i)), *array->get(i));
    }
  }

  /// Keys that are tables or lists of texts.
  template <class Table>
  bool read_compound(Table& table, const std::string& prefix, const std::string& name, Place key_place,
                     const toml::node& node) {
    if constexpr (requires { table.link; })
      if (name == "link")
        return read_inner(table.link.emplace(), prefix + name, "{ path = \"…\", ratio = … }", node), true;
    if constexpr (requires { table.stop; })
      if (name == "stop")
        return read_inner(table.stop.emplace(), prefix + name, "{ output = \"…\", half_width = … }", node),
               true;
    if constexpr (requires { table.distribution; })
      if (name == "distribution")
        return read_distribution(table.distribution, prefix + name, node), true;
    if constexpr (requires { table.outputs; })
      if (name == "outputs")
        return read_names(table.outputs, prefix + name, key_place, node), true;
    return false;
  }

  template <class Table>
  void read_inner(Table& table, const std::string& path, const char* expected, const toml::node& node) {
    given_.emplace(path, place_of(node));
    if (!node.is_table())
      return fault(place_of(node), path, fmt::format("expected {}, got {}", expected, node_words(node)));
    read_table(table, path, place_of(node), node);
  }

  void read_names(std::vector<std::string>& names, const std::string& path, Place key_place,
                  const toml::node& node);
  void read_distribution(Distribution& distribution, const std::string& path, const toml::node& node);
  template <class Shape>
  void read_shape(Distribution& distribution, const std::string& path, const toml::node& node);

  template <class Table>
  void demand(const Table& table, const std::string& prefix, Place place) {
    for (const auto& key : study_keys(table)) {
      const std::string path = prefix + std::string(key.field.path);
      if (key.field.required && !given_.contains(path) && !meant_.contains(path))
        fault(place, path,
              fmt::format("missing; expected {}: {}", expectation(key.field), key.field.sentence));
    }
  }

  void read_top(const std::string& name, const toml::key& key, const toml::node& node);
  void read_kind(const toml::table& root);
  void demand_headings(const toml::table& root);
  void read_gear(const toml::table& root);
  void take_loads_from_gear();

  // reduced.cpp
  void read_reduced(const toml::table& table);
  void settle_reduced_changes();
  void apply_below(const std::string& prefix, const toml::table& table);
  void reduce(const std::string& path, Place key_place, const toml::node& node);
  template <class Table>
  bool reduce_item(std::vector<Table>& tables, std::string_view name, const std::string& indexed,
                   const std::string& key, Place key_place, const toml::node& node);

  StudyFile study_;
  std::filesystem::path folder_;
  const StudyVocabulary& vocabulary_;
  std::optional<std::string_view> gear_text_;
  std::vector<FileFault> faults_;
  std::map<std::string, Place> given_; ///< keys that the file gives, right or wrong
  StudyPlaces places_;                 ///< values that were read, and tables
  std::set<std::string> meant_;        ///< legal keys that misspelt ones stand for
};

/// Every plain value below `table`, with its path.
void note_changes(std::vector<StudyChange>& changes, const toml::table& table, const std::string& prefix);

} // namespace strainwave
