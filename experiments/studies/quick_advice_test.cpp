// The model's sum, the choice that follows, and what the model of this build has.
#include "experiments/studies/quick_advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/image.hpp"

namespace footprint {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Scene scene_with_a_map() {
  Image normals(16, 16, 4, 1.0F);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      normals.at(x, y)[0] = x % 2 == 0 ? 0.3F : -0.3F;
      normals.at(x, y)[1] = 0.0F;
    }
  }
  Material grooved, plain;
  grooved.name = "grooved";
  grooved.roughness = 0.5F;
  grooved.normal_map = TextureMap{.name = "grooves", .image = std::make_shared<Image>(normals), .coordinates = {}};
  plain.name = "plain";
  Scene scene;
  scene.name = "two";
  scene.materials = {grooved, plain};
  return scene;
}

// Two levels: weights of each level, of alpha and of the four simple lobes.
QuickMethod quick_method(const std::string& name, double error, double cost) {
  return {.method = name,
          .bytes_per_texel = 8,
          .filters = {{.footprint = "trilinear",
                       .weights = {std::log(error), std::log(2.0 * error), 0, 0, 0, 0, 0},
                       .costs = {{"PS4", cost}}}}};
}

QuickModel small_model() {
  return {
      .texels_per_pixel = {2, 4},
      .scenes = 3,
      .calibration = {{.footprint = "trilinear", .scenes = 2, .interval_80 = {0.5, 2.0}, .order_factor = 1.1}},
      .methods = {quick_method("direct", 0.1, 1), quick_method("lean", 0.05, 2), quick_method("tan_gmm:n=4", 0.02, 4)}};
}

QuickQuestion among(const std::string& methods) {
  QuickQuestion question{.methods = parse_methods(methods), .filters = {"trilinear"}, .limits = {}};
  question.limits.gpu = "PS4";
  return question;
}

TEST(QuickAdvice, PredictsTheExponentialOfASum) {
  const std::vector<double> weights{0.5, -1.0, 2.0, 3.0};  // two levels, two inputs
  EXPECT_DOUBLE_EQ(quick_prediction(weights, 0, {0.1, 0.2}), std::exp(0.5 + 0.2 + 0.6));
  EXPECT_DOUBLE_EQ(quick_prediction(weights, 1, {0.1, 0.2}), std::exp(-1.0 + 0.2 + 0.6));
}

TEST(QuickAdvice, ChoosesTheSmallestErrorForMaterialsWithAMap) {
  const QuickAdvice advice = quick_advice(scene_with_a_map(), small_model(), among("direct,lean,tan_gmm"));
  ASSERT_EQ(advice.materials.size(), 1U);
  const MaterialAdvice& own = advice.materials.front();
  EXPECT_EQ(own.material, "grooved");
  const Candidate& chosen = own.candidates.at(own.choice.chosen.value());
  EXPECT_EQ(chosen.method, "tan_gmm:n=4") << "the default of tan_gmm";
  EXPECT_NEAR(chosen.errors.at(0), 0.02, 1e-12);
  EXPECT_NEAR(chosen.worst, 0.04, 1e-12);
  EXPECT_EQ(chosen.bytes, 16U * 16U * 8U);
}

TEST(QuickAdvice, KeepsToTheLimits) {
  QuickQuestion limited = among("direct,lean,tan_gmm");
  limited.limits.max_cost = 3;
  const QuickAdvice advice = quick_advice(scene_with_a_map(), small_model(), limited);
  const MaterialAdvice& own = advice.materials.front();
  EXPECT_EQ(own.candidates.at(own.choice.chosen.value()).method, "lean");
}

TEST(QuickAdvice, PredictionsWithinTheOrderFactorAreTied) {
  QuickModel model = small_model();
  model.methods.push_back(quick_method("leadr", 0.0495, 1.5));    // 1% better than lean, and cheaper
  model.methods.push_back(quick_method("cells:k=4", 0.0199, 9));  // no better than tan_gmm, beyond 10%
  const QuickAdvice advice = quick_advice(scene_with_a_map(), model, among("direct,leadr,lean,tan_gmm,cells"));
  const MaterialAdvice& own = advice.materials.front();
  EXPECT_EQ(own.candidates.at(own.choice.chosen.value()).method, "tan_gmm:n=4");
}

TEST(QuickAdvice, SaysWhereAMapIsOutsideTheDomain) {
  QuickModel model = small_model();
  const std::array<double, 2> wide{-20, 20};
  model.domain = {2, {{std::log(0.1), std::log(0.3)}, wide, wide, wide, wide}};  // of alpha, which is 0.25
  const auto words = [&] {
    return fmt::format(
        "{}", fmt::join(quick_advice(scene_with_a_map(), model, among("direct,lean")).materials[0].words, " "));
  };
  EXPECT_EQ(words().find("outside"), std::string::npos);
  model.domain[1][0][1] = std::log(0.2);
  EXPECT_THAT(words(), HasSubstr("mean alpha 0.25 at 4 texels per pixel, where the model knows 0.1 to 0.2."));
}

TEST(QuickAdvice, SaysWhereNoFilterMayBeAsAccurate) {
  QuickModel model = small_model();  // lean errs half as much as direct
  const auto words = [&] {
    return fmt::format(
        "{}", fmt::join(quick_advice(scene_with_a_map(), model, among("direct,lean")).materials[0].words, " "));
  };
  EXPECT_EQ(words().find("No filter"), std::string::npos);
  model.calibration.front().order_factor = 1.5;
  EXPECT_THAT(words(), HasSubstr("No filter (`direct`) may be as accurate"));
}

