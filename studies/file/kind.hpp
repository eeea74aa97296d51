#pragma once
// A kind of study says everything about itself in one object, in a folder of its own: name, tables and their
// keys, checks. Files are read, written, described (schema, reference page) and checked by what the kinds
// say; who can be reported, and whose rows are known in advance, adds to this (report/reported_kind.hpp,
// tables/row_kind.hpp). The list of kinds is handed in.

#include "strainwave/studies/file/keys.hpp"

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace strainwave {

class StudyChecker;

/// A heading of study files and what belongs under it; made by table() of key_rows.hpp.
struct StudyTable {
  std::string_view name;
  std::string_view sentence;     ///< what it is about
  std::string_view missing = {}; ///< what is said where it is missing; empty: it may be
  bool repeated = false;         ///< [[name]]
  StudyKeys (*keys)() = nullptr; ///< null: any path may stand there (override, reduced)
  const void* (*blank)() = nullptr;
  std::size_t (*count)(const StudyFile&) = nullptr; ///< how many there are
  void* (*at)(StudyFile&, std::size_t) = nullptr;
  const void* (*read)(const StudyFile&, std::size_t) = nullptr;
  void* (*add)(StudyFile&) = nullptr; ///< one more, of a repeated one
};

class StudyKind {
public:
  virtual ~StudyKind() = default;
  virtual std::string_view name() const = 0;     ///< in files: kind = "…"
  virtual std::string_view sentence() const = 0; ///< what it does, without a full stop
  virtual std::unique_ptr<StudyPart> part() const = 0;
  /// In the order in which files show them.
  virtual std::span<const StudyTable> tables() const = 0;
  /// Do the parts of the study fit the gear and each other? Faults go to the checker.
  virtual void check(StudyChecker& checker) const = 0;
  /// Share of evaluations that may fail where a file does not say. A sample that fails is a hole in a table.
  virtual double failure_share() const { return 0.01; }

  /// plan.json: what varies, and by which rule points are chosen.
  virtual nlohmann::ordered_json plan_inputs(const StudyFile& study) const = 0;
  virtual std::string_view plan_points(const StudyFile& study) const = 0;
};

/// All tables of a file of this kind: the common ones and its own between them.
std::vector<StudyTable> study_tables(const StudyKind& kind);
std::vector<std::string_view> kind_names(StudyKinds kinds);

} // namespace strainwave
