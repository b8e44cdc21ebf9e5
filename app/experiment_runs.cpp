// Reports of whole runs, and finished work of parts of them.
#include "app/experiment_runs.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <iterator>
#include <map>
#include <regex>

#include "app/child_process.hpp"
#include "app/folders.hpp"
#include "app/subcommand.hpp"
#include "experiments/runner/matrix.hpp"
#include "experiments/runner/region.hpp"
#include "experiments/runner/run_experiment.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/core/process.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

FurtherTimes measure_further_times(const Experiment& experiment, const fs::path& scratch, const Progress& progress) {
  return times_of_processes(experiment.run.timing.processes - 1, {timing_member_option, experiment.full_name()},
                            scratch, progress);
}

Results run_into(const Experiment& experiment, OutputFolder& folder, const FinishedWork& finished,
                 const Progress& progress, const RecordWatch& watch) {
  ProgressParts parts(progress, main_process_weight + experiment.run.timing.processes - 1);
  const CompareContext context{.further_times = measure_further_times(
                                   experiment, folder.path(), parts.next(experiment.run.timing.processes - 1, "")),
                               .finished = &finished,
                               .watch = watch,
                               .gpu_compiler = amd_compiler_if_installed()};
  Results results = run_experiment(experiment, folder.run(), parts.next(main_process_weight, ""), context);
  keep_results(results, folder, write_report);
  return results;
}

// Fills a folder by `write`, whose text it prints with the place of the page.
// failed: set to the losses of the report, if it has none.
void report_whole(const fs::path& output, std::optional<Error>& failed,
                  const std::function<std::string(const RunFolder&)>& write) {
  const auto [text, path, lost] = write_whole(output, [&](OutputFolder& folder) {
    std::string made = write(folder.run());
    keep(folder);
    return made;
  });
  write_output(fmt::format("{}\npage: {}\n", text, (path / "index.html").string()));
  if (!failed) failed = lost;
}

ExperimentReport report_matrix(const ExperimentGroup& group, std::vector<Results> members, const fs::path& output,
                               std::optional<Error>& failed) {
  const Experiment& whole = group.judged();
  MatrixResults results{.report = judge(whole, members), .left_out = group.left_out};
  results.report.quick = whole.quick;
  for (std::size_t i = 0; i < members.size(); ++i)
    results.members.push_back({.folder = group.experiments[i].name, .results = std::move(members[i])});
  report_whole(output, failed, [&](const RunFolder& folder) {
    write_matrix_report(results, folder);
    return matrix_table(results);
  });
  return std::move(results.report);
}

void report_region(const Experiment& stated, const std::vector<Results>& settings, const fs::path& output,
                   std::optional<Error>& failed) {
  const RegionReport report = region_report(stated, settings);
  report_whole(output, failed, [&](const RunFolder& folder) {
    write_region(report, folder);
    return region_table(report);
  });
}

// Runs a group into its folders below `output`, prints its results and passes them to the listener.
// failed: set to the first failure of a row or loss of a file, if it has none.
void run_group(const RequestedExperiments& requested, const ExperimentGroup& group, const fs::path& output,
               const FinishedWork& finished, bool quiet, const RunListener& listener, std::optional<Error>& failed) {
  NoiseGuard guard(group.judged(), group.experiments);
  std::vector<Results> all;
  for (const Experiment& experiment : group.experiments) {
    ProgressDisplay display(progress_style(quiet));
    auto [results, path, lost] = write_whole(output / requested.folder_of(experiment), [&](OutputFolder& folder) {
      return run_into(experiment, folder, finished, display.callback(), guard.watch(experiment));
    });
    display.finish();
    if (!group.matrix && !group.region) print_results(results, path);
    if (!group.region || all.empty()) listener.experiment(results);  // of a region the stated setting
    if (!failed) failed = row_failures(results);
    if (!failed) failed = lost;
    all.push_back(std::move(results));
  }
  if (group.region) report_region(*group.region, all, output, failed);
  if (!group.matrix) return;
  listener.matrix(report_matrix(group, std::move(all), output / requested.folder_of(*group.matrix), failed));
}

