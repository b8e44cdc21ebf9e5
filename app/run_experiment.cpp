// `footprint run` and `footprint check`: an experiment, its figures beside the published ones, and its claims.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <system_error>

#include "app/asked_experiments.hpp"
#include "app/check_reports.hpp"
#include "app/commands.hpp"
#include "app/experiment_runs.hpp"
#include "app/folders.hpp"
#include "app/hard_cases.hpp"
#include "app/messages.hpp"
#include "app/part_file.hpp"
#include "app/progress_display.hpp"
#include "app/run_options.hpp"
#include "app/standard_output.hpp"
#include "app/timing_process.hpp"
#include "experiments/runner/run_experiment.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/host.hpp"

namespace footprint {
namespace {

constexpr const char* experiment_words =
    "EXPERIMENT is a TOML file of experiments/ by its name, or a path to one (docs/experiments.md).\n"
    "`footprint list experiments` names them. A folder stands for all experiments in it.\n"
    "\n";

constexpr const char* run_examples =
    "Examples:\n"
    "  footprint run tan2005_fig4 -o out            the figures beside the published ones, and the claims\n"
    "  footprint run tan2005_fig4 --quick -o out    a quarter of the size: whether it runs and how it looks\n"
    "  footprint run xu2017_table1 --processes 5 -o out    times over five processes\n"
    "  footprint run engine_constants --only ggx -o out    of its members those that are called so\n"
    "  footprint run --all -o results                      every experiment, resumable; --only '^tan' some of them\n"
    "  footprint run cells --shard 1/4 -o parts/1          a quarter of it, for `footprint merge parts/* -o out`\n"
    "  footprint run mine.toml -o out";

constexpr const char* check_examples =
    "Exit code 1, with the list of what fell short, where a claim does not come out as its file expects or a\n"
    "threshold is not held; the report is written all the same.\n"
    "\n"
    "Examples:\n"
    "  footprint check quick -o out                 every method, in seconds\n"
    "  footprint check hard_cases -o out            every method where numbers are hard (docs/stability.md)\n"
    "  footprint check experiments/tan2005_fig4.toml -o out\n"
    "  footprint check quick -o out --junit out/junit.xml --github\n"
    "  footprint check quick -o out --baseline quick.json --update-baseline    once; and without the latter ever after";

struct ExperimentArguments {
  explicit ExperimentArguments(CLI::App& command) : run(command) {}

