// [reduced] of a study file: the keys that --reduced changes.

#include "strainwave/studies/file/reader.hpp"

#include <algorithm>
#include <charconv>

namespace strainwave {

namespace {

bool is_gear_path(std::string_view path) {
  const std::string_view first = path.substr(0, path.find('.'));
  return find_table(first) != nullptr;
}

} // namespace

void note_changes(std::vector<StudyChange>& changes, const toml::table& table, const std::string& prefix) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    if (node.is_table())
      note_changes(changes, *node.as_table(), path + ".");
    else if (auto value = plain_value(node))
      changes.push_back({path, std::move(*value)});
  }
}

/// `indexed`: "load_case[0]".
void StudyReader::reduce_item(const StudyTable& tables, const std::string& indexed, const std::string& key,
                              Place key_place, const toml::node& node) {
  const std::string index = indexed.substr(tables.name.size());
  std::size_t i = 0;
  const bool bracketed = index.size() > 2 && index.front() == '[' && index.back() == ']';
  const char* const end = index.data() + index.size() - 1;
  if (!bracketed || std::from_chars(index.data() + 1, end, i).ptr != end)
    fault(key_place, "reduced." + indexed + "." + key,
          fmt::format("says not which one; write {}[0].{}", tables.name, key));
  else if (i >= tables.count(study_))
    fault(key_place, "reduced." + indexed + "." + key,
          fmt::format("there are only {} [[{}]], counted from 0", tables.count(study_), tables.name));
  else
    read_key(tables.keys(), tables.at(study_, i), indexed + ".", key, key_place, node);
}

/// Always read, so that a slip shows before an overnight run; kept only if the reduced study is wanted.
void StudyReader::read_reduced(const toml::table& table) {
  note_changes(study_.reduced_changes, table, "");
  StudyFile whole = study_;
  StudyPlaces whole_places = places_;
  for (const auto& [key, node] : table) {
    if (const toml::table* inside = node.as_table(); inside && !is_gear_path(key.str()))
      for (const auto& [inner, value] : *inside)
        reduce(fmt::format("{}.{}", key.str(), inner.str()), place_of(inner), value);
    else if (inside) {
      apply_below(std::string(key.str()), *inside);
    } else
      reduce(std::string(key.str()), place_of(key), node);
  }
  if (study_.reduced)
    return settle_reduced_changes();
  study_ = std::move(whole);
  places_ = std::move(whole_places);
}

/// The reduced study is a study of its own, with its changes of the gear among the overrides.
void StudyReader::settle_reduced_changes() {
  for (StudyChange& change : study_.reduced_changes) {
    if (!is_gear_path(change.path))
      continue;
    std::erase_if(study_.overrides, [&](const StudyChange& old) {
      return old.path == change.path || old.path.starts_with(change.path + "[");
    });
    study_.overrides.push_back(std::move(change));
  }
  study_.reduced_changes.clear();
  std::sort(study_.overrides.begin(), study_.overrides.end(),
            [](const StudyChange& a, const StudyChange& b) { return a.path < b.path; });
}

void StudyReader::apply_below(const std::string& prefix, const toml::table& table) {
  for (const auto& [key, node] : table) {
    const std::string path = fmt::format("{}.{}", prefix, key.str());
    if (node.is_table())
      apply_below(path, *node.as_table());
    else
      apply_override(study_.gear, path, node, place_of(key), folder_, faults_);
  }
}

/// "method.budget", "load_case[0].phases", or a key of the gear.
void StudyReader::reduce(const std::string& path, Place key_place, const toml::node& node) {
  if (is_gear_path(path))
    return apply_override(study_.gear, path, node, key_place, folder_, faults_);
  if (path == "seed")
    return read_key(top_, &study_, "", path, key_place, node);
  const std::size_t dot = path.find('.');
  const std::string table = path.substr(0, dot), key = dot == std::string::npos ? "" : path.substr(dot + 1);
  const StudyTable* known = find_study_table(table.substr(0, table.find('[')));
  if (known && known->keys && !key.empty()) {
    if (known->repeated)
      return reduce_item(*known, table, key, key_place, node);
    if (table == known->name)
      return read_key(known->keys(), known->at(study_, 0), table + ".", key, key_place, node);
  }
  fault(key_place, "reduced." + path,
        "no such key of a study or of a gear; expected, for example, \"method.budget\", "
        "\"load_case[0].phases\" or "
        "\"mesh.per_pitch\"");
}

} // namespace strainwave
