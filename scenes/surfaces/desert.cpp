// desert: dunes with steep lee sides, under wind ripples of several widths down to grains, on sand of uneven colour.
#include <array>
#include <cmath>
#include <numbers>

#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::desert {
namespace {

constexpr double tau = 2.0 * std::numbers::pi;

/// A train of ripples across the map: `waves` whole waves along x and `lean` along y, so that the map tiles.
struct Ripples {
  double waves, lean;
  double slope;                    ///< of its steeper side, where it is strongest
  double bend;                     ///< how far noise moves its crests, in waves
  int bend_cells, strength_cells;  ///< of the noise that bends it, and of that which strengthens and fades it
};

/// The ripples of the map, wide to narrow.
constexpr std::array<Ripples, 3> trains{
    {{13.0, 2.0, 0.38, 1.1, 5, 4}, {31.0, -3.0, 0.2, 1.3, 7, 6}, {59.0, 5.0, 0.16, 1.5, 11, 9}}};

/// Octaves of grains: cells along the map's width and slope.
struct Grains {
  int cells;
  double slope;
};
constexpr std::array<Grains, 3> grains{{{64, 0.05}, {160, 0.07}, {400, 0.09}}};

/// Noise by its cells along the map's width.
class MapNoise {
 public:
  MapNoise(int cells, std::mt19937_64& random) : cells_(cells), noise_(cells, random) {}

  [[nodiscard]] Height at(const HeightPoint& at) const { return noise_.at(cells_ * at.x, cells_ * at.y); }

 private:
  double cells_;
  PeriodicNoise noise_;
};

/// All that varies over the map.
class Sand {
 public:
  explicit Sand(const SurfaceSettings& settings) : steepness_(settings.parameters.number("steepness")) {
    std::mt19937_64 random(settings.seed);
    for (const Ripples& train : trains) {
      bends_.emplace_back(train.bend_cells, random);
      strengths_.emplace_back(train.strength_cells, random);
    }
    for (const Grains& octave : grains) grains_.emplace_back(octave.cells, random);
  }

  [[nodiscard]] glm::dvec3 normal(const glm::dvec2& uv) const {
    return normal_of_slope(steepness_ * slope_of(height(HeightPoint{uv})));
  }

  /// Heavy dark grains stay in the ripples' troughs.
  [[nodiscard]] glm::dvec3 color(const glm::dvec2& uv) const {
    constexpr glm::dvec3 light{0.62, 0.40, 0.21}, dark{0.50, 0.30, 0.145};
    const HeightPoint at{uv};
    const double darkness = 0.5 - 0.3 * ripples(at, 0).value() + 0.4 * grains_.front().at(at).value();
    return glm::mix(light, dark, glm::clamp(darkness, 0.0, 1.0));
  }

 private:
  /// The height at a point, in map widths.
  [[nodiscard]] Height height(const HeightPoint& at) const {
    Height sum{0.0};
    for (std::size_t i = 0; i < trains.size(); ++i) sum += trains[i].slope / (tau * trains[i].waves) * ripples(at, i);
    for (std::size_t i = 0; i < grains.size(); ++i) sum += grains[i].slope / grains[i].cells * grains_[i].at(at);
    return sum;
  }

  /// A train's height, -1 to 1: waves that lean with the wind, which comes from -x, each train strong in places only.
  [[nodiscard]] Height ripples(const HeightPoint& at, std::size_t train) const {
    const Ripples& kind = trains[train];
    const Height strength = smooth_step(strengths_[train].at(at), -0.45, 0.25);
    const Height phase = tau * (kind.waves * at.x + kind.lean * at.y + kind.bend * bends_[train].at(at));
    return sin(phase + 0.45 * sin(phase)) * strength;
  }

  double steepness_;
  std::vector<MapNoise> bends_, strengths_, grains_;
};

/// The dunes' height over a point, both in sides of the terrain.
class Dunes {
 public:
  explicit Dunes(std::uint32_t seed) : random_(seed) {}

  [[nodiscard]] Height at(const HeightPoint& at) const {
    const Height wander = 0.55 * warp_.at(4.0 * at.x, 4.0 * at.y) + 0.16 * warp_.at(10.0 * at.x, 10.0 * at.y);
    const Height size = 0.35 + 0.65 * smooth_step(size_.at(3.8 * at.x, 3.8 * at.y), -0.4, 0.35);
    const Height rolling = 0.018 * size_.at(2.6 * at.x, 2.6 * at.y);
    return rolling + 0.028 * size * crest(6.2 * at.x + 1.8 * at.y + wander) +
           0.006 * crest(16.6 * at.x - 3.4 * at.y + 1.6 * wander);
  }

 private:
  /// One dune a period: a long windward side from a flat foot up to the crest, then the short, steep lee side. The
  /// crest is where the lower of the two takes over, rounded so that the mesh can follow it.
  [[nodiscard]] static Height crest(const Height& phase) {
    constexpr double top = 0.72, sharpness = 8.0;
    const Height t = phase - std::floor(phase.value());
    const Height up = t / top, down = higher(-1.5, (t - 1.0) / (1.0 - top));
    const Height windward = up * up * (1.8 - 0.8 * up), lee = down * down * (1.6 + 0.6 * down);
    return log(exp(-sharpness * windward) + exp(-sharpness * lee)) / -sharpness;
  }

  std::mt19937_64 random_;
  PeriodicNoise warp_{10, random_}, size_{4, random_};
};

Mesh mesh(const SurfaceSettings& settings) {
  constexpr int cells = 240;
  constexpr double side = 120.0;  // metres
  const Dunes dunes(settings.seed);
  Mesh mesh = grid_mesh(cells, cells, [&](const glm::dvec2& st) {
    const Height height = dunes.at(HeightPoint{st});
    const glm::dvec2 slope = slope_of(height);
    Vertex vertex;
    vertex.position = side * glm::dvec3{st - 0.5, height.value()};
    vertex.normal = normal_of_slope(slope);
    vertex.tangent = {glm::vec3{glm::normalize(glm::dvec3{1.0, 0.0, slope.x})}, 1.0F};
    vertex.uv0 = vertex.uv1 = glm::vec2{st.x, 1.0 - st.y};
    return vertex;
  });
  mesh.name = "dunes";
  return mesh;
}

}  // namespace

Surface surface() {
  return {.name = "desert",
          .summary = "dunes under wind ripples of several widths, down to grains",
          .parameters = {number_option("steepness", 1.0, 0, 10, "factor on the slopes of ripples and grains")},
          .default_resolution = 1024,
          .normals = map_of<4, &Sand::normal>,
          .base_color = map_of<4, &Sand::color>,
          .mesh = mesh};
}

}  // namespace footprint::surfaces::desert
