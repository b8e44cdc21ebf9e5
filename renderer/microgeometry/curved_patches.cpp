// Patches of curved surfaces: woven threads, balls on a floor, random waves.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "renderer/core/random.hpp"
#include "renderer/microgeometry/patch_builders.hpp"

namespace footprint {
namespace {

using std::numbers::pi;

constexpr int threads = 2;  // of each kind in a period: a plain weave repeats after two
constexpr double thread_distance = 1.0 / threads;

struct Thread {
  double centre;  // of its axis, across
  double width;   // full
  double height;  // of its wave, and half its thickness
  double phase;   // 1: on top at the first crossing, -1: below
};

// The upper half of an elliptic thread that follows a cosine: (across, along, z). Where its axis is highest and lowest
// lie the crossings, so that threads touch there.
glm::dvec3 thread_point(const Thread& thread, double across, double along) {
  const double angle = pi * (1.0 - across);  // 0..1 from one edge to the other
  const double axis = thread.phase * thread.height * std::cos(2.0 * pi * (along - 0.5 * thread_distance));
  return {thread.centre + 0.5 * thread.width * std::cos(angle), along, axis + thread.height * std::sin(angle)};
}

struct Wave {
  glm::dvec2 frequency;
  double phase, amplitude;
};

// Waves of all directions with as much slope on each, cut at `most` waves a period.
std::vector<Wave> random_waves(int most, double slope, std::mt19937_64& random) {
  std::vector<Wave> waves;
  for (int y = -most; y <= most; ++y) {
    for (int x = 0; x <= most; ++x) {
      const double length = std::hypot(x, y);
      if (length > most || (x == 0 && y <= 0)) continue;
      waves.push_back({glm::dvec2(x, y) * 2.0 * pi, 2.0 * pi * uniform(random), 1.0 / (2.0 * pi * length)});
    }
  }
  // A wave of amplitude a and frequency k has the mean square slope (a k)^2 / 2, here 1/2 before scaling.
  const double scale = slope / std::sqrt(0.5 * static_cast<double>(waves.size()));
  for (Wave& wave : waves) wave.amplitude *= scale;
  return waves;
}

}  // namespace

Patch weave_patch(const Options& parameters, std::uint64_t /*seed*/) {
  const auto color = [&](const std::string& thread) {
    return glm::vec3(parameters.number(thread + "_red"), parameters.number(thread + "_green"),
                     parameters.number(thread + "_blue"));
  };
  const int along = static_cast<int>(parameters.number("steps_along"));
  const int across = static_cast<int>(parameters.number("steps_across"));
  Patch patch;
  patch.name = "weave";
  patch.palette = {color("warp"), color("weft")};
  for (int i = 0; i < threads; ++i) {
    Thread thread{.centre = (i + 0.5) * thread_distance,
                  .width = parameters.number("warp_width") * thread_distance,
                  .height = parameters.number("height"),
                  .phase = i % 2 == 0 ? 1.0 : -1.0};
    add_grid(patch, across, along, 0, [&](int u, int v) {
      return glm::vec3(thread_point(thread, static_cast<double>(u) / across, static_cast<double>(v) / along));
    });
    thread.width = parameters.number("weft_width") * thread_distance;
    thread.phase = -thread.phase;
    add_grid(patch, along, across, 1, [&](int u, int v) {  // x and y change places, and so the direction across
      const glm::dvec3 p = thread_point(thread, static_cast<double>(v) / across, static_cast<double>(u) / along);
      return glm::vec3(glm::dvec3(p.y, p.x, p.z));
    });
  }
  return patch;
}

Patch noise_patch(const Options& parameters, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::vector<Wave> waves =
      random_waves(static_cast<int>(parameters.number("waves")), parameters.number("slope"), random);
  const int steps = static_cast<int>(parameters.number("steps"));
  return height_field_patch("noise", steps, steps, [&](double x, double y) {
    double sum = 0.0;
    for (const Wave& w : waves) sum += w.amplitude * std::cos(w.frequency.x * x + w.frequency.y * y + w.phase);
    return sum;
  });
}

Patch spheres_patch(const Options& parameters, std::uint64_t /*seed*/) {
  const double radius = parameters.number("radius");
  const double lift = parameters.number("height") * radius;
  const int around = static_cast<int>(parameters.number("steps"));
  const int down = std::max(around / 2, 2);
  Patch patch = height_field_patch("spheres", 1, 1, [](double, double) { return 0.0; });
  add_grid(patch, around, down, 0, [&](int u, int v) {
    const double turn = 2.0 * pi * (u % around) / around;
    const double polar = pi * (1.0 - static_cast<double>(v) / down);  // from the lower pole up
    const double sine = v == 0 || v == down ? 0.0 : radius * std::sin(polar);
    return glm::vec3(
        glm::dvec3(0.5 + sine * std::cos(turn), 0.5 + sine * std::sin(turn), lift + radius * std::cos(polar)));
  });
  return patch;
}

}  // namespace footprint
