#include "strainwave/studies/search/text.hpp"

#include "strainwave/studies/search/bound.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <iterator>

namespace strainwave {

namespace {

using Json = nlohmann::ordered_json;
using Out = std::back_insert_iterator<std::string>;

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.5g}", value) : "–";
}

std::string change_text(double before, double after) {
  if (!std::isfinite(before) || !std::isfinite(after) || before == 0.0)
    return "";
  const double percent = 100.0 * (after - before) / std::abs(before);
  return std::abs(percent) < 0.05 ? "=" : fmt::format("{:+.1f} %", percent);
}

void line(Out out, std::string_view name, std::string_view unit, double before, std::optional<double> after,
          std::string_view remark = "") {
  fmt::format_to(out, "  {:<46} {:>8} {:>12} {:>12} {:>10}{}{}\n", name, unit, number_text(before),
                 after ? number_text(*after) : "–", after ? change_text(before, *after) : "",
                 remark.empty() ? "" : "  ", remark);
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json outputs_json(const Evaluation& evaluation) {
  Json json = Json::object();
  const auto responses = gear_responses();
  for (std::size_t i = 0; i < responses.size(); ++i)
    json[std::string(responses[i].name)] = number(evaluation.values[i]);
  return json;
}

Json certificate_json(const Certificate& c) {
  return {{"complementarity", c.complementarity}, {"min_gap_um", c.min_gap_um},
          {"min_force_n", c.min_force_n},         {"reciprocity", c.reciprocity},
          {"equilibrium", c.equilibrium},         {"discretisation_estimate", c.discretisation_estimate}};
}

/// One line for each design: the two aims, the variables, the verdict.
void front_table(const OptimisationReport& report, Out out) {
  const std::string& first = report.study.part<SearchPart>().objective.output;
  const std::string& second = report.study.part<ParetoPart>().pareto.output;
  fmt::format_to(out, "\n  Front: {} against {}\n  {:>14} {:>14}", first, second, first.substr(0, 14),
                 second.substr(0, 14));
  const std::size_t variables = report.study.part<SearchPart>().variables.size();
  for (std::size_t i = 0; i < variables; ++i)
    fmt::format_to(out, " {:>12}", fmt::format("input {}", i + 1));
  fmt::format_to(out, "  verdict\n");
  const auto responses = gear_responses();
  for (const FrontPoint& point : report.front) {
    const auto aim = [&](const std::string& name) {
      return point.outputs ? number_text(point.outputs->values[*find_response(responses, name)]) : "–";
    };
    fmt::format_to(out, "  {:>14} {:>14}", aim(first), aim(second));
    for (std::size_t i = 0; i < variables; ++i)
      fmt::format_to(out, " {:>12}", point.outputs ? number_text(point.inputs[i].best) : "–");
    fmt::format_to(out, "  {}\n", verdict_name(point.verdict));
  }
}

Json front_json(const OptimisationReport& report) {
  Json front = Json::array();
  for (const FrontPoint& point : report.front) {
    Json inputs = Json::object();
    for (const InputChange& input : point.inputs)
      inputs[input.path] = input.best;
    front.push_back({{"bound", point.bound ? Json(*point.bound) : Json(nullptr)},
                     {"verdict", verdict_name(point.verdict)},
                     {"message", point.message},
                     {"inputs", point.outputs ? inputs : Json(nullptr)},
                     {"outputs", point.outputs ? outputs_json(*point.outputs) : Json(nullptr)}});
  }
  return front;
}

/// What the optimum is worth in other models: objective, rotation and least backlash, unmodified → optimised.
void variant_table(const OptimisationReport& report, Out out) {
  const auto responses = gear_responses();
  const auto value = [&](const Evaluation& e, std::string_view name) {
    return e.ok ? number_text(e.values[*find_response(responses, name)]) : std::string("–");
  };
  const std::string& aim = report.study.part<SearchPart>().objective.output;
  fmt::format_to(out, "\n  {:<22} {:>30} {:>30} {:>24}\n", "The optimum in other models", aim, "rotation_rad",
                 "min_backlash_um");
  for (const ModelVariant& v : report.variants) {
    const auto pair = [&](std::string_view name) {
      return fmt::format("{} → {}", value(v.baseline, name), value(v.best, name));
    };
    const auto index = *find_response(responses, aim);
    const std::string change =
        v.baseline.ok && v.best.ok ? change_text(v.baseline.values[index], v.best.values[index]) : "";
    fmt::format_to(out, "  {:<22} {:>22} {:>9} {:>28} {:>24}\n", v.name, pair(aim), change,
                   pair("rotation_rad"), pair("min_backlash_um"));
    for (const Evaluation* e : {&v.baseline, &v.best})
      if (!e->ok)
        fmt::format_to(out, "    {}: {}\n", e == &v.best ? "optimum" : "unmodified", e->message);
  }
}

Json variants_json(const OptimisationReport& report) {
  Json all = Json::array();
  const auto outputs = [](const Evaluation& e) {
    return e.ok ? outputs_json(e) : Json{{"status", e.status}, {"message", e.message}};
  };
  for (const ModelVariant& v : report.variants)
    all.push_back({{"model", v.name}, {"baseline", outputs(v.baseline)}, {"best", outputs(v.best)}});
  return all;
}

} // namespace

