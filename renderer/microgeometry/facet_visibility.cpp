// Draws stratified samples of the area, and tests visibility on the torus onto which the tiled patch projects.
#include "renderer/microgeometry/facet_visibility.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "renderer/core/numbers.hpp"

namespace footprint {
namespace {

// Uniform over a triangle: the fold of the unit square (Turk 1990, "Generating Random Points in Triangles").
glm::vec3 point_in(const Patch& patch, const glm::uvec3& triangle, double u, double v) {
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const glm::dvec3 a(patch.vertices[triangle.x]);
  const glm::dvec3 b(patch.vertices[triangle.y]);
  const glm::dvec3 c(patch.vertices[triangle.z]);
  return glm::vec3(a + u * (b - a) + v * (c - a));
}

// How far behind the plane of a triangle a sample must be to be occluded, relative to the size of the patch. Larger
// than the rounding error of 32-bit positions, so that a facet does not occlude itself or its neighbour at a common
// edge.
constexpr double behind_tolerance = 4e-6;

// Samples per cell of the grid over the torus: enough for long loops, few enough for few tests.
constexpr double samples_per_cell = 12.0;

// The region that a triangle covers in projection, and the half-space behind it: four linear forms of (x, y, z, 1).
struct Blocker {
  std::array<glm::vec3, 3> edges;  // a x + b y + c >= 0 inside
  glm::vec4 plane;                 // a x + b y + c z + d < 0 behind
};

// Samples of one direction in the order of the torus' cells.
struct Scratch {
  std::vector<std::uint32_t> starts, order, cells;
  std::vector<float> x, y, z;                   // in that order
  std::vector<float> projected_x, projected_y;  // in the samples' own
  std::vector<std::uint8_t> blocked;
  std::vector<std::uint8_t> faces;  // of each triangle
};

// The innermost loop, without branches so that compilers vectorise it.
void block(const Blocker& b, const Scratch& s, std::size_t begin, std::size_t end, std::uint8_t* blocked) {
  const float* const x = s.x.data();
  const float* const y = s.y.data();
  const float* const z = s.z.data();
  for (std::size_t i = begin; i < end; ++i) {
    const float e0 = b.edges[0].x * x[i] + b.edges[0].y * y[i] + b.edges[0].z;
    const float e1 = b.edges[1].x * x[i] + b.edges[1].y * y[i] + b.edges[1].z;
    const float e2 = b.edges[2].x * x[i] + b.edges[2].y * y[i] + b.edges[2].z;
    const float front = b.plane.x * x[i] + b.plane.y * y[i] + b.plane.z * z[i] + b.plane.w;
    const float inside = std::min(std::min(e0, e1), std::min(e2, -front));
    blocked[i] = static_cast<std::uint8_t>(blocked[i] | static_cast<std::uint8_t>(inside >= 0.0F));
  }
}

// The margin around a triangle, in cells; rounding moves a sample by much less.
constexpr double hair = 1e-5;

// Triangles that span more cells than this along both axes are rasterised row by row. Near the horizon they are
// slivers, and most cells of their bounding box are empty.
constexpr int least_slant = 3;

// The cells of a row that a triangle reaches, within the range `within` (first and last). Its corners are in units of
// cells.
glm::ivec2 reached_cells(const std::array<glm::dvec2, 3>& corners, int row, const glm::ivec2& within) {
  const std::array<double, 2> borders{row - hair, row + 1.0 + hair};
  double left = within.y + 1.0, right = within.x - 1.0;
  const auto take = [&](double x) {
    left = std::min(left, x);
    right = std::max(right, x);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 a = corners.at(i), b = corners.at((i + 1) % 3);
    if (a.y >= borders[0] && a.y <= borders[1]) take(a.x);
    for (const double y : borders) {
      if ((a.y < y) != (b.y < y)) take(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  }
  return {std::max(within.x, static_cast<int>(std::floor(std::max(left, within.x - 1.0) - hair))),
          std::min(within.y, static_cast<int>(std::floor(std::min(right, within.y + 1.0) + hair)))};
}

class Projector {
 public:
  Projector(const Patch& patch, const FacetSamples& samples) : patch_(patch), samples_(samples) {
    planes_.reserve(patch.triangles.size());
    float size = std::max(patch.period.x, patch.period.y);
    for (std::size_t i = 0; i < patch.triangles.size(); ++i) planes_.push_back(facet_plane(patch, i));
    for (const glm::vec3& p : samples.positions) size = std::max(size, std::abs(p.z));
    tolerance_ = behind_tolerance * size;
    const double side = std::sqrt(static_cast<double>(samples.size()) / samples_per_cell);
    side_ = std::clamp(static_cast<int>(side), 1, 512);
  }

  void project(const glm::dvec3& direction, Scratch& scratch, std::span<std::uint64_t> visible) const {
    const glm::dvec2 shear = glm::dvec2(direction) / direction.z;
    sort_samples(shear, scratch);
    scratch.faces.resize(planes_.size());
    for (std::size_t t = 0; t < planes_.size(); ++t) {
      const double facing = glm::dot(planes_[t].normal, direction);
      scratch.faces[t] = static_cast<std::uint8_t>(facing > 0.0);
      if (facing > 0.0) cover(t, shear, facing / direction.z, scratch);
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const std::uint32_t sample = scratch.order[i];
      const bool sees = scratch.faces[samples_.triangles[sample]] != 0 && scratch.blocked[i] == 0;
      visible[sample / 64] |= std::uint64_t{sees} << (sample % 64);
    }
  }

 private:
  // Counting sort of the projected samples by cell.
  void sort_samples(const glm::dvec2& shear, Scratch& s) const {
    const std::size_t count = samples_.size();
    const auto cells = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
    s.starts.assign(cells + 1, 0);
    s.cells.resize(count);
    for (auto* values : {&s.x, &s.y, &s.z, &s.projected_x, &s.projected_y}) values->resize(count);
    s.order.resize(count);
    s.blocked.assign(count, 0);
    project_samples(glm::vec2(shear), s);
    for (const std::uint32_t cell : s.cells) ++s.starts[cell + 1];
    for (std::size_t c = 0; c < cells; ++c) s.starts[c + 1] += s.starts[c];
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t slot = s.starts[s.cells[i]]++;
      s.x[slot] = s.projected_x[i];
      s.y[slot] = s.projected_y[i];
      s.z[slot] = samples_.positions[i].z;
      s.order[slot] = static_cast<std::uint32_t>(i);
    }
    for (std::size_t c = cells; c > 0; --c) s.starts[c] = s.starts[c - 1];  // the scatter moved each start to the next
    s.starts[0] = 0;
  }

  // Projects the samples into one period and finds their cells, without branches or calls.
  void project_samples(const glm::vec2& shear, Scratch& s) const {
    // Truncation equals floor for positive values. Samples are below 0 by less than this many periods: 16 up, and 24
    // along for each, in the lowest direction of a grid of 48 x 48.
    constexpr float above_zero = 512.0F;
    const glm::vec2 per_period = 1.0F / patch_.period;
    const auto last_cell = side_ - 1;
    const auto cells = static_cast<float>(side_);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const glm::vec3& p = samples_.positions[i];
      const float x = (p.x - shear.x * p.z) * per_period.x;
      const float y = (p.y - shear.y * p.z) * per_period.y;
      const float part_x = x - (static_cast<float>(static_cast<int>(x + above_zero)) - above_zero);
      const float part_y = y - (static_cast<float>(static_cast<int>(y + above_zero)) - above_zero);
      s.projected_x[i] = part_x * patch_.period.x;
      s.projected_y[i] = part_y * patch_.period.y;
      const int cell_x = std::min(static_cast<int>(std::max(part_x, 0.0F) * cells), last_cell);
      const int cell_y = std::min(static_cast<int>(std::max(part_y, 0.0F) * cells), last_cell);
      s.cells[i] = static_cast<std::uint32_t>(cell_y * side_ + cell_x);
    }
  }

  // Clears the samples that a triangle occludes, in every copy of the period that its projection reaches.
  void cover(std::size_t triangle, const glm::dvec2& shear, double slope, Scratch& s) const {
    std::array<glm::dvec2, 3> corners{};
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 v(patch_.vertices[patch_.triangles[triangle][i]]);
      corners.at(static_cast<std::size_t>(i)) = glm::dvec2(v) - shear * v.z;
    }
    const glm::dvec2 cell = glm::dvec2(patch_.period) / static_cast<double>(side_);
    std::array<glm::dvec2, 3> in_cells{};
    std::ranges::transform(corners, in_cells.begin(), [&](const glm::dvec2& corner) { return corner / cell; });
    const glm::ivec2 first(glm::floor(glm::min(glm::min(in_cells[0], in_cells[1]), in_cells[2]) - hair));
    const glm::ivec2 last(glm::floor(glm::max(glm::max(in_cells[0], in_cells[1]), in_cells[2]) + hair));
    const bool slanted = last.x - first.x >= least_slant && last.y - first.y >= least_slant;
    for (int copy_y = floor_div(first.y); copy_y <= floor_div(last.y); ++copy_y) {
      for (int copy_x = floor_div(first.x); copy_x <= floor_div(last.x); ++copy_x) {
        const glm::ivec2 origin = side_ * glm::ivec2(copy_x, copy_y);
        const glm::ivec2 low = glm::max(first - origin, glm::ivec2(0));
        const glm::ivec2 high = glm::min(last - origin, glm::ivec2(side_ - 1));
        const glm::dvec2 shift = glm::dvec2(copy_x, copy_y) * glm::dvec2(patch_.period);
        const Blocker blocker = blocker_of(corners, triangle, shear, slope, shift);
        for (int row = low.y; row <= high.y; ++row) {
          glm::ivec2 reach(low.x, high.x);
          if (slanted) reach = reached_cells(in_cells, origin.y + row, origin.x + reach) - origin.x;
          if (reach.x > reach.y) continue;
          const auto row_start = s.starts.begin() + std::ptrdiff_t{row} * side_;
          block(blocker, s, row_start[reach.x], row_start[reach.y + 1], s.blocked.data());
        }
      }
    }
  }

