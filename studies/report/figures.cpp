// Figures of a study's report.

#include "strainwave/studies/report/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace strainwave {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_figures = 16;

/// For gnuplot: no quote and no enhanced-text sign may end it.
std::string label(std::string_view text) {
  std::string safe;
  for (const char c : text)
    if (c != '\'' && c != '"' && c != '\\' && c != '{' && c != '}')
      safe += c;
  return safe;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return label(unit.empty() || unit == "1" ? name : fmt::format("{} ({})", name, unit));
}

/// The part of a path that tells it from the others: "tip_relief_um".
std::string last_part(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

// ---- sweep: mean and range of an output over every variable

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
        with_unit(last_part(r.input_columns[i].name), r.input_columns[i].unit),
        i == 0 ? fmt::format("set ylabel '{}' noenhanced\n",
                             with_unit(r.output_columns[output].name, r.output_columns[output].unit))
               : "unset ylabel\n",
        figure.name, i, i, figure_colour(0));
  }
  figure.drawing =
      fmt::format("set xtics rotate by -40\nset multiplot layout 1,{}\n{}unset multiplot\n", inputs, panels);
  return figure;
}

// ---- monte_carlo

Figure histogram(const std::string& output, const std::string& unit, const Json& s) {
  Figure figure;
  figure.name = "histogram-" + output;
  const double lower = s["histogram"]["lower"], upper = s["histogram"]["upper"];
  const auto& counts = s["histogram"]["counts"];
  const double width = counts.empty() ? 1.0 : (upper - lower) / static_cast<double>(counts.size());
  figure.data = fmt::format("# middle of the bin ({}), samples\n", unit);
  double most = 1.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    most = std::max(most, counts[i].get<double>());
    figure.data +=
        fmt::format("{:.9g} {}\n", lower + (static_cast<double>(i) + 0.5) * width, counts[i].get<double>());
  }
  figure.drawing = fmt::format("set xlabel '{}' noenhanced\nset ylabel 'samples'\nset style fill solid 0.5 "
                               "noborder\nset yrange [0:{}]\n",
                               with_unit(output, unit), 1.15 * most);
  int k = 0;
  for (const auto& [p, value] : s["quantiles"].items())
    if (value.is_number())
      figure.drawing += fmt::format(
          "set arrow from {0:.9g},0 to {0:.9g},{1} nohead linecolor '{2}' dashtype 2\n"
          "set label '{3}' at {0:.9g},{4} offset 0.4,0 textcolor '{2}'\n",
          value.get<double>(), 1.05 * most, figure_colour(1), p, (1.05 + 0.04 * (k++ % 2)) * most);
  figure.drawing += fmt::format("plot '{}.dat' using 1:2:({:.9g}) with boxes linecolor '{}' notitle\n",
                                figure.name, width > 0.0 ? width : 1.0, figure_colour(0));
  return figure;
}

/// Bars with 95 % intervals, one row for each name: name, value, lower, upper; several groups side by side.
Figure bars(const std::string& name, const std::string& title,
            const std::vector<std::pair<std::string, std::vector<std::array<double, 3>>>>& groups,
            const std::vector<std::string>& names, const std::string& axis) {
  Figure figure;
  figure.name = name;
  figure.height = static_cast<int>(120 + 40 * names.size());
  const double thick = 0.8 / static_cast<double>(groups.size());
  std::string plots, tics;
  for (std::size_t i = 0; i < names.size(); ++i)
    tics += fmt::format("{}'{}' {}", i ? ", " : "", label(names[i]), names.size() - 1 - i);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    figure.data += fmt::format("# {}: value, lower and upper end of 95 %, place\n", groups[g].first);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto& v = groups[g].second[i];
      const double at =
          static_cast<double>(names.size() - 1 - i) + 0.4 - thick * (static_cast<double>(g) + 0.5);
      figure.data += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}\n", v[0], v[1], v[2], at);
    }
    figure.data += "\n\n";
    plots += fmt::format(
        "{0}'{1}.dat' index {2} using (0.5*$1):4:(0.5*$1):({3}) with boxxyerror fillcolor '{4}' fillstyle "
        "solid 0.6 "
        "noborder title '{5}', '' index {2} using 1:4:2:3 with xerrorbars linecolor '#202020' pointtype 7 "
        "pointsize 0.3 notitle",
        g ? ", " : "plot ", figure.name, g, 0.45 * thick, figure_colour(g), label(groups[g].first));
  }
  figure.drawing = fmt::format("set title '{}' noenhanced\nset xlabel '{}'\nset ytics ({}) noenhanced\nset "
                               "yrange [-0.6:{}]\nset yzeroaxis\nset key outside "
                               "bottom center horizontal\n{}\n",
                               label(title), axis, tics, static_cast<double>(names.size()) - 0.4, plots);
  return figure;
}

double or_nan(const Json& value) {
  return value.is_number() ? value.get<double>() : NAN;
}

