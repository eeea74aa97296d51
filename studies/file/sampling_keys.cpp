// study_keys() of sweeps, tolerances and sensitivities, and the headings of all study files.

#include "strainwave/studies/file/key_rows.hpp"

namespace strainwave {

using namespace study_rows;

namespace {

constexpr Range open_unit{.lower = 0.0, .upper = 1.0, .lower_open = true, .upper_open = true};

} // namespace

std::span<const StudyKey<SweepVariable>> study_keys(const SweepVariable&) {
  static const std::array keys{
      row<&SweepVariable::path>("path", "", any,
                                "the number that varies: of the gear, or \"load_case[0].torque_nm\"", needed),
      row<&SweepVariable::values>("values", "", any, "its values, in the unit of the key"),
      row<&SweepVariable::lower>("lower", "", any, "first of evenly spaced values, instead"),
      row<&SweepVariable::upper>("upper", "", any, "last of them"),
      row<&SweepVariable::count>("count", "", within(2, 1000000), "how many, ends included"),
  };
  return keys;
}

std::span<const StudyKey<StudySweep>> study_keys(const StudySweep&) {
  static const std::array keys{
      choice_row<&StudySweep::mode>("mode",
                                    "every value with every other, or value i of all variables together"),
  };
  return keys;
}

std::span<const StudyKey<StudySource>> study_keys(const StudySource&) {
  static const std::array keys{
      row<&StudySource::name>("name", "", any, "its name in results", needed),
      choice_row<&StudySource::kind>("kind", "what is not exact", needed),
      choice_row<&StudySource::member>("member", "of which gear"),
      row<&StudySource::harmonic>("harmonic", "", within(1, 1000), "cumulative_pitch: periods over one turn"),
      row<&StudySource::path>("path", "", any, "gear_key: the number of the gear"),
  };
  return keys;
}

std::span<const StudyKey<StudyCorrelation>> study_keys(const StudyCorrelation&) {
  static const std::array keys{
      row<&StudyCorrelation::first>("first", "", any, "name of a source that is one number", needed),
      row<&StudyCorrelation::second>("second", "", any, "name of another one", needed),
      row<&StudyCorrelation::rank>("rank", "",
                                   {.lower = -1.0, .upper = 1.0, .lower_open = true, .upper_open = true},
                                   "rank correlation (Spearman) between them", needed),
  };
  return keys;
}

std::span<const StudyKey<StudySampling>> study_keys(const StudySampling&) {
  static const std::array keys{
      choice_row<&StudySampling::design>("design", "how the samples are spread"),
      row<&StudySampling::samples>("samples", "", within(4, 2147483647.0), "samples in all"),
      row<&StudySampling::randomisations>("randomisations", "", within(16, 65536),
                                          "independent repetitions of latin_hypercube and sobol designs"),
      row<&StudySampling::positions>("positions", "", within(1, 100000),
                                     "positions of the wave generator; a sample is the worst of them"),
      row<&StudySampling::quantiles>("quantiles", "", open_unit, "probabilities of the quantiles asked for"),
  };
  return keys;
}

std::span<const StudyKey<StudyStop>> study_keys(const StudyStop&) {
  static const std::array keys{
      row<&StudyStop::output>("output", "", any, "the output that is watched", needed),
      row<&StudyStop::quantile>("quantile", "", open_unit, "its quantile of this probability"),
      row<&StudyStop::limit>("limit", "", any,
                             "or the probability of exceeding this limit; neither: its mean"),
      row<&StudyStop::half_width>("half_width", "", above_zero(1e12),
                                  "half width of the 95 % interval at which the study ends", needed),
  };
  return keys;
}

std::span<const StudyKey<StudyExceedance>> study_keys(const StudyExceedance&) {
  static const std::array keys{
      row<&StudyExceedance::output>("output", "", any,
                                    "the output whose probability of exceeding is asked for", needed),
      row<&StudyExceedance::limit>("limit", "", any, "the limit, in the unit of the output", needed),
  };
  return keys;
}

std::span<const StudyKey<StudySensitivity>> study_keys(const StudySensitivity&) {
  static const std::array keys{
      choice_row<&StudySensitivity::method>("method",
                                            "Sobol' indices, Morris screening, or local elasticities"),
      row<&StudySensitivity::samples>("samples", "", within(2, 1073741824.0),
                                      "blocks (sobol, a power of two) or trajectories (morris)"),
      row<&StudySensitivity::positions>("positions", "", within(1, 100000),
                                        "positions of the wave generator; a row is the worst of them"),
      row<&StudySensitivity::levels>("levels", "", within(2, 1000), "morris: levels of each source, even"),
  };
  return keys;
}

std::span<const StudyKey<Normal>> study_keys(const Normal&) {
  static const std::array keys{
      row<&Normal::mean>("mean", "", any, "its mean", needed),
      row<&Normal::std>("std", "", above_zero(1e12), "its standard deviation", needed),
  };
  return keys;
}

std::span<const StudyKey<TruncatedNormal>> study_keys(const TruncatedNormal&) {
  static const std::array keys{
      row<&TruncatedNormal::mean>("mean", "", any, "mean before the cut", needed),
      row<&TruncatedNormal::std>("std", "", above_zero(1e12), "standard deviation before the cut", needed),
      row<&TruncatedNormal::lower>("lower", "", any, "least value", needed),
      row<&TruncatedNormal::upper>("upper", "", any, "largest value", needed),
  };
  return keys;
}

std::span<const StudyKey<Uniform>> study_keys(const Uniform&) {
  static const std::array keys{
      row<&Uniform::lower>("lower", "", any, "least value", needed),
      row<&Uniform::upper>("upper", "", any, "largest value", needed),
  };
  return keys;
}

std::span<const StudyKey<Triangular>> study_keys(const Triangular&) {
  static const std::array keys{
      row<&Triangular::lower>("lower", "", any, "least value", needed),
      row<&Triangular::mode>("mode", "", any, "most frequent value", needed),
      row<&Triangular::upper>("upper", "", any, "largest value", needed),
  };
  return keys;
}

std::span<const StudyKey<Lognormal>> study_keys(const Lognormal&) {
  static const std::array keys{
      row<&Lognormal::mean>("mean", "", above_zero(1e12), "mean of the value", needed),
      row<&Lognormal::std>("std", "", above_zero(1e12), "standard deviation of the value", needed),
  };
  return keys;
}

std::span<const StudyKey<Tabulated>> study_keys(const Tabulated&) {
  static const std::array keys{
      row<&Tabulated::value>("value", "", any, "values, ascending", needed),
      row<&Tabulated::cumulative>("cumulative", "", within(0.0, 1.0), "share at or below each, from 0 to 1",
                                  needed),
  };
  return keys;
}

std::span<const StudyHeading> study_headings() {
  static constexpr std::array headings{
      StudyHeading{"override", false, "opwms", "", "changes of the gear: any of its keys by its path", ""},
      StudyHeading{"load_case", true, "opwms", "", "a load; without any, those of the gear's [load]", ""},
      StudyHeading{"variable", true, "opw", "opw", "a number that varies",
                   "nothing varies; give at least one [[variable]] with path, lower and upper"},
      StudyHeading{"objective", false, "op", "op", "what is wanted",
                   "the table [objective] is missing; it has to give output"},
      StudyHeading{"constraint", true, "op", "", "what has to be kept", ""},
      StudyHeading{"pareto", false, "p", "p", "the aim that competes with the objective",
                   "the table [pareto] is missing; it has to give output, the aim that competes"},
      StudyHeading{"method", false, "op", "", "how to search", ""},
      StudyHeading{"sweep", false, "w", "", "which values go together, and what is recorded", ""},
      StudyHeading{"source", true, "ms", "ms", "something that is not exact",
                   "nothing is uncertain; give at least one [[source]] with name, kind and distribution"},
      StudyHeading{"correlation", true, "ms", "", "two sources that go together", ""},
      StudyHeading{"sampling", false, "m", "", "how many samples, and what is asked of them", ""},
      StudyHeading{"exceedance", true, "m", "", "a limit whose probability of being exceeded is asked for",
                   ""},
      StudyHeading{"sensitivity", false, "s", "", "which method, and how many rows", ""},
      StudyHeading{"limits", false, "opwms", "", "when the study counts as failed", ""},
      StudyHeading{"reduced", false, "opwms", "",
                   "what --reduced changes: keys of this file (\"method.budget\") or of the gear", ""},
  };
  return headings;
}

} // namespace strainwave
