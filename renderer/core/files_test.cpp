// Files and folders appear whole or not at all, also on a full disk and where nothing may be written.
#include "renderer/core/files.hpp"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>

#include "renderer/core/error.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;
using test::fresh_folder;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    names.push_back(entry.path().lexically_relative(folder).string());
  }
  std::ranges::sort(names);
  return names;
}

// The error that `action` ends in; fails the test if there is none.
Error error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return {ErrorKind::check, {}, {}};
}

void expect_error(const Error& error, ErrorKind kind, const fs::path& place, const std::string& reason) {
  EXPECT_EQ(error.kind(), kind) << error.what();
  EXPECT_NE(error.place().find(place.string()), std::string::npos) << error.what();
  EXPECT_NE(error.message().find(reason), std::string::npos) << error.what();
  EXPECT_FALSE(error.hint().empty()) << error.what();
}

using Names = std::vector<std::string>;

TEST(WriteFile, WritesAndReplaces) {
  const fs::path folder = fresh_folder();
  write_file_atomically(folder / "a.txt", "first");
  EXPECT_EQ(text_of(folder / "a.txt"), "first");
  write_file_atomically(folder / "a.txt", std::vector<std::uint8_t>{'x', 0, 'y'});
  EXPECT_EQ(text_of(folder / "a.txt"), std::string("x\0y", 3));
  write_file_atomically(folder / "empty", "");
  EXPECT_EQ(names_in(folder), (Names{"a.txt", "empty"}));
}

TEST(WriteFile, HasThePermissionsOfAnyNewFile) {
  const fs::path folder = fresh_folder();
  std::ofstream(folder / "plain") << "x";
  write_file_atomically(folder / "atomic", "x");
  EXPECT_EQ(fs::status(folder / "atomic").permissions(), fs::status(folder / "plain").permissions());
}

TEST(WriteFile, NextToAStrangersPartialFile) {
  const fs::path folder = fresh_folder();
  const std::string partial = ".a.txt.partial-" + std::to_string(::getpid());
  std::ofstream(folder / partial) << "not ours";
  write_file_atomically(folder / "a.txt", "text");
  EXPECT_EQ(names_in(folder), (Names{partial, "a.txt"}));
  EXPECT_EQ(text_of(folder / partial), "not ours");
}

TEST(WriteFile, InAFolderThatIsNotThere) {
  const fs::path file = fresh_folder() / "absent" / "a.txt";
  expect_error(error_of([&] { write_file_atomically(file, "x"); }), ErrorKind::machine, file, "No such file");
}

TEST(WriteFile, InAFileInPlaceOfAFolder) {
  const fs::path folder = fresh_folder();
  std::ofstream(folder / "file") << "x";
  const fs::path file = folder / "file" / "a.txt";
  expect_error(error_of([&] { write_file_atomically(file, "x"); }), ErrorKind::machine, file, "Not a directory");
}

