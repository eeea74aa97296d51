#include "studies/study_file.hpp"

#include "model/gear/nearest.hpp"
#include "model/gear_file/field_reader.hpp"
#include "model/gear_file/gear_file.hpp"
#include "studies/study_checks.hpp"
#include "studies/study_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <set>

namespace strainwave {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 12> top_level{"kind",      "gear",     "seed",      "override",
                                                     "load_case", "variable", "objective", "constraint",
                                                     "pareto",    "method",   "limits",    "reduced"};

class Reader {
public:
  Reader(const std::string& name, bool reduced, const StudyVocabulary& vocabulary)
      : folder_(fs::path(name).parent_path()), vocabulary_(vocabulary) {
    study_.file = name;
    study_.reduced = reduced;
  }

  StudyFile read(const toml::table& root) {
    refuse_other_kinds(root);
    for (const auto& [key, node] : root)
      read_top(std::string(key.str()), key, node);
    demand(study_, "", Place{1, 1});
    if (!root.contains("objective"))
      fault({1, 1}, "objective", "the table [objective] is missing; it has to give output");
    if (!root.contains("variable"))
      fault({1, 1}, "variable", "nothing varies; give at least one [[variable]] with path, lower and upper");
    if (study_.kind == StudyKind::pareto && !root.contains("pareto"))
      fault({1, 1}, "pareto", "the table [pareto] is missing; it has to give output, the aim that competes");
    if (study_.kind != StudyKind::pareto && root.contains("pareto"))
      fault(place_of(*root.get("pareto")), "pareto", "is of no use in a study of kind \"optimize\"");
    read_gear(root);
    if (const toml::node* node = root.get("reduced"); node && node->is_table())
      read_reduced(*node->as_table());
    if (study_.load_cases.empty())
      take_loads_from_gear();
    check_study(study_, places_, vocabulary_, faults_);
    if (!faults_.empty())
      throw FileError(study_.file, std::move(faults_));
    return std::move(study_);
  }

private:
  void fault(Place place, std::string key, std::string sentence, std::string nearest = "") {
    faults_.push_back({place, std::move(key), std::move(sentence), std::move(nearest)});
  }

  /// The keys of other kinds are not known here, so nothing else is said about their files.
  void refuse_other_kinds(const toml::table& root) {
    const toml::node* kind = root.get("kind");
    if (!kind || !kind->is_string())
      return;
    const std::string& name = kind->as_string()->get();
    const auto known = std::find(study_kinds.begin(), study_kinds.end(), name);
    if (known == study_kinds.end() || known < study_kinds.begin() + runnable_kinds)
      return;
    throw FileError(
        study_.file,
        {{place_of(*kind), "kind",
          fmt::format("the kind \"{}\" is not available in this version, which runs \"{}\" and \"{}\"", name,
                      study_kinds[0], study_kinds[1]),
          ""}});
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
    if constexpr (std::is_same_v<Table, StudyVariable>) {
      if (name == "link")
        return read_link(table, prefix + "link", key_place, node);
      legal.push_back("link");
    }
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

  void read_link(StudyVariable& variable, const std::string& path, Place key_place, const toml::node& node) {
    if (!node.is_table())
      return fault(key_place, path,
                   fmt::format("expected {{ path = \"…\", ratio = … }}, got {}", node_words(node)));
    variable.link.emplace();
    read_table(*variable.link, path, key_place, node);
  }

  template <class Table>
  void demand(const Table& table, const std::string& prefix, Place place) {
    for (const auto& key : study_keys(table)) {
      const std::string path = prefix + std::string(key.field.path);
      if (key.field.required && !given_.contains(path) && !meant_.contains(path))
        fault(place, path,
              fmt::format("missing; expected {}: {}", expectation(key.field), key.field.sentence));
    }
  }

  void read_top(const std::string& name, const toml::key& key, const toml::node& node) {
    const Place place = place_of(key);
    if (name == "override" || name == "reduced") { // read later, when the gear is there
      if (!node.is_table())
        fault(place, name, fmt::format("expected a table, opened by [{}], got {}", name, node_words(node)));
    } else if (name == "load_case")
      read_tables(study_.load_cases, name, place, node);
    else if (name == "variable")
      read_tables(study_.variables, name, place, node);
    else if (name == "constraint")
      read_tables(study_.constraints, name, place, node);
    else if (name == "objective")
      read_table(study_.objective, name, place, node);
    else if (name == "pareto")
      read_table(study_.pareto, name, place, node);
    else if (name == "method")
      read_table(study_.method, name, place, node);
    else if (name == "limits")
      read_table(study_.limits, name, place, node);
    else if (name == "kind" || name == "gear" || name == "seed")
      read_key(study_, "", name, place, node);
    else if (std::find(tables_of_other_kinds.begin(), tables_of_other_kinds.end(), name) !=
             tables_of_other_kinds.end())
      fault(place, name, fmt::format("is of no use in a study of kind \"{}\"", study_kinds.front()));
    else {
      const Nearest nearest = nearest_name(name, top_level);
      fault(place, name,
            fmt::format(fmt::runtime(nearest.close ? "no such key or table; did you mean {}?"
                                                   : "no such key or table; the nearest legal one is {}"),
                        nearest.name),
            std::string(nearest.name));
      meant_.insert(std::string(nearest.name));
    }
  }

  /// The gear file's own faults are thrown as they are: they are to be corrected there.
  void read_gear(const toml::table& root) {
    if (study_.gear_file.empty())
      return;
    const std::string path = fs::absolute(folder_ / study_.gear_file).lexically_normal().string();
    study_.gear_file = path;
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) {
      try {
        (void)read_text_file(path, "gear file");
      } catch (const FileError& error) {
        fault(places_["gear"], "gear", fmt::format("{}: {}", path, error.faults().front().sentence));
        study_.gear_file.clear();
        return;
      }
    }
    study_.gear = load_gear(path).gear;
    if (const toml::node* node = root.get("override"); node && node->is_table()) {
      apply_overrides(study_.gear, *node->as_table(), folder_, faults_);
      note_changes(study_.overrides, *node->as_table(), "");
    }
  }

