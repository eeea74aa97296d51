// The kind "convergence": its keys, checks, rows, answer and page. Its rows are those of a sweep whose lists
// stand side by side.

#include "strainwave/studies/convergence/convergence.hpp"

#include "strainwave/studies/convergence/order.hpp"
#include "strainwave/studies/file/checker.hpp"
#include "strainwave/studies/file/key_rows.hpp"
#include "strainwave/studies/report/page.hpp"
#include "strainwave/studies/sweep/sweep.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace strainwave {

using namespace study_rows;
using Json = nlohmann::ordered_json;

// ---- keys

static StudyKeys study_keys(const MeshRefinement&) {
  static const std::array keys{
      row<&MeshRefinement::path>("path", "", any, "a count of elements: a key of the gear's [mesh]", needed),
      row<&MeshRefinement::values>("values", "", any, "its values, coarse to fine; one for each level",
                                   needed),
  };
  return keys;
}

static StudyKeys study_keys(const StudyConvergence&) {
  static const std::array keys{outputs_row<&StudyConvergence::outputs>()};
  return keys;
}

namespace {

// ---- checks

void check_refinement(StudyChecker& checker, const ConvergencePart& part, std::size_t i) {
  const MeshRefinement& r = part.refinements[i];
  const std::string table = fmt::format("refine[{}]", i), values = table + ".values";
  const auto number = checker.continuous_number(table + ".path", r.path, true);
  if (number && !r.path.starts_with("mesh."))
    return checker.fault(table + ".path",
                         fmt::format("{} is no count of elements; expected a key of mesh, for example "
                                     "mesh.per_pitch. Other keys can be swept",
                                     r.path));
  if (number)
    checker.claim(table + ".path", number->path());
  if (!number || !checker.given(values))
    return;
  if (r.values.size() < 2)
    return checker.fault(values,
                         "holds one level; a mesh is compared with a finer one, an order needs three");
  if (r.values.size() != part.refinements.front().values.size())
    return checker.fault(values,
                         fmt::format("has {} levels, the first [[refine]] has {}; all have equally many",
                                     r.values.size(), part.refinements.front().values.size()));
  for (std::size_t k = 0; k < r.values.size(); ++k) {
    if (r.values[k] != std::floor(r.values[k]))
      return checker.fault(values,
                           fmt::format("{} is a whole number; {} is none", r.path, shortest(r.values[k])));
    if (!number->field().range.contains(r.values[k]))
      return checker.check_in_range(values, *number, r.values[k]);
    if (k > 0 && r.values[k] < r.values[k - 1])
      return checker.fault(values, fmt::format("have to run from coarse to fine; {} follows {}",
                                               shortest(r.values[k]), shortest(r.values[k - 1])));
  }
}

/// Every level has to be finer than the one before in one key at least.
void check_levels(StudyChecker& checker, const ConvergencePart& part) {
  if (checker.faulty("refine") || part.refinements.empty())
    return;
  const std::vector<double> sizes = element_sizes(part);
  for (std::size_t level = 1; level < sizes.size(); ++level)
    if (!(sizes[level] < sizes[level - 1]))
      checker.fault("refine[0].values",
                    fmt::format("level {} is the same mesh as level {}", level, level - 1));
}

// ---- answer

struct OutputConvergence {
  std::string output, unit;
  std::vector<double> size, value; ///< of the levels with a result
  std::vector<std::size_t> level;
  std::optional<ObservedOrder> order;
};

double relative_change(double from, double to) {
  return to != 0.0 ? (to - from) / std::abs(to) : std::numeric_limits<double>::quiet_NaN();
}

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:+.3g} %", 100.0 * share) : "–";
}

class ConvergenceAnswer : public RowAnswer {
public:
  ConvergenceAnswer(const ConvergencePart& part, const SampledStudy& rows, const RowTable& table)
      : part_(part) {
    const std::vector<double> sizes = element_sizes(part);
    for (std::uint32_t output = 0; output < table.outputs(); ++output) {
      OutputConvergence c{.output = rows.output_columns[output].name,
                          .unit = rows.output_columns[output].unit,
                          .size = {},
                          .value = {},
                          .level = {},
                          .order = {}};
      for (std::uint64_t row = 0; row < table.rows(); ++row) {
        if (table.status()[row] != row_ok)
          continue;
        c.size.push_back(sizes[row]);
        c.value.push_back(table.value(row, output));
        c.level.push_back(row);
      }
      c.order = observed_order(c.size, c.value);
      outputs_.push_back(std::move(c));
    }
  }

