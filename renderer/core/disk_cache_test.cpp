// Files stored between runs: they come back, the oldest are removed, and a folder without access causes no error.
// Damaged bytes are not read.
#include "renderer/core/disk_cache.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "tests/support/fresh_folder.hpp"

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

const std::vector<std::uint8_t> some_bytes{1, 2, 3, 0, 255};

// The stored bytes; empty without an entry.
std::vector<std::uint8_t> found(const DiskCache& cache, const std::string& key) {
  const std::optional<ByteSource> stored = cache.find(key);
  if (!stored) return {};
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(stored->size()));
  EXPECT_TRUE(stored->read(0, bytes));
  return bytes;
}

TEST(DiskCache, FindsWhatItStoredAndNothingElse) {
  const DiskCache cache(test::fresh_folder() / "cache");
  EXPECT_FALSE(cache.find("a"));
  cache.store("a", some_bytes);
  EXPECT_EQ(found(cache, "a"), some_bytes);
  EXPECT_FALSE(cache.find("b"));
}

TEST(DiskCache, AFileUnderAnothersNameIsNone) {
  const DiskCache cache(test::fresh_folder() / "cache");
  cache.store("one", some_bytes);
  cache.store("two", std::vector<std::uint8_t>{9});
  fs::copy_file(cache.folder() / "one.bake", cache.folder() / "two.bake", fs::copy_options::overwrite_existing);
  fs::copy_file(cache.folder() / "one.bake", cache.folder() / "three.bake");
  EXPECT_FALSE(cache.find("two"));
  EXPECT_FALSE(cache.find("three"));
  EXPECT_EQ(found(cache, "one"), some_bytes);
}

TEST(DiskCache, RelativeHomesAreNone) {
  const Variable own("FOOTPRINT_CACHE", ""), shared("XDG_CACHE_HOME", "cache"), home("HOME", "home");
  EXPECT_FALSE(default_cache_folder());
  const Variable absolute("HOME", "/home/someone");
  EXPECT_EQ(default_cache_folder(), fs::path("/home/someone/.cache/footprint"));
}

TEST(DiskCache, FolderThatIsAFileCostsNoError) {
  const fs::path file = test::fresh_folder() / "cache";
  std::ofstream(file) << "a file";
  const DiskCache cache(file);
  EXPECT_NO_THROW(cache.store("a", some_bytes));
  EXPECT_FALSE(cache.find("a"));
}

TEST(DiskCache, TheLeastRecentlyUsedGoes) {
  const DiskCache cache(test::fresh_folder() / "cache", 2 * some_bytes.size() + std::string("newold").size());
  cache.store("old", some_bytes);
  cache.store("new", some_bytes);
  const auto earlier = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(cache.folder() / "old.bake", earlier);
  fs::last_write_time(cache.folder() / "new.bake", earlier - std::chrono::hours(1));
  EXPECT_TRUE(cache.find("new"));  // used just now
  cache.store("third", some_bytes);
  EXPECT_FALSE(cache.find("old"));
  EXPECT_TRUE(cache.find("new"));
  EXPECT_TRUE(cache.find("third"));
}

TEST(DiskCache, WhatIsLargerThanTheFolderMayBeIsNotStored) {
  const DiskCache cache(test::fresh_folder() / "cache", some_bytes.size() - 1);
  cache.store("a", some_bytes);
  EXPECT_FALSE(cache.find("a"));
}

TEST(DiskCache, WhatIsHandedOverInPiecesComesBackInPieces) {
  const DiskCache cache(test::fresh_folder() / "cache");
  cache.store("a", 3, [](const ByteSink& out) {
    out(std::vector<std::uint8_t>{7, 8});
    out(std::vector<std::uint8_t>{9});
  });
  EXPECT_EQ(found(cache, "a"), (std::vector<std::uint8_t>{7, 8, 9}));
  const std::optional<ByteSource> stored = cache.find("a");
  ASSERT_TRUE(stored);
  std::vector<std::uint8_t> piece(2);
  EXPECT_TRUE(stored->read(1, piece));
  EXPECT_EQ(piece, (std::vector<std::uint8_t>{8, 9}));
  EXPECT_FALSE(stored->read(2, piece)) << "the key behind the bytes is not one of them";
  cache.store("a", some_bytes);
  EXPECT_TRUE(stored->read(0, piece)) << "replaced: what was opened stays";
  EXPECT_EQ(piece, (std::vector<std::uint8_t>{7, 8}));
}

