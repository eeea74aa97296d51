#pragma once
// Pieces of a study's page, for the kinds: cells and tables in HTML, labels and bars of figures.

#include "strainwave/model/export/figure.hpp"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strainwave {

/// A page has no more figures than this of one kind of answer.
inline constexpr std::size_t most_figures = 16;

std::string escape_html(std::string_view text);
/// A number with five digits, a text, or a dash.
std::string html_text(const nlohmann::ordered_json& value);
/// "[lower, upper]" of a list of two; empty for anything else.
std::string html_interval(const nlohmann::ordered_json& ends);
/// First cell a name, all others numbers (HTML).
std::string html_row(const std::string& name, const std::vector<std::string>& cells, const char* tag = "td");
/// Opens a table by its first row.
std::string html_heading(const std::string& name, const std::vector<std::string>& cells);

/// For gnuplot: no quote and no enhanced-text sign may end it.
std::string gnuplot_text(std::string_view text);
/// "peak_force_n (N)"
std::string axis_label(const std::string& name, const std::string& unit);
/// The part of a path that tells it from the others: "tip_relief_um".
std::string last_part_of_path(const std::string& path);
double number_or_nan(const nlohmann::ordered_json& value);

/// One colour of a figure of bars: its title, and of each name value, lower and upper end of 95 %.
using BarGroup = std::pair<std::string, std::vector<std::array<double, 3>>>;
/// Bars with 95 % intervals, one row for each name; several groups side by side.
Figure bars(const std::string& name, const std::string& title, const std::vector<BarGroup>& groups,
            const std::vector<std::string>& names, const std::string& axis);

} // namespace strainwave
