#include "strainwave/model/gear_file/gear_file.hpp"

#include "strainwave/common/core/nearest.hpp"
#include "strainwave/model/gear_file/field_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace strainwave {

namespace {

std::string below(std::string_view table, std::string_view key) {
  return table.empty() ? std::string(key) : fmt::format("{}.{}", table, key);
}

class Reader {
public:
  Reader(GearDocument& document) // NOLINT: one call
      : document_(document), folder_(std::filesystem::path(document.file).parent_path()) {}

  void read(const toml::table& root) {
    read_table(root, "");
    demand_required_keys(root);
    demand_table_file(root);
    if (!faults_.empty())
      throw FileError(document_.file, std::move(faults_));
  }

private:
  void read_table(const toml::table& table, const std::string& table_path) {
    for (const auto& [key, node] : table) {
      const std::string path = below(table_path, key.str());
      if (const Field* field = find_field(path)) {
        warn_of_former_name(*field, node);
        document_.places.emplace(path, place_of(key));
        apply_override(document_.gear, path, node, place_of(key), folder_, faults_);
      } else if (find_table(path)) {
        if (const toml::table* inside = node.as_table())
          read_table(*inside, path);
        else
          faults_.push_back(
              {place_of(key), path,
               node.is_array_of_tables()
                   ? fmt::format("this table is opened with single brackets: [{}]", path)
                   : fmt::format("expected a table, opened by [{}], got {}", path, node_words(node)),
               ""});
      } else {
        complain_about_unknown(path, key, node);
      }
    }
  }

  void warn_of_former_name(const Field& field, const toml::node& node) {
    const auto* text = node.as_string();
    const FormerChoice* former = text ? find_former_choice(field, FieldValue(text->get())) : nullptr;
    if (!former)
      return;
    const Place place = place_of(node);
    document_.warnings.push_back(fmt::format("{}:{}:{}: {}: {}", document_.file, place.line, place.column,
                                             field.path, renamed_sentence(*former)));
  }

  void complain_about_unknown(const std::string& path, const toml::key& key, const toml::node& node) {
    FileFault fault{place_of(key), path, "", ""};
    const bool table_like = node.is_table() || (node.is_array_of_tables() && !node.as_array()->empty());
    if (table_like) {
      std::vector<std::string_view> names;
      for (const FieldTable& table : gear_tables())
        names.push_back(table.path);
      const Nearest nearest = nearest_name(path, names);
      fault.nearest = nearest.name;
      fault.sentence = nearest.close
                           ? fmt::format("no such table; did you mean [{}]?", nearest.name)
                           : fmt::format("no such table; the nearest legal one is [{}]", nearest.name);
    } else {
      fault.sentence = unknown_key_sentence(path, &fault.nearest);
    }
    meant_.insert(fault.nearest);
    faults_.push_back(std::move(fault));
  }

  /// A misspelt key or table is one fault: what it stands for is not called missing as well.
  bool is_meant(std::string_view path) const { return meant_.contains(std::string(path)); }

  void demand_required_keys(const toml::table& root) {
    for (const FieldTable& table : gear_tables()) {
      std::vector<const Field*> missing;
      bool needed = false;
      for (const Field& field : gear_fields()) {
        if (field.table() != table.path || !field.required)
          continue;
        needed = true;
        if (!document_.places.contains(field.path) && !is_meant(field.path))
          missing.push_back(&field);
      }
      if (!needed || missing.empty() || is_meant(table.path))
        continue;
      const toml::node* node = root.get(table.path); // tables with required keys stand at the top level
      if (!node) {
        std::string keys;
        for (const Field* field : missing)
          keys += (keys.empty() ? "" : ", ") + std::string(field->key());
        faults_.push_back({{1, 1},
                           std::string(table.path),
                           fmt::format("the table [{}] is missing; it has to give {}", table.path, keys),
                           ""});
      } else if (node->is_table()) {
        for (const Field* field : missing)
          faults_.push_back({place_of(*node), std::string(field->path),
                             fmt::format("missing in the table [{}]; expected {}: {}", table.path,
                                         expectation(*field), field->sentence),
                             ""});
      }
    }
  }

  /// The curve of shape = "table" is part of the file's content, so its absence is a fault of the file.
  void demand_table_file(const toml::table& root) {
    const WaveGenerator& wave = document_.gear.wave_generator;
    const toml::node* shape = root.at_path("wave_generator.shape").node();
    if (wave.shape == WaveGeneratorShape::table && wave.table_file.empty() && shape && faults_.empty())
      faults_.push_back({place_of(*shape), "wave_generator.shape",
                         "the shape \"table\" needs table_file, the file that holds the curve", ""});
  }

  GearDocument& document_;
  std::filesystem::path folder_;
  std::vector<FileFault> faults_;
  std::set<std::string> meant_;
};

} // namespace

std::string GearDocument::where(std::string_view path) const {
  const auto found = places.find(path);
  if (found == places.end())
    return file;
  return fmt::format("{}:{}:{}", file, found->second.line, found->second.column);
}

GearDocument parse_gear(std::string_view text, const std::string& name) {
  const toml::table root = parse_toml(text, name);
  if (root.empty())
    throw FileError(
        name, {{{1, 1}, "", "the file gives no key; `strainwave example` prints a complete gear file", ""}});
  GearDocument document;
  document.file = name;
  Reader(document).read(root);
  return document;
}

GearDocument load_gear(const std::string& path) {
  return parse_gear(read_text_file(path, "gear file"), path);
}

} // namespace strainwave
