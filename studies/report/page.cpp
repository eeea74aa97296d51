#include "strainwave/studies/report/page.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace strainwave {

using Json = nlohmann::ordered_json;

std::string escape_html(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
    case '&':
      safe += "&amp;";
      break;
    case '<':
      safe += "&lt;";
      break;
    case '>':
      safe += "&gt;";
      break;
    case '"':
      safe += "&quot;";
      break;
    default:
      safe += c;
    }
  }
  return safe;
}

std::string html_text(const Json& value) {
  if (value.is_number())
    return fmt::format("{:.5g}", value.get<double>());
  return value.is_string() ? escape_html(value.get<std::string>()) : "–";
}

std::string html_interval(const Json& ci) {
  return ci.is_array() && ci.size() == 2 ? fmt::format("[{}, {}]", html_text(ci[0]), html_text(ci[1])) : "";
}

std::string html_row(const std::string& name, const std::vector<std::string>& cells, const char* tag) {
  std::string html = fmt::format("<tr><{0}>{1}</{0}>", tag, escape_html(name));
  for (const std::string& cell : cells)
    html += fmt::format("<{0} class=n>{1}</{0}>", tag, cell);
  return html + "</tr>\n";
}

std::string html_heading(const std::string& name, const std::vector<std::string>& cells) {
  return "<table>" + html_row(name, cells, "th");
}

std::string gnuplot_text(std::string_view text) {
  std::string safe;
  for (const char c : text)
    if (c != '\'' && c != '"' && c != '\\' && c != '{' && c != '}')
      safe += c;
  return safe;
}

std::string axis_label(const std::string& name, const std::string& unit) {
  return gnuplot_text(unit.empty() || unit == "1" ? name : fmt::format("{} ({})", name, unit));
}

std::string last_part_of_path(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

double number_or_nan(const Json& value) {
  return value.is_number() ? value.get<double>() : NAN;
}

Figure bars(const std::string& name, const std::string& title, const std::vector<BarGroup>& groups,
            const std::vector<std::string>& names, const std::string& axis) {
  Figure figure;
  figure.name = name;
  figure.height = static_cast<int>(120 + 40 * names.size());
  const double thick = 0.8 / static_cast<double>(groups.size());
  std::string plots, tics;
  for (std::size_t i = 0; i < names.size(); ++i)
    tics += fmt::format("{}'{}' {}", i ? ", " : "", gnuplot_text(names[i]), names.size() - 1 - i);
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
        g ? ", " : "plot ", figure.name, g, 0.45 * thick, figure_colour(g), gnuplot_text(groups[g].first));
  }
  figure.drawing =
      fmt::format("set title '{}' noenhanced\nset xlabel '{}'\nset ytics ({}) noenhanced\nset "
                  "yrange [-0.6:{}]\nset yzeroaxis\nset key outside "
                  "bottom center horizontal\n{}\n",
                  gnuplot_text(title), axis, tics, static_cast<double>(names.size()) - 0.4, plots);
  return figure;
}

} // namespace strainwave
