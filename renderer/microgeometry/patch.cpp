// Planes and colours of triangles, checks of a patch, and grids of quadrilaterals.
#include "renderer/microgeometry/patch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/core/error.hpp"

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

}  // namespace footprint