  [[nodiscard]] int floor_div(int cell) const { return cell >= 0 ? cell / side_ : -((side_ - 1 - cell) / side_); }

  // The linear forms of a triangle in the coordinates of the copy shifted by -shift.
  [[nodiscard]] Blocker blocker_of(const std::array<glm::dvec2, 3>& corners, std::size_t triangle,
                                   const glm::dvec2& shear, double slope, const glm::dvec2& shift) const {
    Blocker out{};
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 a = corners.at(i) - shift;
      const glm::dvec2 along = corners.at((i + 1) % 3) - corners.at(i);
      out.edges.at(i) = glm::vec3(glm::dvec3(-along.y, along.x, along.y * a.x - along.x * a.y));
    }
    // n.(x + shear z, y, z) = n_xy.(x, y) + (n.direction / direction.z) z.
    const glm::dvec3& n = planes_[triangle].normal;
    const glm::dvec3 v(patch_.vertices[patch_.triangles[triangle].x]);
    const glm::dvec2 p = glm::dvec2(v) - shear * v.z - shift;
    const double offset = n.x * p.x + n.y * p.y + slope * v.z;
    out.plane = glm::vec4(glm::dvec4(n.x, n.y, slope, tolerance_ - offset));
    return out;
  }

  const Patch& patch_;
  const FacetSamples& samples_;
  std::vector<FacetPlane> planes_;
  double tolerance_ = 0.0;
  int side_ = 1;
};

}  // namespace

