// Experiments as files: what is read from them, and the one error that a wrong one gives.
#include "experiments/runner/experiment.hpp"
#include "experiments/studies/view_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "experiments/runner/run_experiment.hpp"
#include "experiments/studies/stage.hpp"
#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr const char* head = R"([experiment]
title = "A title"
scene = "ribbed_plane"
methods = ["direct", "toksvig:storage=fp16"]
)";

class ExperimentFile : public ::testing::Test {
 protected:
  void SetUp() override {
    write("paper.toml",
          "[[value]]\nfigure = \"Figure 1\"\nmeasure = \"error(toksvig)\"\nvalue = 0.5\n"
          "[[value]]\nfigure = \"Figure 2\"\nmeasure = \"fps(unknown)\"\nvalue = 7\n");
  }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  Experiment read(const std::string& text) const { return read_experiment(write("mine.toml", text)); }

  std::string complaint(const std::string& text) const {
    try {
      (void)read(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return error.what();
    }
    ADD_FAILURE() << "was taken:\n" << text;
    return {};
  }

  void expect_complaint(const std::string& text, const std::string& part) const {
    const std::string found = complaint(text);
    EXPECT_NE(found.find("mine.toml:"), std::string::npos) << found;
    EXPECT_NE(found.find(part), std::string::npos) << found;
  }

  const fs::path folder_ = test::fresh_folder();
};

TEST_F(ExperimentFile, DefaultsAreThoseOfACompare) {
  const Experiment experiment = read(head);
  EXPECT_EQ(experiment.name, "mine");
  EXPECT_EQ(experiment.run.scene, "ribbed_plane");
  ASSERT_EQ(experiment.run.methods.size(), 2U);
  EXPECT_EQ(experiment.run.methods[1].options.at("storage"), "fp16");
  EXPECT_TRUE(experiment.run.view.distances.empty());
  EXPECT_EQ(experiment.run.view.zoom.frames, 0);
  EXPECT_EQ(experiment.run.reference.spp, 64);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(experiment.run.overrides.camera));
}

TEST_F(ExperimentFile, ASizeIsTakenAsOnTheCommandLine) {
  const std::string methods = "[experiment]\ntitle = \"t\"\nscene = \"ribbed_plane\"\nmethods = [\"direct\"]\n";
  EXPECT_EQ(read(methods + "size = \"256x128\"\n").run.view.size, glm::ivec2(256, 128));
  EXPECT_EQ(read(methods + "size = [256, 128]\n").run.view.size, glm::ivec2(256, 128));
  expect_complaint(methods + "size = \"256\"\n", "`256` is not a frame size");
  expect_complaint(methods + "size = \"0x3\"\n", "has no pixels");
}

TEST_F(ExperimentFile, OnlyASceneBesideItComesBeforeTheLibrary) {
  fs::create_directories(folder_ / "ribbed_plane");
  EXPECT_EQ(read(head).run.scene, "ribbed_plane") << "a folder without a scene, as runs leave them";
  write("ribbed_plane/scene.toml", "");
  EXPECT_EQ(read(head).run.scene, (folder_ / "ribbed_plane").string());
}

constexpr const char* every_key = R"toml(
description = "words"
size = [500, 400]
exposure = 0.25
without = ["fresnel", "cast_shadow"]
footprint = "anisotropic:8"
repeats = 3
[zoom]
from = 1
to = 4
frames = 3
[camera]
position = [0, 0, 2]
target = [0, 0, 0]
[reference]
spp = 256
other_spp = [16, 36]
supersampling = [1, 4]
seed = 7
filter = "nearest"
integrator = "dense"
[published]
file = "paper.toml"
figures = ["Figure 1"]
[[ndf]]
name = "corner"
footprint = [0, 0, 0.25, 0.5]
[[claim]]
name = "less"
text = "It is less."
source = "our_measure"
inequality = "error(toksvig, spp=16) < error(direct, frame=2)"
expect = "not_reproduced"
reason = "because"
[threshold]
"error(*)" = 0.5
"flicker(direct)" = 0.1
[figure]
crop = [0.25, 0.25, 0.75, 0.75]
inset = [0, 0, 0.1, 0.1]
[[figure.row]]
pictures = [{ method = "toksvig", frame = 1, label = "(a)" }, { method = "reference" }]
)toml";

