// What a patch shows from above, and when its colours count.
#include "renderer/microgeometry/microgeometry.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>

namespace footprint {
namespace {

// A square of the plane, lower left and upper right corner, at a height.
void add_square(Patch& patch, const glm::vec2& low, const glm::vec2& high, float z, std::uint8_t paint) {
  const auto first = static_cast<unsigned>(patch.vertices.size());
  for (const auto& [x, y] :
       {std::pair(low.x, low.y), std::pair(high.x, low.y), std::pair(high.x, high.y), std::pair(low.x, high.y)}) {
    patch.vertices.emplace_back(x, y, z);
  }
  patch.triangles.emplace_back(first, first + 1, first + 2);
  patch.triangles.emplace_back(first, first + 2, first + 3);
  patch.paints.insert(patch.paints.end(), 2, paint);
}

// Red all over, with a green quarter above the lower left one; whichever is listed first.
TEST(PatchMaps, ShowTheHighestTriangle) {
  for (const bool top_first : {true, false}) {
    Patch patch;
    patch.palette = {{1, 0, 0}, {0, 1, 0}};
    if (top_first) add_square(patch, {0, 0}, {0.5F, 0.5F}, 0.2F, 1);
    add_square(patch, {0, 0}, {1, 1}, 0.0F, 0);
    if (!top_first) add_square(patch, {0, 0}, {0.5F, 0.5F}, 0.2F, 1);
    EXPECT_EQ(patch_maps(patch, 8).mean_color, glm::vec3(0.75F, 0.25F, 0.0F)) << top_first;
  }
}

// Row 0 is the top, where y is largest; a triangle over the border fills the other side.
TEST(PatchMaps, HolesHaveNoWeight) {
  Patch patch;
  add_square(patch, {0.5F, -0.25F}, {1.5F, 0.25F}, 0.0F, 0);
  const PatchMaps maps = patch_maps(patch, 4);
  for (int x = 0; x < 4; ++x) {
    for (const int y : {0, 3}) EXPECT_EQ(maps.normals.at(x, y)[3], 1.0F) << x << ", " << y;
    for (const int y : {1, 2}) EXPECT_EQ(maps.normals.at(x, y)[3], 0.0F) << x << ", " << y;
  }
  Patch lower_left;
  add_square(lower_left, {0, 0}, {0.5F, 0.5F}, 0.0F, 0);
  const PatchMaps quarter = patch_maps(lower_left, 2);
  EXPECT_EQ(quarter.normals.at(0, 1)[3], 1.0F);
  EXPECT_EQ(quarter.normals.at(0, 0)[3], 0.0F);
}

// One paint is in the base colour, unless the facets' table knows nothing of it.
TEST(Microgeometry, NeedsColorsThatAreInNoBaseColor) {
  Microgeometry geometry;
  geometry.patch.palette = {{0.5F, 1, 1}};
  add_square(geometry.patch, {0, 0}, {1, 1}, 0.0F, 0);
  EXPECT_FALSE(needs_colors(geometry));
  geometry.brdf = std::make_shared<const TabulatedBrdf>();
  EXPECT_TRUE(needs_colors(geometry));
  geometry.patch.palette = {glm::vec3(1.0F)};
  EXPECT_FALSE(needs_colors(geometry));
}

}  // namespace
}  // namespace footprint