FacetSamples sample_facets(const Patch& patch, std::size_t count, std::uint64_t seed) {
  std::vector<double> areas(patch.triangles.size());
  double total = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i) total += areas[i] = facet_plane(patch, i).area;

  FacetSamples samples;
  samples.positions.reserve(count);
  samples.triangles.reserve(count);
  samples.facet_area = total / static_cast<double>(count);
  std::mt19937_64 random(seed);
  std::size_t triangle = 0;
  double before = 0.0;  // area of the triangles before this one
  for (std::size_t i = 0; i < count; ++i) {
    const double position = (static_cast<double>(i) + uniform(random)) * samples.facet_area;
    while (triangle + 1 < areas.size() && (position >= before + areas[triangle] || areas[triangle] == 0.0)) {
      before += areas[triangle++];
    }
    while (areas[triangle] == 0.0) --triangle;  // rounding can leave the last position behind the last area
    const double u = uniform(random);
    samples.positions.push_back(point_in(patch, patch.triangles[triangle], u, uniform(random)));
    samples.triangles.push_back(static_cast<std::uint32_t>(triangle));
  }
  return samples;
}

FacetVisibility facet_visibility(const Patch& patch, const FacetSamples& samples,
                                 std::span<const glm::dvec3> directions, const Progress& progress) {
  FacetVisibility out(directions.size(), samples.size());
  const Projector projector(patch, samples);
  tbb::enumerable_thread_specific<Scratch> scratch;
  // Reports progress between batches, only from the calling thread because it may throw.
  constexpr std::size_t batch = 36;
  for (std::size_t begin = 0; begin < directions.size(); begin += batch) {
    progress("visibility", static_cast<double>(begin) / static_cast<double>(directions.size()));
    const std::size_t end = std::min(begin + batch, directions.size());
    tbb::parallel_for(begin, end, [&](std::size_t i) { projector.project(directions[i], scratch.local(), out.of(i)); });
  }
  return out;
}

}  // namespace footprint
