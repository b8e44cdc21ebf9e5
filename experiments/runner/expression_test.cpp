// Claims as text: what parses, what it comes to by hand, and how anything else is refused.
#include "experiments/runner/expression.hpp"

#include <gtest/gtest.h>

#include <random>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

std::span<const Results> only(const Results& results) { return {&results, 1}; }

Record record_of(const std::string& method, int frame, double distance, double error, double ms) {
  Record record;
  record.method = method;
  record.frame = frame;
  record.distance = distance;
  record.error.emplace().normalized_color = error;
  record.error->psnr = 30;
  record.error->noise_floor = 0.01;
  record.other_references = {{.spp = 16, .normalized_color = 2 * error}};
  record.frame_ms.median = ms;
  record.precompute_bytes = 1024;
  record.equivalent = EquivalentSamples{64, CurveSide::above};
  if (frame > 0) record.flicker = Flicker{.mean = error / 2, .p99 = 3 * error};
  return record;
}

/// Two frames of two methods; `a` once more with an option.
Results two_frames() {
  Results results;
  results.records = {record_of("a", 0, 1, 0.1, 2),     record_of("b", 0, 1, 0.3, 3),
                     record_of("b:x=1", 0, 1, 0.5, 4), record_of("a", 1, 2.5, 0.2, 10),
                     record_of("b", 1, 2.5, 0.5, 5),   record_of("b:x=1", 1, 2.5, 0.7, 6)};
  return results;
}

double value_of(const std::string& text) {
  const Evaluation found = Expression(text, "here").evaluate(only(two_frames()));
  EXPECT_TRUE(found.value) << text << ": " << found.problem;
  return found.value.value_or(std::nan(""));
}

