// For tests: whether a text has some words.
#pragma once

#include <gtest/gtest.h>

#include <string_view>

namespace footprint::test {

/// Succeeds if `text` contains `expected`; a failure shows both.
[[nodiscard]] inline ::testing::AssertionResult says(std::string_view text, std::string_view expected) {
  if (text.find(expected) != std::string_view::npos) {
    return ::testing::AssertionSuccess() << "`" << text << "` says `" << expected << "`";
  }
  return ::testing::AssertionFailure() << "`" << text << "` does not say `" << expected << "`";
}

}  // namespace footprint::test