std::vector<WorkUnit> all_units(const RequestedExperiments& requested) {
  std::vector<WorkUnit> all;
  for (const ExperimentGroup& group : requested.groups) {
    for (const Experiment& experiment : group.experiments)
      std::ranges::move(work_units(experiment), std::back_inserter(all));
  }
  return all;
}

// Distances of one experiment that are next to each other are done at once: it is set up once.
std::vector<WorkUnit> share_of(const std::vector<WorkUnit>& all, const Shard& shard) {
  const auto [first, last] = range_of(shard, all.size());
  std::vector<WorkUnit> share;
  for (const WorkUnit& unit : std::span(all).subspan(first, last - first)) {
    const bool goes_on = !share.empty() && share.back().experiment == unit.experiment &&
                         !share.back().distances.empty() && !unit.distances.empty();
    if (goes_on) {
      std::ranges::copy(unit.distances, std::back_inserter(share.back().distances));
    } else {
      share.push_back(unit);
    }
  }
  return share;
}

constexpr std::uint64_t largest_experiment = 1U << 26U;  // bytes of TOML

Experiment load_experiment(const std::filesystem::path& file, const ExperimentRequest& request) {
  Experiment experiment = read_experiment(file);
  request.apply(experiment.run);
  if (request.quick && experiment.axes.empty()) make_quick(experiment);  // a matrix: each member
  if (experiment.members.empty()) check_against_scenes(experiment);
  return experiment;
}

std::regex expression_of(const std::string& only) {
  try {
    return std::regex(only, std::regex::ECMAScript);
  } catch (const std::regex_error&) {
    throw Error(ErrorKind::usage, "--only", fmt::format("`{:.80}` is not a regular expression", only),
                "give part of a name, or for example `fig[45]`");
  }
}

// The members of a matrix whose names match; what is said of others is left out of it.
ExperimentGroup matrix_group(const Experiment& whole, const std::string& only, bool quick) {
  ExperimentGroup group{.experiments = {}, .matrix = whole};
  const std::regex expression = expression_of(only);
  std::vector<Coordinates> missing;
  for (Experiment& member : members_of_matrix(whole)) {
    if (!std::regex_search(member.name, expression)) {
      missing.push_back(member.coordinates);
      continue;
    }
    if (quick) make_quick(member);
    group.experiments.push_back(std::move(member));
  }
  group.matrix->quick = quick;
  group.left_out = leave_out(*group.matrix, missing);
  return group;
}

// The experiments of a folder, but for the ones that are made of others: their members lie there too.
std::vector<ExperimentGroup> groups_in(const fs::path& folder, const ExperimentRequest& request) {
  const std::regex only = expression_of(request.only);
  std::vector<ExperimentGroup> groups;
  for (const std::string& name : list_experiments(folder)) {
    if (!std::regex_search(name, only)) continue;
    const Experiment experiment = load_experiment(folder / (name + ".toml"), request);
    if (!experiment.members.empty()) continue;
    groups.push_back(experiment.axes.empty() ? ExperimentGroup{.experiments = {experiment}}
                                             : matrix_group(experiment, "", request.quick));
  }
  if (!groups.empty()) return groups;
  throw Error(ErrorKind::usage, request.only.empty() ? folder.string() : "--only",
              fmt::format("no experiment in {} matches", folder.string()),
              "`footprint list experiments` names those of this program");
}

