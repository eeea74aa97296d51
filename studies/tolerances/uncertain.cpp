#include "strainwave/studies/tolerances/uncertain.hpp"

#include "strainwave/studies/file/key_rows.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace strainwave {

using namespace study_rows;

// ---- keys

static std::span<const std::string_view> names_of(SourceKind) {
  return source_kind_names;
}
static std::span<const std::string_view> names_of(SourceMember) {
  static constexpr std::array<std::string_view, 2> names{"flexspline", "circular_spline"};
  return names;
}

/// Keys that say nothing about a source are left out: they would be refused when the file is read.
template <class Applies>
static StudyKey written_if(StudyKey key, Applies) {
  key.applies = [](const void* source) { return Applies{}(*static_cast<const StudySource*>(source)); };
  return key;
}

static StudyKeys study_keys(const Normal&) {
  static const std::array keys{
      row<&Normal::mean>("mean", "", any, "its mean", needed),
      row<&Normal::std>("std", "", above_zero(1e12), "its standard deviation", needed),
  };
  return keys;
}

static StudyKeys study_keys(const TruncatedNormal&) {
  static const std::array keys{
      row<&TruncatedNormal::mean>("mean", "", any, "mean before the cut", needed),
      row<&TruncatedNormal::std>("std", "", above_zero(1e12), "standard deviation before the cut", needed),
      row<&TruncatedNormal::lower>("lower", "", any, "least value", needed),
      row<&TruncatedNormal::upper>("upper", "", any, "largest value", needed),
  };
  return keys;
}

static StudyKeys study_keys(const Uniform&) {
  static const std::array keys{
      row<&Uniform::lower>("lower", "", any, "least value", needed),
      row<&Uniform::upper>("upper", "", any, "largest value", needed),
  };
  return keys;
}

static StudyKeys study_keys(const Triangular&) {
  static const std::array keys{
      row<&Triangular::lower>("lower", "", any, "least value", needed),
      row<&Triangular::mode>("mode", "", any, "most frequent value", needed),
      row<&Triangular::upper>("upper", "", any, "largest value", needed),
  };
  return keys;
}

static StudyKeys study_keys(const Lognormal&) {
  static const std::array keys{
      row<&Lognormal::mean>("mean", "", above_zero(1e12), "mean of the value", needed),
      row<&Lognormal::std>("std", "", above_zero(1e12), "standard deviation of the value", needed),
  };
  return keys;
}

static StudyKeys study_keys(const Tabulated&) {
  static const std::array keys{
      row<&Tabulated::value>("value", "", any, "values, ascending", needed),
      row<&Tabulated::cumulative>("cumulative", "", within(0.0, 1.0), "share at or below each, from 0 to 1",
                                  needed),
  };
  return keys;
}

StudyKeys study_keys(const StudySource&) {
  static const std::array keys{
      row<&StudySource::name>("name", "", any, "its name in results", needed),
      choice_row<&StudySource::kind>("kind", "what is not exact", needed),
      written_if(choice_row<&StudySource::member>("member", "of which gear"),
                 [](const StudySource& source) {
                   return source.kind != SourceKind::centre_offset && source.kind != SourceKind::ovality &&
                          source.kind != SourceKind::gear_key;
                 }),
      written_if(row<&StudySource::harmonic>("harmonic", "", within(1, 1000),
                                             "cumulative_pitch: periods over one turn"),
                 [](const StudySource& source) { return source.kind == SourceKind::cumulative_pitch; }),
      written_if(row<&StudySource::path>("path", "", any,
                                         "gear_key: the number of the gear, or \"load_case[0].torque_nm\""),
                 [](const StudySource& source) { return source.kind == SourceKind::gear_key; }),
      one_of_row<&StudySource::distribution>("distribution", distribution_names, "distribution",
                                             "{ normal = { mean = 0.0, std = 1.0 } }",
                                             "of each of its numbers: µm, or the unit of the gear's key"),
  };
  return keys;
}

StudyKeys study_keys(const StudyCorrelation&) {
  static const std::array keys{
      row<&StudyCorrelation::first>("first", "", any, "name of a source that is one number", needed),
      row<&StudyCorrelation::second>("second", "", any, "name of another one", needed),
      row<&StudyCorrelation::rank>("rank", "",
                                   {.lower = -1.0, .upper = 1.0, .lower_open = true, .upper_open = true},
                                   "rank correlation (Spearman) between them", needed),
  };
  return keys;
}

StudyTable source_table() {
  return table<&UncertainPart::sources>(
      "source", "something that is not exact",
      "nothing is uncertain; give at least one [[source]] with name, kind and distribution");
}

StudyTable correlation_table() {
  return table<&UncertainPart::correlations>("correlation", "two sources that go together");
}

// ---- checks

namespace {

class UncertainCheck {
public:
  explicit UncertainCheck(StudyChecker& checker)
      : checker_(checker), part_(checker.study().part<UncertainPart>()) {}