std::string optimisation_table(const OptimisationReport& report, const std::string& folder) {
  const StudyFile& study = report.study;
  std::string text;
  const Out out(text);
  fmt::format_to(out, "{}: {} {} of \"{}\"{}\n", std::filesystem::path(study.file).stem().string(),
                 study.part<SearchPart>().objective.goal == Goal::maximise ? "largest" : "least",
                 study.part<SearchPart>().objective.output, study.gear.name,
                 study.reduced ? " (reduced study)" : "");
  fmt::format_to(out, "fidelity {}, {} variable{}, method {}\n\n", choice_name(study.gear.contact.fidelity),
                 study.part<SearchPart>().variables.size(),
                 study.part<SearchPart>().variables.size() == 1 ? "" : "s", report.method);

  const auto headings = [&](const char* what) {
    fmt::format_to(out, "  {:<46} {:>8} {:>12} {:>12} {:>10}\n", what, "unit", "unmodified", "optimised",
                   "change");
  };
  headings("Inputs");
  for (const InputChange& input : report.inputs)
    line(out, input.path, input.unit, input.baseline, report.best ? std::optional(input.best) : std::nullopt,
         input.link.empty() ? "" : "= " + input.link);
  fmt::format_to(out, "\n");
  headings("Outputs");
  const auto responses = gear_responses();
  for (std::size_t i = 0; i < responses.size(); ++i) {
    if (!std::isfinite(report.baseline.values[i]))
      continue;
    line(out, responses[i].name, responses[i].unit, report.baseline.values[i],
         report.best ? std::optional(report.best->values[i]) : std::nullopt,
         responses[i].name == study.part<SearchPart>().objective.output ? "<- objective" : "");
  }
  if (!report.limits.empty())
    fmt::format_to(out, "\n  Limits\n");
  for (const LimitReport& l : report.limits) {
    const Response& response = responses[l.limit.response];
    fmt::format_to(out, "  {} {} {:.6g}{}{}{}", response.name, l.limit.upper ? "≤" : "≥", l.limit.bound,
                   response.unit.empty() ? "" : " ", response.unit,
                   l.origin.empty() ? "" : fmt::format(" ({})", l.origin));
    if (report.best) {
      const double value = report.best->values[l.limit.response];
      const double excess = l.limit.scaled_excess(value);
      fmt::format_to(out, ": {:.6g}, {}", value,
                     excess > feasibility_tolerance ? "VIOLATED"
                     : excess > -1e-3               ? "kept, active"
                                                    : "kept");
    }
    fmt::format_to(out, "\n");
  }
  if (!report.variants.empty())
    variant_table(report, out);
  if (!report.front.empty())
    front_table(report, out);
  fmt::format_to(out, "\nVerdict      {}: {}\n", verdict_name(report.verdict), report.message);
  if (const std::string bound = bound_sentence(report); !bound.empty())
    fmt::format_to(out, "Bound        {}\n", bound);
  fmt::format_to(out, "Evaluations  {} done, {} reused, {} failed; {:.1f} s\n", report.counts.done,
                 report.counts.reused, report.counts.failed, report.seconds);
  for (const FailureCount& failure : count_failures(report.points))
    fmt::format_to(out, "             {} {}, for example: {}\n", failure.count, failure.status,
                   failure.example);
  fmt::format_to(out, "Folder       {}\n", folder);
  return text;
}

Json optimisation_json(const OptimisationReport& report, const std::string& folder) {
  Json json;
  const bool pareto = report.study.find_part<ParetoPart>() != nullptr;
  json["kind"] = report.study.kind->name();
  json["study"] = report.study.file;
  json["reduced"] = report.study.reduced;
  json["method"] = report.method;
  json["verdict"] = verdict_name(report.verdict);
  json["message"] = report.message;
  json["evaluations"] = {
      {"done", report.counts.done}, {"reused", report.counts.reused}, {"failed", report.counts.failed}};
  json["seconds"] = report.seconds;
  json["failures"] = Json::array();
  for (const FailureCount& failure : count_failures(report.points))
    json["failures"].push_back(
        {{"status", failure.status}, {"count", failure.count}, {"example", failure.example}});
  Json before = Json::object(), after = Json::object();
  for (const InputChange& input : report.inputs) {
    before[input.path] = input.baseline;
    after[input.path] = input.best;
  }
  json["best"] = nullptr;
  if (report.best)
    json["best"] = {{"inputs", after}, {"outputs", outputs_json(*report.best)}};
  json["baseline"] = {{"inputs", before}, {"outputs", outputs_json(report.baseline)}};
  Json limits = Json::array();
  for (const LimitReport& l : report.limits) {
    Json limit{{"output", gear_responses()[l.limit.response].name},
               {l.limit.upper ? "max" : "min", l.limit.bound}};
    if (report.best) {
      const double value = report.best->values[l.limit.response];
      limit["value"] = number(value);
      limit["kept"] = l.limit.scaled_excess(value) <= feasibility_tolerance;
    }
    limits.push_back(std::move(limit));
  }
  json["limits"] = std::move(limits);
  if (!report.variants.empty())
    json["other_models"] = variants_json(report);
  if (report.bound) {
    const GearBound& bound = report.bound->bound;
    json["bound"] = {{"peak_force_n", bound.peak_force_n},
                     {"rotation_rad", bound.rotation_rad},
                     {"torque_nm", bound.torque_nm},
                     {"phase", bound.phase},
                     {"tooth", bound.tooth},
                     {"force_n", bound.force_n},
                     {"optimum_ratio", report.bound->optimum_n / bound.peak_force_n}};
  }
  if (pareto)
    json["front"] = front_json(report);
  json["certificate_worst"] = certificate_json(report.certificate_worst);
  json["folder"] = folder;
  return json;
}

} // namespace strainwave