  std::string text() const override {
    std::string text;
    for (const OutputConvergence& c : outputs_) {
      text += fmt::format("  {} ({}): {}\n", c.output, c.unit, order_text(c));
      for (std::size_t i = 0; i < c.level.size(); ++i)
        text += fmt::format("    level {}  {:<34} size {:<7.4g} {:>14.7g} {:>12}\n", c.level[i],
                            counts(c.level[i]), c.size[i], c.value[i],
                            i > 0 ? percent(relative_change(c.value[i - 1], c.value[i])) : "");
    }
    return text;
  }

  void add_json(Json& result) const override {
    Json all = Json::object();
    for (const OutputConvergence& c : outputs_) {
      Json levels = Json::array();
      for (std::size_t i = 0; i < c.level.size(); ++i)
        levels.push_back({{"level", c.level[i]},
                          {"size", c.size[i]},
                          {"value", c.value[i]},
                          {"change", i > 0 ? number_or_null(relative_change(c.value[i - 1], c.value[i]))
                                           : Json(nullptr)}});
      all[c.output] = {{"unit", c.unit}, {"levels", levels}, {"order", nullptr}, {"limit", nullptr}};
      all[c.output]["finest_off_by"] = nullptr;
      if (c.order) {
        all[c.output]["order"] = c.order->order;
        all[c.output]["limit"] = c.order->limit;
        all[c.output]["finest_off_by"] = number_or_null(relative_change(c.value.back(), c.order->limit));
      }
    }
    result["convergence"] = all;
  }

private:
  static std::string order_text(const OutputConvergence& c) {
    if (!c.order)
      return c.value.size() < 3
                 ? "an order needs three levels with a result"
                 : "no order: the last three levels swing, stand still or do not draw together";
    return fmt::format("order {:.2f}, limit {:.6g}, from the finest level {}", c.order->order, c.order->limit,
                       percent(relative_change(c.value.back(), c.order->limit)));
  }
  /// "4 × 6 × 14": the counts of a level, in the order of the file.
  std::string counts(std::size_t level) const {
    std::string text;
    for (const MeshRefinement& r : part_.refinements)
      text += fmt::format("{}{}", text.empty() ? "" : " × ", r.values[level]);
    return text;
  }

  ConvergencePart part_;
  std::vector<OutputConvergence> outputs_;
};

// ---- page

std::string convergence_html(const Json& result) {
  std::string html;
  for (const auto& [output, c] : result["convergence"].items()) {
    html += fmt::format("<h2>{}</h2>\n", escape_html(output));
    html += fmt::format("<p>observed order {}, limit {}</p>\n", html_text(c["order"]), html_text(c["limit"]));
    html += html_heading("Level", {"size", "value", "change"});
    for (const Json& level : c["levels"]) {
      const Json& change = level["change"];
      html += html_row(fmt::format("{}", level["level"].get<std::size_t>()),
                       {html_text(level["size"]), html_text(level["value"]),
                        change.is_number() ? percent(change.get<double>()) : "–"});
    }
    html += "</table>\n";
  }
  return html;
}

/// An output over the size of the elements, with its limit at 0.
Figure convergence_figure(const std::string& output, const Json& c) {
  Figure figure;
  figure.name = "convergence-" + output;
  figure.data = fmt::format("# size, {}\n", output);
  for (const Json& level : c["levels"])
    figure.data += fmt::format("{:.9g} {:.9g}\n", level["size"].get<double>(), level["value"].get<double>());
  std::string limit;
  if (c["limit"].is_number()) {
    figure.data += fmt::format("\n\n# limit\n0 {:.9g}\n", c["limit"].get<double>());
    limit = fmt::format(", '' index 1 using 1:2 with points pointtype 6 linecolor '{}' title 'limit'",
                        figure_colour(1));
  }
  figure.drawing =
      fmt::format("set xlabel 'size of the elements'\nset ylabel '{}' noenhanced\nset xrange "
                  "[0:1.05]\nset key outside top horizontal\nplot '{}.dat' index 0 using 1:2 with "
                  "linespoints pointtype 7 linecolor '{}' title 'levels'{}\n",
                  axis_label(output, c["unit"]), figure.name, figure_colour(0), limit);
  return figure;
}

