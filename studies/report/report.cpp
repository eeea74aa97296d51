#include "strainwave/studies/report/report.hpp"

#include "strainwave/common/files/whole_file.hpp"
#include "strainwave/studies/report/page.hpp"
#include "strainwave/studies/report/reported_kind.hpp"
#include "strainwave/studies/results/result_folder.hpp"
#include "strainwave/studies/results/results_reader.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <fstream>
#include <iterator>
#include <system_error>

namespace strainwave {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

constexpr std::string_view style = R"(
body { font: 15px/1.45 "DejaVu Sans", Helvetica, Arial, sans-serif; color: #202020; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2.2rem; border-bottom: 1px solid #d0d0d0; }
table { border-collapse: collapse; margin: 0.6rem 0; } td, th { padding: 0.15rem 0.8rem 0.15rem 0; text-align: left; vertical-align: top; }
th { border-bottom: 1px solid #808080; } td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; }
img { max-width: 100%; display: block; margin: 1rem 0; } pre { background: #f4f4f4; padding: 0.6rem; overflow-x: auto; }
.bad { color: #b03000; }
)";

std::string head(const StudyFile& study, const Json& result, const StoredResults& results,
                 const fs::path& folder) {
  const std::string name = fs::path(study.file).stem().string();
  std::string page = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title><style>{1}</style>"
      "</head>\n<body>\n<h1>{0}: {2} of “{3}”{4}</h1>\n",
      escape_html(name), style, study.kind->name(), escape_html(study.gear.name),
      study.reduced ? " (reduced study)" : "");
  const Json& e = result["evaluations"];
  page += fmt::format("<p>{} rows; {} failed. Fidelity {}. Seed {}. Version {}, plan {}.</p>\n", results.rows,
                      e.value("failed", 0ULL), choice_name(study.gear.contact.fidelity), study.seed,
                      escape_html(results.version), results.plan_hash);
  const std::string verdict =
      result.value("verdict", result.value("complete", false) ? "complete" : "not complete");
  const std::string message = result.value("message", "");
  page += fmt::format("<p><b>{}</b>{}{}</p>\n", escape_html(verdict), message.empty() ? "" : ": ",
                      escape_html(message));
  (void)folder;
  return page;
}

std::string failures(const Json& result, const fs::path& folder) {
  if (!result.contains("failures") || result["failures"].empty())
    return "";
  std::string page = "<h2>Evaluations without a result</h2>\n<p>They are left out of every number "
                     "above.</p>\n<table><tr><th>status</th><th "
                     "class=n>how many</th><th>for example</th></tr>\n";
  for (const Json& f : result["failures"])
    page += fmt::format("<tr><td>{}</td><td class=n>{}</td><td>{}</td></tr>\n",
                        escape_html(f.value("status", "")), f.value("count", 0ULL),
                        escape_html(f.value("example", "")));
  page += "</table>\n";
  if (result["failures"][0].contains("example_row"))
    page += fmt::format("<pre>strainwave eval --from {} --index {}</pre>\n", escape_html(folder.string()),
                        result["failures"][0].value("example_row", 0ULL));
  return page;
}

} // namespace

std::string write_report(const fs::path& folder, StudyKinds kinds) {
  const StudyFile study = read_plan(folder, kinds);
  const auto& kind = dynamic_cast<const ReportedKind&>(*study.kind);
  const StoredResults results = read_results_table(folder / "results.h5");
  const Json result = Json::parse(text_of(folder / "result.json"), nullptr, false);
  if (!result.is_object() || !result.contains("evaluations"))
    throw std::system_error(EIO, std::generic_category(), (folder / "result.json").string() + " is damaged");
  const std::vector<Figure> figures = kind.report_figures(study, results, result);
  const Drawn drawn = draw(figures, folder / "figures");
  std::string page = head(study, result, results, folder) + kind.report_tables(study, result);
  std::string pictures;
  for (const Figure& figure : figures)
    if (const std::string svg = text_of(folder / "figures" / (figure.name + ".svg")); !svg.empty())
      pictures += fmt::format("<img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">\n",
                              escape_html(figure.name), base64(svg));
  if (!pictures.empty())
    page += "<h2>Figures</h2>\n" + pictures;
  else if (!drawn.note.empty())
    page += fmt::format("<p class=bad>{}</p>\n", escape_html(drawn.note));
  page += failures(result, folder);
  page += fmt::format("<h2>One evaluation again</h2>\n<p>Every row of results.h5 can be made again, bit for "
                      "bit; <code>--gear</code> writes it "
                      "as a gear file.</p>\n<pre>strainwave eval --from {} --index 0 --gear row.toml</pre>\n",
                      escape_html(folder.string()));
  page += fmt::format("<h2>The whole study</h2>\n<details><summary>study and gear, every default filled "
                      "in</summary>\n<pre>{}</pre>\n"
                      "</details>\n</body></html>\n",
                      escape_html(config_text(study)));
  write_whole_text(folder / "report.html", page);
  return drawn.note;
}

} // namespace strainwave
