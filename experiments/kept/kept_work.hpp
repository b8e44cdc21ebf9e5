// Finished parts of a run, kept in a folder by the hash of what they depend on, with the files that they wrote.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/kept/packed.hpp"

namespace footprint {

/// A folder of finished work: an item is `XY/KEY.done`, its files lie in `files/XY/` by the hash of their bytes, each
/// once. XY are the first digits of the hash, so that no folder of a large run is slow to search.
/// Everything appears whole or not at all, and is checked when it is read again: what is damaged, or names a file
/// outside of the folder of a run, counts as not there.
class KeptWork {
 public:
  /// `maker` names what made it and enters every key: the program and the renderer (maker_of_work). Nothing is written
  /// before the first item is. Errors (usage): `folder` is there and is no folder.
  /// `complete`: all of a run must be there, and nothing is made anew.
  KeptWork(std::filesystem::path folder, std::string maker, bool complete = false);

  /// A key of something: `kind` (letters) and a hash over the maker and `depends_on`.
  [[nodiscard]] std::string key(std::string_view kind, std::span<const std::string> depends_on) const;

  /// What is kept under `key`, its files put into `run_folder` under the names that they had; none where it is not
  /// there, is damaged, or a file of it is. Errors (machine): `run_folder` cannot be written.
  template <class T>
  [[nodiscard]] std::optional<T> find(const std::string& key, const std::filesystem::path& run_folder) const {
    const std::optional<Item> item = read(key);
    if (!item) return {};
    std::optional<T> value = unpacked<T>(item->value, key);
    if (!value || !put_files(*item, run_folder)) return {};
    if (used_.insert(key).second) ++found_;
    return value;
  }

  /// Keeps `value` and `files` of `run_folder` (relative to it) under `key`. Errors (machine): the folder cannot be
  /// written, the disk is full.
  template <class T>
  void keep(const std::string& key, T value, const std::filesystem::path& run_folder,
            const std::vector<std::string>& files = {}) const {
    write(key, packed(std::move(value), key), run_folder, files);
  }

  /// Whether there is an item of that key that can be read and whose files are there whole.
  [[nodiscard]] bool has_whole(const std::string& key) const;

  /// The keys of all items, sorted.
  [[nodiscard]] std::vector<std::string> keys() const;

  /// The keys that were found or kept through this object, sorted, and how many were found that it had not kept itself.
  [[nodiscard]] std::vector<std::string> used() const { return {used_.begin(), used_.end()}; }
  [[nodiscard]] std::size_t found() const { return found_; }

  /// Takes an item over from another folder. Errors (usage): it is missing or damaged there, naming the file.
  void take(const std::string& key, const KeptWork& from) const;

  /// For before anything is made. Errors (usage): it is said to be complete, and lacks something of `what`.
  void require_more_allowed(const std::string& what) const;

  /// Removes everything that is kept.
  void clear() const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const std::string& maker() const { return maker_; }

 private:
  struct KeptFile {
    std::string name, hash;
  };
  struct Item {
    std::vector<KeptFile> files;
    std::vector<std::uint8_t> value;
  };
  [[nodiscard]] std::filesystem::path item_path(const std::string& key) const;
  [[nodiscard]] std::filesystem::path file_path(const std::string& hash) const;
  [[nodiscard]] std::optional<Item> read(const std::string& key) const;
  [[nodiscard]] bool is_whole(const KeptFile& file) const;
  [[nodiscard]] bool put_files(const Item& item, const std::filesystem::path& run_folder) const;
  void write(const std::string& key, std::span<const std::uint8_t> value, const std::filesystem::path& run_folder,
             const std::vector<std::string>& files) const;

  std::filesystem::path folder_;
  std::string maker_;
  bool complete_;
  mutable std::set<std::string> used_;
  mutable std::size_t found_ = 0;
};

/// Who makes results: this very program's bytes, and what draws for it ("llvmpipe (LLVM 15.0.6, 256 bits)"), whose
/// pictures may differ.
[[nodiscard]] std::string maker_of_work(std::string_view renderer);

/// Whether a maker's program is this one, whatever drew for it.
[[nodiscard]] bool is_made_by_this_program(std::string_view maker);

}  // namespace footprint
