// Pictures of any origin against a reference, through the program.
#include <string>

#include "tests/command_line/bumpy_quad.hpp"
#include "tests/command_line/program_case.hpp"
#include "tests/support/png_file.hpp"

namespace footprint::test {
namespace {

// Radiance HDR of 2 x `height` grey pixels of `mantissa` / 128: short rows are stored as they are.
std::string grey_hdr(int height, char mantissa) {
  std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X 2\n";
  for (int i = 0; i < 2 * height; ++i) text += std::string{mantissa, mantissa, mantissa, '\x81'};
  return text;
}

// Two pixels, 0.5 above 0.25, stored downwards and upwards; the exposure of the second is 2.
std::string turned_hdr() { return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n@@@\x81   \x81"; }
std::string turned_back_hdr() { return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n+Y 2 +X 1\n@@@\x81@@@\x82"; }

// White under alpha 0.
std::string uncovered_png() {
  const std::string row = std::string(1, '\0') + "\xff\xff\xff" + std::string(1, '\0');
  const auto bytes = png_file(1, 1, 8, PngColor::rgba, row);
  return {bytes.begin(), bytes.end()};
}

std::string grey_png(char value) {
  const std::string row = std::string(1, '\0') + std::string(6, value);
  return png_text(2, 2, row + row);
}

Case row(const std::string& name, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "score");
  return {.name = name,
          .arguments = std::move(arguments),
          .files = {{"reference.hdr", grey_hdr(2, 0x40)},
                    {"darker.hdr", grey_hdr(2, 0x30)},
                    {"darkest.hdr", grey_hdr(2, 0x10)},
                    {"tall.hdr", grey_hdr(3, 0x40)},
                    {"quiet.hdr", grey_hdr(2, 0x01)},
                    {"white.png", grey_png('\xff')},
                    {"black.png", grey_png('\0')},
                    {"golden/near/one.hdr", grey_hdr(2, 0x40)},
                    {"golden/two.hdr", grey_hdr(2, 0x40)},
                    {"golden/notes.txt", "text"},
                    {"pairs/view.hdr", grey_hdr(2, 0x40)},
                    {"pairs/view.png", grey_png('\0')},
                    {"others/view.PNG", grey_png('\xff')},
                    {"uncovered.png", uncovered_png()},
                    {"turned.hdr", turned_hdr()},
                    {"turned_back.hdr", turned_back_hdr()},
                    {"nightly/near/one.hdr", grey_hdr(2, 0x40)},
                    {"nightly/two.hdr", grey_hdr(2, 0x30)},
                    {"text.png", "text"}}};
}

Case good(const std::string& name, std::vector<std::string> arguments, std::vector<std::string> output,
          std::set<std::string> leaves = {}) {
  Case made = row(name, std::move(arguments));
  made.output_has = std::move(output);
  made.leaves = std::move(leaves);
  return made;
}

Case wrong(const std::string& name, std::vector<std::string> arguments, std::vector<std::string> errors) {
  Case made = row(name, std::move(arguments));
  made.exit_code = 2;
  made.errors_have = std::move(errors);
  return made;
}

// The reference is 0.5 everywhere, the pictures 0.375 and 0.126: errors of 0.126 and 0.375 at exposure 1.
std::vector<Case> good_scores() {
  return {
      {.name = "HelpOfScore",
       .arguments = {"score", "--help"},
       .output_has = {"Examples:", "footprint score", "--reference", "--mask", "--standard-error", "HDR"}},
      good("ScoreOne", {"{}/darker.hdr", "--reference", "{}/reference.hdr", "--exposure", "1"},
           {"4 pixels, exposure 1", "LDR-FLIP", "HDR-FLIP", "| 0.126 |", "-0.25"}),
      good("ScoreTheReferenceItself", {"{}/reference.hdr", "--reference", "{}/reference.hdr"}, {"|     0 |", "inf"}),
      good("ScoreTwo", {"{}/darkest.hdr", "{}/darker.hdr", "--reference", "{}/reference.hdr", "-o", "{}/score"},
           {"The first is closer to the reference in 0.0% of the pixels, the second in 100.0%", "noise unknown",
            "score.json"},
           {"score/score.json", "score/ldr_flip_1.png", "score/hdr_flip_1.png", "score/ldr_flip_2.png",
            "score/hdr_flip_2.png", "score/closer.png", "score/index.html", "score/reference.png",
            "score/reference_values.js", "score/image_1.png", "score/image_2_values.js"}),
      good("ScoreBeyondNoise",
           {"{}/darkest.hdr", "{}/darker.hdr", "--reference", "{}/reference.hdr", "--standard-error",
            "{}/reference.hdr", "--exposure", "1"},
           {"The first is closer to the reference in 0.0% of the pixels, the second in 0.0%", "three standard errors"}),
      good("ScoreDisplayedColours", {"{}/white.png", "--reference", "{}/reference.hdr", "--exposure", "2"},
           {"|     0 |", "n/a"}),
      good("ScoreAgainstAScene",
           {"{}/darker.hdr", "{}/white.png", "--reference", "v_grooves", "--spp", "16", "--distance", "0.2"},
           {"pixels, exposure", "darker.hdr", "white.png", "three standard errors"}),
      good("ScoreOfFoldersByStem", {"{}/others", "--reference", "{}/pairs", "--exposure", "2"},
           {"view.PNG", "|     0 |", "n/a"}),
      good("ScoreOfTurnedPixels", {"{}/turned_back.hdr", "--reference", "{}/turned.hdr"}, {"|     0 |", "inf"}),
      good("ScoreUnderAMask", {"{}/darker.hdr", "--reference", "{}/reference.hdr", "--mask", "{}/white.png"},
           {"4 pixels"}),
  };
}

// Limits and the test per pixel. The error of darker.hdr is 0.126 everywhere.
std::vector<Case> limited_scores() {
  const auto failed = [](const std::string& name, std::vector<std::string> arguments, std::vector<std::string> output) {
    Case made = good(name, std::move(arguments), std::move(output));
    made.exit_code = 1;
    made.errors_have = {"limits failed"};
    return made;
  };
  const std::vector<std::string> one{"{}/darker.hdr", "--reference", "{}/reference.hdr", "--exposure", "1"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), one.begin(), one.end());
    return more;
  };
  return {
      good("ScoreWithinLimits", with({"--max", "p99=0.13", "--max", "share_above:0.2=0", "--junit", "{}/out.xml"}),
           {"| 0.126 |"}, {"out.xml"}),
      failed("ScoreAboveALimit", with({"--max", "p99=0.12", "--github"}),
             {"failed: limit p99=0.12: it is 0.126", "::error file=", "darker.hdr%3A limit p99=0.12::it is 0.126"}),
      failed("ScoreBeyondNoiseOfAllPixels",
             with({"--standard-error", "{}/quiet.hdr", "--significance", "0.01", "--max", "rejected=3"}),
             {"failed: limit rejected=3: it is 4"}),
      good("ScoreWithinNoiseOfAllPixels",
           with({"--standard-error", "{}/darkest.hdr", "--significance", "0.01", "--max", "rejected=0"}),
           {"| 0.126 |"}),
      failed("ScoreOfFolders",
             {"{}/nightly", "--reference", "{}/golden", "--exposure", "1", "--max", "normalized_color=0.1"},
             {"one.hdr", "two.hdr", "failed: limit normalized_color=0.1: it is 0.126"}),
      good("ScoreOfFoldersIntoAFolder", {"{}/nightly", "--reference", "{}/golden", "--max", "p100=1", "-o", "{}/s"},
           {"score: "},
           {"s/near/one.hdr/index.html", "s/near/one.hdr/score.json", "s/near/one.hdr/ldr_flip_1.png",
            "s/near/one.hdr/hdr_flip_1.png", "s/two.hdr/score.json", "s/two.hdr/ldr_flip_1.png",
            "s/two.hdr/hdr_flip_1.png"}),
  };
}

std::vector<Case> wrong_scores() {
  return {
      wrong("ScoreOfAnotherSize", {"{}/tall.hdr", "--reference", "{}/reference.hdr"},
            {"tall.hdr", "2 x 3", "2 x 2", "one size"}),
      wrong("ScoreWithNoiseOfAnotherSize",
            {"{}/darker.hdr", "{}/darkest.hdr", "--reference", "{}/reference.hdr", "--standard-error", "{}/tall.hdr"},
            {"2 x 3", "2 x 2"}),
      wrong("ScoreOfNoCoverage", {"{}/uncovered.png", "--reference", "{}/reference.hdr"},
            {"uncovered.png", "alpha is 0 everywhere"}),
      wrong("ScoreOfText", {"{}/text.png", "--reference", "{}/reference.hdr"}, {"text.png"}),
      wrong("ScoreOfNothing", {"{}/missing.exr", "--reference", "{}/reference.hdr"}, {"missing.exr", "no such file"}),
      wrong("ScoreAgainstDisplayedColours", {"{}/darker.hdr", "--reference", "{}/white.png"},
            {"white.png", "displayed colours", "--method reference"}),
      wrong("ScoreAgainstAMissingScene", {"{}/darker.hdr", "--reference", "v_groves"}, {"v_groves", "v_grooves"}),
      wrong("ScoreAgainstAPictureWithSamples", {"{}/darker.hdr", "--reference", "{}/reference.hdr", "--spp", "16"},
            {"--spp", "is an image", "with a scene"}),
      wrong("ScoreAgainstAPictureFromAfar", {"{}/darker.hdr", "--reference", "{}/reference.hdr", "--distance", "2"},
            {"--distance", "is an image", "with a scene"}),
      wrong("ScoreAgainstASceneWithNoise",
            {"{}/darker.hdr", "--reference", "v_grooves", "--standard-error", "{}/reference.hdr"},
            {"--standard-error", "has its own"}),
      wrong("ScoreWithoutReference", {"{}/darker.hdr"}, {"--reference"}),
      wrong("ScoreOfThree", {"{}/darker.hdr", "{}/darkest.hdr", "{}/darker.hdr", "--reference", "{}/reference.hdr"},
            {"pictures", "At Most 2"}),
      wrong("ScoreUnderAMaskOfAnotherSize",
            {"{}/darker.hdr", "--reference", "{}/reference.hdr", "--mask", "{}/tall.hdr"}, {"tall.hdr", "2 x 3"}),
      wrong("ScoreUnderABlackMask", {"{}/darker.hdr", "--reference", "{}/reference.hdr", "--mask", "{}/black.png"},
            {"black.png", "leaves no pixel"}),
      wrong("ScoreWithAnUnknownLimit", {"{}/darker.hdr", "--reference", "{}/reference.hdr", "--max", "p99.0.1"},
            {"--max p99.0.1", "NAME=VALUE"}),
      wrong("ScoreTestedWithoutNoise", {"{}/darker.hdr", "--reference", "{}/reference.hdr", "--significance", "0.01"},
            {"--significance", "noise of the reference is not known"}),
      wrong("ScoreOfAFolderAgainstAnImage", {"{}/nightly", "--reference", "{}/reference.hdr"},
            {"nightly", "folder of references"}),
      wrong("ScoreOfAFolderThatLacksAnImage", {"{}/nightly/near", "--reference", "{}/golden"},
            {"near/one.hdr", "no such file"}),
      wrong("ScoreAtNoExposure", {"{}/darker.hdr", "--reference", "{}/reference.hdr", "--exposure", "0"},
            {"--exposure"}),
  };
}

INSTANTIATE_TEST_SUITE_P(GoodScore, CommandLine, ::testing::ValuesIn(good_scores()), case_name);
INSTANTIATE_TEST_SUITE_P(LimitedScore, CommandLine, ::testing::ValuesIn(limited_scores()), case_name);
INSTANTIATE_TEST_SUITE_P(WrongScore, CommandLine, ::testing::ValuesIn(wrong_scores()), case_name);

}  // namespace
}  // namespace footprint::test