TEST_F(ExperimentFile, EveryKeyIsRead) {
  const Experiment experiment = read(std::string(head) + every_key);
  EXPECT_EQ(*experiment.run.view.size, glm::ivec2(500, 400));
  EXPECT_EQ(given_distances(experiment.run.view), (std::vector<double>{1, 2, 4}));
  EXPECT_EQ(experiment.run.view.exposure->factor, 0.25F);
  EXPECT_EQ(experiment.run.view.exposure->source, ExposureSource::experiment);
  EXPECT_EQ(experiment.run.footprint, (FootprintFilter{FootprintFilterKind::anisotropic, 8}));
  EXPECT_EQ(experiment.run.timing.repeats, 3);
  EXPECT_EQ(experiment.run.reference.spp, 256);
  EXPECT_EQ(experiment.run.reference.seed, 7U);
  EXPECT_TRUE(std::holds_alternative<PlacedCamera>(experiment.run.overrides.camera));
  EXPECT_EQ(experiment.run.reference.other_spp, (std::vector<int>{16, 36}));
  EXPECT_EQ(experiment.run.reference.supersampling, (std::vector<int>{1, 4}));
  EXPECT_EQ(experiment.run.without.count(), 2U);
  EXPECT_TRUE(has(experiment.run.without, Effect::fresnel) && has(experiment.run.without, Effect::cast_shadow));
  EXPECT_EQ(experiment.run.reference.filter, Sampling::nearest);
  EXPECT_EQ(experiment.run.reference.environment, EnvironmentUse::dense);
  ASSERT_EQ(experiment.published.size(),
            1U);  // that of figure 2 names a method that this build lacks, and is not requested
  EXPECT_EQ(experiment.published[0].printed.published, 0.5);
  ASSERT_EQ(experiment.footprints.size(), 1U);
  EXPECT_EQ(experiment.footprints[0].rect.upper, glm::dvec2(0.25, 0.5));
  ASSERT_EQ(experiment.claims.size(), 1U);
  EXPECT_EQ(experiment.claims[0].stated.source, ClaimSource::our_measure);
  EXPECT_EQ(experiment.claims[0].stated.expect, Verdict::not_reproduced);
  ASSERT_EQ(experiment.thresholds.size(), 3U);
  EXPECT_EQ(experiment.thresholds[0].measure.text(), "error(direct)");
  EXPECT_EQ(experiment.thresholds[1].measure.text(), "error(toksvig:storage=fp16)");
  ASSERT_EQ(experiment.figure.rows.size(), 1U);
  EXPECT_EQ(experiment.figure.rows[0][0].method, 1U);
  EXPECT_FALSE(experiment.figure.rows[0][1].method);
}

TEST_F(ExperimentFile, AllIsEveryMethodExceptSlowOnes) {
  const Experiment experiment = read("[experiment]\ntitle = \"t\"\nscene = \"s\"\nmethods = \"all\"\n");
  const auto slow = std::ranges::count_if(all_methods(), [](const Method* method) { return method->info.slow_frame; });
  EXPECT_GT(slow, 0);
  EXPECT_EQ(experiment.run.methods.size() + static_cast<std::size_t>(slow), all_methods().size());
}

TEST_F(ExperimentFile, ASceneBesideTheFileIsTheOneThatIsMeant) {
  write("own.gltf", "{}");
  const Experiment experiment = read("[experiment]\ntitle = \"t\"\nscene = \"own.gltf\"\nmethods = [\"direct\"]\n");
  EXPECT_EQ(experiment.run.scene, (folder_ / "own.gltf").string());
}

