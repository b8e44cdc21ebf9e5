// Output folders of subcommands: filled out of sight, moved to their place at the end, with errors that name that
// place.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "results/report/listed_files.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// An error of a file that is still out of sight, with the place that the file was meant for.
[[nodiscard]] Error at_final_place(const Error& error, const OutputFolder& folder);

/// Fills in what only the program knows: its version, and the processor that it runs on.
void sign(ToolInfo& tool, BackendInfo& backend);

/// Moves the folder to its place. Errors (interrupted): where the run was interrupted, it is not moved.
void keep(OutputFolder& folder);

/// Prints the summary of `results`, or with `verbose` all of table.md, and the path of their page in `folder`.
void print_results(const Results& results, const std::filesystem::path& folder, bool verbose = false);

/// The error (check) that ends the program after a run in which rows failed, once everything else is written; none
/// where no row failed.
[[nodiscard]] std::optional<Error> row_failures(const Results& results);

/// What `write` makes of the folder (it commits) and where that is. Nothing is left of a folder that was not committed.
template <typename Write>
auto write_whole(const std::filesystem::path& output, Write write) {
  OutputFolder folder(output);
  try {
    auto made = write(folder);
    return std::pair(std::move(made), folder.final_path());
  } catch (const Error& error) {
    throw at_final_place(error, folder);
  }
}

/// Signs measured `results` with the program's version and the processor, lets `write` put them into the folder and
/// moves that to its place, where pictures go that an earlier run's `document` lists. Errors (interrupted): nothing is
/// moved.
template <typename Measured, typename Write>
void keep_results(Measured& results, OutputFolder& folder, Write write, const char* document = "results.json") {
  sign(results.tool, results.backend);
  if constexpr (requires { results.files; }) results.files = images_in(folder.path());
  write(results, folder.path());
  folder.replaces(listed_files(folder.final_path() / document));
  keep(folder);
}

}  // namespace footprint
