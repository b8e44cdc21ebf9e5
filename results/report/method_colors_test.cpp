// The places of colours: the same in every report, distinct within one.
#include "results/report/method_colors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace footprint {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> light_colors(const std::vector<std::string>& methods) {
  std::vector<std::string> colors;
  for (const std::size_t place : color_places(methods)) colors.push_back(report_palette().light.at(place));
  return colors;
}

TEST(MethodColors, AreTheSameBesideOtherMethods) {
  EXPECT_THAT(light_colors({"direct", "toksvig"}), ElementsAre("#444444", "#0072b2"));
  EXPECT_THAT(light_colors({"lean", "toksvig", "direct"}), ElementsAre("#d55e00", "#0072b2", "#444444"));
}

// `naive_mip` has the place of `xu_vmf`, which is absent; the variant's own place is taken.
TEST(MethodColors, OfVariantsAreTheNextFreeOnes) {
  EXPECT_THAT(light_colors({"direct", "naive_mip", "toksvig", "toksvig:storage=unorm8"}),
              ElementsAre("#444444", "#b5488a", "#0072b2", "#d55e00"));
}

TEST(MethodColors, AreDistinctUntilAllAreTaken) {
  const std::vector<std::string>& methods = report_palette().methods;
  const std::size_t count = report_palette().light.size();
  ASSERT_GT(methods.size(), count);
  ASSERT_EQ(report_palette().dark.size(), count);
  const std::vector<std::size_t> places = color_places(methods);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(places[i], i % count) << methods[i];
}

TEST(MethodColors, OfUnknownMethodsFollowThoseOfThePalette) {
  const std::size_t next = report_palette().methods.size() % report_palette().light.size();
  EXPECT_THAT(color_places({"mine", "mine:k=2", "yours"}), ElementsAre(next, next + 1, next + 2));
}

}  // namespace
}  // namespace footprint
