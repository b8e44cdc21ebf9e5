// Planes and colours of triangles, checks of a patch, and grids of quadrilaterals.
#include "renderer/microgeometry/patch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/numbers.hpp"

namespace footprint {
namespace {

struct Box {
  glm::vec3 lower, upper;
};

// The bounds of all referenced vertices; not finite if one of them is not.
Box box_of(const Patch& patch) {
  Box box{patch.vertices[patch.triangles.front().x], patch.vertices[patch.triangles.front().x]};
  for (const glm::uvec3& triangle : patch.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3& v = patch.vertices[triangle[corner]];
      if (!std::isfinite(v.x + v.y + v.z)) return {v, v};
      box.lower = glm::min(box.lower, v);
      box.upper = glm::max(box.upper, v);
    }
  }
  return box;
}

bool indices_hold(const Patch& patch) {
  const auto count = patch.vertices.size();
  return std::ranges::all_of(patch.triangles,
                             [count](const glm::uvec3& t) { return t.x < count && t.y < count && t.z < count; });
}

bool paints_hold(const Patch& patch) {
  if (patch.palette.empty() || (!patch.paints.empty() && patch.paints.size() != patch.triangles.size())) return false;
  return std::ranges::all_of(patch.paints, [&](std::uint8_t paint) { return paint < patch.palette.size(); });
}

bool has_area(const Patch& patch) {
  for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
    if (facet_plane(patch, i).area > 0.0) return true;
  }
  return false;
}

using std::numbers::pi;

// Adds a grid of quadrilaterals, two triangles each, counter-clockwise in (u, v). `point(u, v)` is called for u in
// 0..columns and v in 0..rows. Degenerate triangles are omitted.
void add_grid(Patch& patch, int columns, int rows, std::uint8_t paint,
              const std::function<glm::vec3(int, int)>& point) {
  const auto base = static_cast<std::uint32_t>(patch.vertices.size());
  const auto stride = static_cast<std::uint32_t>(columns) + 1;
  for (int v = 0; v <= rows; ++v) {
    for (int u = 0; u <= columns; ++u) patch.vertices.push_back(point(u, v));
  }
  const auto add = [&](const glm::uvec3& triangle) {
    patch.triangles.push_back(triangle);
    if (facet_plane(patch, patch.triangles.size() - 1).area > 0.0) {
      patch.paints.push_back(paint);
    } else {
      patch.triangles.pop_back();
    }
  };
  for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(rows); ++v) {
    for (std::uint32_t u = 0; u + 1 < stride; ++u) {
      const std::uint32_t corner = base + v * stride + u;
      add({corner, corner + 1, corner + stride + 1});
      add({corner, corner + stride + 1, corner + stride});
    }
  }
}

// Triangles of the height field z = height(x, y) over [0, 1) x [0, 1), which must have period 1. Each of the columns x
// rows squares is cut along the diagonal from its lower left corner.
Patch height_field_patch(std::string name, int columns, int rows, const std::function<double(double, double)>& height) {
  Patch patch;
  patch.name = std::move(name);
  add_grid(patch, columns, rows, 0, [&](int u, int v) {
    const double x = static_cast<double>(u) / columns;
    const double y = static_cast<double>(v) / rows;
    // The last column evaluates the first again, so that rounding cannot open the border.
    return glm::vec3(glm::dvec3(x, y, height(u == columns ? 0.0 : x, v == rows ? 0.0 : y)));
  });
  return patch;
}

constexpr int threads = 2;  // of each kind in a period: a plain weave repeats after two
constexpr double thread_distance = 1.0 / threads;

struct Thread {
  double centre;  // of its axis, across
  double width;   // full
  double height;  // of its wave, and half its thickness
  double phase;   // 1: on top at the first crossing, -1: below
};

// The upper half of an elliptic thread along a cosine: (across, along, z). The crossings are at the extrema of its
// axis, where threads touch.
glm::dvec3 thread_point(const Thread& thread, double across, double along) {
  const double angle = pi * (1.0 - across);  // 0..1 from one edge to the other
  const double axis = thread.phase * thread.height * std::cos(2.0 * pi * (along - 0.5 * thread_distance));
  return {thread.centre + 0.5 * thread.width * std::cos(angle), along, axis + thread.height * std::sin(angle)};
}

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
    add_grid(patch, along, across, 1, [&](int u, int v) {  // swaps x and y, which reverses the direction across
      const glm::dvec3 p = thread_point(thread, static_cast<double>(v) / across, static_cast<double>(u) / along);
      return glm::vec3(glm::dvec3(p.y, p.x, p.z));
    });
  }
  return patch;
}