  static void note_changes(std::vector<StudyChange>& changes, const toml::table& table,
                           const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string path = prefix + std::string(key.str());
      if (node.is_table())
        note_changes(changes, *node.as_table(), path + ".");
      else if (auto value = plain_value(node))
        changes.push_back({path, std::move(*value)});
    }
  }

  /// Always read, so that a slip shows before an overnight run; kept only if the reduced study is wanted.
  void read_reduced(const toml::table& table) {
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
  void settle_reduced_changes() {
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

  void apply_below(const std::string& prefix, const toml::table& table) {
    for (const auto& [key, node] : table) {
      const std::string path = fmt::format("{}.{}", prefix, key.str());
      if (node.is_table())
        apply_below(path, *node.as_table());
      else
        apply_override(study_.gear, path, node, place_of(key), folder_, faults_);
    }
  }

  static bool is_gear_path(std::string_view path) {
    const std::string_view first = path.substr(0, path.find('.'));
    return find_table(first) != nullptr;
  }

  /// "method.budget", "load_case[0].phases", or a key of the gear.
  void reduce(const std::string& path, Place key_place, const toml::node& node) {
    if (is_gear_path(path))
      return apply_override(study_.gear, path, node, key_place, folder_, faults_);
    const std::size_t dot = path.find('.');
    const std::string table = path.substr(0, dot), key = dot == std::string::npos ? "" : path.substr(dot + 1);
    if (path == "seed")
      return read_key(study_, "", path, key_place, node);
    if (table == "method" && !key.empty())
      return read_key(study_.method, "method.", key, key_place, node);
    if (table == "pareto" && !key.empty())
      return read_key(study_.pareto, "pareto.", key, key_place, node);
    if (table == "limits" && !key.empty())
      return read_key(study_.limits, "limits.", key, key_place, node);
    if (table == "objective" && !key.empty())
      return read_key(study_.objective, "objective.", key, key_place, node);
    if (reduce_item(study_.load_cases, "load_case", table, key, key_place, node))
      return;
    if (reduce_item(study_.variables, "variable", table, key, key_place, node))
      return;
    if (reduce_item(study_.constraints, "constraint", table, key, key_place, node))
      return;
    fault(key_place, "reduced." + path,
          "no such key of a study or of a gear; expected, for example, \"method.budget\", "
          "\"load_case[0].phases\" or "
          "\"mesh.per_pitch\"");
  }

  template <class Table>
  bool reduce_item(std::vector<Table>& tables, std::string_view name, const std::string& indexed,
                   const std::string& key, Place key_place, const toml::node& node) {
    if (!indexed.starts_with(name) || key.empty())
      return false;
    const std::string index = indexed.substr(name.size());
    std::size_t i = 0;
    const bool bracketed = index.size() > 2 && index.front() == '[' && index.back() == ']';
    const char* const end = index.data() + index.size() - 1;
    const bool read = bracketed && std::from_chars(index.data() + 1, end, i).ptr == end;
    if (!read) {
      fault(key_place, "reduced." + indexed + "." + key,
            fmt::format("says not which one; write {}[0].{}", name, key));
    } else if (i >= tables.size()) {
      fault(key_place, "reduced." + indexed + "." + key,
            fmt::format("there are only {} [[{}]], counted from 0", tables.size(), name));
    } else {
      read_key(tables[i], indexed + ".", key, key_place, node);
    }
    return true;
  }

  void take_loads_from_gear() {
    const Load& load = study_.gear.load;
    const LoadCase common{
        .torque_nm = {}, .rotation_rad = {}, .phases = load.phases, .direction = load.direction};
    for (const double torque_nm : load.torque_nm)
      study_.load_cases.emplace_back(common).torque_nm = torque_nm;
    for (const double rotation_rad : load.rotation_rad)
      study_.load_cases.emplace_back(common).rotation_rad = rotation_rad;
    if (study_.load_cases.empty() && !study_.gear_file.empty())
      fault({1, 1}, "load_case",
            "there is no load: neither a [[load_case]] here nor a torque or rotation in the gear's [load]");
  }

  StudyFile study_;
  fs::path folder_;
  const StudyVocabulary& vocabulary_;
  std::vector<FileFault> faults_;
  std::map<std::string, Place> given_; ///< keys that the file gives, right or wrong
  StudyPlaces places_;                 ///< values that were read, and tables
  std::set<std::string> meant_;        ///< legal keys that misspelt ones stand for
};

} // namespace

StudyFile parse_study(std::string_view text, const std::string& name, bool reduced,
                      const StudyVocabulary& vocabulary) {
  const toml::table root = parse_toml(text, name);
  if (root.empty())
    throw FileError(
        name, {{{1, 1}, "", "the file gives no key; expected kind, gear, [[variable]], [objective] …", ""}});
  return Reader(name, reduced, vocabulary).read(root);
}

bool is_study_text(std::string_view text) {
  try {
    const toml::table root = parse_toml(text, "");
    return root.contains("kind") || root.contains("gear") || root.contains("variable") ||
           root.contains("objective");
  } catch (const FileError&) {
    return false;
  }
}

StudyFile load_study(const std::string& path, bool reduced, const StudyVocabulary& vocabulary) {
  return parse_study(read_text_file(path, "study file"), path, reduced, vocabulary);
}

} // namespace strainwave