TEST(WriteFile, NeverReplacesAFolderOrADevice) {
  const fs::path folder = fresh_folder();
  expect_error(error_of([&] { write_file_atomically(folder, "x"); }), ErrorKind::usage, folder, "is a folder");
  expect_error(error_of([] { write_file_atomically("/dev/full", "x"); }), ErrorKind::usage, "/dev/full",
               "regular file");
  expect_error(error_of([&] { write_file_atomically(folder / "", "x"); }), ErrorKind::usage, folder, "is a folder");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  expect_error(error_of([&] { write_file_atomically(folder / "pipe", "x"); }), ErrorKind::usage, folder,
               "regular file");
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

// A file-size limit fails in the middle of a write as a full disk does, and needs no privilege.
TEST(WriteFile, PastTheFileSizeLimitTheOldFileStays) {
  const fs::path folder = fresh_folder();
  write_file_atomically(folder / "a.txt", "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1 << 16, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const Error error = error_of([&] { write_file_atomically(folder / "a.txt", std::string(1 << 20, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  expect_error(error, ErrorKind::machine, folder / "a.txt", "File too large");
  EXPECT_EQ(names_in(folder), Names{"a.txt"});
  EXPECT_EQ(text_of(folder / "a.txt"), "old");
}

TEST(WriteFile, OnAFullDiskNothingIsLeft) {
  const fs::path folder = fresh_folder();
  if (::mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=64k") != 0) GTEST_SKIP() << "mounting needs privileges";
  const Error error = error_of([&] { write_file_atomically(folder / "a.txt", std::string(1 << 20, 'x')); });
  const Names left = names_in(folder);
  write_file_atomically(folder / "small.txt", "fits");
  const std::string small = text_of(folder / "small.txt");
  ASSERT_EQ(::umount(folder.c_str()), 0);
  expect_error(error, ErrorKind::machine, folder / "a.txt", "No space left");
  EXPECT_NE(error.hint().find("space"), std::string::npos);
  EXPECT_TRUE(left.empty());
  EXPECT_EQ(small, "fits");
}

TEST(OutputFolder, AppearsAtTheCommit) {
  const fs::path folder = fresh_folder();
  OutputFolder output(folder / "out");
  EXPECT_EQ(output.path().parent_path(), folder);
  EXPECT_TRUE(output.path().filename().string().starts_with(".out.partial-"));
  fs::create_directory(output.path() / "images");
  write_file_atomically(output.path() / "images" / "a.png", "a");
  write_file_atomically(output.path() / "index.html", "i");
  EXPECT_FALSE(fs::exists(folder / "out"));
  output.commit();
  EXPECT_EQ(names_in(folder), (Names{"out", "out/images", "out/images/a.png", "out/index.html"}));
}

TEST(OutputFolder, WithoutACommitNothingIsLeft) {
  const fs::path folder = fresh_folder();
  {
    const OutputFolder output(folder / "new" / "deep" / "out");
    write_file_atomically(output.path() / "a", "a");
    EXPECT_TRUE(fs::exists(folder / "new" / "deep"));
  }
  EXPECT_TRUE(names_in(folder).empty());
}

TEST(OutputFolder, WithoutACommitAnExistingFolderIsAsItWas) {
  const fs::path folder = fresh_folder();
  std::ofstream(folder / "index.html") << "old";
  {
    const OutputFolder output(folder);
    write_file_atomically(output.path() / "index.html", "new");
    EXPECT_EQ(text_of(folder / "index.html"), "old");
  }
  EXPECT_EQ(names_in(folder), Names{"index.html"});
  EXPECT_EQ(text_of(folder / "index.html"), "old");
}

TEST(OutputFolder, KeepsWhatItDidNotWrite) {
  const fs::path folder = fresh_folder();
  fs::create_directories(folder / "images" / "mine");
  std::ofstream(folder / "notes.txt") << "mine";
  std::ofstream(folder / "images" / "mine" / "b.png") << "mine";
  std::ofstream(folder / "index.html") << "old";
  OutputFolder output(folder);
  fs::create_directory(output.path() / "images");
  fs::create_directory(output.path() / "extra");
  write_file_atomically(output.path() / "images" / "a.png", "a");
  write_file_atomically(output.path() / "index.html", "new");
  output.commit();
  EXPECT_EQ(names_in(folder),
            (Names{"extra", "images", "images/a.png", "images/mine", "images/mine/b.png", "index.html", "notes.txt"}));
  EXPECT_EQ(text_of(folder / "index.html"), "new");
  EXPECT_EQ(text_of(folder / "notes.txt"), "mine");
}

// What an earlier run of the same kind wrote, and this one did not.
TEST(OutputFolder, RemovesWhatItReplacesAndNothingElse) {
  const fs::path folder = fresh_folder();
  const fs::path out = folder / "out";
  fs::create_directories(out / "images" / "kept");
  for (const char* name : {"images/old.png", "images/new.png", "images/mine.png", "results.json", "../outside"})
    std::ofstream(out / name) << "before";
  {
    OutputFolder output(out);
    fs::create_directory(output.path() / "images");
    write_file_atomically(output.path() / "images" / "new.png", "now");
    output.replaces({"images/old.png", "images/new.png", "images/kept", "images/absent", "../outside",
                     folder / "outside", "images/../../outside"});
    EXPECT_TRUE(fs::exists(out / "images" / "old.png"));
    output.commit();
  }
  EXPECT_EQ(names_in(folder), (Names{"out", "out/images", "out/images/kept", "out/images/mine.png",
                                     "out/images/new.png", "out/results.json", "outside"}));
  EXPECT_EQ(text_of(out / "images" / "new.png"), "now");
}

// A child that is killed in the midst of what `work` does.
template <class Work>
void kill_within(Work work, std::chrono::microseconds after) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    work();
    ::pause();
  }
  std::this_thread::sleep_for(after);
  ::kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
}

TEST(OutputFolder, WhatAKilledProcessLeftIsRemovedByTheNext) {
  const fs::path folder = fresh_folder();
  fs::create_directory(folder / "there");
  const auto begin = [&] {
    static const OutputFolder absent(folder / "new"), there(folder / "there");
    std::ofstream(absent.path() / "a") << "a";
  };
  kill_within(begin, std::chrono::milliseconds(100));
  EXPECT_EQ(names_in(folder).size(), 4U);                  // two hidden folders, one with a file in it
  const std::string stranger = ".new.partial-1-00000000";  // of another machine
  fs::create_directory(folder / stranger);
  fs::create_directory(folder / (".other.partial-" + std::to_string(::getpid())));
  OutputFolder(folder / "new").commit();
  OutputFolder(folder / "there").commit();
  EXPECT_EQ(names_in(folder), (Names{stranger, ".other.partial-" + std::to_string(::getpid()), "new", "there"}));
}

// Twenty points of the move: the files below are all of one run, and the list on top is of that run, or there is none.
TEST(OutputFolder, AKillInTheMoveMixesNoRuns) {
  const fs::path folder = fresh_folder();
  constexpr int files = 150;
  const auto write_run = [&](const std::string& word, const auto& before_commit) {
    OutputFolder output(folder / "out");
    fs::create_directory(output.path() / "images");
    for (int i = 0; i < files; ++i) std::ofstream(output.path() / "images" / std::to_string(i)) << word;
    std::ofstream(output.path() / "results.json") << word;
    before_commit();
    output.commit();
  };
  int between = 0;  // kills after the first step and before the last
  for (int round = 0; round < 20 || (between == 0 && round < 200); ++round) {
    write_run("old", [] {});
    std::ofstream(folder / "go") << "";
    const auto work = [&] {
      write_run("new", [&] { fs::remove(folder / "go"); });
      ::_exit(0);
    };
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) work();
    while (fs::exists(folder / "go")) {
    }
    // Every other kill waits for the first step, because how long the steps before it take depends on the build.
    const auto has_begun = [&] { return text_of(folder / "out" / "results.json") != "old"; };
    while (round % 2 == 1 && !has_begun()) {
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200 * (round % 20)));
    ::kill(child, SIGKILL);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    int renewed = 0;
    for (int i = 0; i < files; ++i) renewed += text_of(folder / "out" / "images" / std::to_string(i)) == "new" ? 1 : 0;
    EXPECT_TRUE(renewed == 0 || renewed == files) << round << ": " << renewed;
    if (!fs::exists(folder / "out" / "results.json")) {
      ++between;
      continue;
    }
    EXPECT_EQ(renewed, text_of(folder / "out" / "results.json") == "new" ? files : 0) << round;
  }
  EXPECT_GT(between, 0) << "no kill met the move: wait in other steps";
}

