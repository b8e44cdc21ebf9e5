// Equal ratios of distance in a zoom, and turns about an axis through the centre of the bounds, in double.
#include "experiments/studies/view_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>
#include <variant>

#include "experiments/studies/picture_files.hpp"
#include "renderer/core/error.hpp"
#include "renderer/effects/effects.hpp"

namespace footprint {
namespace {

constexpr double default_zoom = 8.0;

// Nine digits: 4, where the powers give 3.9999999999999996.
double rounded(double value) {
  const double scale = std::pow(10.0, 8.0 - std::floor(std::log10(value)));
  return std::round(value * scale) / scale;
}

constexpr double default_turn = 60.0;  // degrees

[[noreturn]] void refuse(const char* option, const char* why) {
  throw Error(ErrorKind::usage, option, why, "leave it out, or choose another --path");
}

void require_settings_of_its_own(const ViewSettings& view) {
  if (kind_of(view) != RunKind::animation) return;
  const bool zooms = view.path.kind == AnimationPath::zoom;
  const bool plays = view.path.kind == AnimationPath::animation;
  if ((zooms || plays) && view.path.degrees) refuse("--degrees", "this path does not turn");
  if ((zooms || plays) && view.path.axis) refuse("--axis", "this path does not turn");
  if (!plays && view.path.until) refuse("--until", "this path follows no animation");
  if (zooms && !view.distances.empty()) refuse("--distance", "a zoom goes from --from to --to");
  if (!zooms && view.zoom.from) refuse("--from", "this path is not a zoom");
  if (!zooms && view.zoom.to) refuse("--to", "this path is not a zoom");
}

// At equal times from --time to --until.
void set_times(const PathSettings& path, double from, const Scene& scene, std::vector<RunView>& views) {
  const double until = path.until.value_or(scene.motion ? scene.motion->last_key : from);
  if (from == until)
    throw Error(ErrorKind::usage, "--until", fmt::format("the animation ends at {:g} s, where it starts", until),
                "let --time and --until differ");
  for (RunView& view : views) view.seconds = from + (until - from) * view.frame / static_cast<double>(views.size() - 1);
}

std::vector<RunView> views_of_distances(const ViewSettings& settings, const Scene& scene) {
  std::vector<RunView> views;
  for (const double distance : run_distances(settings, scene)) {
    const std::size_t frame = kind_of(settings) == RunKind::comparison ? 0 : views.size();
    views.push_back({.distance = distance, .frame = static_cast<std::uint32_t>(frame)});
  }
  return views;
}

// A path that turns, or that follows an animation.
std::vector<RunView> views_of_path(const ViewSettings& settings, double first_time, const Scene& scene) {
  if (settings.path.kind == AnimationPath::light && scene.lights.empty())
    throw Error(ErrorKind::usage, "--path", scene.source + " has no light to move, and its environment stays",
                "take --path orbit");
  const int count = settings.zoom.frames;
  const double distance = settings.distances.empty() ? 1.0 : settings.distances.front();
  const bool plays = settings.path.kind == AnimationPath::animation;
  const double turn = plays ? 0.0 : settings.path.degrees.value_or(default_turn);
  std::vector<RunView> views;
  for (int i = 0; i < count; ++i)
    views.push_back({.distance = distance, .degrees = turn * i / (count - 1), .frame = static_cast<std::uint32_t>(i)});
  if (plays) set_times(settings.path, first_time, scene, views);
  return views;
}

// The turn that a path has made in a frame, about the centre of the bounds.
glm::dmat4 turn_of(const PathSettings& path, const Scene& scene, const RunView& view) {
  const glm::dvec3 axis = turning_axis(path, scene);
  const glm::dvec3 centre(scene.bounds.centre());
  return glm::translate(glm::dmat4(1.0), centre) * glm::rotate(glm::dmat4(1.0), glm::radians(view.degrees), axis) *
         glm::translate(glm::dmat4(1.0), -centre);
}

// A light turned: its positions and its directions.
Light turned(Light light, const glm::dmat4& turn) {
  const auto point = [&](const glm::vec3& at) { return glm::vec3(turn * glm::dvec4(glm::dvec3(at), 1.0)); };
  const auto direction = [&](const glm::vec3& to) {
    return glm::normalize(glm::vec3(glm::dmat3(turn) * glm::dvec3(to)));
  };
  const auto turn_members = [&](auto& own) {
    if constexpr (requires { own.point; }) own.point.position = point(own.point.position);
    if constexpr (requires { own.position; }) own.position = point(own.position);
    if constexpr (requires { own.direction; }) own.direction = direction(own.direction);
    if constexpr (requires { own.across; }) {
      own.across = direction(own.across);
      own.up = direction(own.up);
    }
  };
  std::visit(turn_members, light);
  return light;
}

bool casts_shadows(const Scene& scene) {
  return std::ranges::any_of(derive_effects(scene), [](const EffectDecision& decision) {
    return decision.effect == Effect::cast_shadow && decision.on;
  });
}

}  // namespace

std::vector<double> zoom_distances(double from, double to, int frames) {
  std::vector<double> distances;
  distances.reserve(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) {
    distances.push_back(rounded(from * std::pow(to / from, static_cast<double>(i) / (frames - 1))));
  }
  distances.front() = from;
  distances.back() = to;
  return distances;
}

std::vector<double> given_distances(const ViewSettings& view) {
  const ZoomSettings& zoom = view.zoom;
  if (zoom.frames == 0) return view.distances;
  if (!zoom.from || !zoom.to) return {};
  return zoom_distances(*zoom.from, *zoom.to, zoom.frames);
}

std::vector<double> run_distances(const ViewSettings& view, const Scene& scene) {
  const ZoomSettings& zoom = view.zoom;
  if (zoom.frames == 0) return view.distances.empty() ? scene.distances : view.distances;
  const double from = zoom.from.value_or(scene.distances.front());
  const double last = scene.distances.size() > 1 ? scene.distances.back() : default_zoom * from;
  const double to = zoom.to.value_or(last);
  if (from == to) {
    throw Error(ErrorKind::usage, "--to", fmt::format("the zoom ends at {:g}, where it starts", to),
                "let --from and --to differ");
  }
  return zoom_distances(from, to, zoom.frames);
}

std::string PlannedView::words() const {
  if (kind != RunKind::animation) return fmt::format("distance {:g}", at.distance);
  return fmt::format("frame {} of {}", index + 1, count);
}

std::string PlannedView::stem(const std::string& what) const {
  return kind == RunKind::animation ? fmt::format("{}_{:04}", what, index) : distance_stem(at.distance, what);
}

std::vector<PlannedView> plan_views(const ViewSettings& settings, double first_time, const Scene& scene) {
  require_settings_of_its_own(settings);
  const std::vector<RunView> places = settings.path.kind.value_or(AnimationPath::zoom) == AnimationPath::zoom
                                          ? views_of_distances(settings, scene)
                                          : views_of_path(settings, first_time, scene);
  std::vector<PlannedView> views;
  for (const RunView& at : places)
    views.push_back({.at = at, .kind = kind_of(settings), .index = views.size(), .count = places.size()});
  return views;
}

glm::dvec3 turning_axis(const PathSettings& path, const Scene& scene) {
  return path.axis.value_or(glm::normalize(glm::dvec3(scene.camera.world[1])));
}

Camera camera_on_path(const PathSettings& path, const Scene& scene, const RunView& view) {
  Camera camera = camera_at_distance(scene, view.distance);
  if (path.kind != AnimationPath::orbit || view.degrees == 0.0) return camera;
  camera.world = glm::mat4(turn_of(path, scene, view) * glm::dmat4(camera.world));
  return camera;
}

std::vector<Light> lights_on_path(const PathSettings& path, const Scene& scene, const std::vector<Light>& lights,
                                  const RunView& view) {
  if (path.kind != AnimationPath::light || view.degrees == 0.0) return lights;
  const glm::dmat4 turn = turn_of(path, scene, view);
  std::vector<Light> moved;
  for (const Light& light : lights) moved.push_back(turned(light, turn));
  return moved;
}

Scene ScenePoses::at(double seconds, const std::optional<PlacedBounds>& bounds) {
  SceneOverrides overrides = overrides_;
  overrides.model.time = seconds;
  overrides.bounds = bounds;
  return assemble(read_scene(scene_, library_, overrides), files_);
}

Scene scene_of_run(const ViewSettings& settings, ScenePoses& poses) {
  if (settings.path.kind != AnimationPath::animation) return poses.first();
  const Scene first = poses.at(poses.first_time(), {});
  WideBounds bounds;
  bounds.add(first.bounds, first.origin);
  bool casts = false;
  for (const PlannedView& view : plan_views(settings, poses.first_time(), first)) {
    const Scene posed = poses.at(view.at.seconds, {});
    bounds.add(posed.bounds, posed.origin);
    casts = casts || casts_shadows(posed);
  }
  const glm::dvec3 origin = origin_for(bounds);
  Scene scene = poses.at(poses.first_time(), PlacedBounds{bounds.from(origin), origin});
  if (casts && !scene.shadows.cast) scene.shadows.cast = true;
  return scene;
}

Scene scene_for_path(const ViewSettings& settings, Scene scene) {
  if (settings.path.kind != AnimationPath::light || scene.shadows.cast || casts_shadows(scene)) return scene;
  Scene moved = scene;
  const std::vector<PlannedView> views = plan_views(settings, 0.0, scene);  // of lights that turn: no times
  const bool casts = std::ranges::any_of(views, [&](const PlannedView& view) {
    moved.lights = lights_on_path(settings.path, scene, scene.lights, view.at);
    return casts_shadows(moved);
  });
  if (casts) scene.shadows.cast = true;
  return scene;
}

}  // namespace footprint
