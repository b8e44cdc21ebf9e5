// `footprint animate`: the frames of a zoom, an orbit or a light's path, with error and flicker against the reference.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <system_error>

#include "app/child_process.hpp"
#include "app/experiment_runs.hpp"
#include "app/subcommand.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr const char* film_file = "images/film.mp4";
constexpr int frames_per_second = 30;

constexpr const char* animate_examples =
    R"(The folder gets images/METHOD_NNNN and images/reference_NNNN (.exr and .png), index.html with the film and its
figures, results.json, results.csv and table.md. Finished frames stay in kept/, so an interrupted run resumes.
`footprint merge` joins the parts of an animation that was rendered with --shard.

Examples:
  footprint animate model.gltf --methods toksvig --frames 60 -o out
  footprint animate ribbed_plane --methods direct,toksvig --frames 30 --from 1 --to 16 --spp 64 -o out
  footprint animate carved_disk --methods direct,lean --path orbit --degrees 40 --video -o out
  footprint animate carved_disk --methods direct,lean --path light --axis 0,1,0 --shard 1/4 -o parts/1)";

struct AnimateArguments : RunArguments {
  explicit AnimateArguments(CLI::App& command) : RunArguments(command) {
    add_output_folder(command, output, "Folder for index.html, results.json, results.csv, table.md, images/, kept/");
    add_value(command, "--shard", shard, "I/N",
              "Render part I of N of the frames into the output folder, for `footprint merge`");
  }

  std::string output = "out";
  std::string shard;  // empty: all frames
};

// Nothing is measured but what frames differ by.
RunSettings settings_of(const AnimateArguments& arguments) {
  RunSettings settings = arguments.settings();
  settings.reference.by_cause = false;
  settings.reference.supersampling = {};
  settings.timing.repeats = 0;
  return settings;
}

void animate_part(const AnimateArguments& arguments) {
  const RunSettings settings = settings_of(arguments);
  if (settings.output.video)
    throw Error(ErrorKind::usage, "--video", "a film cannot be made of a part",
                "merge the parts, then run this without --shard over the merged folder: it reuses the frames");
  const Shard shard = parse_shard(arguments.shard);
  const FinishedWork finished = finished_work_in(arguments.output, settings.backend.context, settings.output.fresh);
  make_part(shard, arguments.output, finished, [&]() -> PartFile {
    ProgressDisplay display(progress_style(arguments.quiet));
    const OutputFolder scratch(arguments.output);  // never moved to its place
    const auto [first, last] = range_of(shard, static_cast<std::size_t>(settings.view.zoom.frames));
    std::vector<std::size_t> frames(last - first);
    std::iota(frames.begin(), frames.end(), first);
    std::string fingerprint =
        measure_views(settings, frames, scratch.run(), display.callback(), {.finished = &finished});
    require_stored(scratch);
    return {.kind = PartKind::animation,
            .experiment = settings.scene,
            .fingerprint = std::move(fingerprint),
            .tile = settings.backend.tile};
  });
}

// The pattern of all frames that the picture of frame 0 is of: "images/toksvig_%04d.png".
std::string pattern_of(const std::string& first) {
  constexpr std::string_view ending = "_0000.exr";
  return first.substr(0, first.size() - ending.size()) + "_%04d.png";
}

std::vector<std::string> columns_of(const Results& animation) {
  std::vector<std::string> patterns{pattern_of(animation.records.front().images.reference)};
  for (const Record& record : animation.records) {
    if (record.frame == 0) patterns.push_back(pattern_of(record.images.color));
  }
  return patterns;
}

std::vector<std::string> film_arguments(const Results& animation) {
  std::vector<std::string> arguments{"ffmpeg", "-y", "-nostdin", "-loglevel", "error"};
  const std::vector<std::string> columns = columns_of(animation);
  std::string inputs;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    arguments.insert(arguments.end(), {"-framerate", fmt::format("{}", frames_per_second), "-i", columns[i]});
    inputs += fmt::format("[{}:v]", i);
  }
  const std::string layout =
      fmt::format("{}hstack=inputs={},pad=ceil(iw/2)*2:ceil(ih/2)*2,format=yuv420p", inputs, columns.size());
  arguments.insert(arguments.end(), {"-filter_complex", layout, "-c:v", "libx264", "-crf", "16", "-threads", "1",
                                     "-fflags", "+bitexact", film_file});
  return arguments;
}

// The path of ffmpeg. Errors (machine): it is not in PATH.
fs::path find_ffmpeg() {
  const char* const path = std::getenv("PATH");
  std::string_view folders = path != nullptr ? path : "";
  while (!folders.empty()) {
    const std::string_view folder = folders.substr(0, folders.find(':'));
    folders.remove_prefix(std::min(folder.size() + 1, folders.size()));
    fs::path file = fs::path(folder) / "ffmpeg";
    if (!folder.empty() && access(file.c_str(), X_OK) == 0) return fs::absolute(file);
  }
  throw Error(ErrorKind::machine, "--video", "ffmpeg is not installed",
              "install the package ffmpeg, or leave --video out: the frames are written anyway");
}

// Writes FOLDER/images/film.mp4, the reference and then all methods side by side, and returns its path from the folder.
// One input per column; sides are padded to even numbers, as the pixel format needs. Errors (machine): ffmpeg ends
// with a failure, in its own words; an interrupt through `progress`: ffmpeg is ended.
std::string make_film(const fs::path& ffmpeg, const Results& animation, const fs::path& folder,
                      const Progress& progress) {
  const auto [exit_code, words] = run_child(
      {.program = ffmpeg, .arguments = film_arguments(animation), .errors = folder / "ffmpeg.log", .folder = folder},
      Error(ErrorKind::machine, "--video", fmt::format("{} cannot be started", ffmpeg.string()), "try it by hand"),
      [&] { progress("the film", 0.0); });
  if (exit_code == 0 && fs::is_regular_file(folder / film_file)) return film_file;
  std::error_code ignored;
  fs::remove(folder / film_file, ignored);  // half of one
  throw Error(ErrorKind::machine, "--video",
              fmt::format("ffmpeg ended with {}: {}", exit_code, words.empty() ? "no message" : words.substr(0, 400)),
              "leave --video out: finished frames are stored, and are not rendered again");
}

void run_animate(const AnimateArguments& arguments) {
  if (!arguments.shard.empty()) return animate_part(arguments);
  const RunSettings settings = settings_of(arguments);
  const fs::path ffmpeg = settings.output.video ? find_ffmpeg() : fs::path();
  const FinishedWork finished = finished_work_in(arguments.output, settings.backend.context, settings.output.fresh);
  ProgressDisplay display(progress_style(arguments.quiet));
  write_and_print_animation(arguments.output, [&](const RunFolder& folder) {
    ProgressParts parts(display.callback(), 20);
    Results animation = run_compare(settings, folder, parts.next(19, ""), {.finished = &finished});
    if (settings.output.video) {
      folder.attempt(film_file,
                     [&] { animation.film = make_film(ffmpeg, animation, folder.path(), parts.next(1, "")); });
    }
    display.finish();
    return animation;
  });
}

}  // namespace

void add_animate_command(CLI::App& app) {
  add_command(app, "animate", "Render a zoom, an orbit or a light path, and measure error and flicker",
              animate_examples, run_animate);
}

}  // namespace footprint