struct Wave {
  glm::dvec2 frequency;
  double phase, amplitude;
};

// A sum of waves in all directions with equal slope, up to `most` waves per period.
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

double tangent_of(const Options& parameters, std::string_view name) {
  return std::tan(parameters.number(name) * pi / 180.0);
}

// Distance along one axis from the nearest border of the period.
double from_border(double x) { return std::min(x, 1.0 - x); }

Patch flat_patch(const Options& /*parameters*/, std::uint64_t /*seed*/) {
  return height_field_patch("flat", 1, 1, [](double, double) { return 0.0; });
}

// One groove per period along y: a flat part of width `land`, then a V or, with `rounded`, half a wave.
Patch grooves_patch(const Options& parameters, std::uint64_t /*seed*/) {
  const double land = parameters.number("land");
  const double flank = 0.5 * (1.0 - land);
  const double depth = flank * tangent_of(parameters, "flank_degrees");
  const bool rounded = parameters.word("profile") == "round";
  const int steps = rounded ? static_cast<int>(parameters.number("steps")) : 2;
  Patch patch;
  patch.name = "grooves";
  const auto across = [&](int u) {
    const double t = static_cast<double>(u) / steps;  // across the groove
    const double fall = rounded ? 0.5 - 0.5 * std::cos(2.0 * pi * t) : 1.0 - std::abs(2.0 * t - 1.0);
    return glm::dvec2(land + (1.0 - land) * t, -depth * fall);
  };
  add_grid(patch, steps, 1, 0, [&](int u, int v) { return glm::vec3(across(u).x, v, across(u).y); });
  if (land > 0.0) {
    add_grid(patch, 1, 1, 0, [&](int u, int v) { return glm::vec3(land * u, v, 0.0); });
  }
  return patch;
}

// One pyramid per period; `floor` is the flat share along each axis. A negative angle builds a pit.
Patch pyramids_patch(const Options& parameters, std::uint64_t /*seed*/) {
  const double margin = 0.5 * parameters.number("floor");
  const double rise = tangent_of(parameters, "slope_degrees");
  const std::array<double, 5> edges{0.0, margin, 0.5, 1.0 - margin, 1.0};
  Patch patch;
  patch.name = "pyramids";
  const auto corner = [&](int u, int v) {
    const double x = edges.at(static_cast<std::size_t>(u));
    const double y = edges.at(static_cast<std::size_t>(v));
    return glm::vec3(x, y, rise * std::max(std::min(from_border(x), from_border(y)) - margin, 0.0));
  };
  // The diagonals must point towards the tip: four quadrants, each cut along its own diagonal.
  add_grid(patch, 4, 4, 0, corner);
  for (std::size_t i = 0; i + 1 < patch.triangles.size(); i += 2) {
    const glm::uvec3 a = patch.triangles[i];      // corner, +u, +u+v
    const glm::uvec3 b = patch.triangles[i + 1];  // corner, +u+v, +v
    const glm::vec3 middle = 0.5F * (patch.vertices[a.x] + patch.vertices[a.z]);
    if ((middle.x < 0.5F) == (middle.y < 0.5F)) continue;
    patch.triangles[i] = {a.x, a.y, b.z};
    patch.triangles[i + 1] = {a.y, a.z, b.z};
  }
  return patch;
}

}  // namespace

FacetPlane facet_plane(const Patch& patch, std::size_t triangle) {
  const glm::uvec3& corners = patch.triangles[triangle];
  const glm::dvec3 a(patch.vertices[corners.x]);
  const glm::dvec3 product =
      glm::cross(glm::dvec3(patch.vertices[corners.y]) - a, glm::dvec3(patch.vertices[corners.z]) - a);
  const double length = glm::length(product);
  if (!(length > 1e-14)) return {};
  return {product / length, 0.5 * length};
}

glm::vec3 facet_color(const Patch& patch, std::size_t triangle) {
  return patch.palette[patch.paints.empty() ? 0 : patch.paints[triangle]];
}

bool has_colors(const Patch& patch) {
  return std::ranges::any_of(patch.palette, [&](const glm::vec3& c) { return c != patch.palette.front(); }) &&
         !patch.paints.empty();
}

