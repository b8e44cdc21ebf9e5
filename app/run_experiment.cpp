// `footprint run` and `footprint check`: an experiment, its figures beside the published ones, and its claims.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/child_process.hpp"
#include "app/commands.hpp"
#include "app/experiment_runs.hpp"
#include "app/folders.hpp"
#include "app/hard_cases.hpp"
#include "app/messages.hpp"
#include "app/output.hpp"
#include "app/part_file.hpp"
#include "app/run_options.hpp"
#include "experiments/runner/run_experiment.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/core/process.hpp"
#include "results/report/check_outcomes.hpp"

namespace footprint {
namespace {

constexpr const char* experiment_words =
    "EXPERIMENT is a name of `footprint list experiments`, or a path to a TOML file or a folder of them\n"
    "(docs/reference/experiments.md).\n"
    "\n";

constexpr const char* run_examples =
    "Examples:\n"
    "  footprint run tan2005_fig4 -o out            figures next to the published ones, claims\n"
    "  footprint run tan2005_fig4 --quick -o out    a quarter of the size: a test run\n"
    "  footprint run xu2017_table1 --processes 5 -o out    times from five processes\n"
    "  footprint run engine_constants --only ggx -o out    its members whose names match\n"
    "  footprint run --all -o results                      every experiment; an interrupted run resumes\n"
    "  footprint run cells --shard 1/4 -o parts/1          one of four parts, for `footprint merge`\n"
    "  footprint run mine.toml -o out";

constexpr const char* check_examples =
    "Exit code 1, with a list, if a claim's outcome differs from the expected one or a threshold is exceeded. The\n"
    "report is still written.\n"
    "\n"
    "Examples:\n"
    "  footprint check quick -o out                 every method, in seconds\n"
    "  footprint check hard_cases -o out            numerical stress tests (docs/results/stability.md)\n"
    "  footprint check experiments/tan2005_fig4.toml -o out\n"
    "  footprint check quick -o out --junit out/junit.xml --github\n"
    "  footprint check quick -o out --baseline quick.json --update-baseline    first run; later without "
    "--update-baseline";

// The reports of `check` besides the exit code.
struct CheckReports {
  std::string junit;     ///< file to write; empty: none
  bool github = false;   ///< workflow commands on standard output
  std::string baseline;  ///< file to compare with; empty: none
  bool update = false;   ///< write it instead
};

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
  CLI::Option* const named =
      command.add_option("experiment", arguments.experiment, "Name, or path to a TOML file or folder")
          ->type_name("EXPERIMENT");
  command.add_flag("--all", arguments.all, "Run every experiment, each into a subfolder with its name")
      ->excludes(named);
  command
      .add_option(
          "-o,--output", arguments.output,
          "Folder for results.json, results.csv, table.md, index.html, images/, and kept/ with the finished work, "
          "from which an interrupted run resumes")
      ->type_name("DIR")
      ->capture_default_str();
  command
      .add_option("--only", arguments.only, "Run only members or experiments whose names match this regular expression")
      ->type_name("REGEX");
  command.add_flag("--fresh", arguments.fresh,
                   "Measure everything again: discard the finished work in the output folder");
  command.add_option(timing_file_option, arguments.timing_file)->group("");  // no part of the help
  command.add_option(timing_member_option, arguments.timing_member)->group("");
  add_quiet_flag(command, arguments.quiet);
}

RequestedExperiments requested(const ExperimentArguments& arguments) {
  if (arguments.experiment.empty() && !arguments.all)
    throw Error(ErrorKind::usage, "EXPERIMENT", "no experiment is given", "`footprint list experiments` names them");
  return requested_experiments({.experiment = arguments.all ? experiments_folder().string() : arguments.experiment,
                                .only = arguments.only,
                                .quick = arguments.quick,
                                .apply = [&](RunSettings& run) { arguments.run.apply(run); }});
}

// The job of a timing process: times the frames of one member.
void take_times(const ExperimentArguments& arguments) {
  for (const Experiment& experiment : requested(arguments).experiments) {
    if (experiment.full_name() != arguments.timing_member) continue;
    return write_frame_times(arguments.timing_file, time_frames(experiment.run, no_progress));
  }
  throw Error(ErrorKind::usage, timing_member_option, fmt::format("no experiment `{}` here", arguments.timing_member),
              "it is for processes that this program starts itself");
}

FinishedWork finished_work(const RequestedExperiments& requested, const ExperimentArguments& arguments) {
  FinishedWork finished(finished_work_folder(arguments.output), maker_for(requested.experiments.front().run));
  if (arguments.fresh) finished.clear();
  return finished;
}

// Runs the experiment, or each of its members into a folder of its own, and prints the tables.
void run_all(const ExperimentArguments& arguments, const RunListener& listener) {
  const RequestedExperiments experiments = requested(arguments);
  const FinishedWork finished = finished_work(experiments, arguments);
  run_and_print(experiments, arguments.output, finished, arguments.quiet, listener);
  if (finished.reused() > 0 && !arguments.quiet) write_message(reuse_text(finished));
}

// Runs one part; `part.json` says that it is whole, and is there only then.
void run_shard(const ExperimentArguments& arguments) {
  const auto begin = std::chrono::steady_clock::now();
  const Shard shard = parse_shard(arguments.shard);
  const RequestedExperiments experiments = requested(arguments);
  const std::filesystem::path output = arguments.output;
  const FinishedWork finished = finished_work(experiments, arguments);
  std::error_code none;
  std::filesystem::remove(output / "part.json", none);
  run_part(experiments, shard, output, finished, arguments.quiet);
  const RunSettings& run = experiments.experiments.front().run;
  std::filesystem::create_directories(output);
  write_part_file(output, {.experiment = std::filesystem::absolute(experiments.file).lexically_normal().string(),
                           .fingerprint = experiments.fingerprint,
                           .maker = finished.maker(),
                           .shard = shard,
                           .only = arguments.only,
                           .quick = arguments.quick,
                           .processes = run.timing.processes,
                           .tile = run.backend.tile,
                           .node = host_name(),
                           .seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
                           .keys = finished.used()});
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

constexpr std::uint64_t largest_baseline = 1U << 26U;  // bytes

// None if the file does not exist and is about to be written.
std::optional<Baseline> baseline_of(const CheckReports& reports) {
  if (reports.baseline.empty()) {
    if (!reports.update) return {};
    throw Error(ErrorKind::usage, "--update-baseline", "the baseline is not given", "add --baseline FILE");
  }
  std::error_code unknown;
  if (std::filesystem::is_regular_file(reports.baseline, unknown)) {
    const std::vector<std::uint8_t> bytes = read_file_bytes(reports.baseline, largest_baseline);
    return parse_baseline(std::string(bytes.begin(), bytes.end()), reports.baseline);
  }
  if (reports.update) return {};
  throw Error(ErrorKind::usage, reports.baseline, "no such baseline", "--update-baseline writes it");
}

// Collects the outcomes of runs and reports them.
class CheckReporter {
 public:
  // Reads the baseline. Errors (usage): it is missing or not a baseline; it is to be updated and not named.
  explicit CheckReporter(CheckReports reports);

  // The outcomes of one run, or of a matrix.
  void add(const Results& results);
  void add(const ExperimentReport& report);

  // Writes and prints the reports, and a baseline that is updated with its differences. Errors (machine): a file cannot
  // be written.
  void report() const;

  // One line per failure, with its experiment if there are several.
  [[nodiscard]] std::vector<std::string> shortfalls() const;

 private:
  void update_baseline() const;

  CheckReports reports_;
  std::optional<Baseline> baseline_;
  BaselineFigures figures_;
  std::vector<CheckOutcome> outcomes_;
  std::size_t runs_ = 0;
};

CheckReporter::CheckReporter(CheckReports reports) : reports_(std::move(reports)), baseline_(baseline_of(reports_)) {}

void CheckReporter::add(const ExperimentReport& report) {
  ++runs_;
  for (CheckOutcome& outcome : check_outcomes(report)) outcomes_.push_back(std::move(outcome));
}

void CheckReporter::add(const Results& results) {
  add(results.experiment.value());
  const BaselineFigures figures = baseline_figures(results);
  if (baseline_ && !reports_.update) {
    for (CheckOutcome& outcome : compare_with_baseline(*baseline_, figures, reports_.baseline))
      outcomes_.push_back(std::move(outcome));
  }
  figures_.insert(figures.begin(), figures.end());
}

void CheckReporter::report() const {
  if (!reports_.junit.empty()) write_file_atomically(reports_.junit, junit_xml(outcomes_));
  if (reports_.update) update_baseline();
  if (reports_.github) write_output(github_annotations(outcomes_));
}

// Experiments that were not run stay as they are.
void CheckReporter::update_baseline() const {
  Baseline next = baseline_.value_or(Baseline{});
  std::string text;
  for (const CheckOutcome& outcome : compare_with_baseline(next, figures_, reports_.baseline)) {
    if (!outcome.failure.empty())
      text += fmt::format("{}: {}: {}: {}\n", reports_.baseline, outcome.suite, outcome.name, outcome.failure);
  }
  for (const auto& [experiment, records] : figures_) next.figures[experiment] = records;
  write_file_atomically(reports_.baseline, baseline_json(next));
  write_output(text.empty() ? fmt::format("{}: no differences\n", reports_.baseline) : text);
}

std::vector<std::string> CheckReporter::shortfalls() const {
  std::vector<std::string> lines;
  for (const CheckOutcome& outcome : outcomes_) {
    if (outcome.failure.empty()) continue;
    lines.push_back(fmt::format("{}{}: {}", runs_ > 1 ? outcome.suite + ": " : "", outcome.name, outcome.failure));
  }
  return lines;
}

// Errors (usage): a report is requested that only experiments have.
void refuse_reports(const CheckReports& reports) {
  const char* option = nullptr;
  if (!reports.junit.empty()) option = "--junit";
  if (reports.github) option = "--github";
  if (!reports.baseline.empty() || reports.update) option = "--baseline";
  if (option == nullptr) return;
  throw Error(ErrorKind::usage, option, fmt::format("{} is not an experiment and has no such report", hard_cases_name),
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
  if (!arguments.run.settings().methods.empty())
    throw Error(ErrorKind::usage, "--methods", fmt::format("only {} takes methods", hard_cases_name),
                "leave it out: an experiment names its own");
  if (!arguments.timing_file.empty()) return take_times(arguments);
  CheckReporter reporter(arguments.reports);
  std::optional<Error> failed;
  const auto add = [&](const Results& results) {
    reporter.add(results);
    if (!failed) failed = row_failures(results);
  };
  run_all(arguments, {.experiment = add, .matrix = [&](const ExperimentReport& report) { reporter.add(report); }});
  reporter.report();
  const std::vector<std::string> shortfalls = reporter.shortfalls();
  if (shortfalls.empty() && failed) throw *failed;
  if (shortfalls.empty()) return;
  std::string list;
  for (const std::string& line : shortfalls) list += "failed: " + line + "\n";
  write_output(list);
  throw Error(ErrorKind::check, arguments.experiment,
              fmt::format("{} claims and thresholds failed, the first: {}", shortfalls.size(),
                          shortfalls.front().substr(0, 300)),
              "");
}

}  // namespace

void add_run_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Run an experiment and compare it with published results");
  const auto arguments = std::make_shared<ExperimentArguments>(*command);
  add_options(*command, *arguments);
  command->add_flag("--quick", arguments->quick,
                    "Test run: a quarter of the size, few samples and texels; not a measurement");
  command->footer(std::string(experiment_words) + run_examples);
  command->add_option("--shard", arguments->shard, "Run part I of N into the output folder, for `footprint merge`")
      ->type_name("I/N");
  command->callback([arguments] { run(*arguments); });
}

void add_check_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("check", "Run an experiment; fail if a claim or threshold fails (CI)");
  const auto arguments = std::make_shared<ExperimentArguments>(*command);
  add_options(*command, *arguments);
  command->add_flag("--wide", arguments->wide, "hard_cases: every storage in every case, and slow cases too");
  command->add_option("--junit", arguments->reports.junit, "Also write every claim and threshold as JUnit XML")
      ->type_name("FILE");
  command->add_flag("--github", arguments->reports.github, "Also print failures as annotations for GitHub workflows");
  command
      ->add_option("--baseline", arguments->reports.baseline,
                   "Also compare errors, flicker and memory with this file of an earlier run")
      ->type_name("FILE");
  command->add_flag("--update-baseline", arguments->reports.update,
                    "Write the --baseline file instead of comparing with it, and print the differences");
  command->footer(std::string(experiment_words) + check_examples);
  command->callback([arguments] { check(*arguments); });
}

}  // namespace footprint