void add_monte_carlo(std::vector<Figure>& figures, const StoredResults& r, const Json& result) {
  for (const TableColumn& column : r.output_columns) {
    const auto found = result["statistics"].find(column.name);
    if (found == result["statistics"].end() || !found->contains("histogram") ||
        figures.size() >= most_figures)
      continue;
    figures.push_back(histogram(column.name, column.unit, *found));
    std::vector<std::string> names;
    std::vector<std::array<double, 3>> values;
    for (const auto& [input, c] : (*found)["correlation"].items()) {
      names.push_back(input);
      values.push_back(
          {or_nan(c["pearson"]["value"]), or_nan(c["pearson"]["ci95"][0]), or_nan(c["pearson"]["ci95"][1])});
    }
    if (!names.empty())
      figures.push_back(
          bars("correlation-" + column.name, column.name, {{"correlation", values}}, names, "correlation"));
  }
}

// ---- sensitivity

void add_indices(std::vector<Figure>& figures, const StudyFile& study, const StoredResults& r,
                 const Json& result) {
  const char* const parts[3][2] = {{"first", "total"}, {"mu_star", nullptr}, {"elasticity", nullptr}};
  const auto& kinds = parts[static_cast<std::size_t>(study.sensitivity.method)];
  for (const TableColumn& column : r.output_columns) {
    const auto found = result["indices"].find(column.name);
    if (found == result["indices"].end() || found->empty() || figures.size() >= most_figures)
      continue;
    std::vector<std::string> names;
    std::vector<std::pair<std::string, std::vector<std::array<double, 3>>>> groups;
    for (const char* part : kinds) {
      if (!part)
        continue;
      names.clear();
      std::vector<std::array<double, 3>> values;
      for (const auto& [input, index] : found->items()) {
        names.push_back(input);
        const double v = or_nan(index[part]);
        const bool ends = index.contains("ci95") && index["ci95"].contains(part);
        values.push_back(
            {v, ends ? or_nan(index["ci95"][part][0]) : v, ends ? or_nan(index["ci95"][part][1]) : v});
      }
      groups.emplace_back(part, values);
    }
    figures.push_back(bars("indices-" + column.name, column.name, groups, names, "index"));
  }
}

// ---- optimize, pareto

std::size_t column_of(const StoredResults& r, const std::string& name) {
  for (std::size_t i = 0; i < r.output_columns.size(); ++i)
    if (r.output_columns[i].name == name)
      return i;
  return 0;
}

void add_search(std::vector<Figure>& figures, const StudyFile& study, const StoredResults& r,
                const Json& result) {
  const std::size_t inputs = r.input_columns.size(), outputs = r.output_columns.size();
  const std::size_t aim = column_of(r, study.objective.output);
  for (std::size_t i = 0; i < inputs && figures.size() < most_figures; ++i) {
    Figure figure;
    figure.name = fmt::format("search-{}", i);
    figure.data = fmt::format("# {}, {}\n", r.input_columns[i].name, study.objective.output);
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
      figure.data += fmt::format("\n\n# {}\n{:.9g} {:.9g}\n", title, or_nan(result[key]["inputs"][path]),
                                 or_nan(result[key]["outputs"][study.objective.output]));
      marks += fmt::format(
          ", '' index {} using 1:2 with points pointtype 7 pointsize 1.1 linecolor '{}' title '{}'", block++,
          figure_colour(static_cast<std::size_t>(colour)), title);
    }
    figure.drawing = fmt::format(
        "set xlabel '{}' noenhanced\nset ylabel '{}' noenhanced\nset key outside top horizontal\nplot "
        "'{}.dat' index 0 using 1:2 "
        "with points pointtype 7 pointsize 0.35 linecolor '{}' title 'evaluations'{}\n",
        with_unit(path, r.input_columns[i].unit),
        with_unit(study.objective.output, r.output_columns[aim].unit), figure.name, figure_colour(5), marks);
    figures.push_back(std::move(figure));
  }
  if (!result.contains("front"))
    return;
  Figure figure;
  figure.name = "front";
  figure.data = fmt::format("# {}, {}\n", study.objective.output, study.pareto.output);
  for (const Json& point : result["front"])
    if (point["outputs"].is_object())
      figure.data += fmt::format("{:.9g} {:.9g}\n", or_nan(point["outputs"][study.objective.output]),
                                 or_nan(point["outputs"][study.pareto.output]));
  figure.drawing =
      fmt::format("set xlabel '{}' noenhanced\nset ylabel '{}' noenhanced\nplot 'front.dat' using 1:2 with "
                  "linespoints pointtype 7 "
                  "linecolor '{}' notitle\n",
                  with_unit(study.objective.output, r.output_columns[aim].unit),
                  with_unit(study.pareto.output, r.output_columns[column_of(r, study.pareto.output)].unit),
                  figure_colour(0));
  figures.insert(figures.begin(), std::move(figure));
}

} // namespace

std::vector<Figure> report_figures(const StudyFile& study, const StoredResults& r, const Json& result) {
  std::vector<Figure> figures;
  if (study.kind == StudyKind::sweep) {
    for (std::size_t output = 0; output < std::min(r.output_columns.size(), most_figures); ++output)
      figures.push_back(main_effects(r, output));
  } else if (study.kind == StudyKind::monte_carlo && result.contains("statistics")) {
    add_monte_carlo(figures, r, result);
  } else if (study.kind == StudyKind::sensitivity && result.contains("indices")) {
    add_indices(figures, study, r, result);
  } else if (study.kind == StudyKind::optimize || study.kind == StudyKind::pareto) {
    add_search(figures, study, r, result);
  }
  return figures;
}

} // namespace strainwave
