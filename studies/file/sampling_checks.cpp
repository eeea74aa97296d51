// Checks of sweeps, tolerances and sensitivities.

#include "strainwave/studies/file/checker.hpp"
#include "strainwave/studies/file/keys.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace strainwave {

namespace {

class SampledChecker : StudyChecker {
public:
  using StudyChecker::StudyChecker;

  void run() {
    if (study_.kind == StudyKind::sweep)
      return check_sweep();
    if (study_.kind != StudyKind::monte_carlo && study_.kind != StudyKind::sensitivity)
      return;
    for (std::size_t i = 0; i < study_.sources.size(); ++i)
      check_source(i);
    for (std::size_t i = 0; i < study_.correlations.size(); ++i)
      check_correlation(i);
    if (study_.kind == StudyKind::monte_carlo)
      check_sampling();
    else
      check_sensitivity();
  }

private:
  // ---- sweeps

  void check_sweep() {
    for (std::size_t i = 0; i < study_.sweep_variables.size(); ++i)
      check_sweep_variable(i);
    for (std::size_t i = 0; i < study_.sweep.outputs.size(); ++i)
      check_output(fmt::format("sweep.outputs[{}]", i), study_.sweep.outputs[i]);
    if (study_.sweep.mode == SweepMode::list)
      check_lengths();
  }

  void check_sweep_variable(std::size_t i) {
    const SweepVariable& v = study_.sweep_variables[i];
    const std::string table = fmt::format("variable[{}]", i);
    const bool even = v.lower || v.upper || v.count;
    if (v.values.empty() && !(v.lower && v.upper && v.count))
      return fault(table, "has no values; give values, or lower, upper and count");
    if (!v.values.empty() && even)
      return fault(table, "has both values and evenly spaced ones; give values, or lower, upper and count");
    if (even && !(*v.lower < *v.upper))
      return fault(table + ".upper",
                   fmt::format("must be above lower = {}, is {}", shortest(*v.lower), shortest(*v.upper)));
    const std::vector<double> values = sweep_values(v);
    if (v.path.starts_with("load_case["))
      check_load_path(table + ".path", v.path, values);
    else if (v.path.starts_with("load."))
      fault(table + ".path",
            "the loads of a study are its load cases; write load_case[0].torque_nm, for example");
    else if (const auto number = continuous_number(table + ".path", v.path, true)) {
      check_values(table, *number, values, 1.0);
      claim(table + ".path", number->path());
    }
    if (!v.link)
      return;
    if (const auto number = continuous_number(table + ".link.path", v.link->path)) {
      check_values(table + ".link", *number, values, v.link->ratio);
      claim(table + ".link.path", number->path());
    }
  }

  void check_values(const std::string& table, const NumberPath& number, const std::vector<double>& values,
                    double ratio) {
    const std::string key = given(table + ".values")  ? table + ".values"
                            : given(table + ".ratio") ? table + ".ratio"
                                                      : table + ".lower";
    for (const double value : values) {
      if (number.field().kind == FieldKind::integer && std::round(ratio * value) != ratio * value)
        return fault(key,
                     fmt::format("{} is a whole number; {} is none", number.path(), shortest(ratio * value)));
      const std::size_t before = faults_.size();
      check_in_range(key, number, ratio * value);
      if (faults_.size() > before)
        return;
    }
  }

  void check_load_path(const std::string& key, const std::string& path, const std::vector<double>& values) {
    const auto load = sweep_load(path);
    if (!load)
      return fault(
          key,
          fmt::format("{} is no load; expected load_case[0].torque_nm or load_case[0].rotation_rad", path));
    if (load->number >= study_.load_cases.size())
      return fault(key,
                   fmt::format("there are only {} load cases, counted from 0", study_.load_cases.size()));
    const LoadCase& c = study_.load_cases[load->number];
    if (load->torque != c.torque_nm.has_value())
      return fault(key, fmt::format("load case {} is given by its {}", load->number,
                                    c.torque_nm ? "torque_nm" : "rotation_rad"));
    for (const double value : values)
      if (!(value >= 0.0) || value > (load->torque ? 1e6 : 1.0))
        return fault(key, fmt::format("the load must be at least 0 and at most {}, is {}",
                                      load->torque ? "1000000 N·m" : "1 rad", shortest(value)));
    claim(key, path);
  }

