#include "strainwave/studies/file/schema.hpp"
#include "app/commands.hpp"
#include "app/output.hpp"
#include "strainwave/model/gear_file/gear_schema.hpp"
#include "strainwave/model/results/result_fields.hpp"
#include "strainwave/studies/commands/kinds.hpp"

#include <nlohmann/json.hpp>

#include <memory>

namespace strainwave::app {

void add_schema(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of gear files, or of study files");
  command->footer("The schema is JSON Schema 2020-12; editors use it to complete and check keys.\n"
                  "Example:  strainwave schema > strainwave.schema.json");
  const auto as_page = std::make_shared<bool>(false);
  command->add_flag("--reference", *as_page, "Print the reference page of the keys instead, in Markdown");
  const auto of_studies = std::make_shared<bool>(false);
  command->add_flag("--study", *of_studies, "Of study files instead of gear files");
  const auto of_results = std::make_shared<bool>(false);
  command
      ->add_flag("--results", *of_results, "The keys of `analyze --json`, with units, instead; in Markdown")
      ->excludes("--study");
  command->callback([&chosen, as_page, of_studies, of_results] {
    chosen = [as_page, of_studies, of_results] {
      if (*of_results)
        print(results_reference());
      else if (*as_page)
        print(*of_studies ? study_reference_page(study_kinds()) : reference_page());
      else
        print((*of_studies ? study_json_schema(study_kinds()) : json_schema()).dump(2) + "\n");
      return ExitCode::done;
    };
  });
}

} // namespace strainwave::app
