#include "strainwave/studies/file/study.hpp"

#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/studies/file/reader.hpp"

#include <algorithm>

namespace strainwave {

namespace fs = std::filesystem;

StudyFile::StudyFile(const StudyKind& of_kind) : kind(&of_kind), own(of_kind.part()) {
  limits.failure_share = of_kind.failure_share();
}

StudyReader::StudyReader(const std::string& name, StudyKinds kinds, bool reduced,
                         std::optional<std::string_view> gear_text)
    : study_(*kinds.front()), folder_(fs::path(name).parent_path()), kinds_(kinds),
      kind_names_(kind_names(kinds)), top_(top_keys(kind_names_)), gear_text_(gear_text) {
  study_.file = name;
  study_.reduced = reduced;
}

StudyFile StudyReader::read(const toml::table& root) {
  read_kind(root);
  for (const auto& [key, node] : root)
    read_top(std::string(key.str()), key, node);
  demand(top_, "", Place{1, 1});
  demand_tables(root);
  read_gear(root);
  if (const toml::node* node = root.get("reduced"); node && node->is_table())
    read_reduced(*node->as_table());
  if (study_.load_cases.empty())
    take_loads_from_gear();
  StudyChecker checker(study_, places_, faults_);
  checker.check_loads();
  study_.kind->check(checker);
  if (!faults_.empty())
    throw FileError(study_.file, std::move(faults_));
  return std::move(study_);
}

/// What a table means depends on the kind, so it comes first; what is wrong with it is said by read_top().
void StudyReader::read_kind(const toml::table& root) {
  if (const toml::node* kind = root.get("kind"); kind && kind->is_string()) {
    const auto known = std::ranges::find(kind_names_, std::string_view(kind->as_string()->get()));
    if (known != kind_names_.end()) {
      StudyFile study(*kinds_[static_cast<std::size_t>(known - kind_names_.begin())]);
      study.file = study_.file;
      study.reduced = study_.reduced;
      study_ = std::move(study);
    }
  }
  tables_ = study_tables(*study_.kind);
}

const StudyTable* StudyReader::find_study_table(std::string_view name) const {
  const auto found = std::ranges::find(tables_, name, &StudyTable::name);
  return found == tables_.end() ? nullptr : &*found;
}

void StudyReader::demand_tables(const toml::table& root) {
  for (const StudyTable& table : tables_)
    if (!table.missing.empty() && !root.contains(table.name))
      fault({1, 1}, std::string(table.name), std::string(table.missing));
}

void StudyReader::read_top(const std::string& name, const toml::key& key, const toml::node& node) {
  const Place place = place_of(key);
  if (std::ranges::any_of(top_, [&](const StudyKey& top) { return top.field.path == name; }))
    return read_key(top_, &study_, "", name, place, node);
  if (const StudyTable* table = find_study_table(name)) {
    if (table->repeated)
      return read_tables(*table, place, node);
    if (table->keys)
      return read_table(table->keys(), table->at(study_, 0), name, place, node);
    if (!node.is_table()) // read later, when the gear is there
      fault(place, name, fmt::format("expected a table, opened by [{}], got {}", name, node_words(node)));
    return;
  }
  for (const StudyKind* kind : kinds_)
    for (const StudyTable& other : kind->tables())
      if (other.name == name)
        return fault(place, name, fmt::format("is of no use in a study of kind \"{}\"", study_.kind->name()));
  std::vector<std::string_view> legal;
  for (const StudyKey& top : top_)
    legal.push_back(top.field.path);
  for (const StudyTable& table : tables_)
    legal.push_back(table.name);
  const Nearest nearest = nearest_name(name, legal);
  fault(place, name,
        fmt::format(fmt::runtime(nearest.close ? "no such key or table; did you mean {}?"
                                               : "no such key or table; the nearest legal one is {}"),
                    nearest.name),
        std::string(nearest.name));
  meant_.insert(std::string(nearest.name));
}

void StudyReader::read_key(StudyKeys keys, void* table, const std::string& prefix, const std::string& name,
                           Place key_place, const toml::node& node) {
  std::vector<std::string_view> legal;
  for (const StudyKey& key : keys) {
    legal.push_back(key.field.path);
    if (key.field.path != name)
      continue;
    const std::string path = prefix + name;
    if (key.holds != StudyKey::Holds::value)
      return read_compound(key, table, path, key_place, node);
    given_.emplace(path, key_place);
    if (const auto value = read_value(key.field, path, node, faults_)) {
      key.write(table, *value);
      places_[path] = place_of(node);
    }
    return;
  }
  const Nearest nearest = nearest_name(name, legal);
  fault(key_place, prefix + name,
        fmt::format(fmt::runtime(nearest.close ? "no such key; did you mean {}?"
                                               : "no such key; the nearest legal key is {}"),
                    nearest.name),
        prefix + std::string(nearest.name));
  meant_.insert(prefix + std::string(nearest.name));
}

void StudyReader::read_table(StudyKeys keys, void* table, const std::string& path, Place key_place,
                             const toml::node& node) {
  const toml::table* inside = node.as_table();
  if (!inside)
    return fault(key_place, path,
                 fmt::format("expected a table, opened by [{}], got {}", path, node_words(node)));
  places_[path] = place_of(node);
  for (const auto& [key, value] : *inside)
    read_key(keys, table, path + ".", std::string(key.str()), place_of(key), value);
  demand(keys, path + ".", place_of(node));
}

void StudyReader::read_tables(const StudyTable& tables, Place key_place, const toml::node& node) {
  const std::string name(tables.name);
  const toml::array* array = node.as_array();
  if (!array)
    return fault(key_place, name,
                 node.is_table()
                     ? fmt::format("there may be several of these, so each is opened by [[{}]]", name)
                     : fmt::format("expected tables, each opened by [[{}]], got {}", name, node_words(node)));
  for (std::size_t i = 0; i < array->size(); ++i)
    read_table(tables.keys(), tables.add(study_), fmt::format("{}[{}]", name, i), place_of(*array->get(i)),
               *array->get(i));
}

void StudyReader::read_compound(const StudyKey& key, void* table, const std::string& path, Place key_place,
                                const toml::node& node) {
  if (key.holds == StudyKey::Holds::names)
    read_names(*key.names(table), path, key_place, node);
  else if (key.holds == StudyKey::Holds::one_of)
    read_one_of(key, table, path, node);
  else
    read_inner(key.shapes.front(), table, path, key.example, node);
}

void StudyReader::read_inner(const StudyShape& shape, void* table, const std::string& path,
                             std::string_view expected, const toml::node& node) {
  given_.emplace(path, place_of(node));
  void* const inner = shape.put(table);
  if (!node.is_table())
    return fault(place_of(node), path, fmt::format("expected {}, got {}", expected, node_words(node)));
  read_table(shape.keys(), inner, path, place_of(node), node);
}

void StudyReader::demand(StudyKeys keys, const std::string& prefix, Place place) {
  for (const StudyKey& key : keys) {
    const std::string path = prefix + std::string(key.field.path);
    if (key.field.required && !given_.contains(path) && !meant_.contains(path))
      fault(place, path, fmt::format("missing; expected {}: {}", expectation(key.field), key.field.sentence));
  }
}

void StudyReader::read_names(std::vector<std::string>& names, const std::string& path, Place key_place,
                             const toml::node& node) {
  given_.emplace(path, key_place);
  const toml::array* array = node.as_array();
  if (!array)
    return fault(place_of(node), path, fmt::format("expected a list of texts, got {}", node_words(node)));
  places_[path] = place_of(node);
  names.clear();
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& item = *array->get(i);
    const std::string key = fmt::format("{}[{}]", path, i);
    if (!item.is_string()) {
      fault(place_of(item), key, fmt::format("expected a text, got {}", node_words(item)));
      continue;
    }
    places_[key] = place_of(item);
    names.push_back(item.as_string()->get());
  }
}

