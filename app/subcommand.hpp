// What subcommands share: options that are settings of a run by their table (experiments/settings/setting.hpp), MAP,
// and output; and the headers that they all need. Folders are filled out of sight and moved to their place at the end;
// errors name that place.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "app/messages.hpp"
#include "experiments/settings/setting.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/core/run_folder.hpp"
#include "renderer/scene/settings/part.hpp"
#include "results/report/records.hpp"
#include "results/report/report.hpp"

namespace footprint {

/// The arguments of a subcommand that has settings of a run, and --quiet. Must outlive the parsing and running of the
/// subcommand.
struct RunArguments {
  /// Adds the options that the table has for `command`'s name.
  explicit RunArguments(CLI::App& command);

  /// Overwrites settings of `run` with the options given, and sets the folders of scenes and the cache. Call it after
  /// the whole command line has been parsed. Errors (usage) name the option; (machine): an image of --size does not fit
  /// in memory.
  void apply(RunSettings& run) const;

  /// Returns the defaults of a run, overwritten by `apply`.
  [[nodiscard]] RunSettings settings() const;

  /// The options given that have a key in [`table`] of an experiment's file: "--spp" of [reference].
  [[nodiscard]] std::vector<std::string> given_of(std::string_view table) const;

  bool quiet = false;

 private:
  std::vector<std::pair<const Setting*, const CLI::Option*>> added_;
};

/// Adds an option or argument with a value that the help calls `type`.
CLI::Option* add_value(CLI::App& command, const std::string& names, auto& value, const std::string& type,
                       const std::string& help) {
  return command.add_option(names, value, help)->type_name(type);
}

/// Adds --output, a folder; `help` says what it gets.
inline CLI::Option* add_output_folder(CLI::App& command, std::string& output, const std::string& help) {
  return add_value(command, "-o,--output", output, "DIR", help)->capture_default_str();
}

/// Adds a subcommand that does `work`. Its arguments add their options when they are made, and live as long as `app`.
template <class Arguments>
void add_command(CLI::App& app, const std::string& name, const std::string& description, const std::string& footer,
                 void (*work)(const Arguments&)) {
  CLI::App* command = app.add_subcommand(name, description);
  const auto arguments = std::make_shared<Arguments>(*command);
  if constexpr (requires { arguments->quiet; })
    command->add_flag("-q,--quiet", arguments->quiet, "No progress on standard error");
  command->footer(footer);
  command->callback([arguments, work] { work(*arguments); });
}

/// A check of a number from `low` to `high`, both inclusive. Unlike CLI::Range it refuses NaN, and prints short limits.
[[nodiscard]] inline CLI::Validator within(double low, double high) {
  const std::string range = fmt::format("{:g} to {:g}", low, high);
  return {[low, high, range](std::string& text) {
            double value = 0.0;
            if (!CLI::detail::lexical_cast(text, value) || std::isnan(value))
              return "Value " + text + " is not a number";
            return value >= low && value <= high ? std::string() : "Value " + text + " not in range " + range;
          },
          fmt::format("FLOAT in [{:g} - {:g}]", low, high)};
}

/// The options of a subcommand that say how its MAP is read. Must outlive the parsing and running of the subcommand.
class MapOptions {
 public:
  void add_to(CLI::App& command) {
    auto* scale =
        command.add_option("--height-scale", scale_, "MAP stores heights; the height of value 1 in widths of the map")
            ->type_name("X")
            ->check(within(-100.0, 100.0));
    command.add_option("--slope-filter", filter_, "Derivative of the heights: central, sobel or scharr")
        ->type_name("WORD")
        ->needs(scale)
        ->capture_default_str();
  }

  /// The file with these options. Throws Error (usage): an unknown filter.
  [[nodiscard]] NormalFile of(const std::string& path) const {
    NormalFile file{.path = path};
    const SlopeFilter filter = word_value(slope_filters, filter_, "slope filter", "--slope-filter");
    if (!scale_) return file;
    file.scale = *scale_;
    file.heights = HeightSettings{.filter = filter};
    return file;
  }

 private:
  std::optional<double> scale_;
  std::string filter_ = "central";
};

/// The error of a hidden file, with the path that the file will have at its place.
[[nodiscard]] Error at_final_place(const Error& error, const OutputFolder& folder);

/// The error (check) for files of the folder that could not be written, to be thrown once everything else is written
/// and printed; none if all were.
[[nodiscard]] std::optional<Error> losses_of(const OutputFolder& folder);

/// Throws the first error that there is.
void throw_first(std::initializer_list<std::optional<Error>> errors);

/// Writes a message where no font is there for captions; for commands that caption pictures, before they run.
void warn_without_captions();

/// The path of an output image. Errors (usage): the extension is neither .exr nor .png, with `hint`.
[[nodiscard]] std::filesystem::path image_path(const std::string& output, const std::string& hint);

/// Adds the program's version and the processor.
void sign(ToolInfo& tool, BackendInfo& backend);

/// Moves the folder to its place. Errors (interrupted): the run was interrupted, and the folder is not moved.
void keep(OutputFolder& folder);

/// Prints the summary of `results`, or with `verbose` all of table.md, and the path of their page in `folder`.
void print_results(const Results& results, const std::filesystem::path& folder, bool verbose = false);

/// Lets `make` fill a folder out of sight, writes the report of the animation that it returns, moves all of it to
/// `output` and prints the table. Errors: those of `make`, and nothing is left of the folder then; (check) losses.
void write_and_print_animation(const std::filesystem::path& output,
                               const std::function<Results(const RunFolder& folder)>& make);

/// The error (check) for a run in which rows failed or lack an estimate for a GPU, to be thrown once everything else is
/// written; none if all passed.
[[nodiscard]] std::optional<Error> row_failures(const Results& results);

/// Prints a line per failure of a check. Errors (check): there is one; `checks` says what failed.
void require_none_failed(const std::string& place, const char* checks, const std::vector<std::string>& failures);

/// The result of write_whole.
template <typename Made>
struct Written {
  Made made;
  std::filesystem::path folder;  ///< its final place
  std::optional<Error> lost;     ///< (check) files that could not be written; everything else is there
};

/// The result of `write`, which fills and commits the folder. Removes a folder that was not committed.
template <typename Write>
auto write_whole(const std::filesystem::path& output, Write write) {
  OutputFolder folder(output);
  try {
    auto made = write(folder);
    return Written<decltype(made)>{std::move(made), folder.final_path(), losses_of(folder)};
  } catch (const Error& error) {
    throw at_final_place(error, folder);
  }
}

/// Writes the document and the page of what is finished so far into the hidden folder, where the final ones take their
/// place: what fails here is no loss of the run. Returns whether the page is there.
bool write_interim(const OutputFolder& folder, const std::string& document,
                   const std::function<std::string()>& make_document, const std::function<std::string()>& make_page);

/// Signs `results`, writes them into the folder by `write` and moves it to its place, where it replaces the images that
/// an earlier run's `document` lists. Errors (interrupted): nothing is moved.
template <typename Measured, typename Write>
void keep_results(Measured& results, OutputFolder& folder, Write write, const char* document = "results.json") {
  sign(results.tool, results.backend);
  if constexpr (requires { results.files; }) results.files = files_below(folder.path(), "images");
  write(results, folder.run());
  folder.replaces(listed_files(folder.final_path() / document));
  keep(folder);
}

}  // namespace footprint
