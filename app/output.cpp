// Places of errors, signatures, and the summary that is printed at the end.
#include "app/output.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/messages.hpp"
#include "renderer/core/process.hpp"
#include "results/report/report.hpp"

namespace footprint {

Error at_final_place(const Error& error, const OutputFolder& folder) {
  std::string place = error.place();
  const std::string hidden = folder.path().string();
  if (place.starts_with(hidden)) place.replace(0, hidden.size(), folder.final_path().string());
  return {error.kind(), std::move(place), error.message(), error.hint()};
}

std::filesystem::path image_path(const std::string& output, const std::string& hint) {
  std::filesystem::path path = output;
  if (path.extension() == ".exr" || path.extension() == ".png") return path;
  throw Error(ErrorKind::usage, "--output", fmt::format("`{}` is not an image file", output), hint);
}

void sign(ToolInfo& tool, BackendInfo& backend) {
  tool.version = FOOTPRINT_VERSION;
  backend.cpu = describe_cpu();
}

void keep(OutputFolder& folder) {
  throw_if_interrupted();
  folder.commit();
}

void print_results(const Results& results, const std::filesystem::path& folder, bool verbose) {
  write_output(verbose ? fmt::format("{}\npage: {}\n", results_table(results), (folder / "index.html").string())
                       : fmt::format("{}\n  page: {}\n  every figure: {}\n", results_summary(results),
                                     (folder / "index.html").string(), (folder / "table.md").string()));
}

void write_and_print_animation(const std::filesystem::path& output,
                               const std::function<Results(const std::filesystem::path& folder)>& make) {
  const auto [animation, path] = write_whole(output, [&](OutputFolder& folder) {
    Results made = make(folder.path());
    keep_results(made, folder, write_report);
    return made;
  });
  write_output(fmt::format("{}\nframes: {}\npage: {}\n", results_table(animation), (path / "images").string(),
                           (path / "index.html").string()));
}

std::optional<Error> row_failures(const Results& results) {
  const auto failure_of = [](const Record& record) {
    if (record.failure) return record.failure;
    const auto missing = std::ranges::find_if(record.gpu_costs, [](const GpuCost& cost) { return !!cost.failure; });
    return missing == record.gpu_costs.end() ? std::optional<std::string>() : missing->failure;
  };
  const auto is_failed = [&](const Record& record) { return !!failure_of(record); };
  const auto first = std::ranges::find_if(results.records, is_failed);
  if (first == results.records.end()) return {};
  return Error(ErrorKind::check, results.scene.name,
               fmt::format("{} of {} rows failed; the first, at distance {:g}: {}",
                           std::ranges::count_if(results.records, is_failed), results.records.size(), first->distance,
                           *failure_of(*first)));
}

void require_none_failed(const std::string& place, const char* checks, const std::vector<std::string>& failures) {
  std::string list;
  for (const std::string& failure : failures) list += "failed: " + failure + "\n";
  write_output(list);
  if (failures.empty()) return;
  throw Error(ErrorKind::check, place,
              fmt::format("{} {} failed, the first: {}", failures.size(), checks, failures.front().substr(0, 300)), "");
}

}  // namespace footprint
