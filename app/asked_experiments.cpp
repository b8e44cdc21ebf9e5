// Members one after the other, those that --only names.
#include "app/asked_experiments.hpp"

#include <fmt/format.h>

#include <regex>

#include "app/folders.hpp"
#include "experiments/runner/run_experiment.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/file_bytes.hpp"
#include "renderer/core/hash.hpp"

namespace footprint {
namespace {

constexpr std::uint64_t largest_experiment = 1U << 26U;  // bytes of TOML

Experiment experiment_of(const std::filesystem::path& file, const ExperimentRequest& request) {
  Experiment experiment = read_experiment(file);
  request.apply(experiment.run);
  if (request.quick) make_quick(experiment);
  if (experiment.members.empty()) check_against_scene(experiment);
  return experiment;
}

std::regex expression_of(const std::string& only) {
  try {
    return std::regex(only, std::regex::ECMAScript);
  } catch (const std::regex_error&) {
    throw Error(ErrorKind::usage, "--only", fmt::format("`{:.80}` is no regular expression", only),
                "write a part of a name, or for example `fig[45]`");
  }
}

// Those of a folder, but for the ones that are made of others: their members lie there too.
std::vector<Experiment> experiments_in(const std::filesystem::path& folder, const ExperimentRequest& request) {
  const std::regex only = expression_of(request.only);
  std::vector<Experiment> all;
  for (const std::string& name : list_experiments(folder)) {
    if (!std::regex_search(name, only)) continue;
    Experiment experiment = experiment_of(folder / (name + ".toml"), request);
    if (experiment.members.empty()) all.push_back(std::move(experiment));
  }
  if (!all.empty()) return all;
  throw Error(ErrorKind::usage, request.only.empty() ? folder.string() : "--only",
              fmt::format("no experiment in {} is called so", folder.string()),
              "`footprint list experiments` names those of this program");
}

std::vector<Experiment> members_of(const Experiment& named, const ExperimentRequest& request) {
  const std::regex only = expression_of(request.only);
  std::vector<Experiment> members;
  for (const std::filesystem::path& file : named.members) {
    if (!std::regex_search(file.stem().string(), only)) continue;
    members.push_back(experiment_of(file, request));
    if (members.back().members.empty()) continue;
    throw Error(ErrorKind::usage, named.file.string(), fmt::format("its member {} has members", members.back().name),
                "name those instead");
  }
  return members;
}

// The settings that enter are those that a command line may set beside the file.
std::string fingerprint_of(const AskedExperiments& asked, const ExperimentRequest& request) {
  ContentHash hash;
  const auto add_file = [&](const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_file_bytes(file, largest_experiment);
    hash.add(file.stem().string());
    hash.add(std::as_bytes(std::span(bytes)));
  };
  if (!std::filesystem::is_directory(asked.file)) add_file(asked.file);
  for (const Experiment& experiment : asked.experiments) {
    add_file(experiment.file);
    hash.add(fmt::format("{} {}", experiment.run.timing.processes, experiment.run.backend.tile));
  }
  hash.add(request.quick ? "quick" : "");
  return hash.hex();
}

}  // namespace

AskedExperiments ask_experiments(const ExperimentRequest& request) {
  if (std::filesystem::is_directory(request.experiment)) {
    AskedExperiments asked{
        .file = request.experiment, .experiments = experiments_in(request.experiment, request), .fingerprint = {}};
    asked.fingerprint = fingerprint_of(asked, request);
    return asked;
  }
  AskedExperiments asked{
      .file = find_experiment(request.experiment, experiments_folder()), .experiments = {}, .fingerprint = {}};
  const Experiment named = experiment_of(asked.file, request);
  if (named.members.empty() && !request.only.empty())
    throw Error(ErrorKind::usage, "--only", fmt::format("{} has no members to choose from", named.name),
                "leave it out");
  asked.experiments = named.members.empty() ? std::vector{named} : members_of(named, request);
  if (asked.experiments.empty())
    throw Error(ErrorKind::usage, "--only", fmt::format("no member of {} is called `{:.80}`", named.name, request.only),
                "`footprint list experiments` names them");
  asked.fingerprint = fingerprint_of(asked, request);
  return asked;
}

}  // namespace footprint