void check_patch(const Patch& patch, const std::string& place) {
  const auto refuse = [&](const std::string& message, const std::string& hint) {
    return Error(ErrorKind::usage, place, fmt::format("patch {}: {}", patch.name, message), hint);
  };
  if (!(patch.period.x > 0.0F && patch.period.y > 0.0F && std::isfinite(patch.period.x + patch.period.y))) {
    throw refuse("its period is not above 0", "give two lengths above 0");
  }
  if (patch.triangles.empty()) throw refuse("it has no triangle", "give it at least one");
  if (patch.triangles.size() > most_patch_triangles) {
    throw refuse(fmt::format("it has {} triangles", patch.triangles.size()),
                 fmt::format("use at most {}", most_patch_triangles));
  }
  if (!indices_hold(patch)) throw refuse("a triangle names a vertex that is not there", "fix its indices");
  if (!paints_hold(patch)) throw refuse("a triangle names a colour that is not there", "fix its paints");
  const Box box = box_of(patch);
  const glm::vec3 size = box.upper - box.lower;
  if (!std::isfinite(size.x + size.y + size.z)) throw refuse("a position is not finite", "fix its vertices");
  const float period = std::min(patch.period.x, patch.period.y);
  if (std::max({size.x, size.y, size.z}) > most_patch_rise * period) {
    throw refuse(fmt::format("it measures {} x {} x {}, its period {} x {}", size.x, size.y, size.z, patch.period.x,
                             patch.period.y),
                 fmt::format("make it at most {} periods wide and tall", most_patch_rise));
  }
  if (!has_area(patch)) throw refuse("all its triangles are degenerate", "give it one with an area");
}

std::span<const PatchKind> patch_kinds() {
  static const std::vector<PatchKind> kinds{
      {"flat", "A plane: the effective BRDF is the facets' own.", {}, flat_patch},
      {"grooves",
       "Parallel grooves along y, with flat lands between them.",
       {number_option("land", 0.2, 0.0, 0.95, "Width of the flat between two grooves, in periods."),
        number_option("flank_degrees", 35.0, 0.0, 80.0, "Mean tilt of a groove's flanks, degrees."),
        word_option("profile", {"v", "round"}, "Straight flanks, or a cosine."),
        whole_option("steps", 24, 2, 1024, "profile=round: quadrilaterals across a groove.")},
       grooves_patch},
      {"pyramids",
       "Four-sided pyramids, or pits, on a floor.",
       {number_option("floor", 0.2, 0.0, 0.95, "Share of the floor along each axis."),
        number_option("slope_degrees", 30.0, -80.0, 80.0, "Tilt of the sides, degrees; below 0 a pit.")},
       pyramids_patch},
      {"spheres",
       "Balls half sunk into a floor, one a period.",
       {number_option("radius", 0.4, 0.01, 0.5, "Radius, in periods."),
        number_option("height", 0.0, -0.5, 2.0, "Height of the centre above the floor, in radii."),
        whole_option("steps", 24, 3, 512, "Quadrilaterals around a ball; half as many from pole to pole.")},
       spheres_patch},
      {"weave",
       "Plain weave of warp threads along y and weft threads along x, two of each a period, each of its own colour.",
       {number_option("warp_width", 0.8, 0.02, 1.0, "Width of a warp thread over their distance."),
        number_option("weft_width", 0.8, 0.02, 1.0, "Width of a weft thread over their distance."),
        number_option("height", 0.06, 0.001, 0.5,
                      "How far a thread rises and falls, and half its thickness, in periods."),
        number_option("warp_red", 1.0, 0.0, 1.0, "The warp's colour, linear."),
        number_option("warp_green", 1.0, 0.0, 1.0, "The warp's colour, linear."),
        number_option("warp_blue", 1.0, 0.0, 1.0, "The warp's colour, linear."),
        number_option("weft_red", 1.0, 0.0, 1.0, "The weft's colour, linear."),
        number_option("weft_green", 1.0, 0.0, 1.0, "The weft's colour, linear."),
        number_option("weft_blue", 1.0, 0.0, 1.0, "The weft's colour, linear."),
        whole_option("steps_along", 16, 4, 512, "Quadrilaterals along a thread in a period."),
        whole_option("steps_across", 8, 2, 256, "Quadrilaterals across a thread.")},
       weave_patch},
      {"noise",
       "A rough height field: a sum of waves of random directions and phases.",
       {number_option("slope", 0.4, 0.0, 4.0, "Root mean square slope."),
        whole_option("waves", 6, 1, 64, "Highest number of waves a period along an axis."),
        whole_option("steps", 48, 4, 1024, "Squares a side.")},
       noise_patch},
  };
  return kinds;
}

const PatchKind& find_patch_kind(const std::string& name) {
  std::vector<std::string> names;
  for (const PatchKind& kind : patch_kinds()) names.push_back(kind.name);
  return patch_kinds()[find_word(names, name, "kind", "microgeometry")];
}

Patch make_patch(const PatchKind& kind, const std::map<std::string, std::string>& given, std::uint64_t seed) {
  return kind.build(Options(kind.parameters, given, "microgeometry " + kind.name), seed);
}

}  // namespace footprint
