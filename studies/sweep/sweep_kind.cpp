// The kind "sweep": its keys, checks, answer and page.

#include "strainwave/studies/file/checker.hpp"
#include "strainwave/studies/file/key_rows.hpp"
#include "strainwave/studies/report/page.hpp"
#include "strainwave/studies/sweep/sweep.hpp"
#include "strainwave/studies/tables/answer_text.hpp"
#include "strainwave/studies/tables/ranges.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <map>

namespace strainwave {

using namespace study_rows;
using Json = nlohmann::ordered_json;

// ---- keys

static std::span<const std::string_view> names_of(SweepMode) {
  static constexpr std::array<std::string_view, 2> names{"factorial", "list"};
  return names;
}

static StudyKeys study_keys(const SweepVariable&) {
  static const std::array keys{
      row<&SweepVariable::path>("path", "", any,
                                "the number that varies: of the gear, or \"load_case[0].torque_nm\"", needed),
      row<&SweepVariable::values>("values", "", any, "its values, in the unit of the key"),
      row<&SweepVariable::lower>("lower", "", any, "first of evenly spaced values, instead"),
      row<&SweepVariable::upper>("upper", "", any, "last of them"),
      row<&SweepVariable::count>("count", "", within(2, 1000000), "how many, ends included"),
      link_row<&SweepVariable::link>(),
  };
  return keys;
}

static StudyKeys study_keys(const StudySweep&) {
  static const std::array keys{
      choice_row<&StudySweep::mode>("mode",
                                    "every value with every other, or value i of all variables together"),
      outputs_row<&StudySweep::outputs>(),
  };
  return keys;
}

namespace {

// ---- checks

class SweepCheck {
public:
  explicit SweepCheck(StudyChecker& checker) : checker_(checker), part_(checker.study().part<SweepPart>()) {}

  void run() {
    for (std::size_t i = 0; i < part_.variables.size(); ++i)
      check_variable(i);
    for (std::size_t i = 0; i < part_.sweep.outputs.size(); ++i)
      checker_.check_output(fmt::format("sweep.outputs[{}]", i), part_.sweep.outputs[i]);
    if (part_.sweep.mode == SweepMode::list)
      check_lengths();
  }

private:
  void check_variable(std::size_t i) {
    const SweepVariable& v = part_.variables[i];
    const std::string table = fmt::format("variable[{}]", i);
    const bool even = v.lower || v.upper || v.count;
    if (v.values.empty() && !(v.lower && v.upper && v.count))
      return checker_.fault(table, "has no values; give values, or lower, upper and count");
    if (!v.values.empty() && even)
      return checker_.fault(table,
                            "has both values and evenly spaced ones; give values, or lower, upper and count");
    if (even && !(*v.lower < *v.upper))
      return checker_.fault(table + ".upper", fmt::format("must be above lower = {}, is {}",
                                                          shortest(*v.lower), shortest(*v.upper)));
    const std::vector<double> values = sweep_values(v);
    if (StudyChecker::names_load(v.path)) {
      check_load(table + ".path", v.path, values);
    } else if (const auto number = checker_.continuous_number(table + ".path", v.path, true)) {
      check_values(table, *number, values, 1.0);
      checker_.claim(table + ".path", number->path());
    }
    if (!v.link)
      return;
    if (const auto number = checker_.continuous_number(table + ".link.path", v.link->path)) {
      check_values(table + ".link", *number, values, v.link->ratio);
      checker_.claim(table + ".link.path", number->path());
    }
  }

  void check_values(const std::string& table, const NumberPath& number, const std::vector<double>& values,
                    double ratio) {
    const std::string key = checker_.given(table + ".values")  ? table + ".values"
                            : checker_.given(table + ".ratio") ? table + ".ratio"
                                                               : table + ".lower";
    for (const double value : values) {
      if (number.field().kind == FieldKind::integer && std::round(ratio * value) != ratio * value)
        return checker_.fault(
            key, fmt::format("{} is a whole number; {} is none", number.path(), shortest(ratio * value)));
      if (!number.field().range.contains(ratio * value))
        return checker_.check_in_range(key, number, ratio * value);
    }
  }

  void check_load(const std::string& key, const std::string& path, const std::vector<double>& values) {
    const auto load = checker_.load(key, path);
    if (!load)
      return;
    for (const double value : values)
      if (!(value >= 0.0) || value > (load->torque ? 1e6 : 1.0))
        return checker_.fault(key, fmt::format("the load must be at least 0 and at most {}, is {}",
                                               load->torque ? "1000000 N·m" : "1 rad", shortest(value)));
    checker_.claim(key, path);
  }

  void check_lengths() {
    for (std::size_t i = 1; i < part_.variables.size(); ++i) {
      const std::size_t first = sweep_values(part_.variables[0]).size();
      const std::size_t here = sweep_values(part_.variables[i]).size();
      if (first > 0 && here > 0 && here != first)
        checker_.fault(
            fmt::format("variable[{}]", i),
            fmt::format("has {} values, the first variable has {}; in mode \"list\" all have equally many",
                        here, first));
    }
  }

