// Recommendations through the program: what is refused before anything is measured.
#include "tests/command_line/program_case.hpp"

namespace footprint::test {
namespace {

const std::vector<Case> help_of_recommend{
    {.name = "HelpOfRecommend",
     .arguments = {"recommend", "--help"},
     .output_has = {"Examples:", "footprint recommend", "--max-error", "--max-cost", "--max-bytes", "--footprints",
                    "--methods", "--exhaustive", "recommend.json"}},
};

std::vector<Case> wrong_recommendations() {
  const auto row = [](const std::string& name, std::vector<std::string> arguments, std::vector<std::string> errors) {
    arguments.insert(arguments.begin(), "recommend");
    arguments.insert(arguments.end(), {"--size", "16x16", "-o", "{}/out"});
    return Case{.name = name, .arguments = std::move(arguments), .exit_code = 2, .errors_have = std::move(errors)};
  };
  return {
      row("RecommendNothing", {}, {"scene"}),
      row("RecommendForAMissingScene", {"{}/missing.gltf"}, {"missing.gltf"}),
      row("RecommendWithinTwoLimits", {"v_grooves", "--max-error", "0.1", "--max-cost", "2"}, {"--max-"}),
      row("RecommendWithinTwoOtherLimits", {"v_grooves", "--max-bytes", "10", "--max-cost", "2"}, {"--max-"}),
      row("RecommendWithinNoError", {"v_grooves", "--max-error", "0"}, {"--max-error", "above 0"}),
      row("RecommendWithinANegativeCost", {"v_grooves", "--max-cost", "-1"}, {"--max-cost", "above 0"}),
      row("RecommendWithinNoNumber", {"v_grooves", "--max-cost", "nan"}, {"--max-cost", "above 0"}),
      row("RecommendWithinWords", {"v_grooves", "--max-error", "little"}, {"--max-error"}),
      row("RecommendWithinNegativeBytes", {"v_grooves", "--max-bytes", "-5"}, {"--max-bytes", "0 to 1e+18"}),
      row("RecommendUnderAWrongFilter", {"v_grooves", "--footprints", "trilinear,anistropic:8"},
          {"--footprints", "did you mean `anisotropic`?"}),
      row("RecommendUnderAFilterWithoutItsNumber", {"v_grooves", "--footprints", "shaded"}, {"--footprints", "shaded"}),
      row("RecommendQuicklyIntoAFolder", {"v_grooves", "--quick"}, {"--quick excludes --output"}),
      row("RecommendQuicklyAndInFull", {"v_grooves", "--quick", "--exhaustive"}, {"--exhaustive"}),
      row("RecommendAWrongMethod", {"v_grooves", "--methods", "direct,toxvig"}, {"did you mean `toksvig`?"}),
  };
}

const std::vector<Case> recommendations{
    {.name = "RecommendQuickly",
     .arguments = {"recommend", "v_grooves", "--quick", "--methods", "direct,tan_gmm,yan_gaussians"},
     .output_has = {"v_grooves, the smallest error: predicted", "left out yan_gaussians: ", "Use ",
                    "estimated on Steam Deck", "pairs are in the right order"}},
    {.name = "RecommendQuicklyWithinFrameTimes",
     .arguments = {"recommend", "v_grooves", "--quick", "--max-cost", "2"},
     .exit_code = 2,
     .errors_have = {"--quick", "R@GPU"}},
    {.name = "RecommendQuicklyAsJson",
     .arguments = {"recommend", "v_grooves", "--quick", "--json", "--max-cost", "2@PS4"},
     .output_has = {"\"footprint-quick/1\"", "\"gpu\": \"PS4\""}},
    {.name = "Recommend",
     .arguments = {"recommend", "v_grooves", "--methods", "direct,toksvig", "--footprints", "trilinear", "--size",
                   "48x48", "--distance", "4", "--spp", "16", "--repeats", "1", "-o", "{}/out"},
     .output_has = {"First answer (coarse, 100% of the pixels):", "v_grooves, the smallest error", "Use ",
                    "at distance 4", "work/out/index.html"},
     .leaves = {"out/index.html", "out/recommend.json", "out/trilinear/index.html", "out/trilinear/results.json",
                "out/kept"}},
    {.name = "RecommendLeavesOutAnExpensiveFilter",
     .arguments = {"recommend", "v_grooves", "--methods", "direct,toksvig", "--footprints", "trilinear,shaded:8",
                   "--max-cost", "2", "--size", "96x96", "--distance", "1", "--spp", "16", "--repeats", "3", "-o",
                   "{}/out"},
     .output_has = {"left out every method under shaded:8: `direct` alone costs "},
     .leaves = {"out/index.html", "out/recommend.json", "out/trilinear/results.json"}},
    {.name = "RecommendInterrupted",
     .arguments = {"recommend", "v_grooves", "--methods", "direct,toksvig", "--footprints", "trilinear", "--size",
                   "256x256", "--spp", "4096", "-o", "{}/out"},
     .exit_code = 130,
     .errors_have = {"interrupted"},
     .interrupt_at = "4096 samples",  // after the coarse pass, whose work is stored
     .keeps_work = true},
    {.name = "RecommendOnAFullDisk",
     .arguments = {"recommend", "v_grooves", "--methods", "direct,toksvig", "--footprints", "trilinear", "--size",
                   "48x48", "--distance", "4", "--spp", "16", "--repeats", "1", "-o", "{}/out"},
     .exit_code = 1,
     .errors_have = {"work/out"},
     .file_size_limit = 20000,
     .leaves = {"out/recommend.json"},
     .keeps_results = true},
};

INSTANTIATE_TEST_SUITE_P(HelpOfRecommend, CommandLine, ::testing::ValuesIn(help_of_recommend), case_name);
INSTANTIATE_TEST_SUITE_P(WrongRecommendation, CommandLine, ::testing::ValuesIn(wrong_recommendations()), case_name);
INSTANTIATE_TEST_SUITE_P(Recommendation, CommandLine, ::testing::ValuesIn(recommendations), case_name);

}  // namespace
}  // namespace footprint::test
