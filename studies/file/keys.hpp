#pragma once
// The keys of study files, table by table, in the manner of model/gear/fields.hpp: a key has a Field, which
// knows kind, range and words, and functions that read a value from the table's struct and write a checked
// one into it. The struct stands behind void*, so that reader, writer, schema and reference page need not
// know it; key_rows.hpp makes keys from the members of a struct.

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/studies/file/study.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

struct StudyKey;
using StudyKeys = std::span<const StudyKey>;

/// A table inside a key: link = { path, ratio }, or one of several: distribution = { normal = { mean, std }
/// }.
struct StudyShape {
  std::string_view name; ///< of one of several
  StudyKeys (*keys)() = nullptr;
  const void* (*blank)() = nullptr;                ///< the struct with its defaults
  void* (*put)(void* table) = nullptr;             ///< makes the inner struct in the table's
  const void* (*get)(const void* table) = nullptr; ///< null: it is not there
};

struct StudyKey {
  enum class Holds { value, table, one_of, names };
  Field field; ///< its read and write are not used; of other than values only path and sentence are
  Holds holds = Holds::value;
  FieldValue (*read)(const void* table) = nullptr; ///< of a value
  void (*write)(void* table, const FieldValue&) = nullptr;
  std::span<const StudyShape> shapes;                        ///< of a table (one), or one of several
  std::string_view what;                                     ///< of one of several: "distribution"
  std::string_view example;                                  ///< of both: what messages expect
  std::vector<std::string>* (*names)(void* table) = nullptr; ///< of a list of names
  const std::vector<std::string>& (*list)(const void* table) = nullptr; ///< the same, to read
  bool (*applies)(const void* table) = nullptr; ///< null: always; else whether it is written down
};

/// Keys of the tables that kinds share. Overloads on the table's struct; every kind has those of its own.
StudyKeys study_keys(const LoadCase&);
StudyKeys study_keys(const VariableLink&);
StudyKeys study_keys(const StudyLimits&);

/// Keys at the top of a file; `kinds`: names of the kinds, which have to live as long as the keys.
std::vector<StudyKey> top_keys(std::span<const std::string_view> kinds);

} // namespace strainwave