  StudyChecker& checker_;
  const SweepPart& part_;
};

// ---- answer

/// Where every output is least and greatest.
class SweepAnswer : public RowAnswer {
public:
  explicit SweepAnswer(std::vector<OutputRange> ranges) : ranges_(std::move(ranges)) {}
  std::string text() const override {
    std::string text = fmt::format("  {:<30} {:>8} {:>12} {:>10} {:>12} {:>10}\n", "Outputs", "unit", "least",
                                   "at row", "greatest", "at row");
    for (const OutputRange& r : ranges_)
      text += fmt::format("  {:<30} {:>8} {:>12} {:>10} {:>12} {:>10}\n", r.output, r.unit,
                          number_in_words(r.least), r.least_row, number_in_words(r.greatest), r.greatest_row);
    return text;
  }
  void add_json(Json&) const override {} // the ranges of all kinds are all there is

private:
  std::vector<OutputRange> ranges_;
};

// ---- page

/// Mean and range of an output over every variable.
Figure main_effects(const StoredResults& r, std::size_t output) {
  const std::size_t inputs = r.input_columns.size(), outputs = r.output_columns.size();
  Figure figure;
  figure.name = fmt::format("effects-{}", r.output_columns[output].name);
  figure.width = static_cast<int>(std::min<std::size_t>(270 * inputs + 60, 1400));
  figure.height = 320;
  std::string panels;
  for (std::size_t i = 0; i < inputs; ++i) {
    struct Cell {
      double sum = 0.0, least = INFINITY, greatest = -INFINITY;
      int count = 0;
    };
    std::map<double, Cell> cells;
    for (std::uint64_t row = 0; row < r.rows; ++row) {
      const double y = r.outputs[row * outputs + output];
      if (std::isnan(y))
        continue;
      Cell& cell = cells[r.inputs[row * inputs + i]];
      cell.sum += y;
      ++cell.count;
      cell.least = std::min(cell.least, y);
      cell.greatest = std::max(cell.greatest, y);
    }
    figure.data += fmt::format("# {}, mean, least, greatest of {}\n", r.input_columns[i].name,
                               r.output_columns[output].name);
    for (const auto& [x, cell] : cells)
      figure.data +=
          fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}\n", x, cell.sum / cell.count, cell.least, cell.greatest);
    figure.data += "\n\n";
    panels += fmt::format(
        "set xlabel '{}' noenhanced\n{}plot '{}.dat' index {} using 1:3:4 with filledcurves fillcolor "
        "'#cfe3f3' "
        "notitle, '' index {} using 1:2 with linespoints linecolor '{}' pointtype 7 pointsize 0.4 notitle\n",
        axis_label(last_part_of_path(r.input_columns[i].name), r.input_columns[i].unit),
        i == 0 ? fmt::format("set ylabel '{}' noenhanced\n",
                             axis_label(r.output_columns[output].name, r.output_columns[output].unit))
               : "unset ylabel\n",
        figure.name, i, i, figure_colour(0));
  }
  figure.drawing =
      fmt::format("set xtics rotate by -40\nset multiplot layout 1,{}\n{}unset multiplot\n", inputs, panels);
  return figure;
}

class SweepKind : public RowKind {
public:
  std::string_view name() const override { return "sweep"; }
  std::string_view sentence() const override { return "keys and loads run through lists of values"; }
  std::unique_ptr<StudyPart> part() const override { return std::make_unique<SweepPart>(); }
  std::span<const StudyTable> tables() const override {
    static const std::array tables{
        table<&SweepPart::variables>("variable",
                                     "a number that varies, by `values`, or `lower`, `upper` and `count`",
                                     "nothing varies; give at least one [[variable]] with path and values"),
        table<&SweepPart::sweep>("sweep", "which values go together, and what is recorded"),
    };
    return tables;
  }
  void check(StudyChecker& checker) const override { SweepCheck(checker).run(); }

  Json plan_inputs(const StudyFile& study) const override {
    Json inputs = Json::array();
    for (const SweepVariable& v : study.part<SweepPart>().variables)
      inputs.push_back({{"path", v.path}, {"values", sweep_values(v)}});
    return inputs;
  }
  std::string_view plan_points(const StudyFile& study) const override {
    return study.part<SweepPart>().sweep.mode == SweepMode::list ? "value i of every variable"
                                                                 : "every value with every other";
  }

  Outcome<SampledStudy> make_rows(const StudyFile& study, const RunContext& context) const override {
    return make_sweep_rows(study, context);
  }
  std::unique_ptr<const RowAnswer> answer(const StudyFile&, const SampledStudy& rows,
                                          const RowTable& table) const override {
    return std::make_unique<SweepAnswer>(output_ranges(rows, table));
  }

  std::string report_tables(const StudyFile&, const Json& result) const override {
    if (!result.contains("ranges"))
      return "";
    std::string html = html_heading("Output", {"least", "at row", "greatest", "at row"});
    for (const auto& [name, r] : result["ranges"].items())
      html += html_row(name,
                       {html_text(r["least"]), fmt::format("{}", r["least_row"].get<std::uint64_t>()),
                        html_text(r["greatest"]), fmt::format("{}", r["greatest_row"].get<std::uint64_t>())});
    return html + "</table>\n";
  }
  std::vector<Figure> report_figures(const StudyFile&, const StoredResults& results,
                                     const Json&) const override {
    std::vector<Figure> figures;
    for (std::size_t output = 0; output < std::min(results.output_columns.size(), most_figures); ++output)
      figures.push_back(main_effects(results, output));
    return figures;
  }
};

} // namespace

const RowKind& sweep_kind() {
  static const SweepKind kind;
  return kind;
}

} // namespace strainwave
