// File name parts: what no file system takes is gone, and no two names meet.
#include "renderer/core/names.hpp"

#include <gtest/gtest.h>

namespace footprint {
namespace {

TEST(FileNames, KeepNoCharacterThatIsNotTakenEverywhere) {
  EXPECT_EQ(file_stem("a-b_c.9"), "a-b_c.9");
  EXPECT_EQ(file_stem("a b/c:d\\é"), "a_b_c_d___");
}

TEST(FileNames, AreDifferentOfDifferentNames) {
  EXPECT_EQ(distinct_stems({"metal", "a/b", "a:b", "Metal"}),
            (std::vector<std::string>{"metal", "a_b", "a_b.2", "Metal.3"}));
  EXPECT_EQ(distinct_stems({"", "..", ".x", "_"}), (std::vector<std::string>{"_", "_..", "_.x", "_.3"}));
}

TEST(Names, ThatOccurTwiceAreToldApart) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(told_apart({"a", "b", "a"}), (Names{"a [0]", "b", "a [2]"}));
  EXPECT_EQ(told_apart({"a", "a", "a [1]"}), (Names{"a [0]", "a [1] [1]", "a [1]"}));
  EXPECT_EQ(told_apart({"a", "A"}), (Names{"a", "A"}));
  EXPECT_TRUE(told_apart({}).empty());
}

TEST(FileNames, AreNotTooLong) {
  const auto stems = distinct_stems({std::string(5000, 'x'), std::string(5001, 'x')});
  EXPECT_LT(stems[1].size(), 200U);
  EXPECT_NE(stems[0], stems[1]);
}

}  // namespace
}  // namespace footprint