  RunOptions run;
  std::string experiment;
  std::string output = "out";
  std::string only;
  std::string shard;     // empty: all of it
  CheckReports reports;  // of `check`
  bool all = false;      // in the place of one experiment
  bool quick = false;
  bool fresh = false;
  bool wide = false;          // hard_cases: every storage in every case, and those that take long
  std::string timing_file;    // not empty: this is a process that only takes times
  std::string timing_member;  // and of this experiment alone
  bool quiet = false;
};

void add_options(CLI::App& command, ExperimentArguments& arguments) {
  CLI::Option* const named = command.add_option("experiment", arguments.experiment, "What to run");
  command.add_flag("--all", arguments.all, "Every experiment of the program, each into a folder of its name below DIR")
      ->excludes(named);
  command
      .add_option("-o,--output", arguments.output,
                  "Folder for results.json, results.csv, table.md, index.html, images/, and kept/: finished work, from "
                  "which a run that was interrupted goes on")
      ->capture_default_str();
  command
      .add_option("--only", arguments.only,
                  "Of an experiment's members, or of all, those whose names match (a regular expression)")
      ->type_name("REGEX");
  command.add_flag("--fresh", arguments.fresh,
                   "Measure everything anew: forget the finished work in the output folder");
  command.add_option(timing_file_option, arguments.timing_file)->group("");  // no part of the help
  command.add_option(timing_member_option, arguments.timing_member)->group("");
  add_quiet_flag(command, arguments.quiet);
}

AskedExperiments asked(const ExperimentArguments& arguments) {
  if (arguments.experiment.empty() && !arguments.all)
    throw Error(ErrorKind::usage, "EXPERIMENT", "no experiment is named",
                "`footprint list experiments` names them, `footprint check --help` says more");
  return ask_experiments({.experiment = arguments.all ? experiments_folder().string() : arguments.experiment,
                          .only = arguments.only,
                          .quick = arguments.quick,
                          .apply = [&](RunSettings& run) { arguments.run.apply(run); }});
}

// What a further process does: times the frames of one member.
void take_times(const ExperimentArguments& arguments) {
  for (const Experiment& experiment : asked(arguments).experiments) {
    if (experiment.full_name() != arguments.timing_member) continue;
    return write_frame_times(arguments.timing_file, time_frames(experiment.run, no_progress));
  }
  throw Error(ErrorKind::usage, timing_member_option, fmt::format("no experiment `{}` here", arguments.timing_member),
              "it is for processes that this program starts itself");
}

KeptWork finished_work(const AskedExperiments& asked, const ExperimentArguments& arguments) {
  KeptWork kept(kept_folder(arguments.output), maker_for(asked.experiments.front().run));
  if (arguments.fresh) kept.clear();
  return kept;
}

// Runs the experiment, or each of its members into a folder of its own, and prints the tables.
void run_all(const ExperimentArguments& arguments, const RunListener& listener) {
  const AskedExperiments experiments = asked(arguments);
  const KeptWork kept = finished_work(experiments, arguments);
  run_and_print(experiments, arguments.output, kept, arguments.quiet, listener);
  if (kept.found() > 0 && !arguments.quiet)
    write_message(fmt::format("{} finished parts of an earlier run were taken from {} (--fresh: measure anew)",
                              kept.found(), kept.folder().string()));
}

// Runs one part; `part.json` says that it is whole, and is there only then.
void run_shard(const ExperimentArguments& arguments) {
  const auto begin = std::chrono::steady_clock::now();
  const Shard shard = parse_shard(arguments.shard);
  const AskedExperiments experiments = asked(arguments);
  const std::filesystem::path output = arguments.output;
  const KeptWork kept = finished_work(experiments, arguments);
  std::error_code none;
  std::filesystem::remove(output / "part.json", none);
  run_part(experiments, shard, output, kept, arguments.quiet);
  const RunSettings& run = experiments.experiments.front().run;
  std::filesystem::create_directories(output);
  write_part_file(output, {.experiment = std::filesystem::absolute(experiments.file).lexically_normal().string(),
                           .fingerprint = experiments.fingerprint,
                           .maker = kept.maker(),
                           .shard = shard,
                           .only = arguments.only,
                           .quick = arguments.quick,
                           .processes = run.timing.processes,
                           .tile = run.backend.tile,
                           .node = host_name(),
                           .seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
                           .keys = kept.used()});
  write_output(fmt::format("part {} of {}: {}\n", shard.index, shard.count, output.string()));
}

void run(const ExperimentArguments& arguments) {
  if (!arguments.timing_file.empty()) return take_times(arguments);
  if (!arguments.shard.empty()) return run_shard(arguments);
  std::optional<Error> failed;
  run_all(arguments, {.experiment = [&](const Results& results) {
            if (!failed) failed = row_failures(results);
          }});
  if (failed) throw *failed;
}

// Errors (usage): a report is asked for that only experiments have.
void refuse_reports(const CheckReports& reports) {
  const char* option = nullptr;
  if (!reports.junit.empty()) option = "--junit";
  if (reports.github) option = "--github";
  if (!reports.baseline.empty() || reports.update) option = "--baseline";
  if (option == nullptr) return;
  throw Error(ErrorKind::usage, option, fmt::format("{} is no experiment and has no such report", hard_cases_name),
              "leave it out: hard_cases.json has all outcomes");
}

void check(const ExperimentArguments& arguments) {
  if (arguments.experiment == hard_cases_name) {
    refuse_reports(arguments.reports);
    return check_hard_cases({.run = arguments.run.settings(),
                             .wide = arguments.wide,
                             .output = arguments.output,
                             .quiet = arguments.quiet});
  }
  if (!arguments.timing_file.empty()) return take_times(arguments);
  CheckBook book(arguments.reports);
  std::optional<Error> failed;
  const auto add = [&](const Results& results) {
    book.add(results);
    if (!failed) failed = row_failures(results);
  };
  run_all(arguments, {.experiment = add, .matrix = [&](const ExperimentReport& report) { book.add(report); }});
  book.report();
  const std::vector<std::string> shortfalls = book.shortfalls();
  if (shortfalls.empty() && failed) throw *failed;
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
  command->add_flag("--quick", arguments->quick, "A quarter of the size, few samples and texels: no measurement");
  command->footer(std::string(experiment_words) + run_examples);
  command->add_option("--shard", arguments->shard, "Run part I of N into the output folder, for `footprint merge`")
      ->type_name("I/N");
  command->callback([arguments] { run(*arguments); });
}

void add_check_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("check", "Run an experiment and hold its claims and thresholds");
  const auto arguments = std::make_shared<ExperimentArguments>(*command);
  add_options(*command, *arguments);
  command->add_flag("--wide", arguments->wide,
                    "hard_cases: every storage in every case, not over single lobes alone; cases that take long");
  command->add_option("--junit", arguments->reports.junit, "Also write every claim and threshold as JUnit XML")
      ->type_name("FILE");
  command->add_flag("--github", arguments->reports.github,
                    "Also print what fell short as annotations of a GitHub workflow");
  command
      ->add_option("--baseline", arguments->reports.baseline,
                   "Also hold errors, flicker and bytes of every record against those of an earlier run")
      ->type_name("FILE");
  command->add_flag("--update-baseline", arguments->reports.update,
                    "Write --baseline anew instead of holding against it, and print what differs");
  command->footer(std::string(experiment_words) + check_examples);
  command->callback([arguments] { check(*arguments); });
}

}  // namespace footprint
