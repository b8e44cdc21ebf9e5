// carved_disk: a shallow silver dish, carved in rings from its middle out: a boss, a rosette of veined petals, turned
// grooves, a plait with beads on punched ground, a string of beads, gadroons, and a twisted rope for a rim.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "renderer/core/numbers.hpp"
#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::carved_disk {
namespace {

constexpr double tau = 2.0 * std::numbers::pi;

/// A point of the disk: distance from the middle in radii of the disk, angle in radians.
struct Polar {
  Height radius, angle;
};

/// One of `count` equal sectors of the ring: which one, and the angle from its middle line.
struct Sector {
  std::size_t index;
  Height angle;
  double half_width;  ///< radians
};

Sector sector_of(const Height& angle, int count, double shift = 0.0) {
  const double width = tau / count;
  const double nearest = std::round(angle.value() / width - shift);
  const int index = wrap(static_cast<int>(nearest), count);
  return {static_cast<std::size_t>(index), angle - (nearest + shift) * width, 0.5 * width};
}

/// Round beads in a ring: caps of slope up to about 1.
Height beads(const Polar& at, double ring, double bead, int count, double shift = 0.0) {
  const Sector sector = sector_of(at.angle, count, shift);
  const Height across = (at.radius - ring) / bead, along = sector.angle * ring / bead;
  const Height inside = 1.0 - across * across - along * along;
  if (inside.value() <= 0.0) return Height{0.0};
  return 0.6 * bead * inside * sqrt(inside + 0.05);
}

/// Random differences between petals, tongues and strokes, as a carver's hand leaves them.
class Hand {
 public:
  Hand(std::uint32_t seed, double unevenness) : unevenness_(unevenness), random_(seed) {
    for (double& pressure : pressures_) pressure = 1.0 + unevenness * (2.0 * uniform(random_) - 1.0);
  }

  /// Within 1 - unevenness to 1 + unevenness.
  [[nodiscard]] double pressure(std::size_t stroke) const { return pressures_[stroke % pressures_.size()]; }

  /// The hammered ground under the carving: gentle, of several widths.
  [[nodiscard]] Height hammering(const HeightPoint& at) const {
    const Height coarse = coarse_.at(8.0 * at.x, 8.0 * at.y), fine = fine_.at(31.0 * at.x, 31.0 * at.y);
    return unevenness_ * (0.02 * coarse + 0.005 * fine);
  }