std::vector<ExperimentGroup> members_of(const Experiment& named, const ExperimentRequest& request) {
  const std::regex only = expression_of(request.only);
  std::vector<ExperimentGroup> members;
  for (const fs::path& file : named.members) {
    if (!std::regex_search(file.stem().string(), only)) continue;
    const Experiment member = load_experiment(file, request);
    if (!member.members.empty() || !member.axes.empty())
      throw Error(ErrorKind::usage, named.file.string(), fmt::format("its member {} has members", member.name),
                  "name those instead");
    members.push_back({.experiments = {member}});
  }
  return members;
}

std::vector<ExperimentGroup> groups_of(const Experiment& named, const ExperimentRequest& request) {
  if (named.axes.empty() && named.members.empty()) {
    if (request.only.empty()) return {{.experiments = {named}}};
    throw Error(ErrorKind::usage, "--only", fmt::format("{} has no members to choose from", named.name),
                "leave it out");
  }
  std::vector<ExperimentGroup> groups =
      named.axes.empty() ? members_of(named, request) : std::vector{matrix_group(named, request.only, request.quick)};
  if (!groups.empty() && !groups.front().experiments.empty()) return groups;
  throw Error(ErrorKind::usage, "--only", fmt::format("no member of {} is called `{:.80}`", named.name, request.only),
              named.axes.empty() ? "`footprint list experiments` names them"
                                 : fmt::format("its first is {}", members_of_matrix(named).front().name));
}

ExperimentGroup region_group(const Experiment& stated, const ExperimentRequest& request) {
  if (!stated.members.empty())
    throw Error(ErrorKind::usage, "--region", fmt::format("{} is made of other experiments", stated.name),
                "name one of them");
  if (!request.only.empty())
    throw Error(ErrorKind::usage, "--only", "excludes --region", "take values out of the experiment's [region]");
  return {.experiments = settings_of_region(stated), .region = stated};
}

// The settings that enter are those that a command line may set beside the file.
std::string compute_fingerprint(const RequestedExperiments& requested, const ExperimentRequest& request) {
  ContentHash hash;
  const auto add_file = [&](const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_file_bytes(file, largest_experiment);
    hash.add(file.stem().string());
    hash.add(std::as_bytes(std::span(bytes)));
  };
  if (!std::filesystem::is_directory(requested.file)) add_file(requested.file);
  const auto add_experiment = [&](const Experiment& experiment) {
    add_file(experiment.file);
    if (experiment.presets) add_file(*experiment.presets);
    for (const MethodSpec& method : experiment.run.methods)
      if (method.file) hash.add(method.file->file_content);
    hash.add(experiment.full_name());
    hash.add(fmt::format("{} {}", experiment.run.timing.processes, experiment.run.backend.tile));
  };
  for (const ExperimentGroup& group : requested.groups) std::ranges::for_each(group.experiments, add_experiment);
  hash.add(request.quick ? "quick" : "");
  hash.add(request.region ? "region" : "");
  return hash.hex();
}

}  // namespace

fs::path RequestedExperiments::folder_of(const Experiment& experiment) const {
  if (file != experiment.file) return experiment.full_name();
  return experiment.whole.empty() ? fs::path() : fs::path(experiment.name);
}

RequestedExperiments requested_experiments(const ExperimentRequest& request) {
  RequestedExperiments requested;
  if (fs::is_directory(request.experiment)) {
    if (request.region) throw Error(ErrorKind::usage, "--region", "is of one experiment", "name one");
    requested.file = request.experiment;
    requested.groups = groups_in(requested.file, request);
  } else {
    requested.file = find_experiment(request.experiment, experiments_folder());
    const Experiment named = load_experiment(requested.file, request);
    requested.groups = request.region ? std::vector{region_group(named, request)} : groups_of(named, request);
  }
  requested.fingerprint = compute_fingerprint(requested, request);
  return requested;
}

fs::path finished_work_folder(const fs::path& output) { return output / "kept"; }

void write_reuse(const FinishedWork& finished, bool quiet) {
  if (finished.reused() > 0 && !quiet)
    write_message(fmt::format("{} finished parts of an earlier run were reused from {} (--fresh measures again)",
                              finished.reused(), finished.folder().string()));
}

