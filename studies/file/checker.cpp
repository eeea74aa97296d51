#include "strainwave/studies/file/checker.hpp"

#include "strainwave/common/core/nearest.hpp"
#include "strainwave/model/results/response.hpp"
#include "strainwave/studies/file/study_gear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace strainwave {

Place StudyChecker::place(std::string key) const {
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

void StudyChecker::fault(const std::string& key, std::string sentence, std::string nearest) {
  faults_.push_back({place(key), key, std::move(sentence), std::move(nearest)});
}

bool StudyChecker::faulty(std::string_view start) const {
  return std::ranges::any_of(faults_, [&](const FileFault& fault) { return fault.key.starts_with(start); });
}

void StudyChecker::check_loads() {
  for (std::size_t i = 0; i < study_.load_cases.size(); ++i) {
    const std::string table = fmt::format("load_case[{}]", i);
    const LoadCase& load = study_.load_cases[i];
    if (given(table) &&
        load.torque_nm.has_value() == load.rotation_rad.has_value()) // else of the gear's [load]
      fault(table, load.torque_nm ? "has both torque_nm and rotation_rad; a load case has one of them"
                                  : "needs torque_nm or rotation_rad");
  }
}

void StudyChecker::check_name(const std::string& key, const std::string& name,
                              std::span<const std::string_view> legal, std::string_view what,
                              std::span<const Counterpart> counterparts) {
  if (!given(key) || legal.empty() || std::find(legal.begin(), legal.end(), name) != legal.end())
    return;
  for (const Counterpart& counterpart : counterparts) {
    if (counterpart.name == name) {
      fault(key,
            fmt::format("studies of this kind have no {} \"{}\"; they have \"{}\": {}", what, name,
                        counterpart.here, counterpart.sentence),
            std::string(counterpart.here));
      return;
    }
  }
  const Nearest nearest = nearest_name(name, legal);
  fault(key,
        fmt::format(fmt::runtime(nearest.close ? "there is no {} \"{}\"; did you mean \"{}\"?"
                                               : "there is no {} \"{}\"; the nearest legal one is \"{}\""),
                    what, name, nearest.name),
        std::string(nearest.name));
}

void StudyChecker::check_output(const std::string& key, const std::string& name) {
  check_name(key, name, gear_response_names(), "output");
  if (!given(key) || study_.gear_file.empty() || faulty("load_case"))
    return;
  if (const auto sentence = find_unavailable_response(name, study_.gear, study_loads(study_)))
    fault(key, fmt::format("{} {}", name, *sentence));
}

void StudyChecker::check_names(const std::string& key, const std::vector<std::string>& names,
                               std::span<const std::string_view> legal,
                               std::span<const Counterpart> counterparts) {
  for (auto name = names.begin(); name != names.end(); ++name) {
    const std::string item = fmt::format("{}[{}]", key, name - names.begin());
    check_name(item, *name, legal, "output", counterparts);
    if (std::find(names.begin(), name, *name) != name)
      fault(item, fmt::format("{} is in the list already", *name));
  }
}

std::optional<NumberPath> StudyChecker::continuous_number(const std::string& key, const std::string& path,
                                                          bool whole_allowed) {
  if (!given(key))
    return std::nullopt;
  if (names_load(path)) {
    fault(key, "is a load, which cannot vary here");
    return std::nullopt;
  }
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

void StudyChecker::check_in_range(const std::string& key, const NumberPath& number, double value) {
  const Field& field = number.field();
  if (field.range.contains(value) || !given(key))
    return;
  Field one = field;
  if (one.kind == FieldKind::number_list)
    one.kind = FieldKind::number;
  const bool whole = one.kind == FieldKind::integer && value == std::floor(value) && std::abs(value) < 1e9;
  const FieldValue given_value = whole ? FieldValue(static_cast<int>(value)) : FieldValue(value);
  fault(key, fmt::format("{} {}", number.path(), find_complaint(one, given_value)->sentence));
}

bool StudyChecker::names_load(std::string_view path) {
  return path.starts_with("load_case[") || path.starts_with("load.torque_nm") ||
         path.starts_with("load.rotation_rad");
}

std::optional<LoadKey> StudyChecker::load(const std::string& key, const std::string& path) {
  if (!given(key))
    return std::nullopt;
  const auto refuse = [&](std::string sentence) {
    fault(key, std::move(sentence));
    return std::nullopt;
  };
  if (path.starts_with("load."))
    return refuse("the loads of a study are its load cases; write load_case[0].torque_nm, for example");
  const auto load = load_key(path);
  if (!load)
    return refuse(
        fmt::format("{} is no load; expected load_case[0].torque_nm or load_case[0].rotation_rad", path));
  if (load->number >= study_.load_cases.size())
    return refuse(fmt::format("there are only {} load cases, counted from 0", study_.load_cases.size()));
  const LoadCase& c = study_.load_cases[load->number];
  if (load->torque != c.torque_nm.has_value())
    return refuse(fmt::format("load case {} is given by its {}", load->number,
                              c.torque_nm ? "torque_nm" : "rotation_rad"));
  return load;
}

void StudyChecker::claim(const std::string& key, const std::string& path) {
  const auto [first, is_new] = claimed_.emplace(path, place(key).line);
  if (!is_new)
    fault(key, fmt::format("{} varies already (line {})", path, first->second));
}

std::optional<LoadKey> load_key(std::string_view path) {
  constexpr std::string_view head = "load_case[";
  if (!path.starts_with(head))
    return std::nullopt;
  LoadKey load;
  const char* const end = path.data() + path.size();
  const auto [after, error] = std::from_chars(path.data() + head.size(), end, load.number);
  const std::string_view rest(after, static_cast<std::size_t>(end - after));
  if (error != std::errc() || (rest != "].torque_nm" && rest != "].rotation_rad"))
    return std::nullopt;
  load.torque = rest == "].torque_nm";
  return load;
}

} // namespace strainwave