 private:
  double unevenness_;
  std::mt19937_64 random_;
  PeriodicNoise coarse_{64, random_}, fine_{64, random_};
  std::array<double, 64> pressures_{};
};

Height boss(const Polar& at) {
  const Height t = at.radius / 0.12;
  Height height = t.value() < 1.0 ? Height(0.05 * (1.0 - t * t)) : Height{0.0};
  // Twelve flutes that run out towards the top.
  height += 0.006 * smooth_band(at.radius, 0.02, 0.12, 0.05) * cos(12.0 * at.angle);
  return height + beads(at, 0.15, 0.017, 28);
}

/// Petals from 0.175 to `tip`, with a vein along the middle and strokes towards it.
Height petals(const Polar& at, const Hand& hand, double tip, double shift, double lift) {
  const Sector sector = sector_of(at.angle, 8, shift);
  const Height along = (at.radius - 0.17) / (tip - 0.17);
  if (along.value() <= 0.0 || along.value() >= 1.0) return Height{0.0};
  const Height width = sector.half_width * sin(std::numbers::pi * (0.12 + 0.88 * along));
  const Height across = sector.angle / width;
  const double side = std::abs(across.value());
  if (side >= 1.0) return Height{0.0};
  const Height from_middle = across.value() < 0.0 ? Height(-across) : across;
  const Height body = 0.045 * (1.0 - across * across) * smooth_band(along, 0.0, 1.0, 0.3);
  const Height vein = 0.012 * smooth_ridge(across / 0.09) * smooth_band(along, 0.05, 0.9, 0.2);
  const Height strokes = engraved_wave(16.0 * along - 3.5 * from_middle, 0.016, 0.45) *
                         smooth_band(from_middle, 0.12, 0.9, 0.2) * smooth_band(along, 0.1, 0.9, 0.1);
  return hand.pressure(sector.index + (shift > 0.0 ? 8 : 0)) * (lift + body - vein + strokes);
}

Height rosette(const Polar& at, const Hand& hand) {
  return higher(petals(at, hand, 0.40, 0.0, 0.01), petals(at, hand, 0.425, 0.5, 0.0));
}

Height turned_grooves(const Polar& at, double low, double high, int count) {
  const double period = (high - low) / count;
  return engraved_wave((at.radius - low) / period, period, 0.7) * smooth_band(at.radius, low, high, 0.3 * period);
}

/// One strand of the plait: a wave around the ring, high where it crosses over another and low where it passes under.
Height strand(const Polar& at, double side) {
  constexpr double ring = 0.615, swing = 0.06, half_width = 0.026;
  constexpr int waves = 16;
  const Height phase = waves * at.angle;
  const Height lean = (waves * swing / ring) * cos(phase);
  const Height across = (at.radius - ring - side * swing * sin(phase)) / (half_width * sqrt(1.0 + lean * lean));
  const Height furrows = 0.0022 * cos(3.0 * std::numbers::pi * across) * smooth_ridge(across);
  return (0.02 + side * 0.007 * cos(phase)) * smooth_ridge(across) + furrows;
}

Height plait(const Polar& at) {
  const Height window = smooth_band(at.radius, 0.505, 0.725, 0.01);
  // The ground: dimples of a round punch, in rows.
  const Height punched = 0.0009 * (1.0 + cos(260.0 * at.angle) * cos(tau / 0.0145 * at.radius));
  Height height = higher(punched * window, higher(strand(at, 1.0), strand(at, -1.0)));
  height = higher(height, beads(at, 0.615, 0.024, 32, 0.5));
  return higher(height, higher(beads(at, 0.525, 0.012, 32, 0.5), beads(at, 0.705, 0.012, 32, 0.5)));
}

Height bead_string(const Polar& at) {
  const Height rails = smooth_ridge((at.radius - 0.737) / 0.008) + smooth_ridge((at.radius - 0.793) / 0.008);
  return 0.006 * rails + beads(at, 0.765, 0.0185, 128);
}

/// Rounded tongues side by side, with a round end each and a line cut along every second one.
Height gadroons(const Polar& at, const Hand& hand) {
  const Sector sector = sector_of(at.angle, 48);
  const Height across = sector.angle / sector.half_width;
  const Height end = 0.918 - 0.02 * across * across;
  const Height along = (at.radius - 0.805) / (end - 0.805);
  if (along.value() <= 0.0 || along.value() >= 1.0) return Height{0.0};
  const Height swell = smooth_step(along, 0.0, 0.9) * (1.0 - smooth_step(along, 0.8, 1.0));
  const Height cut = sector.index % 2 == 0 ? Height(0.006 * smooth_ridge(across / 0.2)) : Height{0.0};
  return hand.pressure(sector.index) * (0.034 * (1.0 - across * across) - cut) * swell;
}

Height rope(const Polar& at) {
  const Height across = (at.radius - 0.96) / 0.034;
  if (std::abs(across.value()) >= 1.0) return Height{0.0};
  const Height twist = cos(96.0 * at.angle + 2.2 * across);
  return smooth_ridge(across) * (0.022 + 0.0055 * twist);
}

/// A point belongs to one of the rings, which are side by side, or to the plain strips between them.
Height ring_at(const Polar& at, const Hand& hand) {
  const double radius = at.radius.value();
  if (radius < 0.17) return boss(at);
  if (radius < 0.43) return rosette(at, hand);
  if (radius < 0.505) return turned_grooves(at, 0.432, 0.504, 6);
  if (radius < 0.727) return plait(at);
  if (radius < 0.803) return bead_string(at);
  if (radius < 0.92) return gadroons(at, hand);
  return rope(at);
}

Height carving(const HeightPoint& at, const Hand& hand) {
  const Height squared = at.x * at.x + at.y * at.y;
  // The middle has no direction outwards; beyond the rim is nothing.
  if (squared.value() < 1e-12 || squared.value() >= 1.0) return Height{0.0};
  return ring_at(Polar{sqrt(squared), atan2(at.y, at.x)}, hand) + hand.hammering(at);
}

/// Concentric V-shaped grooves over the whole disk, whose sides lean by the angle of tangent `tilt`.
glm::dvec2 engraving(const glm::dvec2& at, double tilt) {
  constexpr double grooves = 64.0;
  const double radius = glm::length(at), across = grooves * radius;
  if (radius <= 0.0 || radius >= 1.0) return glm::dvec2(0.0);
  return (across - std::floor(across) < 0.5 ? -tilt : tilt) / radius * at;
}

Image normals(const SurfaceSettings& settings) {
  const Hand hand(settings.seed, settings.parameters.number("unevenness"));
  const double depth = settings.parameters.number("depth");
  const double tilt = std::tan(glm::radians(settings.parameters.number("engraving_degrees")));
  return fill_normals(settings.resolution, [&](const glm::dvec2& uv) {
    const glm::dvec2 at = 2.0 * uv - 1.0;
    return normal_of_slope(depth * slope_of(carving(HeightPoint{at}, hand)) + engraving(at, tilt));
  });
}

/// The dish: a fan of rings of radius 1 m, lower in the middle by `dish`, which the map covers once.
Mesh mesh(const SurfaceSettings& settings) {
  constexpr int rings = 24, spokes = 192;
  const double dish = settings.parameters.number("dish");
  const auto vertex_at = [&](double radius, double angle) {
    const glm::dvec2 point = radius * glm::dvec2{std::cos(angle), std::sin(angle)};
    Vertex vertex;
    vertex.position = glm::dvec3{point, dish * radius * radius};
    vertex.normal = normal_of_slope(2.0 * dish * point);
    vertex.tangent = {glm::vec3{glm::normalize(glm::dvec3{1.0, 0.0, 2.0 * dish * point.x})}, 1.0F};
    vertex.uv0 = vertex.uv1 = glm::vec2{0.5 + 0.5 * point.x, 0.5 - 0.5 * point.y};
    return vertex;
  };
  // A grid bent into rings, whose innermost row is one point: the triangles there that have no area are left out.
  Mesh mesh = grid_mesh(spokes, rings, [&](const glm::dvec2& st) { return vertex_at(1.0 - st.y, tau * st.x); });
  std::vector<std::uint32_t> remaining;
  const auto innermost = static_cast<std::uint32_t>(rings * (spokes + 1));
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto triangle = std::span(mesh.indices).subspan(i, 3);
    if (std::ranges::count_if(triangle, [&](std::uint32_t index) { return index >= innermost; }) > 1) continue;
    remaining.insert(remaining.end(), triangle.begin(), triangle.end());
  }
  mesh.indices = std::move(remaining);
  mesh.name = "disk";
  return mesh;
}

}  // namespace

Surface surface() {
  return {.name = "carved_disk",
          .summary = "a dish carved in rings: petals, grooves, a plait, beads, gadroons and a rope",
          .parameters = {number_option("depth", 1.0, 0, 4, "factor on the carving's depth"),
                         number_option("unevenness", 0.12, 0, 0.9,
                                       "how much strokes and ground differ from even, as a share"),
                         number_option("engraving_degrees", 0.0, 0, 60,
                                       "tilt of the sides of V-shaped grooves, 64 from the middle to the rim, degrees"),
                         number_option("dish", 0.08, -0.5, 0.5, "height of the rim over the middle, in radii")},
          .default_resolution = 1024,
          .normals = normals,
          .mesh = mesh};
}

}  // namespace footprint::surfaces::carved_disk
