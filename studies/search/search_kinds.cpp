// The kinds "optimize" and "pareto": their keys, checks and pages.

#include "strainwave/optimize/plans/optimise.hpp"
#include "strainwave/studies/file/checker.hpp"
#include "strainwave/studies/file/key_rows.hpp"
#include "strainwave/studies/report/page.hpp"
#include "strainwave/studies/search/search.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace strainwave {

using namespace study_rows;
using Json = nlohmann::ordered_json;

// ---- keys

static std::span<const std::string_view> names_of(Goal) {
  static constexpr std::array<std::string_view, 2> names{"minimise", "maximise"};
  return names;
}

static StudyKeys study_keys(const StudyVariable&) {
  static const std::array keys{
      row<&StudyVariable::path>("path", "", any, "the number of the gear that varies", needed),
      row<&StudyVariable::lower>("lower", "", any, "lower bound, in the unit of the key", needed),
      row<&StudyVariable::upper>("upper", "", any, "upper bound", needed),
      row<&StudyVariable::start>("start", "", any, "where the search begins"),
      row<&StudyVariable::scale>("scale", "", above_zero(1e9), "typical change"),
      link_row<&StudyVariable::link>(),
  };
  return keys;
}

static StudyKeys study_keys(const StudyObjective&) {
  static const std::array keys{
      row<&StudyObjective::output>("output", "", any, "the result that is to become small", needed),
      choice_row<&StudyObjective::goal>("goal", "or large"),
  };
  return keys;
}

static StudyKeys study_keys(const StudyConstraint&) {
  static const std::array keys{
      row<&StudyConstraint::output>("output", "", any, "the result that is limited", needed),
      row<&StudyConstraint::min>("min", "", any, "it stays at or above"),
      row<&StudyConstraint::max>("max", "", any, "it stays at or below"),
      row<&StudyConstraint::min_ratio_to_baseline>("min_ratio_to_baseline", "", above_zero(1e9),
                                                   "it stays at or above this times the baseline's value"),
      row<&StudyConstraint::max_ratio_to_baseline>("max_ratio_to_baseline", "", above_zero(1e9),
                                                   "it stays at or below this times the baseline's value"),
  };
  return keys;
}

static StudyKeys study_keys(const StudyPareto&) {
  static const std::array keys{
      row<&StudyPareto::output>("output", "", any, "the result that competes with the objective", needed),
      choice_row<&StudyPareto::goal>("goal", "whether less or more of it is wanted"),
      row<&StudyPareto::points>("points", "", within(2, 1000), "points of the front, ends included"),
  };
  return keys;
}

static StudyKeys study_keys(const StudyMethod&) {
  static const std::array keys{
      row<&StudyMethod::name>("name", "", any, "the method of the search"),
      row<&StudyMethod::budget>("budget", "", within(1, 100000000), "evaluations at most"),
      row<&StudyMethod::tolerance>("tolerance", "", above_zero(1.0),
                                   "relative change at which the search ends"),
      row<&StudyMethod::starts>("starts", "", within(1, 100000), "starting points"),
  };
  return keys;
}

namespace {

// ---- checks

class SearchCheck {
public:
  explicit SearchCheck(StudyChecker& checker)
      : checker_(checker), part_(checker.study().part<SearchPart>()) {}

  void run() {
    for (std::size_t i = 0; i < part_.variables.size(); ++i)
      check_variable(i);
    checker_.check_output("objective.output", part_.objective.output);
    if (const auto* pareto = checker_.study().find_part<ParetoPart>())
      checker_.check_output("pareto.output", pareto->pareto.output);
    for (std::size_t i = 0; i < part_.constraints.size(); ++i)
      check_constraint(i);
    if (!part_.method.name.empty())
      checker_.check_name("method.name", part_.method.name, method_names(), "method");
  }

private:
  void check_variable(std::size_t i) {
    const StudyVariable& variable = part_.variables[i];
    const std::string table = fmt::format("variable[{}].", i);
    if (StudyChecker::names_load(variable.path)) {
      if (checker_.load(table + "path", variable.path))
        checker_.fault(table + "path",
                       "a load cannot vary in a search: every design bears the same load cases");
      return;
    }
    const auto number = checker_.continuous_number(table + "path", variable.path);
    const bool bounded = checker_.given(table + "lower") && checker_.given(table + "upper");
    if (bounded && !(variable.lower < variable.upper))
      checker_.fault(table + "upper", fmt::format("must be above lower = {}, is {}", shortest(variable.lower),
                                                  shortest(variable.upper)));
    if (variable.start && bounded &&
        !(variable.lower <= *variable.start && *variable.start <= variable.upper))
      checker_.fault(table + "start", fmt::format("must lie between lower = {} and upper = {}, is {}",
                                                  shortest(variable.lower), shortest(variable.upper),
                                                  shortest(*variable.start)));
    if (number) {
      checker_.check_in_range(table + "lower", *number, variable.lower);
      checker_.check_in_range(table + "upper", *number, variable.upper);
      checker_.claim(table + "path", number->path());
    }
    if (variable.link)
      check_link(table, variable);
  }

