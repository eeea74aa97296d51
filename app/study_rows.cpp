// `study run` of the kinds whose rows are known in advance.

#include "app/output.hpp"
#include "app/progress_line.hpp"
#include "app/stop_request.hpp"
#include "app/study.hpp"
#include "strainwave/studies/tables/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>

namespace strainwave::app {

namespace {

struct Shard {
  std::uint32_t number = 0, count = 1;
};

Shard shard_of(const std::string& text) {
  Shard shard;
  if (text.empty())
    return shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  const bool slash = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
  const auto count = slash ? std::from_chars(number.ptr + 1, end, shard.count) : number;
  if (!slash || count.ec != std::errc() || count.ptr != end || shard.number >= shard.count ||
      shard.count > 9999)
    throw UsageError(fmt::format(
        "--shard wants I/N with I from 0 to N - 1 and N at most 9999, for example 0/4; got {}", text));
  return shard;
}

} // namespace

ExitCode exit_code_of(RunEnd end) {
  return static_cast<ExitCode>(run_exit_code(end));
}

ExitCode run_rows_of(const StudyOptions& options, const StudyFile& study, const RowKind& kind,
                     const ResultFolder& folder) {
  const Shard shard = shard_of(options.shard);
  if (shard.count > 1 && kind.ends_by_itself(study))
    throw UsageError(
        "a study that stops by itself (sampling.stop) cannot be cut into shards: they would not know of "
        "each other");
  std::optional<ProgressLine> line(std::in_place);
  const auto made = run_sampled(study, kind, folder,
                                {.context = run_context(options.threads, options.no_cache),
                                 .shard = shard.number,
                                 .shards = shard.count,
                                 .time_limit_s = options.time_limit_s,
                                 .progress =
                                     [&](const RunProgress& progress) {
                                       if (line->due())
                                         line->show(progress_line(progress));
                                     },
                                 .overdue = leave_stopped});
  line.reset();
  if (!made) {
    report(made.failure().message);
    return ExitCode::no_result;
  }
  const std::string name = folder.path().string();
  print(options.json ? sampled_json(*made, name).dump(2) + "\n" : sampled_table(*made, name));
  if (!made->damage.empty())
    report(made->damage);
  if (!made->sentence.empty())
    report(made->sentence);
  else if (shard.count > 1)
    report(fmt::format("shard {}/{} is done; join all of them with: strainwave study merge {}", shard.number,
                       shard.count, name));
  return exit_code_of(made->end);
}

} // namespace strainwave::app