class ConvergenceKind : public RowKind {
public:
  std::string_view name() const override { return "convergence"; }
  std::string_view sentence() const override {
    return "the same gear on finer and finer meshes: observed order and limit of its numbers";
  }
  std::unique_ptr<StudyPart> part() const override { return std::make_unique<ConvergencePart>(); }
  std::span<const StudyTable> tables() const override {
    static const std::array tables{
        table<&ConvergencePart::refinements>(
            "refine", "a count of elements that grows from level to level, together with all others",
            "nothing is refined; give at least one [[refine]] with path and values"),
        table<&ConvergencePart::convergence>("convergence", "what is recorded"),
    };
    return tables;
  }
  void check(StudyChecker& checker) const override {
    const auto& part = checker.study().part<ConvergencePart>();
    for (std::size_t i = 0; i < part.refinements.size(); ++i)
      check_refinement(checker, part, i);
    check_levels(checker, part);
    for (std::size_t i = 0; i < part.convergence.outputs.size(); ++i)
      checker.check_output(fmt::format("convergence.outputs[{}]", i), part.convergence.outputs[i]);
  }

  Json plan_inputs(const StudyFile& study) const override {
    Json inputs = Json::array();
    for (const MeshRefinement& r : study.part<ConvergencePart>().refinements)
      inputs.push_back({{"path", r.path}, {"values", r.values}});
    return inputs;
  }
  std::string_view plan_points(const StudyFile&) const override { return "value i of every refinement"; }

  Outcome<SampledStudy> make_rows(const StudyFile& study, const RunContext& context) const override {
    const auto& part = study.part<ConvergencePart>();
    auto sweep = std::make_unique<SweepPart>();
    for (const MeshRefinement& r : part.refinements) {
      sweep->variables.emplace_back().path = r.path;
      sweep->variables.back().values = r.values;
    }
    sweep->sweep = {.mode = SweepMode::list, .outputs = part.convergence.outputs};
    StudyFile as_sweep = study;
    as_sweep.kind = &sweep_kind();
    as_sweep.own = OwnPart(std::move(sweep));
    auto made = make_sweep_rows(as_sweep, context);
    if (!made)
      return made.failure();
    SampledStudy rows = std::move(made).value();
    rows.block_rows = 1; // every row solves a cup of its own
    rows.cups = rows.rows;
    return rows;
  }
  std::unique_ptr<const RowAnswer> answer(const StudyFile& study, const SampledStudy& rows,
                                          const RowTable& table) const override {
    return std::make_unique<ConvergenceAnswer>(study.part<ConvergencePart>(), rows, table);
  }

  std::string report_tables(const StudyFile&, const Json& result) const override {
    return result.contains("convergence") ? convergence_html(result) : "";
  }
  std::vector<Figure> report_figures(const StudyFile&, const StoredResults&,
                                     const Json& result) const override {
    std::vector<Figure> figures;
    if (result.contains("convergence"))
      for (const auto& [output, c] : result["convergence"].items())
        if (figures.size() < most_figures && !c["levels"].empty())
          figures.push_back(convergence_figure(output, c));
    return figures;
  }
};

} // namespace

std::vector<double> element_sizes(const ConvergencePart& part) {
  std::vector<double> sizes(part.refinements.front().values.size(), 1.0);
  const auto grow = std::ranges::count_if(
      part.refinements, [](const MeshRefinement& r) { return r.values.back() > r.values.front(); });
  for (const MeshRefinement& r : part.refinements)
    for (std::size_t level = 0; level < sizes.size(); ++level)
      if (r.values.back() > r.values.front())
        sizes[level] *= std::pow(r.values.front() / r.values[level], 1.0 / static_cast<double>(grow));
  return sizes;
}

const RowKind& convergence_kind() {
  static const ConvergenceKind kind;
  return kind;
}

} // namespace strainwave