  void check_lengths() {
    for (std::size_t i = 1; i < study_.sweep_variables.size(); ++i) {
      const std::size_t first = sweep_values(study_.sweep_variables[0]).size();
      const std::size_t here = sweep_values(study_.sweep_variables[i]).size();
      if (first > 0 && here > 0 && here != first)
        fault(fmt::format("variable[{}]", i),
              fmt::format("has {} values, the first variable has {}; in mode \"list\" all have equally many",
                          here, first));
    }
  }

  // ---- sources

  void check_source(std::size_t i) {
    const StudySource& source = study_.sources[i];
    const std::string table = fmt::format("source[{}]", i);
    if (given(table + ".name")) {
      if (source.name.empty())
        fault(table + ".name", "is empty");
      for (std::size_t k = 0; k < i; ++k)
        if (study_.sources[k].name == source.name)
          fault(table + ".name", fmt::format("\"{}\" is the name of an earlier source (line {}) already",
                                             source.name, place(fmt::format("source[{}].name", k)).line));
    }
    if (!given(table + ".distribution"))
      fault(table,
            "has no distribution; give, for example, distribution = { normal = { mean = 0.0, std = 1.0 } }");
    else
      check_distribution_of(table + ".distribution", source.distribution);
    if (!given(table + ".kind"))
      return;
    if (source.kind == SourceKind::gear_key) {
      if (!given(table + ".path"))
        return fault(table, "has no path; kind \"gear_key\" wants the number of the gear that it means");
      if (const auto number = continuous_number(table + ".path", source.path))
        claim(table + ".path", number->path());
    } else if (given(table + ".path")) {
      fault(table + ".path", "is of use with kind \"gear_key\" only");
    }
    if (given(table + ".harmonic") && source.kind != SourceKind::cumulative_pitch)
      fault(table + ".harmonic", "is of use with kind \"cumulative_pitch\" only");
    const bool of_spline = source.kind == SourceKind::centre_offset || source.kind == SourceKind::ovality;
    if (given(table + ".member") && of_spline && source.member == SourceMember::flexspline)
      fault(table + ".member", fmt::format("{} is an error of the circular spline",
                                           source_kind_names[static_cast<std::size_t>(source.kind)]));
  }

  void check_distribution_of(const std::string& key, const Distribution& distribution) {
    const std::size_t shape = distribution.index();
    const std::string below = fmt::format("{}.{}", key, distribution_names[shape]);
    if (!given(below))
      return; // said already
    for (const FileFault& known : faults_)
      if (known.key.starts_with(below))
        return;
    try {
      check_distribution(distribution);
    } catch (const std::invalid_argument& error) {
      fault(key, error.what());
    }
  }

  void check_correlation(std::size_t i) {
    const StudyCorrelation& c = study_.correlations[i];
    const std::string table = fmt::format("correlation[{}]", i);
    std::vector<std::string_view> names;
    for (const StudySource& source : study_.sources)
      names.push_back(source.name);
    check_name(table + ".first", c.first, names, "source");
    check_name(table + ".second", c.second, names, "source");
    if (given(table + ".first") && given(table + ".second") && c.first == c.second)
      fault(table + ".second", "is the same source as first");
    for (std::size_t k = 0; k < i; ++k) {
      const StudyCorrelation& other = study_.correlations[k];
      if ((other.first == c.first && other.second == c.second) ||
          (other.first == c.second && other.second == c.first))
        fault(table, fmt::format("these two sources are correlated already (correlation[{}])", k));
    }
    for (const auto& [key, name] : {std::pair{".first", &c.first}, {".second", &c.second}})
      for (const StudySource& source : study_.sources)
        if (source.name == *name && !is_one_number(source.kind))
          fault(table + key,
                fmt::format(
                    "\"{}\" ({}) is several numbers of one gear; only sources that are one number can be "
                    "correlated: tooth_thickness, profile_slope, profile_form, wear and gear_key",
                    source.name, source_kind_names[static_cast<std::size_t>(source.kind)]));
    if (study_.kind == StudyKind::sensitivity)
      fault(table, "Sobol' indices, Morris screening and elasticities want independent sources");
  }

  static bool is_one_number(SourceKind kind) {
    return kind == SourceKind::tooth_thickness || kind == SourceKind::profile_slope ||
           kind == SourceKind::profile_form || kind == SourceKind::wear || kind == SourceKind::gear_key;
  }

  // ---- what is asked of the samples