  void check_link(const std::string& table, const StudyVariable& variable) {
    const auto number = checker_.continuous_number(table + "link.path", variable.link->path);
    if (!number)
      return;
    checker_.claim(table + "link.path", number->path());
    for (const double bound : {variable.lower, variable.upper})
      if (!number->field().range.contains(variable.link->ratio * bound))
        return checker_.check_in_range(table + "link.ratio", *number, variable.link->ratio * bound);
  }

  void check_constraint(std::size_t i) {
    const StudyConstraint& constraint = part_.constraints[i];
    const std::string table = fmt::format("constraint[{}]", i);
    checker_.check_output(table + ".output", constraint.output);
    if (!constraint.min && !constraint.max && !constraint.min_ratio_to_baseline &&
        !constraint.max_ratio_to_baseline)
      checker_.fault(table, "limits nothing; give min, max, min_ratio_to_baseline or max_ratio_to_baseline");
    if (constraint.min && constraint.max && !(*constraint.min <= *constraint.max))
      checker_.fault(table + ".max", fmt::format("must not be below min = {}, is {}",
                                                 shortest(*constraint.min), shortest(*constraint.max)));
  }

  StudyChecker& checker_;
  const SearchPart& part_;
};

// ---- page

std::string before_and_after(const Json& result) {
  std::string html;
  const bool found = result["best"].is_object();
  for (const auto& [title, key] : {std::pair{"Inputs", "inputs"}, {"Outputs", "outputs"}}) {
    html += html_heading(title, {"unmodified", "optimised", "change"});
    for (const auto& [name, value] : result["baseline"][key].items()) {
      if (!value.is_number())
        continue;
      const Json after = found ? result["best"][key][name] : Json(nullptr);
      std::string change;
      if (after.is_number() && value.get<double>() != 0.0)
        change = fmt::format("{:+.1f} %", 100.0 * (after.get<double>() / value.get<double>() - 1.0));
      html += html_row(name, {html_text(value), html_text(after), change});
    }
    html += "</table>\n";
  }
  if (!result["limits"].empty()) {
    html += html_heading("Limits", {"at least", "at most", "value", "kept"});
    for (const Json& l : result["limits"])
      html += html_row(l["output"], {html_text(l.value("min", Json())), html_text(l.value("max", Json())),
                                     html_text(l.value("value", Json())),
                                     l.value("kept", false) ? "yes" : "<span class=bad>no</span>"});
    html += "</table>\n";
  }
  return html;
}

std::string front_html(const ParetoPart& search, const Json& result) {
  std::string html =
      "<h2>Front</h2>\n" + html_heading("verdict", {search.objective.output, search.pareto.output});
  for (const Json& point : result["front"]) {
    const bool there = point["outputs"].is_object();
    html += html_row(point["verdict"], {there ? html_text(point["outputs"][search.objective.output]) : "–",
                                        there ? html_text(point["outputs"][search.pareto.output]) : "–"});
  }
  return html + "</table>\n";
}

std::size_t column_of(const StoredResults& r, const std::string& name) {
  for (std::size_t i = 0; i < r.output_columns.size(); ++i)
    if (r.output_columns[i].name == name)
      return i;
  return 0;
}

void add_search(std::vector<Figure>& figures, const SearchPart& search, const StoredResults& r,
                const Json& result) {
  const std::size_t inputs = r.input_columns.size(), outputs = r.output_columns.size();
  const std::size_t aim = column_of(r, search.objective.output);
  for (std::size_t i = 0; i < inputs && figures.size() < most_figures; ++i) {
    Figure figure;
    figure.name = fmt::format("search-{}", i);
    figure.data = fmt::format("# {}, {}\n", r.input_columns[i].name, search.objective.output);
    for (std::uint64_t row = 0; row < r.rows; ++row)
      if (const double y = r.outputs[row * outputs + aim]; !std::isnan(y))
        figure.data += fmt::format("{:.9g} {:.9g}\n", r.inputs[row * inputs + i], y);
    const std::string& path = r.input_columns[i].name;
    std::string marks;
    int block = 1;
    for (const auto& [key, title, colour] :
         {std::tuple{"baseline", "unmodified", 4}, {"best", "optimised", 1}}) {
      if (!result.contains(key) || !result[key].is_object() || !result[key]["inputs"].contains(path))
        continue;
      figure.data +=
          fmt::format("\n\n# {}\n{:.9g} {:.9g}\n", title, number_or_nan(result[key]["inputs"][path]),
                      number_or_nan(result[key]["outputs"][search.objective.output]));
      marks += fmt::format(
          ", '' index {} using 1:2 with points pointtype 7 pointsize 1.1 linecolor '{}' title '{}'", block++,
          figure_colour(static_cast<std::size_t>(colour)), title);
    }
    figure.drawing = fmt::format(
        "set xlabel '{}' noenhanced\nset ylabel '{}' noenhanced\nset key outside top horizontal\nplot "
        "'{}.dat' index 0 using 1:2 "
        "with points pointtype 7 pointsize 0.35 linecolor '{}' title 'evaluations'{}\n",
        axis_label(path, r.input_columns[i].unit),
        axis_label(search.objective.output, r.output_columns[aim].unit), figure.name, figure_colour(5),
        marks);
    figures.push_back(std::move(figure));
  }
}

void add_front(std::vector<Figure>& figures, const ParetoPart& search, const StoredResults& r,
               const Json& result) {
  const std::size_t aim = column_of(r, search.objective.output);
  Figure figure;
  figure.name = "front";
  figure.data = fmt::format("# {}, {}\n", search.objective.output, search.pareto.output);
  for (const Json& point : result["front"])
    if (point["outputs"].is_object())
      figure.data += fmt::format("{:.9g} {:.9g}\n", number_or_nan(point["outputs"][search.objective.output]),
                                 number_or_nan(point["outputs"][search.pareto.output]));
  figure.drawing =
      fmt::format("set xlabel '{}' noenhanced\nset ylabel '{}' noenhanced\nplot 'front.dat' using 1:2 with "
                  "linespoints pointtype 7 "
                  "linecolor '{}' notitle\n",
                  axis_label(search.objective.output, r.output_columns[aim].unit),
                  axis_label(search.pareto.output, r.output_columns[column_of(r, search.pareto.output)].unit),
                  figure_colour(0));
  figures.insert(figures.begin(), std::move(figure));
}

class SearchKind : public ReportedKind {
public:
  void check(StudyChecker& checker) const override { SearchCheck(checker).run(); }
  /// A search looks for the edge of what works.
  double failure_share() const override { return 0.5; }
  Json plan_inputs(const StudyFile& study) const override {
    Json inputs = Json::array();
    for (const StudyVariable& v : study.part<SearchPart>().variables)
      inputs.push_back({{"path", v.path}, {"lower", v.lower}, {"upper", v.upper}});
    return inputs;
  }
  std::string_view plan_points(const StudyFile&) const override {
    return "chosen one after the other by the method";
  }

protected:
  static StudyTable variable_table() {
    return table<&SearchPart::variables>(
        "variable", "a number of the gear that varies between bounds",
        "nothing varies; give at least one [[variable]] with path, lower and upper");
  }
  static StudyTable objective_table() {
    return table<&SearchPart::objective>("objective", "what is wanted",
                                         "the table [objective] is missing; it has to give output");
  }
  static StudyTable constraint_table() {
    return table<&SearchPart::constraints>("constraint", "what has to be kept");
  }
  static StudyTable method_table() { return table<&SearchPart::method>("method", "how to search"); }
};

class OptimizeKind : public SearchKind {
public:
  std::string_view name() const override { return "optimize"; }
  std::string_view sentence() const override { return "looks for the design that is best by one aim"; }
  std::unique_ptr<StudyPart> part() const override { return std::make_unique<SearchPart>(); }
  std::span<const StudyTable> tables() const override {
    static const std::array tables{variable_table(), objective_table(), constraint_table(), method_table()};
    return tables;
  }
  std::string report_tables(const StudyFile&, const Json& result) const override {
    return before_and_after(result);
  }
  std::vector<Figure> report_figures(const StudyFile& study, const StoredResults& results,
                                     const Json& result) const override {
    std::vector<Figure> figures;
    add_search(figures, study.part<SearchPart>(), results, result);
    return figures;
  }
};

class ParetoKind : public SearchKind {
public:
  std::string_view name() const override { return "pareto"; }
  std::string_view sentence() const override { return "looks for the front between two aims"; }
  std::unique_ptr<StudyPart> part() const override { return std::make_unique<ParetoPart>(); }
  std::span<const StudyTable> tables() const override {
    static const std::array tables{
        variable_table(), objective_table(), constraint_table(),
        table<&ParetoPart::pareto>(
            "pareto", "the aim that competes with the objective",
            "the table [pareto] is missing; it has to give output, the aim that competes"),
        method_table()};
    return tables;
  }
  std::string report_tables(const StudyFile& study, const Json& result) const override {
    return before_and_after(result) +
           (result.contains("front") ? front_html(study.part<ParetoPart>(), result) : "");
  }
  std::vector<Figure> report_figures(const StudyFile& study, const StoredResults& results,
                                     const Json& result) const override {
    std::vector<Figure> figures;
    add_search(figures, study.part<ParetoPart>(), results, result);
    if (result.contains("front"))
      add_front(figures, study.part<ParetoPart>(), results, result);
    return figures;
  }
};

} // namespace

const ReportedKind& optimize_kind() {
  static const OptimizeKind kind;
  return kind;
}

const ReportedKind& pareto_kind() {
  static const ParetoKind kind;
  return kind;
}

} // namespace strainwave
