// The run, its files and its verdict.
#include "app/hard_cases.hpp"

#include <fmt/format.h>

#include "app/output.hpp"
#include "app/progress_display.hpp"
#include "app/standard_output.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "stability/hard_report.hpp"

namespace footprint {

void check_hard_cases(const HardCasesRequest& request) {
  ProgressDisplay display(progress_style(request.quiet));
  const stability::HardSettings settings{
      .context = request.run.backend.context, .methods = request.run.methods, .wide = request.wide};
  const auto [rows, path] = write_whole(request.output, [&](OutputFolder& folder) {
    auto measured = stability::run_hard_cases(settings, folder.path(), display.callback());
    write_file_atomically(folder.path() / "hard_cases.json", stability::hard_cases_json(measured));
    write_file_atomically(folder.path() / "stability.md", stability::stability_page(measured));
    keep(folder);
    return measured;
  });
  display.finish();
  const std::vector<std::string> fell = stability::what_fell(rows);
  std::string text;
  for (const std::string& line : fell) text += "failed: " + line + "\n";
  write_output(fmt::format("{}{} checks, {} failed\npage: {}\n", text, rows.size(), fell.size(),
                           (path / "stability.md").string()));
  if (fell.empty()) return;
  throw Error(ErrorKind::check, std::string(hard_cases_name),
              fmt::format("{} of {} checks failed, the first: {}", fell.size(), rows.size(), fell.front()), "");
}

}  // namespace footprint
