#pragma once
// The keys of study files, table by table, in the manner of model/gear/fields.hpp: a row has a Field, which
// knows kind, range and words, and a function that writes a checked value into the table's struct.

#include "model/gear/fields.hpp"
#include "studies/study_file.hpp"

#include <array>
#include <span>
#include <string_view>

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

/// All kinds of studies by name; those of StudyKind come first and are the ones that this version runs.
inline constexpr std::array<std::string_view, 5> study_kinds{"optimize", "pareto", "sweep", "monte_carlo",
                                                             "sensitivity"};

inline constexpr std::size_t runnable_kinds = 2;

/// Tables of study files of the other kinds.
inline constexpr std::array<std::string_view, 2> tables_of_other_kinds{"source", "sampling"};

} // namespace strainwave
