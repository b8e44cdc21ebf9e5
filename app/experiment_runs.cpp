// Reports from kept work, and kept work from shares of all there is to do.
#include "app/experiment_runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/messages.hpp"
#include "app/output.hpp"
#include "app/progress_display.hpp"
#include "app/timing_process.hpp"
#include "experiments/runner/run_experiment.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr double weight = 10;  // of the main process's work, where a further process's is 1

// The times of the further processes of an experiment, taken when they are asked for.
FurtherTimes further_times_of(const Experiment& experiment, const fs::path& scratch, const Progress& progress) {
  const int others = experiment.run.timing.processes - 1;
  if (others == 0) return {};
  return [others, &experiment, scratch, progress] {
    return times_of_processes(others, {timing_member_option, experiment.name}, scratch, progress);
  };
}

Results run_into(const Experiment& experiment, OutputFolder& folder, const KeptWork& kept, const Progress& progress) {
  ProgressParts parts(progress, weight + experiment.run.timing.processes - 1);
  const FurtherTimes further =
      further_times_of(experiment, folder.path(), parts.next(experiment.run.timing.processes - 1, ""));
  Results results = run_experiment(experiment, further, folder.path(), parts.next(weight, ""), &kept);
  keep_results(results, folder, write_report);
  return results;
}

// The units of all experiments in one row: which experiment each is of.
struct Assigned {
  const Experiment* experiment;
  WorkUnit unit;
};

std::vector<Assigned> all_units(const AskedExperiments& asked) {
  std::vector<Assigned> all;
  for (const Experiment& experiment : asked.experiments) {
    for (WorkUnit& unit : work_units(experiment)) all.push_back({&experiment, std::move(unit)});
  }
  return all;
}

// Distances of one experiment that are next to each other are done at once: it is set up once.
std::vector<Assigned> share_of(const std::vector<Assigned>& all, const Shard& shard) {
  const auto [first, last] = range_of(shard, all.size());
  std::vector<Assigned> share;
  for (std::size_t i = first; i < last; ++i) {
    const std::vector<std::size_t>& distances = all[i].unit.distances;
    const bool goes_on = !share.empty() && share.back().experiment == all[i].experiment &&
                         !share.back().unit.distances.empty() && !distances.empty();
    if (!goes_on) {
      share.push_back(all[i]);
      continue;
    }
    std::vector<std::size_t>& before = share.back().unit.distances;
    before.insert(before.end(), distances.begin(), distances.end());
  }
  return share;
}

}  // namespace

fs::path kept_folder(const fs::path& output) { return output / "kept"; }

std::string maker_for(const RunSettings& run) {
  const gl::Context context(run.backend.context);
  return maker_of_work(fmt::format("{} {}", context.info().renderer, context.info().version));
}

void run_and_print(const AskedExperiments& asked, const fs::path& output, const KeptWork& kept, bool quiet,
                   const std::function<void(const Results& results)>& each) {
  const auto run_one = [&](const Experiment& experiment, const fs::path& to) {
    ProgressDisplay display(progress_style(quiet));
    const auto [results, path] =
        write_whole(to, [&](OutputFolder& folder) { return run_into(experiment, folder, kept, display.callback()); });
    display.finish();
    print_results(results, path);
    each(results);
  };
  if (!asked.has_members()) return run_one(asked.experiments.front(), output);
  std::vector<std::string> missing;
  ErrorKind kind = ErrorKind::machine;
  for (const Experiment& experiment : asked.experiments) {
    try {
      run_one(experiment, output / experiment.name);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::interrupted) throw;
      if (missing.empty()) kind = error.kind();
      missing.push_back(experiment.name);
      write_message(fmt::format("{} was not run: {}", experiment.name, error.what()));
    }
  }
  if (missing.empty()) return;
  throw Error(kind, asked.file.string(),
              fmt::format("{} of {} experiments were not run: {}", missing.size(), asked.experiments.size(),
                          fmt::join(missing, ", ")),
              "run it again when what they lack is there; the others are kept");
}

void run_part(const AskedExperiments& asked, const Shard& shard, const fs::path& output, const KeptWork& kept,
              bool quiet) {
  const OutputFolder scratch(output);  // never moved to its place
  const std::vector<Assigned> share = share_of(all_units(asked), shard);
  ProgressDisplay display(progress_style(quiet));
  ProgressParts parts(display.callback(), static_cast<double>(share.size()));
  for (const auto& [experiment, unit] : share) {
    const Progress progress = parts.next(1, experiment->name + ": ");
    const fs::path pictures = scratch.path() / experiment->name;
    fs::create_directories(pictures);
    measure_unit(*experiment, unit, further_times_of(*experiment, pictures, progress), pictures, progress, kept);
  }
  display.finish();
}

}  // namespace footprint
