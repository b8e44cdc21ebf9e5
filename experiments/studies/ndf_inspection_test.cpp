// The progress of `footprint ndf`: it only increases, reaches the end, and every method contributes.
#include "experiments/studies/ndf_inspection.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiments/settings/setting.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

using Reports = std::vector<std::pair<std::string, double>>;

// The first report that goes back behind an earlier one, or beyond the whole.
std::optional<std::string> backward_step(const Reports& reports) {
  double done = 0.0;
  for (const auto& [what, fraction] : reports) {
    if (fraction < done || fraction > 1.0 + 1e-9) return what;
    done = fraction;
  }
  return {};
}

Reports reports_of(const Material& material, const FootprintRect& footprint, std::vector<MethodSpec> methods) {
  NdfSource source{"noise", true, material, {}};
  NdfSettings settings;
  settings.footprint = footprint;
  settings.run.methods = std::move(methods);
  settings.resolution = 64;
  settings.picture = 16;
  const auto folder = test::fresh_folder();
  std::filesystem::create_directories(folder / "images");
  Reports reports;
  const auto record = [&](std::string_view what, double fraction) { reports.emplace_back(what, fraction); };
  (void)inspect_ndf(source, settings, folder, record);
  return reports;
}

Material rough_material(int side) {
  const BaseBrdf brdf{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, false};
  Material material = square_scene(random_normals(side, side, 0.4F, 5), {.brdf = brdf}).materials[0];
  material.lobe_parameter = 64.0F;
  return material;
}

TEST(NdfProgress, NeverGoesBackByEveryMethodAndEachByItself) {
  const Material material = rough_material(32);
  const Reports all = reports_of(material, {}, {});
  EXPECT_EQ(backward_step(all), std::nullopt);
  std::set<std::string> stages;
  for (const auto& [what, fraction] : all) stages.insert(what);
  EXPECT_GE(stages.size(), every_method().size());  // each says at least its name
  EXPECT_GT(all.back().second, 0.9);
  for (const MethodSpec& method : every_method()) {
    const Reports one = reports_of(material, {}, {method});
    EXPECT_EQ(backward_step(one), std::nullopt) << method.text;
  }
}

// A corner, of which some methods bake a part alone: their share of the whole is another.
TEST(NdfProgress, NeverGoesBackOverACorner) {
  EXPECT_EQ(backward_step(reports_of(rough_material(64), {{0.0, 0.0}, {0.1, 0.1}}, {})), std::nullopt);
}

TEST(NdfProgress, AStepBackIsFound) {
  EXPECT_EQ(backward_step({{"a", 0.0}, {"b", 0.5}, {"c", 0.4}}), "c");
  EXPECT_EQ(backward_step({{"a", 0.5}, {"b", 1.5}}), "b");
  EXPECT_EQ(backward_step({{"a", 0.5}, {"b", 0.5}, {"c", 1.0}}), std::nullopt);
}

}  // namespace
}  // namespace footprint::testing
