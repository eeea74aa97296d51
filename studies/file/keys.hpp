#pragma once
// The keys of study files, table by table, in the manner of model/gear/fields.hpp: a row has a Field, which
// knows kind, range and words, and a function that writes a checked value into the table's struct.

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/studies/file/study.hpp"

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace strainwave {

template <class Table>
struct StudyKey {
  Field field; ///< read and write are not used
  FieldValue (*read)(const Table&);
  void (*write)(Table&, const FieldValue&);
};

/// Keys of one table. Overloads on the table's struct; StudyFile itself stands for the top of the file.
std::span<const StudyKey<StudyFile>> study_keys(const StudyFile&);
std::span<const StudyKey<LoadCase>> study_keys(const LoadCase&);
std::span<const StudyKey<StudyVariable>> study_keys(const StudyVariable&);
std::span<const StudyKey<VariableLink>> study_keys(const VariableLink&);
std::span<const StudyKey<StudyObjective>> study_keys(const StudyObjective&);
std::span<const StudyKey<StudyConstraint>> study_keys(const StudyConstraint&);
std::span<const StudyKey<StudyPareto>> study_keys(const StudyPareto&);
std::span<const StudyKey<StudyMethod>> study_keys(const StudyMethod&);
std::span<const StudyKey<StudyLimits>> study_keys(const StudyLimits&);
std::span<const StudyKey<SweepVariable>> study_keys(const SweepVariable&);
std::span<const StudyKey<StudySweep>> study_keys(const StudySweep&);
std::span<const StudyKey<StudySource>> study_keys(const StudySource&);
std::span<const StudyKey<StudyCorrelation>> study_keys(const StudyCorrelation&);
std::span<const StudyKey<StudySampling>> study_keys(const StudySampling&);
std::span<const StudyKey<StudyStop>> study_keys(const StudyStop&);
std::span<const StudyKey<StudyExceedance>> study_keys(const StudyExceedance&);
std::span<const StudyKey<StudySensitivity>> study_keys(const StudySensitivity&);
std::span<const StudyKey<Normal>> study_keys(const Normal&);
std::span<const StudyKey<TruncatedNormal>> study_keys(const TruncatedNormal&);
std::span<const StudyKey<Uniform>> study_keys(const Uniform&);
std::span<const StudyKey<Triangular>> study_keys(const Triangular&);
std::span<const StudyKey<Lognormal>> study_keys(const Lognormal&);
std::span<const StudyKey<Tabulated>> study_keys(const Tabulated&);

/// The alternatives of Distribution, by name and in its order.
inline constexpr std::array<std::string_view, 6> distribution_names{
    "normal", "truncated_normal", "uniform", "triangular", "lognormal", "table"};

/// Keys that hold more than a FieldValue can, by the members that they fill:
///     link = { path, ratio }   distribution = { NAME = { … } }   stop = { … }   outputs = ["…", …]
template <class Table>
std::vector<std::string_view> compound_keys() {
  std::vector<std::string_view> names;
  if constexpr (requires(Table t) { t.link; })
    names.push_back("link");
  if constexpr (requires(Table t) { t.distribution; })
    names.push_back("distribution");
  if constexpr (requires(Table t) { t.stop; })
    names.push_back("stop");
  if constexpr (requires(Table t) { t.outputs; })
    names.push_back("outputs");
  return names;
}

/// A heading of study files: which kinds of studies have it, and whether they need it.
struct StudyHeading {
  std::string_view name;
  bool repeated;              ///< [[name]]
  std::string_view kinds;     ///< o optimize, p pareto, w sweep, m monte_carlo, s sensitivity
  std::string_view needed_by; ///< the same
  std::string_view sentence;  ///< what it is about
  std::string_view missing;   ///< what is said where it is missing

  bool belongs_to(StudyKind kind) const { return kinds.find(letter(kind)) != std::string_view::npos; }
  bool needed(StudyKind kind) const { return needed_by.find(letter(kind)) != std::string_view::npos; }
  static char letter(StudyKind kind) { return "opwms"[static_cast<std::size_t>(kind)]; }
};

std::span<const StudyHeading> study_headings();

} // namespace strainwave
