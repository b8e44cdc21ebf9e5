// Files of the MERL format, written from a known BRDF: what comes back, and what is refused.
#include "renderer/scene/assembly/microgeometry_content.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>

#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

using std::numbers::pi;

// The format as the database's own reader has it: sizes, then planes of doubles in its units.
std::string merl_text(const TabulatedBrdf& brdf, std::array<std::int32_t, 3> sizes = {90, 90, 180}) {
  std::string text(reinterpret_cast<const char*>(sizes.data()), sizeof(sizes));
  const std::array<double, 3> scale{1500.0, 1500.0 / 1.15, 1500.0 / 1.66};
  for (int c = 0; c < 3; ++c) {
    for (const glm::vec3& value : brdf.values) {
      const double stored = value[c] * scale.at(static_cast<std::size_t>(c));
      text.append(reinterpret_cast<const char*>(&stored), sizeof(stored));
    }
  }
  return text;
}

glm::dvec3 direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

TEST(MerlFile, GivesTheBrdfBackThatItWasMadeOf) {
  const glm::vec3 diffuse(0.2F, 0.1F, 0.3F), specular(0.5F, 0.4F, 0.1F);
  constexpr double alpha = 0.3;
  const auto file = test::write_file("merl/ward.binary", merl_text(ward_brdf(diffuse, specular, alpha)));
  const TabulatedBrdf read = read_merl(file);
  const glm::dvec3 n(0, 0, 1);
  for (const double theta : {0.1, 0.4, 0.8, 1.1}) {
    for (const double turn : {0.0, 0.7, 2.0, 3.1}) {
      const glm::dvec3 wi = direction(theta, 0.3), wo = direction(0.6, 0.3 + turn);
      const glm::dvec3 h = glm::normalize(wi + wo);
      const double tan2 = (1.0 - h.z * h.z) / (h.z * h.z);
      const double lobe = std::exp(-tan2 / (alpha * alpha)) / (4.0 * pi * alpha * alpha * std::sqrt(wi.z * wo.z));
      const glm::dvec3 expected = glm::dvec3(diffuse) / pi + glm::dvec3(specular) * lobe;
      const glm::vec3 found = read.at(n, wi, wo);
      // The cells are 2 degrees and wider away from the specular direction.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.12 * expected[c]) << theta << " " << turn;
    }
  }
}

TEST(MerlFile, IsReadInItsUnits) {
  TabulatedBrdf brdf = tabulate([](const glm::dvec3&) { return glm::vec3(1.0F, 2.0F, 3.0F); });
  brdf.values[5] = glm::vec3(-1.0F);  // not measured
  const TabulatedBrdf read = read_merl(test::write_file("merl/constant.binary", merl_text(brdf)));
  EXPECT_LT(glm::length(read.values[4] - glm::vec3(1.0F, 2.0F, 3.0F)), 1e-6F);
  EXPECT_EQ(read.values[5], glm::vec3(0.0F));
}

TEST(MerlFile, RefusesHostileFiles) {
  const TabulatedBrdf brdf = tabulate([](const glm::dvec3&) { return glm::vec3(1.0F); });
  const std::string good = merl_text(brdf);
  const auto refused = [](const std::string& text) {
    return test::usage_error([&] { return read_merl(test::write_file("merl/bad.binary", text)); });
  };
  EXPECT_NE(refused("abc").find("not even"), std::string::npos);
  EXPECT_NE(refused(merl_text(brdf, {90, 90, 181})).find("90 x 90 x 181"), std::string::npos);
  EXPECT_NE(refused(merl_text(brdf, {-1, 1 << 30, 1 << 30})).find("not 90 x 90 x 180"), std::string::npos);
  EXPECT_NE(refused(good.substr(0, good.size() - 8)).find("bytes"), std::string::npos);
  EXPECT_NE(refused(good + "12345678").find("bytes"), std::string::npos);
  std::string nan = good;
  const double value = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(nan.data() + 12 + 80, &value, sizeof(value));
  EXPECT_NE(refused(nan).find("value 10 is not finite"), std::string::npos);
  EXPECT_NE(test::usage_error([] { return read_merl("/nowhere.binary"); }).find("/nowhere.binary"), std::string::npos);
}

}  // namespace
}  // namespace footprint
