// For tests: folders for files that no other process uses.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace footprint::test {

/// The folder of this process among the temporary files. It is removed when the process ends; a fork of the process
/// leaves it. Throws std::filesystem::filesystem_error if it cannot be created.
[[nodiscard]] inline const std::filesystem::path& process_folder() {
  struct Folder {
    Folder() {
      std::string name = (std::filesystem::temp_directory_path() / "footprint_test_XXXXXX").string();
      if (::mkdtemp(name.data()) == nullptr) {
        throw std::filesystem::filesystem_error("mkdtemp", name, {errno, std::generic_category()});
      }
      path = name;
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
      std::error_code ignored;
      if (::getpid() == owner) std::filesystem::remove_all(path, ignored);
    }
    std::filesystem::path path;
    pid_t owner = ::getpid();
  };
  static const Folder folder;
  return folder.path;
}

/// An empty folder of the running test, `SUITE/TEST` in the folder of the process. A second call empties it again.
[[nodiscard]] inline std::filesystem::path fresh_folder() {
  const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
  std::filesystem::path folder = process_folder() / test.test_suite_name() / test.name();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace footprint::test
