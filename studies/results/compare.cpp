#include "strainwave/studies/results/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

namespace strainwave {

namespace {

std::vector<std::string> names_of(const std::vector<TableColumn>& columns) {
  std::vector<std::string> names;
  for (const TableColumn& column : columns)
    names.push_back(column.name);
  return names;
}

std::string_view bits_of(const StoredResults& r, std::uint64_t row) {
  const std::size_t columns = r.input_columns.size();
  return {reinterpret_cast<const char*>(r.inputs.data() + row * columns), 8 * columns};
}

/// Row of the second result for every row of the first; rows with equal inputs are matched in their order.
std::vector<std::optional<std::uint64_t>> match(const StoredResults& a, const StoredResults& b) {
  std::vector<std::optional<std::uint64_t>> of(a.rows);
  if (a.input_columns.empty()) {
    for (std::uint64_t row = 0; row < std::min(a.rows, b.rows); ++row)
      of[row] = row;
    return of;
  }
  std::unordered_map<std::string_view, std::vector<std::uint64_t>> places;
  for (std::uint64_t row = b.rows; row-- > 0;)
    places[bits_of(b, row)].push_back(row);
  for (std::uint64_t row = 0; row < a.rows; ++row) {
    const auto found = places.find(bits_of(a, row));
    if (found == places.end() || found->second.empty())
      continue;
    of[row] = found->second.back();
    found->second.pop_back();
  }
  return of;
}

} // namespace

ResultsDifference compare_results(const StoredResults& a, const StoredResults& b) {
  if (names_of(a.input_columns) != names_of(b.input_columns))
    throw std::invalid_argument(
        "the two results do not have the same inputs, so no row of one is a row of the other");
  ResultsDifference d;
  d.first_rows = a.rows;
  d.second_rows = b.rows;
  const auto second_row = match(a, b);
  for (std::uint64_t row = 0; row < a.rows; ++row) {
    if (!second_row[row])
      continue;
    ++d.matched;
    if (a.status_name(row) != b.status_name(*second_row[row])) {
      ++d.status_different;
      if (!d.status_row)
        d.status_row = row;
    }
  }
  const auto first_names = names_of(a.output_columns), second_names = names_of(b.output_columns);
  for (const std::string& name : second_names)
    if (std::ranges::find(first_names, name) == first_names.end())
      d.only_second.push_back(name);
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < first_names.size(); ++i) {
    const auto found = std::ranges::find(second_names, first_names[i]);
    if (found == second_names.end()) {
      d.only_first.push_back(first_names[i]);
      continue;
    }
    const auto j = static_cast<std::size_t>(found - second_names.begin());
    OutputDifference o;
    o.output = first_names[i];
    o.unit = a.output_columns[i].unit;
    for (std::uint64_t row = 0; row < a.rows; ++row) {
      if (!second_row[row])
        continue;
      const double x = a.outputs[row * first_names.size() + i];
      const double y = b.outputs[*second_row[row] * second_names.size() + j];
      if (std::isnan(x) || std::isnan(y))
        continue;
      ++o.rows;
      if (std::memcmp(&x, &y, sizeof x) == 0)
        continue;
      ++o.different;
      const double change = std::abs(x - y);
      if (change > o.largest) {
        o.largest = change;
        o.row = row;
      }
      const double size = std::max(std::abs(x), std::abs(y));
      o.relative = std::max(o.relative, size > 0.0 ? change / size : 0.0);
    }
    different += o.different;
    d.outputs.push_back(std::move(o));
  }
  d.identical = a.rows == b.rows && d.matched == a.rows && d.status_different == 0 && different == 0 &&
                d.only_first.empty() && d.only_second.empty() && a.messages == b.messages;
  return d;
}

} // namespace strainwave
