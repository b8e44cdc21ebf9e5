// Procedural surfaces through the program: written to files, named in scenes, refused where they make no sense.
#include "tests/command_line/program_case.hpp"
#include "tests/support/source_folder.hpp"

namespace footprint::test {
namespace {

const std::vector<Case> good_surfaces{
    {.name = "HelpOfSurface",
     .arguments = {"surface", "--help"},
     .output_has = {"Examples:", "footprint surface", "--resolution", "--seed", "--parameter", ".exr"}},
    {.name = "ListSurfaces",
     .arguments = {"list", "surfaces"},
     .output_has = {"bumps", "v_grooves", "scales", "scratches", "carved_disk", "golden_armor", "desert",
                    "tilt_degrees=30"}},
    {.name = "ListSurfacesAsJson",
     .arguments = {"list", "surfaces", "--json"},
     .output_has = {"\"surfaces\"", "\"parameters\"", "\"resolution\": 512"}},
    {.name = "ListScenesOfSurfaces",
     .arguments = {"list", "scenes"},
     .output_has = {"bumps", "v_grooves", "scales", "scratches", "carved_disk", "golden_armor", "desert"}},
    {.name = "SurfaceAsExr",
     .arguments = {"surface", "v_grooves", "--resolution", "17", "-o", "{}/a.exr"},
     .output_has = {"a.exr"},
     .leaves = {"a.exr"}},
    {.name = "SurfaceInUpperCase",
     .arguments = {"surface", "v_grooves", "--resolution", "17", "-o", "{}/a.EXR"},
     .output_has = {"a.EXR"},
     .leaves = {"a.EXR"}},
    {.name = "SurfaceAsPng",
     .arguments = {"surface", "scales", "--resolution", "1", "--seed", "0", "--parameter", "count=2", "-o", "{}/a.png"},
     .output_has = {"a.png"},
     .leaves = {"a.png"}},
    {.name = "StatisticsOfAMap",
     .arguments = {"statistics", (footprint::testing::source_folder() / "scenes/ribbed_plane/ribs_normal.png").string(),
                   "--json"},
     .output_has = {"footprint-statistics/1", "\"unit_share\": 1.0", "\"level\": 3", "\"gloss_correlation\": null"}},
    {.name = "StatisticsAsText",
     .arguments = {"statistics",
                   (footprint::testing::source_folder() / "scenes/ribbed_plane/ribs_normal.png").string()},
     .output_has = {"100.0% of them unit vectors", "anisotropy"}},
    {.name = "StatisticsOfHeights",
     .arguments = {"statistics",
                   (footprint::testing::source_folder() / "scenes/ribbed_heights/ribs_height.png").string(),
                   "--height-scale", "0.0358098621956765", "--slope-filter", "scharr"},
     .output_has = {"128x128 texels, 100.0% of them unit vectors"}},
    {.name = "StatisticsWithoutAMap",
     .arguments = {"statistics", "{}/none.png"},
     .exit_code = 2,
     .errors_have = {"none.png"}},
    {.name = "ExplainSurface",
     .arguments = {"explain", "v_grooves", "--size", "16x16"},
     .output_has = {"normal_variation         on"}},
};

std::vector<Case> wrong_surfaces() {
  const auto row = [](const std::string& name, std::vector<std::string> arguments, std::vector<std::string> errors) {
    arguments.insert(arguments.begin(), "surface");
    arguments.insert(arguments.end(), {"-o", "{}/a.exr"});
    return Case{.name = name, .arguments = std::move(arguments), .exit_code = 2, .errors_have = std::move(errors)};
  };
  return {
      row("WrongSurface", {"v_groves"}, {"`v_groves`", "did you mean `v_grooves`?"}),
      row("NoSurface", {}, {"name", "footprint surface --help"}),
      row("NoTexels", {"bumps", "--resolution", "0"}, {"--resolution", "1 to 16384"}),
      row("MillionTexels", {"bumps", "--resolution", "1000000"}, {"--resolution", "1 to 16384"}),
      row("TexelsThatAreNoNumber", {"bumps", "--resolution", "nan"}, {"--resolution", "nan"}),
      row("NegativeSeedOfSurface", {"bumps", "--seed", "-1"}, {"--seed", "-1"}),
      row("WrongParameter", {"bumps", "--parameter", "cuont=3"}, {"bumps", "`cuont`", "did you mean `count`?"}),
      row("ParameterOutOfRange", {"bumps", "--parameter", "count=0"}, {"count", "1 to 1024"}),
      row("ParameterThatIsNone", {"bumps", "--parameter", "steepness=nan"}, {"steepness", "`nan`"}),
      row("ParameterWithoutValue", {"bumps", "--parameter", "count"}, {"`count`", "NAME=VALUE"}),
      row("ParameterTwice", {"bumps", "--parameter", "count=2", "--parameter", "count=3"}, {"`count`", "twice"}),
      {.name = "SurfaceOfAnotherFormat",
       .arguments = {"surface", "bumps", "-o", "{}/a.jpg"},
       .exit_code = 2,
       .errors_have = {"a.jpg", ".exr", ".png"}},
      {.name = "SurfaceWithoutOutput", .arguments = {"surface", "bumps"}, .exit_code = 2, .errors_have = {"--output"}},
      {.name = "SurfaceInAFolderThatIsMissing",
       .arguments = {"surface", "bumps", "--resolution", "4", "-o", "{}/nowhere/a.exr"},
       .exit_code = 3,
       .errors_have = {"nowhere"}},
  };
}

std::vector<Case> rendered_surfaces() {
  std::vector<Case> rows;
  for (const std::string name :
       {"bumps", "v_grooves", "scales", "scratches", "carved_disk", "golden_armor", "desert"}) {
    rows.push_back({.name = "Renders_" + name,
                    .arguments = {"render", name, "--method", "direct", "--size", "24x24", "-o", "{}/a.exr"},
                    .output_has = {"a.exr"},
                    .leaves = {"a.exr"}});
  }
  return rows;
}

std::vector<Case> surfaces_in_scenes() {
  const auto row = [](const std::string& name, std::vector<std::string> errors, const std::string& text) {
    return Case{.name = name,
                .arguments = {"render", "{}/scene.toml", "--method", "direct", "-o", "{}/a.exr"},
                .exit_code = 2,
                .errors_have = std::move(errors),
                .files = {{"scene.toml", text}}};
  };
  const std::string bumps = "[surface]\nname = \"bumps\"\n";
  return {
      row("SceneOfWrongSurface", {"scene.toml:2: ", "`bmps`", "did you mean `bumps`?"}, "[surface]\nname = \"bmps\"\n"),
      row("SceneOfNoSurface", {"scene.toml:1: ", "`name` in [surface] is missing"}, "[surface]\nseed = 3\n"),
      row("WrongKeyOfSurface", {"scene.toml:3: ", "`resolutoin`", "did you mean `resolution`?"},
          bumps + "resolutoin = 64\n"),
      row("WrongParameterInScene", {"scene.toml:3: ", "`hight`", "known: count, steepness"},
          bumps + "parameters = { hight = 1 }\n"),
      row("ParameterOutOfRangeInScene", {"scene.toml:3: ", "`count`", "1 to 1024"},
          bumps + "parameters = { count = 1e9 }\n"),
      row("ParameterWithAFraction", {"scene.toml:3: ", "`count`", "whole number"},
          bumps + "parameters = { count = 2.5 }\n"),
      row("NoTexelsInScene", {"scene.toml:3: ", "`resolution`", "1 to 16384"}, bumps + "resolution = 0\n"),
      row("MillionTexelsInScene", {"scene.toml:3: ", "`resolution`", "1 to 16384"}, bumps + "resolution = 1e6\n"),
      row("TexelsThatAreNoNumberInScene", {"scene.toml:3: ", "`resolution`", "nan"}, bumps + "resolution = nan\n"),
      row("FractionsOfTexels", {"scene.toml:3: ", "`resolution`", "whole number"}, bumps + "resolution = 64.5\n"),
      row("TexelsInWords", {"scene.toml:3: ", "`resolution`", "must be a number"}, bumps + "resolution = \"big\"\n"),
      row("NegativeSeedInScene", {"scene.toml:3: ", "`seed`"}, bumps + "seed = -1\n"),
      row("SurfaceAndPlane", {"scene.toml:3: ", "`plane` excludes"}, bumps + "[plane]\n"),
  };
}

INSTANTIATE_TEST_SUITE_P(GoodSurface, CommandLine, ::testing::ValuesIn(good_surfaces), case_name);
INSTANTIATE_TEST_SUITE_P(WrongSurface, CommandLine, ::testing::ValuesIn(wrong_surfaces()), case_name);
INSTANTIATE_TEST_SUITE_P(RenderedSurface, CommandLine, ::testing::ValuesIn(rendered_surfaces()), case_name);
INSTANTIATE_TEST_SUITE_P(SurfaceInScene, CommandLine, ::testing::ValuesIn(surfaces_in_scenes()), case_name);

}  // namespace
}  // namespace footprint::test
