// `study status`, `merge` and `compare`: what is asked of folders that runs have left.

#include "app/commands.hpp"
#include "app/output.hpp"
#include "app/study.hpp"
#include "strainwave/common/rows/merge.hpp"
#include "strainwave/studies/commands/kinds.hpp"
#include "strainwave/studies/commands/status.hpp"
#include "strainwave/studies/results/compare.hpp"
#include "strainwave/studies/search/optimisation.hpp"
#include "strainwave/studies/tables/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <stdexcept>

namespace strainwave::app {

namespace {

using Json = nlohmann::ordered_json;

/// What to do next, as one sentence.
std::string advice(const StudyStatus& s, const std::string& folder) {
  bool running = false;
  for (const JournalStatus& j : s.journals)
    running = running || j.running;
  if (!row_kind(s.study))
    return running                                       ? "it is running"
           : s.verdict.empty() || s.verdict == "stopped" ? "run it again to go on"
                                                         : "it has ended: " + s.verdict;
  if (s.journals.empty())
    return "nothing is done yet; run it";
  if (running)
    return s.missing.empty() ? "it is running" : "it is running; " + s.missing;
  if (!s.missing.empty())
    return s.missing;
  return s.has_results ? "it is complete"
                       : fmt::format("all rows are there: strainwave study merge {}", folder);
}

ExitCode status(const std::string& folder, bool as_json) {
  const StudyStatus s = study_status(folder);
  const std::string next = advice(s, folder);
  if (as_json) {
    Json json{{"kind", s.study.kind->name()},
              {"rows", s.rows},
              {"done", s.done},
              {"failed", s.failed},
              {"complete", row_kind(s.study) ? !s.journals.empty() && s.missing.empty()
                                             : !s.verdict.empty() && s.verdict != "stopped"},
              {"results", s.has_results},
              {"next", next},
              {"shards", Json::array()}};
    for (const JournalStatus& j : s.journals)
      json["shards"].push_back({{"file", j.file},
                                {"shard", j.shard},
                                {"shards", j.shards},
                                {"rows", j.rows},
                                {"done", j.done},
                                {"failed", j.failed},
                                {"running", j.running},
                                {"note", j.note}});
    print(json.dump(2) + "\n");
    return ExitCode::done;
  }
  std::string text = fmt::format("{}: {} of \"{}\"\n", s.study.file, s.study.kind->name(), s.study.gear.name);
  if (s.rows > 0)
    text += fmt::format("  {} of {} rows done ({:.1f} %), {} failed\n", s.done, s.rows,
                        100.0 * static_cast<double>(s.done) / static_cast<double>(s.rows), s.failed);
  else
    text += fmt::format("  {} evaluations done\n", s.done);
  for (const JournalStatus& j : s.journals)
    text += fmt::format("  {:<24} {:>10}{} done, {} failed{}{}\n", j.file, j.done,
                        j.rows > 0 ? fmt::format(" of {}", j.rows) : "", j.failed,
                        j.running ? ", running" : "", j.note.empty() ? "" : "; " + j.note);
  print(text + "  " + next + "\n");
  return ExitCode::done;
}

ExitCode merge(const std::string& folder_name, bool allow_missing, bool as_json, bool no_cache) {
  const StudyFile study = read_plan(folder_name, study_kinds());
  const RowKind* kind = row_kind(study);
  if (!kind)
    throw UsageError(folder_name +
                     " holds a search, which has no shards; `study run` joins what it has found");
  if (!std::filesystem::exists(std::filesystem::path(folder_name) / "shards"))
    throw UsageError(folder_name +
                     "/shards is not there: no shard has been run yet, or not into this folder");
  const auto journals = shard_journals(folder_name);
  if (journals.empty())
    throw UsageError(folder_name + "/shards holds no journal; copy those of all shards there");
  std::optional<Merged> merged;
  try {
    merged = merge_journals(journals, allow_missing);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  if (merged->header.plan_hash != plan_hash(study))
    throw UsageError(fmt::format("{} is the journal of another study than {}/plan.json",
                                 journals.front().string(), folder_name));
  for (const std::string& note : merged->notes)
    report(note);
  const auto rows = kind->make_rows(study, run_context(0, no_cache));
  if (!rows) {
    report(rows.failure().message);
    return ExitCode::no_result;
  }
  if (merged->header.model_hash != sampled_model_hash(*rows) ||
      merged->header.outputs != rows->model->outputs())
    throw UsageError(journals.front().string() + " was written by another model than this program's");
  SampledReport result = report_of(study, *rows, merged->table);
  if (result.whole)
    add_answers(result, *kind, *rows, merged->table);
  result.reused = result.done;
  const double share = static_cast<double>(result.failed);
  if (share > study.limits.failure_share * static_cast<double>(result.done)) {
    result.end = RunEnd::too_many_failed;
    result.sentence = fmt::format("{} of {} rows failed, more than the share of {} that the study allows",
                                  result.failed, result.done, study.limits.failure_share);
  }
  const ResultFolder folder(folder_name);
  write_sampled_results(folder, *rows, merged->table, result);
  print(as_json ? sampled_json(result, folder_name).dump(2) + "\n" : sampled_table(result, folder_name));
  if (merged->missing_rows > 0)
    report(fmt::format("{} rows are missing; the statistics wait for them", merged->missing_rows));
  if (!result.sentence.empty())
    report(result.sentence);
  return exit_code_of(result.end);
}

ExitCode compare(const std::string& first, const std::string& second, bool as_json, bool exact) {
  const auto results_of = [](const std::string& folder) {
    const auto path = std::filesystem::path(folder) / "results.h5";
    if (!std::filesystem::exists(path))
      throw UsageError(path.string() +
                       " is not there: run the study to its end, or `strainwave study merge` its shards");
    return read_results_table(path);
  };
  const StoredResults a = results_of(first), b = results_of(second);
  ResultsDifference d;
  try {
    d = compare_results(a, b);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  if (as_json) {
    Json json{{"identical", d.identical},    {"rows", {d.first_rows, d.second_rows}},
              {"matched", d.matched},        {"status_different", d.status_different},
              {"outputs", Json::object()},   {"only_first", d.only_first},
              {"only_second", d.only_second}};
    for (const OutputDifference& o : d.outputs)
      json["outputs"][o.output] = {{"rows", o.rows},
                                   {"different", o.different},
                                   {"largest", o.largest},
                                   {"relative", o.relative},
                                   {"row", o.row}};
    print(json.dump(2) + "\n");
  } else {
    std::string text = fmt::format("{} rows and {} rows, {} with the same inputs{}\n", d.first_rows,
                                   d.second_rows, d.matched, d.identical ? ": identical, bit for bit" : "");
    if (d.status_different > 0)
      text += fmt::format("  {} rows end with another status, the first is row {}\n", d.status_different,
                          *d.status_row);
    if (!d.identical) {
      text += fmt::format("  {:<30} {:>8} {:>10} {:>14} {:>12} {:>10}\n", "Outputs", "unit", "different",
                          "largest change", "relative", "at row");
      for (const OutputDifference& o : d.outputs)
        text += fmt::format("  {:<30} {:>8} {:>10} {:>14.5g} {:>12.3g} {:>10}\n", o.output, o.unit,
                            o.different, o.largest, o.relative, o.row);
    }
    for (const std::string& name : d.only_first)
      text += fmt::format("  {} is in {} alone\n", name, first);
    for (const std::string& name : d.only_second)
      text += fmt::format("  {} is in {} alone\n", name, second);
    print(text);
  }
  return exact && !d.identical ? ExitCode::no_result : ExitCode::done;
}

} // namespace

void add_study_status(CLI::App& study, Command& chosen) {
  CLI::App* command = study.add_subcommand("status", "What of a study is done, also while it runs");
  const auto folder = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  command->add_option("DIR", *folder, "The folder of a study")->required();
  command->add_flag("--json", *json, "Print one JSON object");
  command->callback([&chosen, folder, json] { chosen = [folder, json] { return status(*folder, *json); }; });
}

void add_study_merge(CLI::App& study, Command& chosen) {
  CLI::App* command = study.add_subcommand("merge", "Join the shards of a study into results.h5");
  command->footer(
      "Reads DIR/shards/*.journal, wherever they were written. Rows that are missing are named with the\n"
      "shard to run again (exit code 75); rows that two shards answer differently are an error.");
  struct Options {
    std::string folder;
    bool allow_missing = false, json = false, no_cache = false;
  };
  const auto o = std::make_shared<Options>();
  command->add_option("DIR", o->folder, "The folder of a study")->required();
  command->add_flag("--allow-missing", o->allow_missing, "Write what is there; statistics wait for the rest");
  command->add_flag("--json", o->json, "Print one JSON object instead of the table");
  command->add_flag("--no-cache", o->no_cache, "Neither read nor write the cache of solved cups");
  command->callback([&chosen, o] {
    chosen = [o] {
      return with_journals([&] { return merge(o->folder, o->allow_missing, o->json, o->no_cache); });
    };
  });
}

void add_study_compare(CLI::App& study, Command& chosen) {
  CLI::App* command = study.add_subcommand("compare", "The difference of two results, row by row");
  struct Options {
    std::string first, second;
    bool json = false, exact = false;
  };
  const auto o = std::make_shared<Options>();
  command->add_option("DIR1", o->first, "The folder of a study")->required();
  command->add_option("DIR2", o->second, "Another one")->required();
  command->add_flag("--exact", o->exact, "Exit code 3 unless both are identical, bit for bit");
  command->add_flag("--json", o->json, "Print one JSON object");
  command->callback(
      [&chosen, o] { chosen = [o] { return compare(o->first, o->second, o->json, o->exact); }; });
}

} // namespace strainwave::app