// A second run may end first.
TEST(OutputFolder, TwoAtOnceMerge) {
  const fs::path folder = fresh_folder();
  OutputFolder first(folder / "out"), second(folder / "out");
  EXPECT_NE(first.path(), second.path());
  write_file_atomically(first.path() / "a", "a");
  write_file_atomically(second.path() / "b", "b");
  first.commit();
  second.commit();
  EXPECT_EQ(names_in(folder), (Names{"out", "out/a", "out/b"}));
}

TEST(OutputFolder, ConflictsAreFoundBeforeAnythingIsMoved) {
  const fs::path folder = fresh_folder();
  fs::create_directory(folder / "b");
  {
    OutputFolder output(folder);
    write_file_atomically(output.path() / "a", "a");
    write_file_atomically(output.path() / "b", "b");
    expect_error(error_of([&] { output.commit(); }), ErrorKind::machine, folder / "b", "is a folder");
  }
  EXPECT_EQ(names_in(folder), Names{"b"});
  {
    OutputFolder output(folder / "b");
    std::ofstream(folder / "b" / "images") << "a file";
    fs::create_directory(output.path() / "images");
    expect_error(error_of([&] { output.commit(); }), ErrorKind::machine, folder / "b" / "images", "is a file");
  }
}

TEST(OutputFolder, APathThatIsNoFolder) {
  const fs::path folder = fresh_folder();
  std::ofstream(folder / "file") << "x";
  expect_error(error_of([&] { OutputFolder(folder / "file"); }), ErrorKind::usage, folder / "file", "not a folder");
  fs::create_symlink(folder / "nowhere", folder / "link");
  expect_error(error_of([&] { OutputFolder(folder / "link"); }), ErrorKind::usage, folder / "link", "link to nothing");
  expect_error(error_of([] { OutputFolder{fs::path()}; }), ErrorKind::usage, "", "no name");
  expect_error(error_of([] { OutputFolder("/"); }), ErrorKind::usage, "/", "not an output folder");
  EXPECT_EQ(names_in(folder), (Names{"file", "link"}));
}