TEST(QuickAdvice, NamesWhatTheModelLacks) {
  const QuickAdvice advice = quick_advice(scene_with_a_map(), small_model(), among("direct,lean,tan_gmm:n=3"));
  ASSERT_EQ(advice.left_out.size(), 1U);
  EXPECT_EQ(advice.left_out.front().method, "tan_gmm:n=3");
  EXPECT_THAT(quick_advice_text(advice), HasSubstr("left out tan_gmm:n=3: "));
}

TEST(QuickAdvice, RefusesWhatItCannotAnswer) {
  QuickQuestion elsewhere = among("direct");
  elsewhere.limits.gpu = "Elsewhere";
  EXPECT_THROW((void)quick_advice(scene_with_a_map(), small_model(), elsewhere), Error);
  EXPECT_THROW((void)quick_advice(scene_with_a_map(), small_model(), among("tan_gmm:n=3")), Error);
  Scene plain = scene_with_a_map();
  plain.materials.erase(plain.materials.begin());
  EXPECT_THROW((void)quick_advice(plain, small_model(), among("direct")), Error);
  EXPECT_THROW((void)read_quick_model("/nowhere/quick_model.json"), Error);
}

TEST(QuickAdvice, RefusesADamagedModel) {
  const auto whole = std::filesystem::path(FOOTPRINT_SOURCE_FOLDER) / "results/quick_model.json";
  const auto file = std::filesystem::temp_directory_path() / fmt::format("quick_model_{}.json", getpid());
  const auto is_refused = [&](const nlohmann::json& damaged) {
    std::ofstream(file) << damaged.dump();
    try {
      (void)read_quick_model(file);
    } catch (const Error& error) {
      return std::string(error.what()).find(file.string()) != std::string::npos;
    }
    return false;
  };
  const auto model = nlohmann::json::parse(std::ifstream(whole));
  EXPECT_FALSE(is_refused(model));
  auto damaged = model;
  damaged["methods"][3]["filters"][0]["weights"].erase(0);
  EXPECT_TRUE(is_refused(damaged));
  damaged = model;
  damaged["calibration"].erase(0);
  EXPECT_TRUE(is_refused(damaged));
  damaged = model;
  damaged["domain"][2].erase(0);
  EXPECT_TRUE(is_refused(damaged));
  damaged = model;
  damaged["methods"] = nlohmann::json::array();
  EXPECT_TRUE(is_refused(damaged));
  damaged["schema"] = "another/1";
  EXPECT_TRUE(is_refused(damaged));
  EXPECT_TRUE(is_refused("text"));
  std::filesystem::remove(file);
}

TEST(QuickAdvice, TrustsTheWorseOfTwoCalibrations) {
  auto model =
      nlohmann::json::parse(std::ifstream(std::filesystem::path(FOOTPRINT_SOURCE_FOLDER) / "results/quick_model.json"));
  auto& own = model["calibration"][0];
  own.update(
      {{"scenes", 3}, {"interval_80", {0.5, 2.0}}, {"order_factor", 1.2}, {"order_right", 0.9}, {"choice_right", 0.6}});
  auto other = own;
  other.update(
      {{"scenes", 4}, {"interval_80", {0.6, 3.0}}, {"order_factor", 1.4}, {"order_right", 0.8}, {"choice_right", 0.7}});
  model["surfaces"] = {other};
  const auto file = std::filesystem::temp_directory_path() / fmt::format("quick_trust_{}.json", getpid());
  std::ofstream(file) << model.dump();
  const QuickCalibration joined = read_quick_model(file).calibration.front();
  std::filesystem::remove(file);
  EXPECT_EQ(joined.scenes, 7);
  EXPECT_THAT(joined.interval_80, ElementsAre(0.5, 3.0));
  EXPECT_THAT((std::array{joined.order_factor, joined.order_right, joined.choice_right}), ElementsAre(1.4, 0.8, 0.6));
}

TEST(QuickAdvice, WritesJson) {
  const auto json =
      nlohmann::json::parse(quick_advice_json(quick_advice(scene_with_a_map(), small_model(), among("direct,lean"))));
  EXPECT_EQ(json["schema"], "footprint-quick/1");
  EXPECT_EQ(json["materials"][0]["candidates"][json["materials"][0]["chosen"].get<std::size_t>()]["method"], "lean");
  EXPECT_THAT(json["calibration"][0]["interval_80"], ElementsAre(0.5, 2.0));
}

TEST(QuickAdvice, TheModelOfThisBuildKnowsItsMethods) {
  const QuickModel model =
      read_quick_model(std::filesystem::path(FOOTPRINT_SOURCE_FOLDER) / "results/quick_model.json");
  EXPECT_THAT(model.texels_per_pixel, ElementsAre(2, 4, 8, 16));
  EXPECT_GT(model.methods.size(), 30U);
  for (const QuickMethod& method : model.methods) {
    EXPECT_NO_THROW((void)find_method(parse_methods(method.method).front().name));
    for (const QuickFilter& filter : method.filters) EXPECT_EQ(filter.weights.size(), 4U + 1U + 4U) << method.method;
  }
  for (const QuickCalibration& own : model.calibration) EXPECT_GT(own.order_right, 0.5) << own.footprint;
}

}  // namespace
}  // namespace footprint