TEST_F(ExperimentFile, WrongFilesAreRefusedAtTheirLine) {
  const std::string good = head;
  expect_complaint("[experimnt]\n", "did you mean `experiment`");
  expect_complaint("title = ", "not valid TOML");
  expect_complaint("[zoom]\ndistances = [1]\n", "`experiment` is missing");
  expect_complaint("[experiment]\nscene = \"s\"\n", "`title` in [experiment] is missing");
  expect_complaint(good + "sizes = [1, 2]\n", "mine.toml:5: unknown key `sizes` in [experiment]");
  expect_complaint(good + "size = [0, 2]\n", "has no pixels");
  expect_complaint(good + "without = [\"fresnell\"]\n", "did you mean `fresnel`");
  expect_complaint(good + "size = [1.5, 2]\n", "is not a frame size");
  expect_complaint("[experiment]\ntitle = \"t\"\nscene = \"s\"\nmethods = [\"toksvg\"]\n", "did you mean `toksvig`");
  expect_complaint("[experiment]\ntitle = \"t\"\nscene = \"s\"\nmethods = [\"toksvig:storag=fp16\"]\n", "storage");
  expect_complaint("[experiment]\ntitle = \"t\"\nscene = \"s\"\nmethods = [\"direct,toksvig\"]\n", "on its own");
  expect_complaint("[experiment]\ntitle = \"t\"\nscene = \"s\"\nmethods = \"some\"\n", "unknown method `some`");
  expect_complaint(good + "[zoom]\nfrom = 1\nto = 1\nframes = 3\n", "where the zoom starts");
  expect_complaint(good + "[zoom]\nfrom = 1\nto = 2\n", "`frames` in [zoom] is missing");
  expect_complaint(good + "[zoom]\ndistances = [1, 2]\nfrom = 1\n", "excludes");
  expect_complaint(good + "[zoom]\ndistances = [1, 1]\n", "twice");
  expect_complaint(good + "[zoom]\nfrom = 1\nto = 2\nframes = 1\n", "a whole number, 2 to");
  expect_complaint(good + "[reference]\nspp = 5000\n", "4096");
  expect_complaint(good + "[reference]\nfilter = \"neerest\"\n", "did you mean `nearest`");
  expect_complaint(good + "[published]\nfile = \"paper.toml\"\nfigures = [\"Figure 3\"]\n", "`Figure 3`");
  expect_complaint(good + "[threshold]\n\"eror(direct)\" = 1\n", "did you mean `error`");
  expect_complaint(good + "[threshold]\n\"error(direct)\" = \"low\"\n", "must be a number");
  expect_complaint(good + "[threshold]\n\"flicker(direct)\" = 1\n", "frames of a zoom");
  expect_complaint(good + "[threshold]\n\"error(direct, spp=16)\" = 1\n", "other_spp");
  expect_complaint(
      good + "[reference]\nsupersampling = [1, 4]\n[threshold]\n\"supersampling_time(direct, spp=16)\" = 1\n",
      "timed are [1, 4]");
  expect_complaint(good + "[threshold]\n\"supersampling_time(direct)\" = 1\n", "does not say of how many samples");
  expect_complaint(good + "[reference]\nsupersampling = [0]\n", "a whole number, 1 to");
  expect_complaint(good + "[threshold]\n\"ndf_l2(direct)\" = 1\n", "add [[ndf]]");
  expect_complaint(good + "[[ndf]]\nname = \"../a\"\nfootprint = [0, 0, 1, 1]\n", "cannot name a folder");
  expect_complaint(good + "[[ndf]]\nname = \"a\"\nfootprint = [0, 0, 0, 1]\n", "`footprint` in [[ndf]]");
  expect_complaint(
      good + "[[ndf]]\nname = \"a\"\nfootprint = [0, 0, 1, 1]\n[threshold]\n\"ndf_l2(direct, footprint=b)\" = 1\n",
      "`b` is not a footprint");
  expect_complaint(good + "[figure]\ncrop = [0, 0, 0, 1]\n", "is empty");
  expect_complaint(good + "[figure]\n", "`row` in [figure] is missing");
  expect_complaint(good + "[[figure.row]]\npictures = [{ method = \"tan\" }]\n", "no method `tan`");
}

