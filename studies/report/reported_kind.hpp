#pragma once
// A kind of study that can be reported: what its page shows, from the folder alone.

#include "strainwave/model/export/figure.hpp"
#include "strainwave/studies/file/kind.hpp"
#include "strainwave/studies/results/results_reader.hpp"

#include <string>
#include <vector>

namespace strainwave {

class ReportedKind : public StudyKind {
public:
  /// Tables of the page (HTML); `result` is result.json.
  virtual std::string report_tables(const StudyFile& study, const nlohmann::ordered_json& result) const = 0;
  virtual std::vector<Figure> report_figures(const StudyFile& study, const StoredResults& results,
                                             const nlohmann::ordered_json& result) const = 0;
};

} // namespace strainwave
