// Output of subcommands. Folders are filled out of sight and moved to their place at the end; errors name that place.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "results/report/records.hpp"
#include "results/report/report.hpp"

namespace footprint {

/// The error of a hidden file, with the path that the file will have at its place.
[[nodiscard]] Error at_final_place(const Error& error, const OutputFolder& folder);

/// The path of an output image. Errors (usage): the extension is neither .exr nor .png, with `hint`.
[[nodiscard]] std::filesystem::path image_path(const std::string& output, const std::string& hint);

/// Adds the program's version and the processor.
void sign(ToolInfo& tool, BackendInfo& backend);

/// Moves the folder to its place. Errors (interrupted): the run was interrupted, and the folder is not moved.
void keep(OutputFolder& folder);

/// Prints the summary of `results`, or with `verbose` all of table.md, and the path of their page in `folder`.
void print_results(const Results& results, const std::filesystem::path& folder, bool verbose = false);

/// Lets `make` fill a folder out of sight, writes the report of the animation that it returns, moves all of it to
/// `output` and prints the table. Errors: those of `make`; nothing is left of the folder then.
void write_and_print_animation(const std::filesystem::path& output,
                               const std::function<Results(const std::filesystem::path& folder)>& make);

/// The error (check) for a run in which rows failed or lack an estimate for a GPU, to be thrown once everything else is
/// written; none if all passed.
[[nodiscard]] std::optional<Error> row_failures(const Results& results);

/// Prints a line per failure of a check. Errors (check): there is one; `checks` says what failed.
void require_none_failed(const std::string& place, const char* checks, const std::vector<std::string>& failures);

/// The result of `write`, which fills and commits the folder, and the folder's place. Removes a folder that was not
/// committed.
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

/// Signs `results`, writes them into the folder by `write` and moves it to its place, where it replaces the images that
/// an earlier run's `document` lists. Errors (interrupted): nothing is moved.
template <typename Measured, typename Write>
void keep_results(Measured& results, OutputFolder& folder, Write write, const char* document = "results.json") {
  sign(results.tool, results.backend);
  if constexpr (requires { results.files; }) results.files = files_below(folder.path(), "images");
  write(results, folder.path());
  folder.replaces(listed_files(folder.final_path() / document));
  keep(folder);
}

}  // namespace footprint
