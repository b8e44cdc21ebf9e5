// For tests: an empty folder for the files of the running test.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace footprint::test {

/// `footprint_SUITE/TEST` under GTest's folder for temporary files, made anew.
[[nodiscard]] inline std::filesystem::path fresh_folder() {
  const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
  std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / (std::string("footprint_") + test.test_suite_name()) / test.name();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace footprint::test
