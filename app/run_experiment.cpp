// `footprint run` and `footprint check`: an experiment, its figures beside the published ones, and its claims.
#include <algorithm>
#include <iterator>
#include <system_error>

#include "app/child_process.hpp"
#include "app/experiment_runs.hpp"
#include "app/folders.hpp"
#include "app/subcommand.hpp"
#include "experiments/runner/run_experiment.hpp"
#include "renderer/core/bytes.hpp"
#include "results/report/experiment_report.hpp"

namespace footprint {
namespace {

constexpr const char* experiment_words =
    R"(EXPERIMENT is a name of `footprint list experiments`, or a path to a TOML file or a folder of them
(docs/reference/experiments.md).

)";

constexpr const char* run_examples =
    R"(Examples:
  footprint run tan2005_fig4 -o out            figures next to the published ones, claims
  footprint run tan2005_fig4 --quick -o out    a quarter of the size: a test run
  footprint run xu2017_table1 --processes 5 -o out    times from five processes
  footprint run engine_constants --only ggx -o out    its members whose names match
  footprint run --all -o results                      every experiment; an interrupted run resumes
  footprint run cells --shard 1/4 -o parts/1          one of four parts, for `footprint merge`
  footprint run tan2005_fig7 --region -o out          in which settings its claims are true
  footprint run mine.toml -o out)";

constexpr const char* check_examples =
    R"(Exit code 1, with a list, if a claim's outcome differs from the expected one or a threshold is exceeded. The
report is still written.

Examples:
  footprint check quick -o out                 every method, in seconds
  footprint check hard_cases -o out            numerical stress tests (docs/results/stability.md)
  footprint check experiments/tan2005_fig4.toml -o out
  footprint check tan2005_fig7 --region -o out        also in which other settings its claims are true
  footprint check quick -o out --junit out/junit.xml --github
  footprint check quick -o out --baseline quick.json --update-baseline    first run; later without --update-baseline)";

// The reports of `check` besides the exit code.
struct CheckReports {
  std::string junit;     ///< file to write; empty: none
  bool github = false;   ///< workflow commands on standard output
  std::string baseline;  ///< file to compare with; empty: none
  bool update = false;   ///< write it instead
};

struct ExperimentArguments : RunArguments {
  explicit ExperimentArguments(CLI::App& command) : RunArguments(command) {
    auto* named = add_value(command, "experiment", experiment, "EXPERIMENT", "Name, or path to a TOML file or folder");
    command.add_flag("--all", all, "Run every experiment, each into a subfolder with its name")->excludes(named);
    add_output_folder(
        command, output,
        "Folder for results.json, results.csv, table.md, index.html, images/, and kept/ with the finished "
        "work, from which an interrupted run resumes");
    add_value(command, "--only", only, "REGEX",
              "Run only members or experiments whose names match this regular expression");
    command.add_flag(
        "--region", region,
        "Also judge the claims at every setting of the experiment's [region]; a map of where they are true");
    command.add_option(timing_file_option, timing_file)->group("");  // no part of the help
    command.add_option(timing_member_option, timing_member)->group("");
    if (command.get_name() == "check") {
      command.add_flag("--wide", wide, "hard_cases: every storage in every case, and slow cases too");
      add_value(command, "--junit", reports.junit, "FILE", "Also write every claim and threshold as JUnit XML");
      command.add_flag("--github", reports.github, "Also print failures as annotations for GitHub workflows");
      add_value(command, "--baseline", reports.baseline, "FILE",
                "Also compare errors, flicker and memory with this file of an earlier run");
      command.add_flag("--update-baseline", reports.update,
                       "Write the --baseline file instead of comparing with it, and print the differences");
    } else {
      command.add_flag("--quick", quick, "Test run: a quarter of the size, few samples and texels; not a measurement");
      add_value(command, "--shard", shard, "I/N", "Run part I of N into the output folder, for `footprint merge`");
    }
  }

  std::string experiment;
  std::string output = "out";
  std::string only;
  std::string shard;     // empty: all of it
  CheckReports reports;  // of `check`
  bool all = false;      // in the place of one experiment
  bool quick = false;
  bool region = false;        // at every setting that the paper leaves open
  bool wide = false;          // hard_cases: every storage in every case, and those that take long
  std::string timing_file;    // not empty: this is a process that only takes times
  std::string timing_member;  // and of this experiment alone
};

RequestedExperiments requested(const ExperimentArguments& arguments) {
  if (arguments.experiment.empty() && !arguments.all)
    throw Error(ErrorKind::usage, "EXPERIMENT", "no experiment is given", "`footprint list experiments` names them");
  return requested_experiments({.experiment = arguments.all ? experiments_folder().string() : arguments.experiment,
                                .only = arguments.only,
                                .quick = arguments.quick,
                                .region = arguments.region,
                                .apply = [&](RunSettings& run) { arguments.apply(run); }});
}

