// `footprint merge`: the parts of a run, made by `run --shard`, joined to its report.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/experiment_runs.hpp"
#include "app/output.hpp"
#include "app/part_file.hpp"
#include "app/run_options.hpp"
#include "experiments/studies/finished_work.hpp"
#include "renderer/core/error.hpp"

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
    add_quiet_flag(command, quiet);
  }

  std::vector<std::string> parts;
  std::string output = "out";
};

struct Part {
  fs::path folder;
  PartFile file;
};

[[noreturn]] void refuse(const Part& part, const std::string& why, const std::string& hint) {
  throw Error(ErrorKind::usage, (part.folder / "part.json").string(), why, hint);
}

// All parts, in the order of their numbers. Errors (usage): one does not go with the first, is there twice, or missing.
std::vector<Part> parts_of(const std::vector<std::string>& folders) {
  std::map<int, Part> parts;
  for (const std::string& folder : folders) {
    Part part{folder, read_part_file(folder)};
    const int index = part.file.shard.index;
    if (parts.contains(index))
      refuse(part, fmt::format("is part {}, and so is {}", index, parts.at(index).folder.string()),
             "name each part once");
    if (!parts.empty()) {
      const Part& first = parts.begin()->second;
      const std::string other = first.folder.string();
      if (part.file.fingerprint != first.file.fingerprint)
        refuse(part, fmt::format("has another experiment or other options than {}", other),
               "merge the parts of one run");
      if (part.file.maker != first.file.maker)
        refuse(part, fmt::format("was made by another program or OpenGL than {}", other),
               "run all parts with one program, on machines of one kind");
      if (part.file.shard.count != first.file.shard.count)
        refuse(part,
               fmt::format("is one of {} parts, but {} is one of {}", part.file.shard.count, other,
                           first.file.shard.count),
               "merge the parts of one run");
    }
    parts.emplace(index, std::move(part));
  }
  std::vector<Part> all;
  all.reserve(parts.size());
  for (auto& [index, part] : parts) all.push_back(std::move(part));
  for (int index = 1; index <= all.front().file.shard.count; ++index) {
    if (!std::ranges::any_of(all, [&](const Part& part) { return part.file.shard.index == index; }))
      refuse(all.front(), fmt::format("part {} of {} is missing", index, all.front().file.shard.count),
             fmt::format("run it with --shard {}/{}, and add its folder", index, all.front().file.shard.count));
  }
  return all;
}

// As the parts were run. Errors (usage): the files or this program are not what they were.
RequestedExperiments requested_by(const Part& first, const RunOptions& options) {
  RequestedExperiments requested = requested_experiments({.experiment = first.file.experiment,
                                                          .only = first.file.only,
                                                          .quick = first.file.quick,
                                                          .apply = [&](RunSettings& run) {
                                                            options.apply(run);
                                                            run.timing.processes = first.file.processes;
                                                            run.backend.tile = first.file.tile;
                                                          }});
  if (requested.fingerprint != first.file.fingerprint)
    refuse(first, fmt::format("{} has changed since this part was run", requested.file.string()),
           "run all parts again, or restore the file");
  return requested;
}

// Copies the finished work of all parts.
void take_all(const std::vector<Part>& parts, const FinishedWork& finished) {
  for (const Part& part : parts) {
    const FinishedWork from(finished_work_folder(part.folder), finished.maker());
    for (const std::string& key : part.file.keys) finished.take(key, from);
  }
}

void merge_animation(const std::vector<Part>& parts, const std::string& output) {
  const FinishedWork finished(finished_work_folder(output), parts.front().file.maker, true);
  take_all(parts, finished);
  write_and_print_animation(output, [&](const fs::path& folder) {
    return joined_animation(finished, parts.front().file.fingerprint, folder);
  });
}

void merge(const MergeArguments& arguments) {
  const std::vector<Part> parts = parts_of(arguments.parts);
  if (!is_made_by_this_program(parts.front().file.maker))
    refuse(parts.front(), "was made by another program than this one", "merge with the program that ran the parts");
  if (parts.front().file.kind == PartKind::animation) return merge_animation(parts, arguments.output);
  const RequestedExperiments requested = requested_by(parts.front(), arguments.run);
  const FinishedWork finished(finished_work_folder(arguments.output), parts.front().file.maker, true);
  take_all(parts, finished);
  if (const auto failed = run_and_print(requested, arguments.output, finished, arguments.quiet, {})) throw *failed;
}

}  // namespace

void add_merge_command(CLI::App& app) {
  add_command(app, "merge", "Join the parts of a run made with --shard into one report", merge_words, merge);
}

}  // namespace footprint
