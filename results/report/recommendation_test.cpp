// The choice among candidates, on numbers made for it: limits, ties within noise, what cannot be said.
#include "results/report/recommendation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace footprint {
namespace {

Candidate candidate(const std::string& method, double error, double cost, double noise = 0.001,
                    std::uint64_t bytes = 1000) {
  return {.method = method,
          .footprint = "trilinear",
          .errors = {error},
          .error = error,
          .worst = error,
          .noise = noise,
          .cost = {.median = cost, .low = 0.95 * cost, .high = 1.05 * cost},
          .bytes = bytes,
          .bake_seconds = 0};
}

const std::vector<Candidate> front{candidate("direct", 0.2, 1.0, 0.001, 10), candidate("naive_mip", 0.21, 1.5),
                                   candidate("toksvig", 0.1, 1.6), candidate("lean", 0.08, 1.8, 0.001, 5000),
                                   candidate("tan_gmm", 0.05, 4.0, 0.001, 90000)};

std::string chosen_of(const std::vector<Candidate>& candidates, const Limits& limits) {
  const Choice choice = choose(candidates, limits);
  return choice.chosen ? candidates[*choice.chosen].method : "none";
}

TEST(Choice, IsTheCheapestWithinAnError) {
  EXPECT_EQ(chosen_of(front, {.max_error = 0.3, .max_cost = {}, .max_bytes = {}}), "direct");
  EXPECT_EQ(chosen_of(front, {.max_error = 0.12, .max_cost = {}, .max_bytes = {}}), "toksvig");
  EXPECT_EQ(chosen_of(front, {.max_error = 0.09, .max_cost = {}, .max_bytes = {}}), "lean");
  EXPECT_EQ(chosen_of(front, {.max_error = 0.06, .max_cost = {}, .max_bytes = {}}), "tan_gmm");
}

TEST(Choice, IsTheBestWithinACostOrSize) {
  EXPECT_EQ(chosen_of(front, {.max_error = {}, .max_cost = 1.7, .max_bytes = {}}), "toksvig");
  EXPECT_EQ(chosen_of(front, {.max_error = {}, .max_cost = 10, .max_bytes = {}}), "tan_gmm");
  EXPECT_EQ(chosen_of(front, {.max_error = {}, .max_cost = {}, .max_bytes = 1000}), "toksvig");
  EXPECT_EQ(chosen_of(front, {.max_error = {}, .max_cost = {}, .max_bytes = 20}), "direct");
  EXPECT_EQ(chosen_of(front, {}), "tan_gmm");
}

// A limit applies at every distance, not only to the mean.
TEST(Choice, LimitsTheErrorAtEveryDistance) {
  std::vector<Candidate> candidates = front;
  candidates[2].worst = 0.5;
  EXPECT_EQ(chosen_of(candidates, {.max_error = 0.12, .max_cost = {}, .max_bytes = {}}), "lean");
}

TEST(Choice, SaysWhatComesClosestWhereNoneKeepsTheLimit) {
  const Choice choice = choose(front, {.max_error = 0.01, .max_cost = {}, .max_bytes = {}});
  EXPECT_FALSE(choice.chosen.has_value());
  EXPECT_EQ(front[choice.nearest.value()].method, "tan_gmm");
  EXPECT_EQ(front[choose(front, {.max_error = {}, .max_cost = 0.5, .max_bytes = {}}).nearest.value()].method, "direct");
}

TEST(Choice, OfErrorsWithinNoiseIsTheCheapest) {
  std::vector<Candidate> candidates = front;
  candidates[4].noise = 0.02;  // 0.05 and 0.08 do not differ any more, 0.05 and 0.1 neither
  EXPECT_EQ(chosen_of(candidates, {}), "toksvig");
}

TEST(Choice, OfCostsWithinTheirSpreadIsTheBest) {
  std::vector<Candidate> candidates = front;
  candidates[3].cost = {.median = 1.62, .low = 1.5, .high = 1.7};
  EXPECT_EQ(chosen_of(candidates, {.max_error = 0.12, .max_cost = {}, .max_bytes = {}}), "lean");
}

TEST(Choice, NamesThoseThatCouldStandInItsPlace) {
  std::vector<Candidate> candidates = front;
  candidates.push_back(candidate("leadr", 0.0801, 1.82));
  const Choice choice = choose(candidates, {.max_error = {}, .max_cost = 2.0, .max_bytes = {}});
  EXPECT_EQ(candidates[choice.chosen.value()].method, "lean");
  EXPECT_EQ(choice.tied, (std::vector<std::size_t>{5}));
  EXPECT_EQ(candidates[choice.better.value()].method, "tan_gmm");
}

TEST(Choice, IsToFilterNothingWhereThatGainsLessThanNoise) {
  const std::vector<Candidate> flat{candidate("direct", 0.002, 1.0), candidate("toksvig", 0.0019, 1.6),
                                    candidate("lean", 0.0018, 1.8)};
  const Choice choice = choose(flat, {});
  EXPECT_EQ(flat[choice.chosen.value()].method, "direct");
  EXPECT_TRUE(choice.filter_nothing);
  EXPECT_FALSE(
      choose(front, {.max_error = 0.3, .max_cost = {}, .max_bytes = {}}).filter_nothing);  // good enough is not that
}

TEST(Choice, SaysNothingOfNothing) {
  const Choice choice = choose({}, {});
  EXPECT_FALSE(choice.chosen.has_value());
  EXPECT_FALSE(choice.nearest.has_value());
}

// Unknown noise parts nothing: plain direct stays.
TEST(Choice, WithoutNoiseTellsNothingApart) {
  std::vector<Candidate> candidates = front;
  for (Candidate& each : candidates) each.noise.reset();
  EXPECT_EQ(chosen_of(candidates, {}), "direct");
}

TEST(Contenders, AreThoseThatNoneBeatsInErrorAndCost) {
  EXPECT_EQ(contenders(front, {}, 0.0, 0.0), (std::vector<std::size_t>{0, 2, 3, 4}));
  std::vector<Candidate> candidates = front;
  candidates.push_back(candidate("slow", 0.3, 9.0));
  candidates.push_back(candidate("near", 0.052, 4.1));
  const auto found = contenders(candidates, {}, 0.2, 0.1);
  EXPECT_EQ(std::ranges::count(found, 5U), 0);  // far behind
  EXPECT_EQ(std::ranges::count(found, 6U), 1);  // within the margins
  EXPECT_EQ(std::ranges::count(found, 0U), 1);  // direct, always
}

// Candidates over the cost limit are not measured in full, except the cheapest that beats all within it.
TEST(Contenders, LeaveOutWhatIsOverALimitOfCost) {
  const std::vector<Candidate> candidates{candidate("direct", 0.3, 1.0), candidate("a", 0.1, 1.9),
                                          candidate("b", 0.05, 2.4), candidate("c", 0.04, 2.9),
                                          candidate("d", 0.02, 6.0)};
  const Limits limits{.max_error = {}, .max_cost = 2.0, .max_bytes = {}};
  EXPECT_EQ(contenders(candidates, limits, 0.1, 0.1), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(contenders(candidates, limits, 0.1, 0.25), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(contenders(candidates, {}, 0.1, 0.1), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

// Under any limit the choice among all is also that among the contenders, if errors and costs are exact.
TEST(Contenders, IncludeTheChoice) {
  std::vector<Candidate> candidates = front;
  for (int i = 0; i < 40; ++i)
    candidates.push_back(candidate("m" + std::to_string(i), 0.03 + 0.011 * ((i * 7) % 17), 1.2 + 0.13 * ((i * 5) % 23),
                                   0.0001, 100U * static_cast<unsigned>(1 + (i * 3) % 11)));
  for (const double limit : {0.02, 0.05, 0.09, 0.13, 0.5}) {
    const Limits all_limits[]{{.max_error = limit, .max_cost = {}, .max_bytes = {}},
                              {.max_error = {}, .max_cost = 1.0 + 10 * limit, .max_bytes = {}},
                              {.max_error = {}, .max_cost = {}, .max_bytes = static_cast<std::uint64_t>(5000 * limit)}};
    for (const Limits& limits : all_limits) {
      std::vector<Candidate> few;
      for (const std::size_t i : contenders(candidates, limits, 0.1, 0.1)) few.push_back(candidates[i]);
      EXPECT_EQ(chosen_of(few, limits), chosen_of(candidates, limits)) << limit;
    }
  }
}

TEST(Advice, SaysWhyAndHowSure) {
  MaterialAdvice advice{.material = "metal",
                        .distances = {1, 4},
                        .pixels = {500, 120},
                        .choice = choose(front, {.max_error = {}, .max_cost = 2.0, .max_bytes = {}}),
                        .closer_than_plain = std::array<double, 2>{0.6, 0.25},
                        .command = "footprint bake x --method lean -o maps",
                        .words = {},
                        .candidates = front};
  std::string text;
  for (const std::string& sentence : advice_sentences(advice, {.max_error = {}, .max_cost = 2.0, .max_bytes = {}}))
    text += sentence + "\n";
  for (const char* words : {"Use lean under trilinear", "0.08", "1.80", "500 at distance 1, 120 at distance 4",
                            "improves 60% of the pixels and worsens 25%", "tan_gmm"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in\n" << text;
}

}  // namespace
}  // namespace footprint
