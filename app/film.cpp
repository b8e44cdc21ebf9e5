// One input per column, stacked horizontally; sides are padded to even numbers, as the pixel format needs.
#include "app/film.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <set>
#include <string_view>
#include <vector>

#include "app/child_process.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr const char* film_file = "images/film.mp4";
constexpr int frames_per_second = 30;

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

}  // namespace

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

std::string make_film(const fs::path& ffmpeg, const Results& animation, const fs::path& folder,
                      const Progress& progress) {
  const fs::path errors = folder / "ffmpeg.log";
  ChildProcess child(
      {.program = ffmpeg, .arguments = film_arguments(animation), .errors = errors, .folder = folder},
      Error(ErrorKind::machine, "--video", fmt::format("{} cannot be started", ffmpeg.string()), "try it by hand"));
  const int exit_code = child.wait([&] { progress("the film", 0.0); });
  std::string words = file_text(errors);
  while (!words.empty() && words.back() == '\n') words.pop_back();
  fs::remove(errors);
  if (exit_code == 0 && fs::is_regular_file(folder / film_file)) return film_file;
  throw Error(ErrorKind::machine, "--video",
              fmt::format("ffmpeg ended with {}: {}", exit_code, words.empty() ? "no message" : words.substr(0, 400)),
              "leave --video out: finished frames are stored, and are not rendered again");
}

}  // namespace footprint