TEST_F(ExperimentFile, TakesQuantitiesThatAMethodHas) {
  const std::string by = "[experiment]\ntitle = \"t\"\nscene = \"s\"\nmethods = [\"direct\", \"iwasaki_sg\"]\n";
  const auto quantity = [&](const std::string& more, const std::string& measure) {
    return by + "[[quantity]]\nname = \"q\"\n" + more + "[threshold]\n\"" + measure + "\" = 1\n";
  };
  const std::string figure = "figure = \"convolution_error\"\n", good = "quantity(iwasaki_sg, name=q)";
  const Experiment experiment = read(quantity(figure + "parameters = { eta1 = 1, eta2 = 10 }\n", good));
  ASSERT_EQ(experiment.quantities.size(), 1U);
  EXPECT_EQ(experiment.quantities[0].parameters.at("eta2"), "10");
  EXPECT_EQ(experiment.thresholds[0].measure.text(), good);
  expect_complaint(quantity("figure = \"convolution_eror\"\n", good), "did you mean `convolution_error`");
  expect_complaint(quantity(figure + "parameters = { eta3 = 1 }\n", good), "did you mean `eta");
  expect_complaint(quantity(figure + "parameters = { eta1 = -1 }\n", good), "is not valid");
  expect_complaint(quantity(figure, "quantity(direct, name=q)"), "direct has no figure");
  expect_complaint(quantity(figure, "quantity(iwasaki_sg, name=r)"), "`r` is not a quantity");
  expect_complaint(quantity(figure, "quantity(iwasaki_sg)"), "does not say which");
  expect_complaint(quantity(figure, "error(iwasaki_sg, name=q)"), "selects nothing of error");
  expect_complaint(quantity(figure + "[[quantity]]\nname = \"q\"\n" + figure, good), "another quantity");
}

TEST_F(ExperimentFile, ClaimsAreCheckedAgainstTheExperiment) {
  const auto claim = [&](const std::string& inequality, const std::string& expect) {
    return std::string(head) + "[zoom]\ndistances = [1, 4]\n[[claim]]\nname = \"n\"\ntext = \"t\"\nreason = \"r\"\n" +
           "expect = \"" + expect + "\"\ninequality = \"" + inequality + "\"\n";
  };
  const std::string good = claim("error(toksvig) < error(direct, distance=4)", "reproduced");
  ASSERT_EQ(read(good).claims.size(), 1U);
  EXPECT_EQ(read(good).claims[0].stated.source, ClaimSource::ours);  // not a paper's unless the file says so
  EXPECT_EQ(read(good + "source = \"paper\"\n").claims[0].stated.source, ClaimSource::paper);
  expect_complaint(good + "source = \"papers\"\n", "did you mean `paper`");
  expect_complaint(claim("error(toksvg) < 1", "reproduced"), "did you mean `toksvig");
  expect_complaint(claim("error(direct, distance=2) < 1", "reproduced"), "it has 1, 4");
  expect_complaint(claim("error(direct, frame=2) < 1", "reproduced"), "frames are 0 to 1");
  expect_complaint(claim("error(direct)", "reproduced"), "one of < <= > >= is missing");
  expect_complaint(claim("error(*) < 1", "reproduced"), "no method `*`");
  expect_complaint(claim("1 < 2", "maybe"), "`maybe`");
}

TEST_F(ExperimentFile, IsFoundByItsNameOrItsPath) {
  const fs::path file = write("mine.toml", head);
  EXPECT_EQ(find_experiment("mine", folder_), file);
  EXPECT_EQ(find_experiment(file.string(), "/nowhere"), file);
  EXPECT_EQ(find_experiment((folder_ / "mine").string(), "/nowhere"), file);
  EXPECT_EQ(list_experiments(folder_), (std::vector<std::string>{"mine", "paper"}));
  try {
    (void)find_experiment("mien", folder_);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean `mine`"), std::string::npos) << error.what();
  }
}

constexpr const char* every_outcome = R"toml(
[threshold]
"error(direct)" = 0.3
"error(toksvig)" = 0.3
"fps(direct) / 0" = 1
[[claim]]
name = "holds"
text = "t"
inequality = "error(toksvig) < error(direct)"
expect = "reproduced"
reason = "r"
[[claim]]
name = "holds_unexpectedly"
text = "t"
inequality = "error(toksvig) < error(direct)"
expect = "not_reproduced"
reason = "r"
[[claim]]
name = "fails"
text = "t"
inequality = "error(toksvig) > error(direct)"
expect = "reproduced"
reason = "r"
[[claim]]
name = "fails_as_expected"
text = "t"
inequality = "error(toksvig) > error(direct)"
expect = "not_reproduced"
reason = "r"
[[claim]]
name = "undecided"
text = "t"
inequality = "precompute(toksvig) > 1"
expect = "not_reproduced"
reason = "r"
)toml";