// The job of a timing process: times the frames of one member.
void take_times(const ExperimentArguments& arguments) {
  for (const ExperimentGroup& group : requested(arguments).groups) {
    const auto found = std::ranges::find(group.experiments, arguments.timing_member, &Experiment::full_name);
    if (found == group.experiments.end()) continue;
    return write_frame_times(arguments.timing_file, time_frames(found->run, no_progress));
  }
  throw Error(ErrorKind::usage, timing_member_option, fmt::format("no experiment `{}` here", arguments.timing_member),
              "it is for processes that this program starts itself");
}

// Runs the experiment, or each of its members into a folder of its own, and prints the tables.
std::optional<Error> run_all(const ExperimentArguments& arguments, const RunListener& listener) {
  const RequestedExperiments experiments = requested(arguments);
  warn_without_captions();
  const FinishedWork finished =
      finished_work_in(arguments.output, experiments.first().run.backend.context, experiments.first().run.output.fresh);
  std::optional<Error> failed = run_and_print(experiments, arguments.output, finished, arguments.quiet, listener);
  write_reuse(finished, arguments.quiet);
  return failed;
}

void run_shard(const ExperimentArguments& arguments) {
  const Shard shard = parse_shard(arguments.shard);
  const RequestedExperiments experiments = requested(arguments);
  const RunSettings& run = experiments.first().run;
  const FinishedWork finished = finished_work_in(arguments.output, run.backend.context, run.output.fresh);
  make_part(shard, arguments.output, finished, [&]() -> PartFile {
    run_part(experiments, shard, arguments.output, finished, arguments.quiet);
    return {.kind = arguments.region ? PartKind::region : PartKind::experiment,
            .experiment = std::filesystem::absolute(experiments.file).lexically_normal().string(),
            .fingerprint = experiments.fingerprint,
            .only = arguments.only,
            .quick = arguments.quick,
            .processes = run.timing.processes,
            .tile = run.backend.tile};
  });
}

void run(const ExperimentArguments& arguments) {
  if (!arguments.timing_file.empty()) return take_times(arguments);
  if (!arguments.shard.empty()) return run_shard(arguments);
  if (const auto failed = run_all(arguments, {})) throw *failed;
}

constexpr std::uint64_t largest_baseline = 1U << 26U;  // bytes

// None if the file does not exist and is about to be written.
std::optional<Baseline> read_baseline(const CheckReports& reports) {
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

class CheckReporter {
 public:
  // Reads the baseline. Errors (usage): it is missing or not a baseline; it is to be updated and not named.
  explicit CheckReporter(const CheckReports& reports) : reports_(reports), baseline_(read_baseline(reports)) {}

  void add(const ExperimentReport& report) {
    ++runs_;
    std::ranges::move(check_outcomes(report), std::back_inserter(outcomes_));
  }
  void add(const Results& results) {
    add(results.experiment.value());
    const BaselineFigures figures = baseline_figures(results);
    if (baseline_ && !reports_.update)
      std::ranges::move(compare_with_baseline(*baseline_, figures, reports_.baseline), std::back_inserter(outcomes_));
    figures_.insert(figures.begin(), figures.end());
  }

  // Writes and prints the reports, and a baseline that is updated with its differences. Errors (machine): a file cannot
  // be written.
  void report() const {
    if (!reports_.junit.empty()) write_file_atomically(reports_.junit, junit_xml(outcomes_));
    if (reports_.update) update_baseline();
    if (reports_.github) write_output(github_annotations(outcomes_));
  }

  // One line per failure, with its experiment if there are several.
  [[nodiscard]] std::vector<std::string> shortfalls() const {
    std::vector<std::string> lines;
    for (const CheckOutcome& outcome : outcomes_) {
      if (outcome.failure.empty()) continue;
      lines.push_back(fmt::format("{}{}: {}", runs_ > 1 ? outcome.suite + ": " : "", outcome.name, outcome.failure));
    }
    return lines;
  }

 private:
  // Experiments that were not run stay as they are.
  void update_baseline() const {
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

  const CheckReports& reports_;
  std::optional<Baseline> baseline_;
  BaselineFigures figures_;
  std::vector<CheckOutcome> outcomes_;
  std::size_t runs_ = 0;
};

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
    return check_hard_cases(
        {.run = arguments.settings(), .wide = arguments.wide, .output = arguments.output, .quiet = arguments.quiet});
  }
  if (!arguments.settings().methods.empty())
    throw Error(ErrorKind::usage, "--methods", fmt::format("only {} takes methods", hard_cases_name),
                "leave it out: an experiment names its own");
  if (!arguments.timing_file.empty()) return take_times(arguments);
  CheckReporter reporter(arguments.reports);
  const auto failed = run_all(arguments, {.experiment = [&](const Results& results) { reporter.add(results); },
                                          .matrix = [&](const ExperimentReport& report) { reporter.add(report); }});
  reporter.report();
  require_none_failed(arguments.experiment, "claims and thresholds", reporter.shortfalls());
  if (failed) throw *failed;
}

}  // namespace

void add_run_command(CLI::App& app) {
  add_command(app, "run", "Run an experiment and compare it with published results",
              std::string(experiment_words) + run_examples, run);
}

void add_check_command(CLI::App& app) {
  add_command(app, "check", "Run an experiment; fail if a claim or threshold fails (CI)",
              std::string(experiment_words) + check_examples, check);
}

}  // namespace footprint
