// Footprint filters as words: they are written as they are read, and unknown ones are reported.
#include "renderer/scene/footprint_filter.hpp"

#include <gtest/gtest.h>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

std::string complaint(const std::string& text) {
  try {
    (void)parse_footprint_filter(text, "--footprint");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "none";
}

TEST(FootprintFilter, IsWrittenAsItIsRead) {
  for (const FootprintFilterWord& word : footprint_filter_words()) {
    for (const int count : {word.least, word.most}) {
      for (const int depth : {finest_depth, 0, 12}) {
        if (depth != finest_depth && !word.stochastic) continue;
        const FootprintFilter filter{word.kind, count, depth};
        EXPECT_EQ(parse_footprint_filter(footprint_filter_text(filter), ""), filter) << footprint_filter_text(filter);
      }
    }
  }
  EXPECT_EQ(parse_footprint_filter("stochastic", ""), (FootprintFilter{FootprintFilterKind::stochastic, 1}));
  EXPECT_EQ(footprint_filter_text(default_footprint_filter), "anisotropic:8") << "as help and documents have it";
}

TEST(FootprintFilter, UnknownFiltersAreReportedWithTheValidOnes) {
  EXPECT_NE(complaint("anisotropc:8").find("anisotropic"), std::string::npos);
  EXPECT_NE(complaint("box").find("has no number"), std::string::npos);
  EXPECT_NE(complaint("trilinear:2").find("takes none"), std::string::npos);
  for (const char* const number : {"box:0", "box:9", "shaded:-1", "ewa:17", "anisotropic:99999999999", "stochastic:0",
                                   "stochastic:17", "stochastic:1:13", "stochastic_trilinear:1:-1"}) {
    EXPECT_NE(complaint(number), "none") << number;
  }
  for (const char* const text :
       {"box:", "box:2.5", "box:2 ", "box:two", "box:2:3", "stochastic:", "stochastic:1:", "stochastic:1:2:3"}) {
    EXPECT_NE(complaint(text).find("no whole number"), std::string::npos) << text;
  }
  EXPECT_NE(complaint("box:9").find("box:N (1 to 8)"), std::string::npos);
  EXPECT_NE(complaint("").find("--footprint"), std::string::npos);
}

}  // namespace
}  // namespace footprint