// Each outcome against each expectation: what falls short, and what does not.
TEST_F(ExperimentFile, JudgingGoesEitherWay) {
  const Experiment experiment = read(std::string(head) + every_outcome);
  Results results;
  for (const char* method : {"direct", "toksvig:storage=fp16"}) {
    Record& record = results.records.emplace_back();
    record.method = method;
    record.error.emplace().normalized_color = record.method == "direct" ? 0.4 : 0.2;
    record.precompute_cached = true;
  }
  const std::vector<std::string> lines = judge(experiment, std::span(&results, 1)).shortfalls();
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_NE(lines[0].find("claim holds_unexpectedly: reproduced, expected not reproduced"), std::string::npos);
  EXPECT_NE(lines[0].find("error(toksvig) = 0.20000; error(direct) = 0.40000"), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find("claim fails: not reproduced, expected reproduced"), std::string::npos);
  EXPECT_NE(lines[2].find("claim undecided: undecided"), std::string::npos);
  EXPECT_NE(lines[3].find("threshold error(direct): at most 0.30000, measured 0.40000"), std::string::npos) << lines[3];
  EXPECT_NE(lines[4].find("division by 0"), std::string::npos);
}

constexpr const char* over_times = R"toml(
[[claim]]
name = "time"
text = "t"
inequality = "time(toksvig) < 2 * time(direct)"
expect = "not_reproduced"
reason = "r"
[[claim]]
name = "frames"
text = "t"
inequality = "fps(direct) > 1000"
expect = "not_reproduced"
reason = "r"
[[claim]]
name = "error"
text = "t"
inequality = "error(toksvig) < error(direct)"
expect = "not_reproduced"
reason = "r"
)toml";

// Measured, toksvig takes 4 and direct 1 ms; estimated, 3e5 pixels at 1.5 and 1 ns, on a GPU that fails for toksvig
// nothing. The claim over errors gets no second verdict, and the first verdicts stay.
TEST_F(ExperimentFile, ClaimsOverTimesAreDecidedAgainByEstimates) {
  const Experiment experiment = read(std::string(head) + over_times);
  Results results;
  for (const bool is_direct : {true, false}) {
    Record& record = results.records.emplace_back();
    record.method = is_direct ? "direct" : "toksvig:storage=fp16";
    record.node = is_direct ? "here" : "there";  // measured times of two hosts decide nothing
    record.error.emplace().normalized_color = 0.1;
    record.pixels.object = 300'000;
    record.frame_ms.median = is_direct ? 1.0 : 4.0;
    record.fps = 1000.0 / record.frame_ms.median;
    record.gpu_costs.resize(2);
    record.gpu_costs[0].gpu = "whole";
    record.gpu_costs[0].cost_ns = is_direct ? 1.0 : 1.5;
    record.gpu_costs[1].gpu = "failing";
    record.gpu_costs[1].cost_ns = 1.0;
    if (!is_direct) record.gpu_costs[1].failure = "refused";
  }
  const ExperimentReport report = judge(experiment, std::span(&results, 1));
  EXPECT_EQ(report.claims[0].outcome, Verdict::undecided);
  ASSERT_EQ(report.second_verdicts.size(), 4U);
  EXPECT_EQ(report.second_verdicts[0].claim, "time");
  EXPECT_EQ(report.second_verdicts[0].gpu, "whole");
  EXPECT_EQ(report.second_verdicts[0].outcome, Verdict::reproduced);
  EXPECT_DOUBLE_EQ(report.second_verdicts[0].left.value(), 0.45);
  EXPECT_DOUBLE_EQ(report.second_verdicts[0].right.value(), 0.6);
  EXPECT_EQ(report.second_verdicts[1].claim, "frames");
  EXPECT_DOUBLE_EQ(report.second_verdicts[1].left.value(), 1000.0 / 0.3);
  EXPECT_EQ(report.second_verdicts[2].outcome, Verdict::undecided);
  EXPECT_FALSE(report.second_verdicts[2].problem.empty());
  EXPECT_EQ(report.second_verdicts[3].outcome, Verdict::reproduced);
}