void StudyReader::read_one_of(const StudyKey& key, void* table, const std::string& path,
                              const toml::node& node) {
  given_.emplace(path, place_of(node));
  const toml::table* inside = node.as_table();
  if (!inside || inside->size() != 1)
    return fault(place_of(node), path,
                 fmt::format("expected one {}, for example {}, got {}", key.what, key.example,
                             inside ? fmt::format("{} of them", inside->size()) : node_words(node)));
  places_[path] = place_of(node);
  const std::string name(inside->begin()->first.str());
  const std::string below = path + "." + name;
  std::vector<std::string_view> legal;
  for (const StudyShape& shape : key.shapes) {
    if (shape.name == name)
      return read_inner(shape, table, below, "{ … }", inside->begin()->second);
    legal.push_back(shape.name);
  }
  const Nearest nearest = nearest_name(name, legal);
  fault(place_of(inside->begin()->first), below,
        fmt::format(fmt::runtime(nearest.close ? "no such {}; did you mean {}?"
                                               : "no such {}; the nearest legal one is {}"),
                    key.what, nearest.name),
        path + "." + std::string(nearest.name));
}

/// The gear file's own faults are thrown as they are: they are to be corrected there.
void StudyReader::read_gear(const toml::table& root) {
  if (study_.gear_file.empty())
    return;
  const std::string path = fs::absolute(folder_ / study_.gear_file).lexically_normal().string();
  study_.gear_file = path;
  std::error_code ignored;
  if (!gear_text_ && !fs::is_regular_file(path, ignored)) {
    try {
      (void)read_text_file(path, "gear file");
    } catch (const FileError& error) {
      fault(places_["gear"], "gear", fmt::format("{}: {}", path, error.faults().front().sentence));
      study_.gear_file.clear();
      return;
    }
  }
  study_.gear = gear_text_ ? parse_gear(*gear_text_, study_.file).gear : load_gear(path).gear;
  if (const toml::node* node = root.get("override"); node && node->is_table()) {
    apply_overrides(study_.gear, *node->as_table(), folder_, faults_);
    note_changes(study_.overrides, *node->as_table(), "");
  }
}

void StudyReader::take_loads_from_gear() {
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

StudyFile parse_study(std::string_view text, const std::string& name, StudyKinds kinds, bool reduced) {
  const toml::table root = parse_toml(text, name);
  if (root.empty())
    throw FileError(
        name, {{{1, 1}, "", "the file gives no key; expected kind, gear, [[variable]], [objective] …", ""}});
  return StudyReader(name, kinds, reduced).read(root);
}

StudyFile restore_study(std::string_view text, std::string_view gear_text, const std::string& name,
                        StudyKinds kinds) {
  return StudyReader(name, kinds, false, gear_text).read(parse_toml(text, name));
}

bool is_study_text(std::string_view text, StudyKinds kinds) {
  try {
    const toml::table root = parse_toml(text, "");
    return root.contains("kind") || root.contains("gear") ||
           std::ranges::any_of(kinds, [&](const StudyKind* kind) {
             return std::ranges::any_of(kind->tables(), [&](const StudyTable& table) {
               return !find_table(table.name) && root.contains(table.name);
             });
           });
  } catch (const FileError&) {
    return false;
  }
}

StudyFile load_study(const std::string& path, StudyKinds kinds, bool reduced) {
  return parse_study(read_text_file(path, "study file"), path, kinds, reduced);
}

} // namespace strainwave