  void run() {
    for (std::size_t i = 0; i < part_.sources.size(); ++i)
      check_source(i);
    for (std::size_t i = 0; i < part_.correlations.size(); ++i)
      check_correlation(i);
  }

private:
  void check_source(std::size_t i) {
    const StudySource& source = part_.sources[i];
    const std::string table = fmt::format("source[{}]", i);
    if (checker_.given(table + ".name")) {
      if (source.name.empty())
        checker_.fault(table + ".name", "is empty");
      for (std::size_t k = 0; k < i; ++k)
        if (part_.sources[k].name == source.name)
          checker_.fault(table + ".name",
                         fmt::format("\"{}\" is the name of an earlier source (line {}) already", source.name,
                                     checker_.place(fmt::format("source[{}].name", k)).line));
    }
    if (!checker_.given(table + ".distribution"))
      checker_.fault(
          table,
          "has no distribution; give, for example, distribution = { normal = { mean = 0.0, std = 1.0 } }");
    else
      check_distribution_of(table + ".distribution", source.distribution);
    if (!checker_.given(table + ".kind"))
      return;
    if (source.kind == SourceKind::gear_key) {
      if (!checker_.given(table + ".path"))
        return checker_.fault(table,
                              "has no path; kind \"gear_key\" wants the number of the gear that it means");
      if (StudyChecker::names_load(source.path)) {
        if (const auto load = checker_.load(table + ".path", source.path); load && !load->torque)
          checker_.fault(table + ".path", "only torques of load cases can be sources");
        else if (load)
          checker_.claim(table + ".path", source.path);
      } else if (const auto number = checker_.continuous_number(table + ".path", source.path))
        checker_.claim(table + ".path", number->path());
    } else if (checker_.given(table + ".path")) {
      checker_.fault(table + ".path", "is of use with kind \"gear_key\" only");
    }
    if (checker_.given(table + ".harmonic") && source.kind != SourceKind::cumulative_pitch)
      checker_.fault(table + ".harmonic", "is of use with kind \"cumulative_pitch\" only");
    const bool of_spline = source.kind == SourceKind::centre_offset || source.kind == SourceKind::ovality;
    if (checker_.given(table + ".member") && of_spline && source.member == SourceMember::flexspline)
      checker_.fault(table + ".member",
                     fmt::format("{} is an error of the circular spline",
                                 source_kind_names[static_cast<std::size_t>(source.kind)]));
  }

  void check_distribution_of(const std::string& key, const Distribution& distribution) {
    const std::size_t shape = distribution.index();
    const std::string below = fmt::format("{}.{}", key, distribution_names[shape]);
    if (!checker_.given(below))
      return; // said already
    if (checker_.faulty(below))
      return;
    try {
      check_distribution(distribution);
    } catch (const std::invalid_argument& error) {
      checker_.fault(key, error.what());
    }
  }

  void check_correlation(std::size_t i) {
    const StudyCorrelation& c = part_.correlations[i];
    const std::string table = fmt::format("correlation[{}]", i);
    std::vector<std::string_view> names;
    for (const StudySource& source : part_.sources)
      names.push_back(source.name);
    checker_.check_name(table + ".first", c.first, names, "source");
    checker_.check_name(table + ".second", c.second, names, "source");
    if (checker_.given(table + ".first") && checker_.given(table + ".second") && c.first == c.second)
      checker_.fault(table + ".second", "is the same source as first");
    for (std::size_t k = 0; k < i; ++k) {
      const StudyCorrelation& other = part_.correlations[k];
      if ((other.first == c.first && other.second == c.second) ||
          (other.first == c.second && other.second == c.first))
        checker_.fault(table, fmt::format("these two sources are correlated already (correlation[{}])", k));
    }
    for (const auto& [key, name] : {std::pair{".first", &c.first}, {".second", &c.second}})
      for (const StudySource& source : part_.sources)
        if (source.name == *name && !is_one_number(source.kind))
          checker_.fault(
              table + key,
              fmt::format(
                  "\"{}\" ({}) is several numbers of one gear; only sources that are one number can be "
                  "correlated: tooth_thickness, profile_slope, profile_form, wear and gear_key",
                  source.name, source_kind_names[static_cast<std::size_t>(source.kind)]));
  }

  static bool is_one_number(SourceKind kind) {
    return kind == SourceKind::tooth_thickness || kind == SourceKind::profile_slope ||
           kind == SourceKind::profile_form || kind == SourceKind::wear || kind == SourceKind::gear_key;
  }

  StudyChecker& checker_;
  const UncertainPart& part_;
};

} // namespace

void check_uncertain(StudyChecker& checker) {
  UncertainCheck(checker).run();
}

nlohmann::ordered_json plan_sources(const StudyFile& study) {
  auto inputs = nlohmann::ordered_json::array();
  for (const StudySource& source : study.part<UncertainPart>().sources)
    inputs.push_back(
        {{"source", source.name}, {"kind", source_kind_names[static_cast<std::size_t>(source.kind)]}});
  return inputs;
}

} // namespace strainwave