constexpr const char* over_gpu_times = R"toml(
[[claim]]
name = "class"
text = "t"
source = "gpu_time"
gpu_class = ["GeForce", "Quadro"]
inequality = "time(toksvig) < 2 * time(direct)"
expect = "not_reproduced"
reason = "r"
[[claim]]
name = "no_class"
text = "t"
source = "gpu_time"
inequality = "fps(direct) > 10"
expect = "undecided"
reason = "r"
[[claim]]
name = "ours"
text = "t"
inequality = "time(toksvig) < 2 * time(direct)"
expect = "not_reproduced"
reason = "r"
[[claim]]
name = "no_measure"
text = "t"
source = "our_measure"
inequality = "time(toksvig) > 0"
expect = "undecided"
reason = "the paper does not say over what"
)toml";

Results timed_on(const std::string& renderer) {
  Results results;
  results.backend.renderer = renderer;
  for (const bool is_direct : {true, false}) {
    Record& record = results.records.emplace_back();
    record.method = is_direct ? "direct" : "toksvig:storage=fp16";
    record.node = "here";
    record.error.emplace().normalized_color = 0.1;
    record.frame_ms.median = is_direct ? 1.0 : 4.0;
    record.fps = 1000.0 / record.frame_ms.median;
  }
  return results;
}

std::vector<Verdict> verdicts(const ExperimentReport& report) {
  std::vector<Verdict> found;
  for (const ClaimOutcome& claim : report.claims) found.push_back(claim.outcome);
  return found;
}

// Only a GPU of the class decides a claim over a GPU's times. Other claims over times are decided by any machine, and
// one that is expected undecided by none.
TEST_F(ExperimentFile, TimesOfAGpuAreDecidedByAGpuOfItsClass) {
  using enum Verdict;
  const Experiment experiment = read(std::string(head) + over_gpu_times);
  for (const char* renderer : {"llvmpipe (LLVM 15.0.6, 256 bits)", "zink Vulkan 1.3(llvmpipe (LLVM 15, GeForce))",
                               "NVIDIA H100 80GB HBM3/PCIe/SSE2", "AMD Radeon RX 480", ""}) {
    const Results results = timed_on(renderer);
    const ExperimentReport report = judge(experiment, std::span(&results, 1));
    EXPECT_EQ(verdicts(report), (std::vector{undecided, undecided, not_reproduced, undecided})) << renderer;
    for (const ClaimOutcome& claim : report.claims) EXPECT_TRUE(claim.as_expected()) << renderer << " " << claim.name;
    EXPECT_NE(report.claims[0].undecidable.find(renderer), std::string::npos) << report.claims[0].undecidable;
    EXPECT_DOUBLE_EQ(report.claims[0].left.value(), 4.0) << "the figures stay";
    EXPECT_EQ(report.claims[3].undecidable, "the paper does not say over what");
  }
  const Results of_class = timed_on("NVIDIA GeForce RTX 3080/PCIe/SSE2");
  EXPECT_EQ(verdicts(judge(experiment, std::span(&of_class, 1))),
            (std::vector{not_reproduced, undecided, not_reproduced, undecided}));
}

TEST_F(ExperimentFile, AFigureThatIsMissingFailsOnAnyMachine) {
  const Experiment experiment = read(std::string(head) + over_gpu_times);
  Results results = timed_on("llvmpipe");
  for (Record& record : results.records) record.frame_ms.median = std::nan("");
  const ExperimentReport report = judge(experiment, std::span(&results, 1));
  EXPECT_FALSE(report.claims[0].as_expected());
  EXPECT_TRUE(report.claims[1].as_expected()) << "it has its figure";
}

