// For tests: vectors that are equal but for rounding.
#pragma once

#include <gtest/gtest.h>

#include <glm/glm.hpp>

namespace footprint::test {

/// Component by component.
inline void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-5F) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

}  // namespace footprint::test