TEST(OutputFolder, AParentThatCannotBeCreated) {
  const fs::path folder = fresh_folder();
  std::ofstream(folder / "file") << "x";
  const fs::path below = folder / "file" / "deep" / "out";
  expect_error(error_of([&] { OutputFolder{below}; }), ErrorKind::machine, folder / "file", "Not a directory");
  expect_error(error_of([] { OutputFolder("/proc/footprint/out"); }), ErrorKind::machine, "/proc", "cannot be created");
}

TEST(OutputFolder, AStagingFolderThatCannotBeCreatedLeavesNoParents) {
  const fs::path folder = fresh_folder();
  const fs::path too_long = folder / "new" / "deep" / std::string(250, 'x');
  expect_error(error_of([&] { OutputFolder{too_long}; }), ErrorKind::machine, too_long, "name too long");
  EXPECT_TRUE(names_in(folder).empty());
}

TEST(OutputFolder, AnExistingFolderThatCannotBeWritten) {
  if (::geteuid() == 0) {
    expect_error(error_of([] { OutputFolder("/proc"); }), ErrorKind::machine, "/proc", "cannot be created");
    return;
  }
  const fs::path folder = fresh_folder();
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  expect_error(error_of([&] { OutputFolder{folder}; }), ErrorKind::machine, folder, "Permission denied");
  fs::permissions(folder, fs::perms::owner_all);
}

TEST(OutputFolder, TrailingSlashesAndDotsNameTheSameFolder) {
  const fs::path folder = fresh_folder();
  for (const std::string name : {"a/", "./b/../c", "d/."}) {
    OutputFolder output(folder / name);
    write_file_atomically(output.path() / "x", "x");
    output.commit();
  }
  EXPECT_EQ(names_in(folder), (Names{"a", "a/x", "c", "c/x", "d", "d/x"}));
}

// The parent of a mount point is on another disk, where nothing can be renamed from.
TEST(OutputFolder, AMountPointIsFilledFromInside) {
  const fs::path folder = fresh_folder();
  if (::mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=64k") != 0) GTEST_SKIP() << "mounting needs privileges";
  {
    OutputFolder output(folder);
    write_file_atomically(output.path() / "a", "a");
    output.commit();
  }
  const Names names = names_in(folder);
  ASSERT_EQ(::umount(folder.c_str()), 0);
  EXPECT_EQ(names, Names{"a"});
}

}  // namespace
}  // namespace footprint
