// `footprint animate`: the frames of a zoom, an orbit or a light's path, with error and flicker against the reference.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <numeric>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.hpp"
#include "app/experiment_runs.hpp"
#include "app/film.hpp"
#include "app/messages.hpp"
#include "app/output.hpp"
#include "app/part_file.hpp"
#include "app/progress_display.hpp"
#include "app/run_options.hpp"
#include "app/standard_output.hpp"
#include "experiments/studies/compare.hpp"
#include "renderer/core/process.hpp"

namespace footprint {
namespace {

constexpr const char* animate_examples =
    "The folder gets images/METHOD_NNNN and images/reference_NNNN (.exr and .png), index.html with the film and its\n"
    "figures, results.json, results.csv and table.md. Finished frames stay in kept/, so an interrupted run "
    "resumes.\n"
    "`footprint merge` joins the parts of an animation that was rendered with --shard.\n"
    "\n"
    "Examples:\n"
    "  footprint animate model.gltf --methods toksvig --frames 60 -o out\n"
    "  footprint animate ribbed_plane --methods direct,toksvig --frames 30 --from 1 --to 16 --spp 64 -o out\n"
    "  footprint animate carved_disk --methods direct,lean --path orbit --degrees 40 --video -o out\n"
    "  footprint animate carved_disk --methods direct,lean --path light --axis 0,1,0 --shard 1/4 -o parts/1";

struct AnimateArguments {
  explicit AnimateArguments(CLI::App& command) : run(command) {}

  RunOptions run;
  std::string output = "out";
  std::string shard;  // empty: all frames
  bool video = false;
  bool fresh = false;
  bool quiet = false;
};

void add_options(CLI::App& command, AnimateArguments& arguments) {
  command
      .add_option("-o,--output", arguments.output,
                  "Folder for index.html, results.json, results.csv, table.md, images/, kept/")
      ->type_name("DIR")
      ->capture_default_str();
  command
      .add_option("--shard", arguments.shard,
                  "Render part I of N of the frames into the output folder, for `footprint merge`")
      ->type_name("I/N");
  command.add_flag("--video", arguments.video, "Also make images/film.mp4 with ffmpeg: all methods side by side");
  command.add_flag("--fresh", arguments.fresh, "Render every frame again: discard the finished ones");
  add_quiet_flag(command, arguments.quiet);
}

// Nothing is measured but what frames differ by.
RunSettings settings_of(const AnimateArguments& arguments) {
  RunSettings settings = arguments.run.settings();
  settings.reference.by_cause = false;
  settings.reference.supersampling = {};
  settings.timing.repeats = 0;
  return settings;
}

FinishedWork finished_frames(const AnimateArguments& arguments, const RunSettings& settings) {
  FinishedWork finished(finished_work_folder(arguments.output), maker_for(settings));
  if (arguments.fresh) finished.clear();
  return finished;
}

// Renders one part; `part.json` says that it is whole, and is there only then.
void animate_part(const AnimateArguments& arguments, const RunSettings& settings) {
  if (arguments.video)
    throw Error(ErrorKind::usage, "--video", "a film cannot be made of a part",
                "merge the parts, then run this without --shard over the merged folder: it reuses the frames");
  const auto begin = std::chrono::steady_clock::now();
  const Shard shard = parse_shard(arguments.shard);
  const FinishedWork finished = finished_frames(arguments, settings);
  const std::filesystem::path output = arguments.output;
  std::error_code none;
  std::filesystem::remove(output / "part.json", none);
  ProgressDisplay display(progress_style(arguments.quiet));
  {
    const OutputFolder scratch(output);  // never moved to its place
    const auto [first, last] = range_of(shard, static_cast<std::size_t>(settings.view.zoom.frames));
    std::vector<std::size_t> frames(last - first);
    std::iota(frames.begin(), frames.end(), first);
    const std::string run =
        measure_views(settings, frames, scratch.path(), display.callback(), {.finished = &finished});
    std::filesystem::create_directories(output);
    write_part_file(output, {.kind = PartKind::animation,
                             .experiment = settings.scene,
                             .fingerprint = run,
                             .maker = finished.maker(),
                             .shard = shard,
                             .only = {},
                             .tile = settings.backend.tile,
                             .node = host_name(),
                             .seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
                             .keys = finished.used()});
  }
  display.finish();
  write_output(fmt::format("part {} of {}: {}\n", shard.index, shard.count, output.string()));
}

void run_animate(const AnimateArguments& arguments) {
  const RunSettings settings = settings_of(arguments);
  if (!arguments.shard.empty()) return animate_part(arguments, settings);
  const std::filesystem::path ffmpeg = arguments.video ? find_ffmpeg() : std::filesystem::path();
  const FinishedWork finished = finished_frames(arguments, settings);
  ProgressDisplay display(progress_style(arguments.quiet));
  write_and_print_animation(arguments.output, [&](const std::filesystem::path& folder) {
    ProgressParts parts(display.callback(), 20);
    Results animation = run_compare(settings, folder, parts.next(19, ""), {.finished = &finished});
    if (arguments.video) animation.film = make_film(ffmpeg, animation, folder, parts.next(1, ""));
    display.finish();
    return animation;
  });
}

}  // namespace

void add_animate_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("animate", "Render a zoom, an orbit or a light path, and measure error and flicker");
  const auto arguments = std::make_shared<AnimateArguments>(*command);
  add_options(*command, *arguments);
  command->footer(animate_examples);
  command->callback([arguments] { run_animate(*arguments); });
}

}  // namespace footprint
