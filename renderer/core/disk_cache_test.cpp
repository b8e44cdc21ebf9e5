// Files kept between runs: what was kept comes back, the oldest go, and a folder that refuses costs no error. And the
// bytes in them: what is damaged is not read.
#include "renderer/core/disk_cache.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "renderer/core/sealed_bytes.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

// An environment variable for the time of a test.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* const before = std::getenv(name)) before_ = before;
    ::setenv(name, value, 1);
  }
  ~Variable() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

fs::path fresh_folder(const std::string& name) {
  fs::path folder = fs::path(::testing::TempDir()) / ("footprint_disk_cache_" + name);
  fs::remove_all(folder);
  return folder;
}

const std::vector<std::uint8_t> some_bytes{1, 2, 3, 0, 255};

TEST(DiskCache, FindsWhatItKeptAndNothingElse) {
  const DiskCache cache(fresh_folder("find"));
  EXPECT_TRUE(cache.find("a").empty());
  cache.keep("a", some_bytes);
  EXPECT_EQ(cache.find("a"), some_bytes);
  EXPECT_TRUE(cache.find("b").empty());
}

TEST(DiskCache, AFileUnderAnothersNameIsNone) {
  const DiskCache cache(fresh_folder("foreign"));
  cache.keep("one", some_bytes);
  cache.keep("two", std::vector<std::uint8_t>{9});
  fs::copy_file(cache.folder() / "one.bake", cache.folder() / "two.bake", fs::copy_options::overwrite_existing);
  fs::copy_file(cache.folder() / "one.bake", cache.folder() / "three.bake");
  EXPECT_TRUE(cache.find("two").empty());
  EXPECT_TRUE(cache.find("three").empty());
  EXPECT_EQ(cache.find("one"), some_bytes);
}

TEST(DiskCache, RelativeHomesAreNone) {
  const Variable own("FOOTPRINT_CACHE", ""), shared("XDG_CACHE_HOME", "cache"), home("HOME", "home");
  EXPECT_FALSE(default_cache_folder());
  const Variable absolute("HOME", "/home/someone");
  EXPECT_EQ(default_cache_folder(), fs::path("/home/someone/.cache/footprint"));
}

TEST(DiskCache, FolderThatIsAFileCostsNoError) {
  const fs::path file = fresh_folder("closed");
  std::ofstream(file) << "a file";
  const DiskCache cache(file);
  EXPECT_NO_THROW(cache.keep("a", some_bytes));
  EXPECT_TRUE(cache.find("a").empty());
}

TEST(DiskCache, TheLeastRecentlyUsedGoes) {
  const DiskCache cache(fresh_folder("room"), 2 * some_bytes.size() + std::string("newold").size());
  cache.keep("old", some_bytes);
  cache.keep("new", some_bytes);
  const auto earlier = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(cache.folder() / "old.bake", earlier);
  fs::last_write_time(cache.folder() / "new.bake", earlier - std::chrono::hours(1));
  EXPECT_FALSE(cache.find("new").empty());  // used just now
  cache.keep("third", some_bytes);
  EXPECT_TRUE(cache.find("old").empty());
  EXPECT_FALSE(cache.find("new").empty());
  EXPECT_FALSE(cache.find("third").empty());
}

TEST(DiskCache, WhatIsLargerThanTheFolderMayBeIsNotKept) {
  const DiskCache cache(fresh_folder("large"), some_bytes.size() - 1);
  cache.keep("a", some_bytes);
  EXPECT_TRUE(cache.find("a").empty());
}

TEST(SealedBytes, ValuesComeBackAndNothingIsLeft) {
  SealedWriter out("numbers 1");
  out.add(7);
  out.add_text("seven");
  out.add_values(std::vector<float>{1.5F, -2.0F});
  const std::vector<std::uint8_t> bytes = std::move(out).seal();
  std::optional<SealedReader> in = SealedReader::open(bytes, "numbers 1");
  ASSERT_TRUE(in);
  EXPECT_EQ(in->get<int>(), 7);
  EXPECT_EQ(in->get_text(), "seven");
  EXPECT_FALSE(in->finished());
  EXPECT_EQ(in->get_values<float>(), (std::vector<float>{1.5F, -2.0F}));
  EXPECT_TRUE(in->finished());
  EXPECT_EQ(in->get<int>(), 0) << "there is nothing more";
  EXPECT_FALSE(in->finished());
  EXPECT_FALSE(SealedReader::open(bytes, "numbers 2"));
}

// Found by scripts/fuzz: any byte was taken for a bool.
TEST(SealedBytes, AByteThatIsNeither0Nor1IsNoBool) {
  for (const int byte : {0, 1, 2, 115, 255}) {
    SealedWriter out("bools 1");
    out.add(static_cast<std::uint8_t>(byte));
    const std::vector<std::uint8_t> bytes = std::move(out).seal();
    std::optional<SealedReader> in = SealedReader::open(bytes, "bools 1");
    ASSERT_TRUE(in);
    EXPECT_EQ(in->get<bool>(), byte == 1) << byte;
    EXPECT_EQ(in->finished(), byte <= 1) << byte;
  }
}

}  // namespace
}  // namespace footprint
