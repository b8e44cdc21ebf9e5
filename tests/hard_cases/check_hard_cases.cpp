// Runs the hard cases, writes the report, and fails if a check failed.
#include "app/commands.hpp"

#include <fmt/format.h>

#include "app/messages.hpp"
#include "app/subcommand.hpp"
#include "renderer/core/error.hpp"
#include "tests/hard_cases/hard_report.hpp"

namespace footprint {

void check_hard_cases(const HardCasesRequest& request) {
  ProgressDisplay display(progress_style(request.quiet));
  const hard_cases::HardSettings settings{
      .context = request.run.backend.context, .methods = request.run.methods, .wide = request.wide};
  warn_without_captions();
  const auto [rows, path, lost] = write_whole(request.output, [&](OutputFolder& folder) {
    auto measured = hard_cases::run_hard_cases(settings, folder.run(), display.callback());
    folder.run().write_document("hard_cases.json", hard_cases::hard_cases_json(measured));
    folder.run().write_text("stability.md", [&] { return hard_cases::stability_page(measured); });
    keep(folder);
    return measured;
  });
  display.finish();
  const std::vector<std::string> failures = hard_cases::failures_of(rows);
  std::string text;
  for (const std::string& line : failures) text += "failed: " + line + "\n";
  write_output(fmt::format("{}{} checks, {} failed\npage: {}\n", text, rows.size(), failures.size(),
                           (path / "stability.md").string()));
  if (failures.empty()) return throw_first({lost});
  throw Error(ErrorKind::check, std::string(hard_cases_name),
              fmt::format("{} of {} checks failed, the first: {}", failures.size(), rows.size(), failures.front()), "");
}

}  // namespace footprint