TEST_F(ExperimentFile, TimesOfSeveralSoftwareRenderersDecideNoMoreThanOne) {
  const Experiment experiment = read(std::string(head) + over_gpu_times);
  Results results = timed_on("llvmpipe");
  results.records[1].node = "there";
  const ExperimentReport report = judge(experiment, std::span(&results, 1));
  EXPECT_TRUE(report.claims[0].as_expected());
  EXPECT_FALSE(report.claims[2].as_expected()) << "ours, over times of two machines";
}

TEST_F(ExperimentFile, AGpuClassBelongsToTimesOfAGpu) {
  const std::string claim = "[[claim]]\nname = \"a\"\ntext = \"t\"\ninequality = \"fps(direct) > 1\"\nreason = \"r\"\n";
  const std::string timed = std::string(head) + claim + "expect = \"undecided\"\nsource = \"gpu_time\"\n";
  EXPECT_EQ(read(timed + "gpu_class = [\"A\", \"B\"]\n").claims[0].gpu_class, (std::vector<std::string>{"A", "B"}));
  EXPECT_TRUE(read(timed).claims[0].gpu_class.empty());
  expect_complaint(timed + "gpu_class = []\n", "must be a list of strings");
  expect_complaint(timed + "gpu_class = [\"\"]\n", "has an empty word");
  expect_complaint(std::string(head) + claim + "expect = \"reproduced\"\ngpu_class = [\"A\"]\n",
                   "belongs to claims over times on a GPU");
  expect_complaint(std::string(head) + claim + "expect = \"nothing\"\n", "undecided");
}

TEST(Zoom, StepsAreEqualRatiosBetweenExactEnds) {
  EXPECT_EQ(zoom_distances(1, 8, 4), (std::vector<double>{1, 2, 4, 8}));
  EXPECT_EQ(zoom_distances(0.1, 0.7, 2), (std::vector<double>{0.1, 0.7}));
  const auto inward = zoom_distances(6, 1.5, 5);
  for (std::size_t i = 1; i < inward.size(); ++i) EXPECT_NEAR(inward[i] / inward[i - 1], std::sqrt(0.5), 1e-8);
}

TEST_F(ExperimentFile, MayBeMadeOfOthersAndThenHasNothingElse) {
  write("first.toml", head);
  write("second.toml", head);
  const std::string title = "[experiment]\ntitle = \"both\"\n";
  const Experiment both = read(title + "members = [\"first\", \"second\"]\n");
  EXPECT_EQ(both.title, "both");
  EXPECT_EQ(both.members, (std::vector<fs::path>{folder_ / "first.toml", folder_ / "second.toml"}));
  expect_complaint(title + "members = [\"frist\"]\n", "did you mean `first`");
  expect_complaint(title + "members = [\"first\", \"first\"]\n", "`first` twice");
  expect_complaint(title + "members = [\"first\"]\nscene = \"bumps\"\n", "excludes `members`");
  expect_complaint(title + "members = [\"first\"]\n[zoom]\ndistances = [1]\n", "excludes `members`");
  expect_complaint(title + "members = [\"first\"]\n[[quantity]]\nname = \"a\"\n", "excludes `members`");
}

TEST_F(ExperimentFile, AQuickRunWaitsForNoNoise) {
  Experiment experiment = read(std::string(head) + "size = [640, 480]\n[reference]\nnoise = 0.001\n");
  EXPECT_FALSE(experiment.run.reference.fixed_spp);
  make_quick(experiment);
  EXPECT_TRUE(experiment.quick);
  EXPECT_TRUE(experiment.run.reference.fixed_spp);
  EXPECT_EQ(experiment.run.reference.spp, 16);
  EXPECT_EQ(experiment.run.overrides.most_texels, 256);
  EXPECT_EQ(experiment.run.view.size, glm::ivec2(160, 120));
  Experiment with_its_own = read(std::string(head) + "size = [640, 480]\nquick_size = \"320x200\"\n");
  EXPECT_EQ(with_its_own.run.view.size, glm::ivec2(640, 480));
  make_quick(with_its_own);
  EXPECT_EQ(with_its_own.run.view.size, glm::ivec2(320, 200));
}

}  // namespace
}  // namespace footprint