std::string complaint(const std::string& text) {
  try {
    const Expression expression(text, "here");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  ADD_FAILURE() << "`" << text << "` was taken";
  return {};
}

TEST(Expression, ArithmeticBindsAsItDoesOnPaper) {
  EXPECT_DOUBLE_EQ(value_of("1 + 2 * 3 - 4 / 2"), 5);
  EXPECT_DOUBLE_EQ(value_of("(1 + 2) * -3"), -9);
  EXPECT_DOUBLE_EQ(value_of("8 / 4 / 2"), 1);
  EXPECT_DOUBLE_EQ(value_of("10 - 4 - 3"), 3);
  EXPECT_DOUBLE_EQ(value_of("--2.5e-1"), 0.25);
  EXPECT_DOUBLE_EQ(value_of("abs(1 - 3)"), 2);
}

TEST(Expression, ACallIsTheMeanOverTheRecordsThatItSelects) {
  EXPECT_DOUBLE_EQ(value_of("error(a)"), 0.15);
  EXPECT_DOUBLE_EQ(value_of(" error( b ,  distance=2.5 ) "), 0.5);
  EXPECT_DOUBLE_EQ(value_of("error(b, frame=0)"), 0.3);
  EXPECT_DOUBLE_EQ(value_of("error(b:x=1)"), 0.6);
  EXPECT_DOUBLE_EQ(value_of("error(a, spp=16)"), 0.3);
  EXPECT_DOUBLE_EQ(value_of("error(a, frame=1, spp=16)"), 0.4);
  EXPECT_DOUBLE_EQ(value_of("time(a) / time(b)"), 1.5);
  EXPECT_DOUBLE_EQ(value_of("bytes(a)"), 1024);
  EXPECT_DOUBLE_EQ(value_of("psnr(a)"), 30);
}

TEST(Expression, RecordsWithoutTheFigureDoNotCount) {
  EXPECT_DOUBLE_EQ(value_of("flicker(a)"), 0.1);
  EXPECT_DOUBLE_EQ(value_of("flicker_p99(a)"), 0.6);
  EXPECT_EQ(Expression("flicker(a, frame=0)", "").evaluate(only(two_frames())).problem,
            "flicker(a, frame=0): no record has this figure");
  EXPECT_EQ(Expression("error(a, distance=7)", "").evaluate(only(two_frames())).problem,
            "error(a, distance=7): the run has no such record");
}

TEST(Expression, FiguresOfFootprintsAreMeansOverThem) {
  Results results = two_frames();
  results.ndf = {{"p", "a", 0.2, 1, 3, 4, ""}, {"q", "a", 0.6, 0.9, 5, 4, ""}, {"p", "b", 0.9, 1, 1, 1, ""}};
  EXPECT_DOUBLE_EQ(Expression("ndf_l2(a)", "").evaluate(only(results)).value.value(), 0.4);
  EXPECT_DOUBLE_EQ(Expression("ndf_peak(a, footprint=q)", "").evaluate(only(results)).value.value(), 5);
  EXPECT_NE(Expression("ndf_energy(b, footprint=q)", "").evaluate(only(results)).problem.find("no such footprint"),
            std::string::npos);
  EXPECT_NE(complaint("ndf_l2(a, distance=1)").find("known: footprint"), std::string::npos);
  EXPECT_NE(complaint("error(a, name=p)").find("selects nothing of error"), std::string::npos);
}

TEST(Expression, WhatIsRebuiltEachFrameIsTakenApartFromTheShading) {
  Results results = two_frames();
  for (Record& record : results.records) {
    record.frame_ms.median = 10;
    if (record.method == "a") record.frame_build_ms = 4.0, record.frame_build = BuildTiming::every_frame;
    record.precompute_bytes_per_texel = 12;
  }
  const auto value = [&](const std::string& text) { return Expression(text, "").evaluate(only(results)).value; };
  EXPECT_EQ(value("build(a)"), 4.0);
  EXPECT_EQ(value("shading(a)"), 6.0);
  EXPECT_EQ(value("total(a)"), 10.0);
  EXPECT_EQ(value("build(b)"), std::nullopt);
  EXPECT_EQ(value("total(b)"), 10.0);
  EXPECT_EQ(value("bytes_per_texel(a)"), 12.0);
  for (Record& record : results.records) {
    if (record.frame_build) record.frame_build = BuildTiming::reused;
  }
  EXPECT_EQ(value("shading(a)"), 10.0);
  EXPECT_EQ(value("total(a)"), 14.0);
}

TEST(Expression, PlainSupersamplingIsTimedByItsCountOfSamples) {
  Results results = two_frames();
  results.supersampling = {{1.0, 16, 0.1, {}, 20.0, "m"}, {1.0, 64, 0.0, {}, 80.0, "m"}, {2.5, 64, 0.0, {}, 40.0, "m"}};
  const auto value = [&](const std::string& text) { return Expression(text, "").evaluate(only(results)).value; };
  EXPECT_EQ(value("supersampling_time(a, spp=64)"), 60.0);
  EXPECT_EQ(value("supersampling_time(a, spp=64, distance=2.5)"), 40.0);
  EXPECT_EQ(value("supersampling_time(a, spp=16)"), 20.0);
  EXPECT_EQ(value("supersampling_time(a, spp=4)"), std::nullopt);
  EXPECT_EQ(value("supersampling_time(a)"), std::nullopt);
  EXPECT_NE(complaint("supersampling_time(a, frame=1)").find("selects nothing"), std::string::npos);
}

TEST(Expression, TimesOfSeveralMachinesAreNoFigureAndRatiosAre) {
  Results results = two_frames();
  for (Record& record : results.records) record.node = record.frame == 0 ? "one" : "two";
  results.supersampling = {{1.0, 16, 0.1, {}, 20.0, "one"}, {2.5, 16, 0.1, {}, 20.0, "two"}};
  const auto evaluated = [&](const std::string& text) { return Expression(text, "").evaluate(only(results)); };
  for (const char* const text : {"time(a)", "fps(a)", "shading(a)", "total(a)", "supersampling_time(a, spp=16)",
                                 "time(a, frame=0) / time(b, frame=1)"}) {
    EXPECT_FALSE(evaluated(text).value) << text;
    EXPECT_NE(evaluated(text).problem.find("taken on 2 machines (one, two)"), std::string::npos) << text;
  }
  for (const char* const text : {"time(a, frame=0)", "time(a, frame=0) / time(b, frame=0)", "ratio(a)", "error(a)",
                                 "supersampling_time(a, spp=16, distance=1)"})
    EXPECT_TRUE(evaluated(text).value) << text << ": " << evaluated(text).problem;
}

TEST(Expression, ABoundOfTheCurveCountsAsItsEnd) { EXPECT_DOUBLE_EQ(value_of("equivalent_spp(a)"), 64); }

TEST(Expression, ABakeFromTheCacheHasNoTime) {
  Results results = two_frames();
  for (Record& record : results.records) record.precompute_cached = true;
  EXPECT_NE(Expression("precompute(a)", "").evaluate(only(results)).problem.find("--no-cache"), std::string::npos);
}

TEST(Expression, DivisionByZeroIsAProblemNotAFigure) {
  const Evaluation found = Expression("1 / (error(a) - error(a))", "").evaluate(only(two_frames()));
  EXPECT_FALSE(found.value);
  EXPECT_NE(found.problem.find("division by 0"), std::string::npos);
}

TEST(Expression, AtTheNoiseFloorIsReported) {
  Results results = two_frames();
  for (Record& record : results.records) record.error->normalized_color = 0.005;
  EXPECT_TRUE(Expression("error(a)", "").evaluate(only(results)).calls.at(0).at_noise_floor);
  results.records[3].error->normalized_color = 0.5;  // one outlier among the frames of `a`
  EXPECT_FALSE(Expression("error(a)", "").evaluate(only(results)).calls.at(0).at_noise_floor);
}

TEST(Expression, FlickerHasANoiseFloorToo) {
  Results results = two_frames();
  for (Record& record : results.records) record.flicker = Flicker{.mean = 0.001, .p99 = 0.1, .noise_floor = 0.002};
  EXPECT_TRUE(Expression("flicker(a)", "").evaluate(only(results)).calls.at(0).at_noise_floor);
  EXPECT_FALSE(Expression("flicker_p99(a)", "").evaluate(only(results)).calls.at(0).at_noise_floor);
}

// A function's own name comes before the name of a column: the column `equivalent_spp` has no figure beyond the curve.
TEST(Expression, AFigureIsAlsoCalledByTheNameOfItsColumn) {
  EXPECT_EQ(Expression("edges_error(a)", "").text(), "edge_error(a)");
  EXPECT_EQ(Expression("psnr_db(a) - normalized_color_error(b, frame=1)", "").text(), "psnr(a) - error(b, frame=1)");
  EXPECT_EQ(value_of("normalized_color_error(a)"), value_of("error(a)"));
  EXPECT_EQ(Expression("equivalent_spp(a)", "").text(), "equivalent_spp(a)");
  EXPECT_DOUBLE_EQ(value_of("equivalent_spp(a)"), 64);
  EXPECT_NE(complaint("scene(a)").find("is not a function"), std::string::npos) << "a column of words";
}

TEST(Expression, TheStarIsAMethod) {
  EXPECT_EQ(Expression("abs(error(*) - error(a))", "").with_method("b").text(), "abs(error(b) - error(a))");
}

// Read again, the text of an expression is worth the same.
TEST(Expression, TextKeepsItsParentheses) {
  for (const char* text : {"-(1 - 3)", "2 - (3 - 4)", "-(-5)", "8 / (2 * 4)", "-2 * 3 + abs(-(1 + 1))"}) {
    const Expression expression(text, "");
    const Expression again(expression.text(), "again");
    EXPECT_EQ(again.evaluate({}).value, expression.evaluate({}).value) << text << " became " << expression.text();
  }
}

TEST(Expression, WhatIsWrongIsNamedWithItsColumn) {
  EXPECT_NE(complaint("eror(a)").find("here, column 1: `eror` is not a function (did you mean `error`?"),
            std::string::npos);
  EXPECT_NE(complaint("1 + ").find("column 5"), std::string::npos);
  EXPECT_NE(complaint("1 + (2 * 3").find("`)` is missing"), std::string::npos);
  EXPECT_NE(complaint("error(a) error(b)").find("column 10"), std::string::npos);
  EXPECT_NE(complaint("error()").find("a method is missing"), std::string::npos);
  EXPECT_NE(complaint("error(a, distanse=1)").find("did you mean `distance`"), std::string::npos);
  EXPECT_NE(complaint("error(a, distance=near)").find("`distance=near` is not a value"), std::string::npos);
  EXPECT_NE(complaint("error(a, distance=1, distance=2)").find("second"), std::string::npos);
  EXPECT_NE(complaint("error(a, spp=0)").find("`spp=0` is not a value"), std::string::npos);
  EXPECT_NE(complaint("psnr(a, spp=16)").find("`spp=16` selects nothing of psnr"), std::string::npos);
  EXPECT_NE(complaint("error(a) < 1").find("`<` does not belong here"), std::string::npos);
  EXPECT_NE(complaint("1e999").find("a number"), std::string::npos);
  EXPECT_NE(complaint(std::string(300, '(')).find("nested too deeply"), std::string::npos);
  EXPECT_NE(complaint(std::string(300, '-') + "1").find("nested too deeply"), std::string::npos);
  EXPECT_NE(complaint(std::string(5000, ' ')).find("longer than"), std::string::npos);
}

TEST(Expression, AMethodIsTakenByItsTextElseByItsNameWhereThatIsClear) {
  const std::vector<std::string> methods{"a", "b:x=1", "b:x=2", "c:y=3"};
  EXPECT_EQ(select_method("a", methods), 0U);
  EXPECT_EQ(select_method("c", methods), 3U);
  EXPECT_EQ(select_method("b:x=2", methods), 2U);
  EXPECT_THROW((void)select_method("b", methods), Error);
  try {
    (void)select_method("b:x=3", methods);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean `b:x="), std::string::npos) << error.what();
  }
}

TEST(Inequality, ComparesItsSides) {
  const Inequality claim("error(a) <= 0.5 * error(b)", "here");
  EXPECT_DOUBLE_EQ(claim.left.evaluate(only(two_frames())).value.value(), 0.15);
  EXPECT_DOUBLE_EQ(claim.right.evaluate(only(two_frames())).value.value(), 0.2);
  EXPECT_TRUE(claim.is_true(1, 1));
  EXPECT_FALSE(claim.is_true(2, 1));
  EXPECT_FALSE(Inequality("1 < 1", "").is_true(1, 1));
  EXPECT_TRUE(Inequality("1 >= 1", "").is_true(1, 1));
  EXPECT_FALSE(Inequality("1 > 1", "").is_true(1, 1));
  EXPECT_THROW(Inequality("error(a)", "here"), Error);
  EXPECT_THROW(Inequality("1 < 2 < 3", "here"), Error);
}

// The parser ends with a tree or with one error for any text.
TEST(Expression, RandomTextIsTakenOrRefused) {
  std::mt19937 random(1);
  const std::vector<std::string> pieces{"error", "(", ")",   "a",    ",",       "spp=",      "16",
                                        "+",     "-", "*",   "/",    "<",       "1e5",       "=",
                                        ".",     " ", "abs", "\xff", "frame=1", "distance=", "time(a)"};
  std::uniform_int_distribution<std::size_t> piece(0, pieces.size() - 1);
  std::uniform_int_distribution<int> length(0, 12);
  int taken = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (int left = length(random); left > 0; --left) text += pieces[piece(random)];
    try {
      const Expression expression(text, "random");
      (void)Expression(expression.text(), "again");
      ++taken;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage) << text;
    }
  }
  EXPECT_GT(taken, 100);
}

}  // namespace
}  // namespace footprint
