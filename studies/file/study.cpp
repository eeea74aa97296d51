#include "strainwave/studies/file/study.hpp"

#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/studies/file/reader.hpp"

#include <algorithm>

namespace strainwave {

namespace fs = std::filesystem;

StudyReader::StudyReader(const std::string& name, bool reduced, const StudyVocabulary& vocabulary,
                         std::optional<std::string_view> gear_text)
    : folder_(fs::path(name).parent_path()), vocabulary_(vocabulary), gear_text_(gear_text) {
  study_.file = name;
  study_.reduced = reduced;
}

StudyFile StudyReader::read(const toml::table& root) {
  read_kind(root);
  for (const auto& [key, node] : root)
    read_top(std::string(key.str()), key, node);
  if (!given_.contains("limits.failure_share"))
    study_.limits.failure_share = default_failure_share(study_.kind);
  demand(study_, "", Place{1, 1});
  demand_headings(root);
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

/// A search looks for the edge of what works; a sample that fails is a hole in a table.
double default_failure_share(StudyKind kind) {
  return kind == StudyKind::optimize || kind == StudyKind::pareto ? 0.5 : 0.01;
}

/// What a heading means depends on the kind, so it comes first; what is wrong with it is said by read_top().
void StudyReader::read_kind(const toml::table& root) {
  const toml::node* kind = root.get("kind");
  if (!kind || !kind->is_string())
    return;
  const auto known = std::find(study_kinds.begin(), study_kinds.end(), kind->as_string()->get());
  if (known != study_kinds.end())
    study_.kind = static_cast<StudyKind>(known - study_kinds.begin());
}

void StudyReader::demand_headings(const toml::table& root) {
  for (const StudyHeading& heading : study_headings())
    if (heading.needed(study_.kind) && !root.contains(heading.name))
      fault({1, 1}, std::string(heading.name), std::string(heading.missing));
}

void StudyReader::read_top(const std::string& name, const toml::key& key, const toml::node& node) {
  const Place place = place_of(key);
  if (name == "kind" || name == "gear" || name == "seed")
    return read_key(study_, "", name, place, node);
  const auto headings = study_headings();
  const auto heading =
      std::find_if(headings.begin(), headings.end(), [&](const StudyHeading& h) { return h.name == name; });
  if (heading == headings.end()) {
    std::vector<std::string_view> legal{"kind", "gear", "seed"};
    for (const StudyHeading& h : headings)
      if (h.belongs_to(study_.kind))
        legal.push_back(h.name);
    const Nearest nearest = nearest_name(name, legal);
    fault(place, name,
          fmt::format(fmt::runtime(nearest.close ? "no such key or table; did you mean {}?"
                                                 : "no such key or table; the nearest legal one is {}"),
                      nearest.name),
          std::string(nearest.name));
    meant_.insert(std::string(nearest.name));
    return;
  }
  if (!heading->belongs_to(study_.kind))
    return fault(place, name,
                 fmt::format("is of no use in a study of kind \"{}\"",
                             study_kinds[static_cast<std::size_t>(study_.kind)]));
  if (name == "override" || name == "reduced") { // read later, when the gear is there
    if (!node.is_table())
      fault(place, name, fmt::format("expected a table, opened by [{}], got {}", name, node_words(node)));
  } else if (name == "load_case")
    read_tables(study_.load_cases, name, place, node);
  else if (name == "variable" && study_.kind == StudyKind::sweep)
    read_tables(study_.sweep_variables, name, place, node);
  else if (name == "variable")
    read_tables(study_.variables, name, place, node);
  else if (name == "constraint")
    read_tables(study_.constraints, name, place, node);
  else if (name == "source")
    read_tables(study_.sources, name, place, node);
  else if (name == "correlation")
    read_tables(study_.correlations, name, place, node);
  else if (name == "exceedance")
    read_tables(study_.exceedances, name, place, node);
  else if (name == "objective")
    read_table(study_.objective, name, place, node);
  else if (name == "pareto")
    read_table(study_.pareto, name, place, node);
  else if (name == "method")
    read_table(study_.method, name, place, node);
  else if (name == "sweep")
    read_table(study_.sweep, name, place, node);
  else if (name == "sampling")
    read_table(study_.sampling, name, place, node);
  else if (name == "sensitivity")
    read_table(study_.sensitivity, name, place, node);
  else if (name == "limits")
    read_table(study_.limits, name, place, node);
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

template <class Shape>
void StudyReader::read_shape(Distribution& distribution, const std::string& path, const toml::node& node) {
  Shape shape;
  read_inner(shape, path, "{ … }", node);
  distribution = shape;
}

void StudyReader::read_distribution(Distribution& distribution, const std::string& path,
                                    const toml::node& node) {
  given_.emplace(path, place_of(node));
  const toml::table* table = node.as_table();
  if (!table || table->size() != 1)
    return fault(
        place_of(node), path,
        fmt::format(
            "expected one distribution, for example {{ normal = {{ mean = 0.0, std = 1.0 }} }}, got {}",
            table ? fmt::format("{} of them", table->size()) : node_words(node)));
  places_[path] = place_of(node);
  const std::string name(table->begin()->first.str());
  const Place name_place = place_of(table->begin()->first);
  const toml::node& inside = table->begin()->second;
  const std::string below = path + "." + name;
  using Read = void (StudyReader::*)(Distribution&, const std::string&, const toml::node&);
  static constexpr std::array<Read, distribution_names.size()> readers{
      &StudyReader::read_shape<Normal>,    &StudyReader::read_shape<TruncatedNormal>,
      &StudyReader::read_shape<Uniform>,   &StudyReader::read_shape<Triangular>,
      &StudyReader::read_shape<Lognormal>, &StudyReader::read_shape<Tabulated>};
  const auto known = std::find(distribution_names.begin(), distribution_names.end(), name);
  if (known != distribution_names.end())
    return (this->*readers[static_cast<std::size_t>(known - distribution_names.begin())])(distribution, below,
                                                                                          inside);
  const Nearest nearest = nearest_name(name, distribution_names);
  fault(name_place, below,
        fmt::format(fmt::runtime(nearest.close ? "no such distribution; did you mean {}?"
                                               : "no such distribution; the nearest legal one is {}"),
                    nearest.name),
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

StudyFile parse_study(std::string_view text, const std::string& name, bool reduced,
                      const StudyVocabulary& vocabulary) {
  const toml::table root = parse_toml(text, name);
  if (root.empty())
    throw FileError(
        name, {{{1, 1}, "", "the file gives no key; expected kind, gear, [[variable]], [objective] …", ""}});
  return StudyReader(name, reduced, vocabulary).read(root);
}

StudyFile restore_study(std::string_view text, std::string_view gear_text, const std::string& name,
                        const StudyVocabulary& vocabulary) {
  return StudyReader(name, false, vocabulary, gear_text).read(parse_toml(text, name));
}

bool is_study_text(std::string_view text) {
  try {
    const toml::table root = parse_toml(text, "");
    return root.contains("kind") || root.contains("gear") || root.contains("variable") ||
           root.contains("objective") || root.contains("source");
  } catch (const FileError&) {
    return false;
  }
}

StudyFile load_study(const std::string& path, bool reduced, const StudyVocabulary& vocabulary) {
  return parse_study(read_text_file(path, "study file"), path, reduced, vocabulary);
}

} // namespace strainwave
