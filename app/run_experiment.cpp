// `footprint run` and `footprint check`: an experiment, its figures beside the published ones, and its claims.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "app/commands.hpp"
#include "app/folders.hpp"
#include "app/hard_cases.hpp"
#include "app/output.hpp"
#include "app/progress_display.hpp"
#include "app/run_options.hpp"
#include "app/standard_output.hpp"
#include "app/timing_process.hpp"
#include "experiments/runner/run_experiment.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

constexpr const char* experiment_words =
    "EXPERIMENT is a TOML file of experiments/ by its name, or a path to one (docs/experiments.md).\n"
    "`footprint list experiments` names them.\n"
    "\n";

constexpr const char* run_examples =
    "Examples:\n"
    "  footprint run tan2005_fig4 -o out            the figures beside the published ones, and the claims\n"
    "  footprint run tan2005_fig4 --quick -o out    a quarter of the size: whether it runs and how it looks\n"
    "  footprint run xu2017_table1 --processes 5 -o out    times over five processes\n"
    "  footprint run mine.toml -o out";

constexpr const char* check_examples =
    "Exit code 1, with the list of what fell short, where a claim does not come out as its file expects or a\n"
    "threshold is not held; the report is written all the same.\n"
    "\n"
    "Examples:\n"
    "  footprint check quick -o out                 every method, in seconds\n"
    "  footprint check hard_cases -o out            every method where numbers are hard (docs/stability.md)\n"
    "  footprint check experiments/tan2005_fig4.toml -o out";

struct ExperimentArguments {
  explicit ExperimentArguments(CLI::App& command) : run(command) {}

  RunOptions run;
  std::string experiment;
  std::string output = "out";
  bool quick = false;
  bool wide = false;          // hard_cases: every storage in every case
  std::string timing_file;    // not empty: this is a process that only takes times
  std::string timing_member;  // and of this experiment alone
  bool quiet = false;
};

void add_options(CLI::App& command, ExperimentArguments& arguments) {
  command.add_option("experiment", arguments.experiment, "What to run")->required();
  command
      .add_option("-o,--output", arguments.output,
                  "Folder for results.json, results.csv, table.md, index.html, images/")
      ->capture_default_str();
  command.add_option(timing_file_option, arguments.timing_file)->group("");  // no part of the help
  command.add_option(timing_member_option, arguments.timing_member)->group("");
  add_quiet_flag(command, arguments.quiet);
}

Results run_into(const Experiment& experiment, OutputFolder& folder, const Progress& progress) {
  constexpr double weight = 10;  // of the main process's work, where a further process's is 1
  const int others = experiment.run.timing.processes - 1;
  ProgressParts parts(progress, weight + others);
  const auto further =
      times_of_processes(others, {timing_member_option, experiment.name}, folder.path(), parts.next(others, ""));
  Results results = run_experiment(experiment, further, folder.path(), parts.next(weight, ""));
  keep_results(results, folder, write_report);
  return results;
}

// The experiment of a file, run as the command line asks.
Experiment asked_experiment(const std::filesystem::path& file, const ExperimentArguments& arguments) {
  Experiment experiment = read_experiment(file);
  arguments.run.apply(experiment.run);
  if (arguments.quick) make_quick(experiment);
  return experiment;
}

// The experiments to run: the one that is named, or its members, none of which has members of its own.
std::vector<Experiment> asked_experiments(const ExperimentArguments& arguments) {
  const Experiment named = asked_experiment(find_experiment(arguments.experiment, experiments_folder()), arguments);
  if (named.members.empty()) return {named};
  std::vector<Experiment> members;
  for (const std::filesystem::path& file : named.members) {
    members.push_back(asked_experiment(file, arguments));
    if (members.back().members.empty()) continue;
    throw Error(ErrorKind::usage, named.file.string(), fmt::format("its member {} has members", members.back().name),
                "name those instead");
  }
  return members;
}

// What a further process does: times the frames of one member.
void take_times(const ExperimentArguments& arguments) {
  for (const Experiment& experiment : asked_experiments(arguments)) {
    if (experiment.name != arguments.timing_member) continue;
    return write_frame_times(arguments.timing_file, time_frames(experiment.run, no_progress));
  }
  throw Error(ErrorKind::usage, timing_member_option, fmt::format("no experiment `{}` here", arguments.timing_member),
              "it is for processes that this program starts itself");
}

// Runs the experiment, or each of its members into a folder of its own, prints the tables and gives what fell short.
std::vector<std::string> run_and_print(const ExperimentArguments& arguments) {
  const std::vector<Experiment> experiments = asked_experiments(arguments);
  std::vector<std::string> shortfalls;
  for (const Experiment& experiment : experiments) {
    const std::filesystem::path output = arguments.output;
    ProgressDisplay display(progress_style(arguments.quiet));
    const auto [results, path] =
        write_whole(experiments.size() > 1 ? output / experiment.name : output,
                    [&](OutputFolder& folder) { return run_into(experiment, folder, display.callback()); });
    display.finish();
    print_results(results, path);
    for (const std::string& line : results.experiment->shortfalls()) {
      shortfalls.push_back(experiments.size() > 1 ? experiment.name + ": " + line : line);
    }
  }
  return shortfalls;
}

void check(const ExperimentArguments& arguments) {
  if (arguments.experiment == hard_cases_name) {
    return check_hard_cases({.run = arguments.run.settings(),
                             .wide = arguments.wide,
                             .output = arguments.output,
                             .quiet = arguments.quiet});
  }
  if (!arguments.timing_file.empty()) return take_times(arguments);
  const std::vector<std::string> shortfalls = run_and_print(arguments);
  if (shortfalls.empty()) return;
  std::string list;
  for (const std::string& line : shortfalls) list += "fell short: " + line + "\n";
  write_output(list);
  throw Error(ErrorKind::check, arguments.experiment,
              fmt::format("{} of its claims and thresholds fell short, the first: {}", shortfalls.size(),
                          shortfalls.front().substr(0, 300)),
              "");
}

}  // namespace

void add_run_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Run an experiment: measured beside published, and its claims");
  const auto arguments = std::make_shared<ExperimentArguments>(*command);
  add_options(*command, *arguments);
  command->add_flag("--quick", arguments->quick, "A quarter of the size and few samples: no measurement");
  command->footer(std::string(experiment_words) + run_examples);
  command->callback([arguments] {
    if (!arguments->timing_file.empty()) return take_times(*arguments);
    (void)run_and_print(*arguments);
  });
}

void add_check_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("check", "Run an experiment and hold its claims and thresholds");
  const auto arguments = std::make_shared<ExperimentArguments>(*command);
  add_options(*command, *arguments);
  command->add_flag("--wide", arguments->wide, "hard_cases: every storage in every case, not over single lobes alone");
  command->footer(std::string(experiment_words) + check_examples);
  command->callback([arguments] { check(*arguments); });
}

}  // namespace footprint