  void check_sampled_output(const std::string& key, const std::string& name) {
    check_name(key, name, vocabulary_.sampled_outputs, "output");
  }

  void check_outputs(const std::string& key, const std::vector<std::string>& outputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      check_sampled_output(fmt::format("{}[{}]", key, i), outputs[i]);
      if (std::find(outputs.begin(), outputs.begin() + static_cast<std::ptrdiff_t>(i), outputs[i]) !=
          outputs.begin() + static_cast<std::ptrdiff_t>(i))
        fault(fmt::format("{}[{}]", key, i), fmt::format("{} is in the list already", outputs[i]));
    }
  }

  /// An output that is asked about has to be recorded.
  void check_recorded(const std::string& key, const std::string& name) {
    check_sampled_output(key, name);
    const auto& recorded = study_.sampling.outputs;
    if (given(key) && !recorded.empty() &&
        std::find(recorded.begin(), recorded.end(), name) == recorded.end())
      fault(key, fmt::format("{} is not among sampling.outputs", name));
  }

  void check_sampling() {
    const StudySampling& s = study_.sampling;
    check_outputs("sampling.outputs", s.outputs);
    for (std::size_t i = 0; i < study_.exceedances.size(); ++i)
      check_recorded(fmt::format("exceedance[{}].output", i), study_.exceedances[i].output);
    const std::string key = given("sampling.samples") ? "sampling.samples" : "sampling";
    if (s.design != SamplingDesign::random) {
      const int each = s.samples / s.randomisations;
      if (s.samples % s.randomisations != 0 || each < 4)
        fault(key, fmt::format("must be a multiple of randomisations = {}, and at least 4 each, is {}",
                               s.randomisations, s.samples));
      else if (s.design == SamplingDesign::sobol && !std::has_single_bit(static_cast<unsigned>(each)))
        fault(key,
              fmt::format("a Sobol' design wants randomisations = {} times a power of two, is {} ({} each)",
                          s.randomisations, s.samples, each));
    }
    if (!s.stop)
      return;
    check_recorded("sampling.stop.output", s.stop->output);
    if (s.stop->quantile && s.stop->limit)
      fault("sampling.stop", "has both quantile and limit; a study stops by one of them");
    if (s.design != SamplingDesign::random)
      fault("sampling.stop",
            "needs design = \"random\": the intervals of other designs need all their samples");
  }

  void check_sensitivity() {
    const StudySensitivity& s = study_.sensitivity;
    check_outputs("sensitivity.outputs", s.outputs);
    const std::string key = given("sensitivity.samples") ? "sensitivity.samples" : "sensitivity";
    if (s.method == SensitivityMethod::sobol &&
        (s.samples < 8 || !std::has_single_bit(static_cast<unsigned>(s.samples))))
      fault(key, fmt::format("must be a power of two, at least 8, is {}", s.samples));
    if (s.method == SensitivityMethod::morris && s.levels % 2 != 0)
      fault("sensitivity.levels", fmt::format("must be even, is {}", s.levels));
  }
};

} // namespace

std::optional<SweepLoad> sweep_load(std::string_view path) {
  constexpr std::string_view head = "load_case[";
  if (!path.starts_with(head))
    return std::nullopt;
  SweepLoad load;
  const char* const end = path.data() + path.size();
  const auto [after, error] = std::from_chars(path.data() + head.size(), end, load.number);
  const std::string_view rest(after, static_cast<std::size_t>(end - after));
  if (error != std::errc() || (rest != "].torque_nm" && rest != "].rotation_rad"))
    return std::nullopt;
  load.torque = rest == "].torque_nm";
  return load;
}

std::vector<double> sweep_values(const SweepVariable& v) {
  if (!v.values.empty() || !v.lower || !v.upper || !v.count)
    return v.values;
  std::vector<double> values(static_cast<std::size_t>(*v.count));
  for (std::size_t i = 0; i < values.size(); ++i) // both ends exactly
    values[i] = i + 1 == values.size() ? *v.upper
                                       : *v.lower + (*v.upper - *v.lower) * static_cast<double>(i) /
                                                        static_cast<double>(*v.count - 1);
  return values;
}

void check_sampled_study(const StudyFile& study, const StudyPlaces& places, const StudyVocabulary& vocabulary,
                         std::vector<FileFault>& faults) {
  SampledChecker(study, places, vocabulary, faults).run();
}

} // namespace strainwave