TEST(DiskCache, WhatFailsHalfWayLeavesNothing) {
  const DiskCache cache(test::fresh_folder() / "cache");
  cache.store("a", 3, [](const ByteSink& out) {
    out(some_bytes);
    throw Error(ErrorKind::machine, "", "no space left");
  });
  EXPECT_FALSE(cache.find("a"));
  EXPECT_TRUE(fs::is_empty(cache.folder()));
}

TEST(ByteSource, OnlyRegularFilesAreRead) {
  const fs::path folder = test::fresh_folder();
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(ByteSource::of_file(folder / "pipe")) << "nor waited for";
  EXPECT_FALSE(ByteSource::of_file(folder));
  EXPECT_FALSE(ByteSource::of_file(folder / "nothing"));
}

TEST(ByteSource, AFileThatWasCutMeanwhileIsNotRead) {
  const fs::path file = test::fresh_folder() / "cache";
  std::ofstream(file) << "0123456789";
  const std::optional<ByteSource> bytes = ByteSource::of_file(file);
  ASSERT_TRUE(bytes);
  fs::resize_file(file, 4);
  std::vector<std::uint8_t> out(10);
  EXPECT_FALSE(bytes->read(0, out));
  EXPECT_TRUE(bytes->read(0, std::span(out).first(4)));
}

struct Numbers {
  int one = 0;
  std::string text{};
  std::vector<float> values{};
  bool operator==(const Numbers&) const = default;
};

struct MoreNumbers {
  Numbers numbers{};
  std::optional<int> more{};
};

std::vector<std::uint8_t> checksummed(std::string_view form, const auto& value) {
  std::vector<std::uint8_t> bytes;
  write_checksummed(form, value, appending_to(bytes));
  return bytes;
}

TEST(ChecksummedBytes, ValuesComeBackAndNothingIsLeft) {
  const Numbers numbers{7, "seven", {1.5F, -2.0F}};
  const std::vector<std::uint8_t> bytes = checksummed("numbers 1", numbers);
  EXPECT_EQ(read_checksummed<Numbers>("numbers 1", bytes), numbers);
  EXPECT_FALSE(read_checksummed<int>("numbers 1", bytes)) << "something is left";
  EXPECT_FALSE(read_checksummed<MoreNumbers>("numbers 1", bytes)) << "there is nothing more";
  EXPECT_FALSE(read_checksummed<Numbers>("numbers 2", bytes));
}

// Found by scripts/fuzz: any byte was taken for a bool.
TEST(ChecksummedBytes, AByteThatIsNeither0Nor1IsNoBool) {
  for (const int byte : {0, 1, 2, 115, 255}) {
    const std::vector<std::uint8_t> bytes = checksummed("bools 1", static_cast<std::uint8_t>(byte));
    const std::optional<bool> read = read_checksummed<bool>("bools 1", bytes);
    EXPECT_EQ(read.has_value(), byte <= 1) << byte;
    EXPECT_EQ(read.value_or(false), byte == 1) << byte;
  }
}

// Undefined bytes would make equal values differ.
TEST(ChecksummedBytes, StructuresWithGapsArePassedMemberByMember) {
  struct Gap {
    std::uint8_t small;
    std::uint32_t large;
  };
  struct Whole {
    std::uint32_t one;
    std::array<float, 2> two;
  };
  static_assert(passes_as_bytes<Whole>() && !passes_as_bytes<Gap>() && !passes_as_bytes<bool>() &&
                !passes_as_bytes<std::optional<int>>());
  EXPECT_EQ(checksummed("form", Whole{1, {}}).size() - checksummed("form", Gap{1, 2}).size(), 12U - 5U);
}

}  // namespace
}  // namespace footprint