FinishedWork finished_work_in(const fs::path& output, const gl::ContextRequest& request, bool fresh) {
  const gl::Context context(request);
  FinishedWork finished(finished_work_folder(output),
                        maker_of_work(fmt::format("{} {}", context.info().renderer, context.info().version)));
  if (fresh) finished.clear();
  return finished;
}

void make_part(const Shard& shard, const fs::path& output, const FinishedWork& finished,
               const std::function<PartFile()>& measure) {
  const auto begin = std::chrono::steady_clock::now();
  std::error_code none;
  fs::remove(output / "part.json", none);
  PartFile part = measure();
  part.maker = finished.maker();
  part.shard = shard;
  part.node = host_name();
  part.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  part.keys = finished.used();
  fs::create_directories(output);
  write_part_file(output, part);
  write_output(fmt::format("part {} of {}: {}\n", shard.index, shard.count, output.string()));
}

std::optional<Error> run_and_print(const RequestedExperiments& requested, const fs::path& output,
                                   const FinishedWork& finished, bool quiet, const RunListener& listener) {
  std::optional<Error> failed;
  const std::vector<ExperimentGroup>& groups = requested.groups;
  const auto run = [&](const ExperimentGroup& group) {
    run_group(requested, group, output, finished, quiet, listener, failed);
  };
  if (groups.size() == 1) {
    run(groups.front());
    return failed;
  }
  std::vector<std::string> missing;
  ErrorKind kind = ErrorKind::machine;
  for (const ExperimentGroup& group : groups) {
    try {
      run(group);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::interrupted) throw;
      if (missing.empty()) kind = error.kind();
      missing.push_back(group.judged().name);
      write_message(fmt::format("{} was not run: {}", group.judged().name, error.what()));
    }
  }
  if (missing.empty()) return failed;
  throw Error(
      kind, requested.file.string(),
      fmt::format("{} of {} experiments were not run: {}", missing.size(), groups.size(), fmt::join(missing, ", ")),
      "fix the causes and run it again; finished experiments are reused");
}

void require_stored(const OutputFolder& scratch) {
  const std::vector<Error>& losses = scratch.run().losses();
  const auto lost = std::ranges::find_if(losses, [](const Error& loss) { return loss.kind() != ErrorKind::check; });
  if (lost != losses.end()) throw Error(ErrorKind::machine, lost->place(), lost->message(), lost->hint());
  if (!losses.empty()) throw losses.front();
}

void run_part(const RequestedExperiments& requested, const Shard& shard, const fs::path& output,
              const FinishedWork& finished, bool quiet) {
  const OutputFolder scratch(output);  // never moved to its place
  const std::vector<WorkUnit> share = share_of(all_units(requested), shard);
  std::map<const Experiment*, std::shared_ptr<NoiseGuard>> guards;
  for (const ExperimentGroup& group : requested.groups) {
    const auto guard = std::make_shared<NoiseGuard>(group.judged(), group.experiments);
    for (const Experiment& experiment : group.experiments) guards[&experiment] = guard;
  }
  ProgressDisplay display(progress_style(quiet));
  ProgressParts parts(display.callback(), static_cast<double>(share.size()));
  for (const WorkUnit& unit : share) {
    const Experiment& experiment = *unit.experiment;
    const Progress progress = parts.next(1, experiment.full_name() + ": ");
    const RunFolder pictures = scratch.run().below(experiment.full_name());
    fs::create_directories(pictures.path());
    measure_unit(unit, pictures, progress,
                 {.further_times = measure_further_times(experiment, pictures.path(), progress),
                  .finished = &finished,
                  .watch = guards.at(&experiment)->watch(experiment),
                  .gpu_compiler = amd_compiler_if_installed()});
  }
  display.finish();
  require_stored(scratch);
}

}  // namespace footprint
