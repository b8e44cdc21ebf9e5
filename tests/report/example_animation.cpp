// Figures that are easy to add up by hand.
#include "tests/report/example_animation.hpp"

#include <fmt/format.h>

#include <limits>

namespace footprint {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Record record_of_frame(int frame, const std::string& method, double error, const std::string& stem) {
  Record record;
  record.scene = "plane";
  record.method = method;
  record.degrees = 10.0 * frame;
  record.frame = frame;
  record.width = 64;
  record.height = 48;
  record.pixels = {.object = 100, .interior = 80, .bound = {}, .light = {}};
  record.error.emplace();
  record.error->normalized_color = error;
  record.error->noise_floor = 0.01;
  record.highlight_energy = 0.3;
  record.reference_highlight_energy = 0.25;
  record.frame_ms = {unknown, unknown, unknown};
  record.fps = unknown;
  record.ratio_to_direct = {unknown, unknown, unknown};
  record.images.color = fmt::format("images/{}_{:04}.exr", stem, frame);
  record.images.reference = fmt::format("images/reference_{:04}.exr", frame);
  if (frame == 0) return record;
  record.error->causes.shading = 0.9 * error;
  record.flicker = Flicker{.mean = 2 * error, .p99 = 3 * error, .noise_floor = {}};
  record.flicker->causes.shading = FlickerFigures{.mean = error, .p99 = error};
  record.flicker->causes.edges = FlickerFigures{.mean = 3 * error, .p99 = 3 * error};
  if (method != "a") record.flicker->causes.filter = FlickerFigures{.mean = 0.05, .p99 = 0.1};
  return record;
}

}  // namespace

Results example_animation() {
  Results animation;
  animation.tool.version = "0.0.0";
  animation.backend = {.name = "egl", .renderer = "none", .version = "4.5", .cpu = "some"};
  animation.scene.name = "plane";
  animation.scene.source = "plane";
  animation.scene.exposure_source = "scene";
  animation.reference = {.spp = 16, .filter = "after_shading", .seed = 1, .standard_errors = {0.02, 0.02, 0.02}};
  animation.footprint = "anisotropic:8";
  animation.timing = {.frames = 0, .processes = 1};
  animation.animation = {.path = "orbit", .axis = std::array{0.0, 1.0, 0.0}};
  for (int frame = 0; frame < 3; ++frame) {
    animation.records.push_back(record_of_frame(frame, "a", 0.1 * (frame + 1), "a"));
    animation.records.push_back(record_of_frame(frame, "b:x=1,\"y\"", 0.3, "b"));
  }
  return animation;
}

Results hostile_animation() {
  Results animation = example_animation();
  animation.scene.name = "</script><script>document.title='broken'</script>\"<b>&amp; {{data}}";
  animation.scene.warnings = {"not UTF-8: \xff\xfe, and <!-- a comment"};
  for (Record& record : animation.records) {
    if (record.method != "a") record.method = "<img src=x onerror=\"document.title='broken'\">";
  }
  animation.records[2].reference_highlight_energy.reset();
  animation.records[2].error.reset();
  animation.records[3].flicker.reset();
  animation.film = "images/film.mp4";
  return animation;
}

}  // namespace footprint
