// Members one after the other, those that --only names.
#include "app/requested_experiments.hpp"

#include <fmt/format.h>

#include <regex>

#include "app/folders.hpp"
#include "experiments/runner/run_experiment.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/hash.hpp"

namespace footprint {
namespace {

constexpr std::uint64_t largest_experiment = 1U << 26U;  // bytes of TOML

Experiment experiment_of(const std::filesystem::path& file, const ExperimentRequest& request) {
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

// Adds those of a matrix whose names match; what is said of others is left out of the matrix.
void add_members(RequestedExperiments& requested, const Experiment& whole, const std::regex& only, bool quick) {
  RequestedMatrix matrix{.whole = whole, .first = requested.experiments.size(), .count = 0, .left_out = {}};
  std::vector<Coordinates> missing;
  for (Experiment& member : members_of_matrix(whole)) {
    if (!std::regex_search(member.name, only)) {
      missing.push_back(member.coordinates);
      continue;
    }
    if (quick) make_quick(member);
    requested.experiments.push_back(std::move(member));
    ++matrix.count;
  }
  matrix.whole.quick = quick;
  matrix.left_out = leave_out(matrix.whole, missing);
  requested.matrices.push_back(std::move(matrix));
}

// Those of a folder, but for the ones that are made of others: their members lie there too.
void add_folder(RequestedExperiments& requested, const ExperimentRequest& request) {
  const std::regex only = expression_of(request.only);
  for (const std::string& name : list_experiments(requested.file)) {
    if (!std::regex_search(name, only)) continue;
    Experiment experiment = experiment_of(requested.file / (name + ".toml"), request);
    if (!experiment.axes.empty()) {
      add_members(requested, experiment, std::regex(""), request.quick);
    } else if (experiment.members.empty()) {
      requested.experiments.push_back(std::move(experiment));
    }
  }
  if (!requested.experiments.empty()) return;
  throw Error(ErrorKind::usage, request.only.empty() ? requested.file.string() : "--only",
              fmt::format("no experiment in {} matches", requested.file.string()),
              "`footprint list experiments` names those of this program");
}

std::vector<Experiment> members_of(const Experiment& named, const ExperimentRequest& request) {
  const std::regex only = expression_of(request.only);
  std::vector<Experiment> members;
  for (const std::filesystem::path& file : named.members) {
    if (!std::regex_search(file.stem().string(), only)) continue;
    members.push_back(experiment_of(file, request));
    if (members.back().members.empty() && members.back().axes.empty()) continue;
    throw Error(ErrorKind::usage, named.file.string(), fmt::format("its member {} has members", members.back().name),
                "name those instead");
  }
  return members;
}

// The settings that enter are those that a command line may set beside the file.
std::string fingerprint_of(const RequestedExperiments& requested, const ExperimentRequest& request) {
  ContentHash hash;
  const auto add_file = [&](const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_file_bytes(file, largest_experiment);
    hash.add(file.stem().string());
    hash.add(std::as_bytes(std::span(bytes)));
  };
  if (!std::filesystem::is_directory(requested.file)) add_file(requested.file);
  for (const Experiment& experiment : requested.experiments) {
    add_file(experiment.file);
    if (experiment.presets) add_file(*experiment.presets);
    for (const MethodSpec& method : experiment.run.methods)
      if (method.file) hash.add(method.file->file_content);
    hash.add(experiment.full_name());
    hash.add(fmt::format("{} {}", experiment.run.timing.processes, experiment.run.backend.tile));
  }
  hash.add(request.quick ? "quick" : "");
  return hash.hex();
}

}  // namespace

std::filesystem::path RequestedExperiments::folder_of(const RequestedMatrix& matrix) const {
  return file == matrix.whole.file ? std::filesystem::path() : std::filesystem::path(matrix.whole.name);
}

std::filesystem::path RequestedExperiments::folder_of(const Experiment& experiment) const {
  if (!has_members()) return {};
  return file == experiment.file ? experiment.name : experiment.full_name();
}

RequestedExperiments requested_experiments(const ExperimentRequest& request) {
  RequestedExperiments requested;
  if (std::filesystem::is_directory(request.experiment)) {
    requested.file = request.experiment;
    add_folder(requested, request);
    requested.fingerprint = fingerprint_of(requested, request);
    return requested;
  }
  requested.file = find_experiment(request.experiment, experiments_folder());
  const Experiment named = experiment_of(requested.file, request);
  const bool has_members = !named.members.empty() || !named.axes.empty();
  if (!has_members && !request.only.empty())
    throw Error(ErrorKind::usage, "--only", fmt::format("{} has no members to choose from", named.name),
                "leave it out");
  if (!named.axes.empty()) {
    add_members(requested, named, expression_of(request.only), request.quick);
  } else {
    requested.experiments = has_members ? members_of(named, request) : std::vector{named};
  }
  if (requested.experiments.empty())
    throw Error(ErrorKind::usage, "--only", fmt::format("no member of {} is called `{:.80}`", named.name, request.only),
                named.axes.empty() ? "`footprint list experiments` names them"
                                   : fmt::format("its first is {}", members_of_matrix(named).front().name));
  requested.fingerprint = fingerprint_of(requested, request);
  return requested;
}

}  // namespace footprint
