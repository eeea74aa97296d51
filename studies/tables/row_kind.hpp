#pragma once
// A kind of study whose rows are known in advance: it makes them and says what the finished table answers.
// Journals, shards, resuming, merging, single rows again and reports follow from that.

#include "strainwave/studies/report/reported_kind.hpp"
#include "strainwave/studies/tables/row_study.hpp"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <memory>
#include <string>

namespace strainwave {

/// What a kind says of its whole table.
class RowAnswer {
public:
  virtual ~RowAnswer() = default;
  /// For people: lines indented by two blanks.
  virtual std::string text() const = 0;
  /// Adds the kind's own keys to result.json.
  virtual void add_json(nlohmann::ordered_json& result) const = 0;
};

class RowKind : public ReportedKind {
public:
  /// May take its time (finite elements). Failure: the nominal gear has no result. Throws FieldError.
  virtual Outcome<SampledStudy> make_rows(const StudyFile& study, const RunContext& context) const = 0;
  virtual std::unique_ptr<const RowAnswer> answer(const StudyFile& study, const SampledStudy& rows,
                                                  const RowTable& table) const = 0;
  /// A study that ends by itself (EngineOptions::enough), and then has no shards; empty: it does not.
  using EnoughRule = std::function<bool(const RowTable&, std::uint64_t)>;
  virtual EnoughRule enough(const StudyFile&, const SampledStudy&) const { return {}; }
  virtual bool ends_by_itself(const StudyFile&) const { return false; }
};

/// Null for a study whose points are not known in advance.
inline const RowKind* row_kind(const StudyFile& study) {
  return dynamic_cast<const RowKind*>(study.kind);
}

} // namespace strainwave
