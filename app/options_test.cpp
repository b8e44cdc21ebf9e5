// Option values: what is taken and what is refused, with words that help.
#include "app/options.hpp"

#include <gtest/gtest.h>

#include <array>

#include "renderer/core/error.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using test::says;

// The text of the usage error that `parse` throws; fails the test if it throws none or another.
template <typename Parse>
std::string refusal(Parse parse) {
  try {
    parse();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    EXPECT_FALSE(error.mend().empty()) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "was taken";
  return {};
}

TEST(ParseSize, TakesWidthThenHeight) {
  EXPECT_EQ(parse_size("640x480"), glm::ivec2(640, 480));
  EXPECT_EQ(parse_size("1x1"), glm::ivec2(1, 1));
  EXPECT_EQ(parse_size("1000000x1000000"), glm::ivec2(1000000, 1000000));
}

TEST(ParseSize, RefusesWhatIsNoSize) {
  for (const std::string_view text :
       {"", "x", "512", "512x", "x512", "512 x 512", "-5x5", "+5x5", "1.5x2", "3x4x5", "5X5", "axb", "5x5 "}) {
    EXPECT_TRUE(says(refusal([&] { (void)parse_size(text); }), "is no frame size")) << text;
  }
  EXPECT_TRUE(says(refusal([] { (void)parse_size("0x0"); }), "has no pixels"));
  EXPECT_TRUE(says(refusal([] { (void)parse_size("512x0"); }), "has no pixels"));
  EXPECT_TRUE(says(refusal([] { (void)parse_size("10000001x1"); }), "more than 10000000 pixels"));
  EXPECT_TRUE(says(refusal([] { (void)parse_size("1x99999999999999999999999"); }), "more than 10000000 pixels"));
}

TEST(ParseDistances, KeepsTheOrder) {
  EXPECT_EQ(parse_distances("4,1,0.5,1e2"), (std::vector<double>{4.0, 1.0, 0.5, 100.0}));
}

TEST(ParseDistances, RefusesWhatIsNoDistance) {
  for (const std::string_view text : {"", ",", "1,", ",1", "0", "-1", "1,nan", "inf", "1e400", "one", "1;2", "1, 2"}) {
    EXPECT_TRUE(says(refusal([&] { (void)parse_distances(text); }), "is no positive number")) << text;
  }
  for (const std::string_view text : {"1e-4", "1,1000001", "1e300"}) {
    EXPECT_TRUE(says(refusal([&] { (void)parse_distances(text); }), "is not within 0.001 to 1000000")) << text;
  }
  EXPECT_TRUE(says(refusal([] { (void)parse_distances("1,2,1.0"); }), "given twice"));
}

TEST(ParseExposure, TakesAutoOrAFactor) {
  EXPECT_EQ(parse_exposure("auto"), std::nullopt);
  EXPECT_EQ(parse_exposure("2.5"), 2.5F);
}

TEST(ParseExposure, RefusesWhatIsNoExposure) {
  for (const std::string_view text : {"", "0", "-1", "nan", "inf", "1e60", "1e-60", "Auto", "1x"}) {
    EXPECT_TRUE(says(refusal([&] { (void)parse_exposure(text); }), "is no exposure")) << text;
  }
}

TEST(ParseChoice, NamesTheNearestChoice) {
  const std::array<std::string, 3> choices{"after_shading", "nearest", "bilinear"};
  EXPECT_EQ(parse_choice("--filter", "bilinear", choices), 2U);
  const std::string text = refusal([&] { (void)parse_choice("--filter", "bilinaer", choices); });
  EXPECT_TRUE(says(text, "--filter")) << text;
  EXPECT_TRUE(says(text, "did you mean `bilinear`")) << text;
}

}  // namespace
}  // namespace footprint
