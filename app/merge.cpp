// `footprint merge`: the parts of a run, made by `run --shard`, joined to its report.
#include <algorithm>

#include "app/experiment_runs.hpp"
#include "app/subcommand.hpp"
#include "experiments/runner/run_experiment.hpp"
#include "renderer/core/bytes.hpp"
#include "results/report/experiment_report.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr const char* merge_words =
    R"(Each PART is the output folder of `footprint run EXPERIMENT --shard I/N` or `footprint animate ... --shard I/N`.
All N parts must come from the same experiment and program. The report equals that of a single run; nothing is
measured again. Times name the machine that took them (docs/guides/cluster.md).

Examples:
  footprint merge parts/1 parts/2 -o out
  footprint merge parts/* -o out)";

struct MergeArguments : RunArguments {
  explicit MergeArguments(CLI::App& command) : RunArguments(command) {
    command.add_option("part", parts, "Output folders of all parts")->required()->type_name("PART");
    add_output_folder(command, output, "Folder for results.json, results.csv, table.md, index.html, images/, kept/");
  }

  std::vector<std::string> parts;
  std::string output = "out";
};

struct Part {
  fs::path folder;
  PartFile file;

  [[nodiscard]] int index() const { return file.shard.index; }
};

[[noreturn]] void refuse(const Part& part, const std::string& why, const std::string& hint) {
  throw Error(ErrorKind::usage, (part.folder / "part.json").string(), why, hint);
}

// All parts, in the order of their numbers. Errors (usage): one does not go with the first, is there twice, or missing.
std::vector<Part> read_parts(const std::vector<std::string>& folders) {
  std::vector<Part> parts;
  for (const std::string& folder : folders) {
    const Part& part = parts.emplace_back(Part{folder, read_part_file(folder)});
    const auto& [other, first] = parts.front();
    const auto same = std::ranges::find(parts, part.index(), &Part::index);
    if (&*same != &part)
      refuse(part, fmt::format("is part {}, and so is {}", part.index(), same->folder.string()), "name each part once");
    if (part.file.fingerprint != first.fingerprint)
      refuse(part, fmt::format("has another experiment or other options than {}", other.string()),
             "merge the parts of one run");
    if (part.file.maker != first.maker)
      refuse(part, fmt::format("was made by another program or OpenGL than {}", other.string()),
             "run all parts with one program, on machines of one kind");
    if (part.file.shard.count != first.shard.count)
      refuse(part,
             fmt::format("is one of {} parts, but {} is one of {}", part.file.shard.count, other.string(),
                         first.shard.count),
             "merge the parts of one run");
  }
  std::ranges::sort(parts, {}, &Part::index);
  const int count = parts.front().file.shard.count;
  for (int index = 1; index <= count; ++index) {
    if (std::ranges::find(parts, index, &Part::index) == parts.end())
      refuse(parts.front(), fmt::format("part {} of {} is missing", index, count),
             fmt::format("run it with --shard {}/{}, and add its folder", index, count));
  }
  return parts;
}

// The experiments as the parts were run. Errors (usage): the files or this program are not what they were.
RequestedExperiments requested_by(const Part& first, const RunArguments& arguments) {
  RequestedExperiments requested = requested_experiments({.experiment = first.file.experiment,
                                                          .only = first.file.only,
                                                          .quick = first.file.quick,
                                                          .region = first.file.kind == PartKind::region,
                                                          .apply = [&](RunSettings& run) {
                                                            arguments.apply(run);
                                                            run.timing.processes = first.file.processes;
                                                            run.backend.tile = first.file.tile;
                                                          }});
  if (requested.fingerprint != first.file.fingerprint)
    refuse(first, fmt::format("{} has changed since this part was run", requested.file.string()),
           "run all parts again, or restore the file");
  return requested;
}

void take_all(const std::vector<Part>& parts, const FinishedWork& finished) {
  for (const Part& part : parts) {
    const FinishedWork from(finished_work_folder(part.folder), finished.maker());
    for (const std::string& key : part.file.keys) finished.take(key, from);
  }
}

void merge_animation(const std::vector<Part>& parts, const std::string& output) {
  const FinishedWork finished(finished_work_folder(output), parts.front().file.maker, true);
  take_all(parts, finished);
  write_and_print_animation(output, [&](const RunFolder& folder) {
    return joined_animation(finished, parts.front().file.fingerprint, folder);
  });
}

void merge(const MergeArguments& arguments) {
  const std::vector<Part> parts = read_parts(arguments.parts);
  if (!is_made_by_this_program(parts.front().file.maker))
    refuse(parts.front(), "was made by another program than this one", "merge with the program that ran the parts");
  if (parts.front().file.kind == PartKind::animation) return merge_animation(parts, arguments.output);
  const RequestedExperiments requested = requested_by(parts.front(), arguments);
  const FinishedWork finished(finished_work_folder(arguments.output), parts.front().file.maker, true);
  take_all(parts, finished);
  if (const auto failed = run_and_print(requested, arguments.output, finished, arguments.quiet, {})) throw *failed;
}

}  // namespace

void add_merge_command(CLI::App& app) {
  add_command(app, "merge", "Join the parts of a run made with --shard into one report", merge_words, merge);
}

}  // namespace footprint
