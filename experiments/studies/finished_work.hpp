// The finished parts of a run: views as plain values, which remain once their images are written, the results that they
// make, and their store on disk, from which an interrupted run resumes and of which `merge` makes one run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/run_folder.hpp"
#include "renderer/scene/scene.hpp"
#include "results/report/json_archive.hpp"
#include "results/report/record_fields.hpp"

namespace footprint {

/// A folder with a JSON file per part, FOLDER/RUN/NAME.json, and the files that the part wrote, below FOLDER/RUN/. RUN
/// is the fingerprint of a run (run_fingerprint), NAME says which part. Both appear whole or not at all. A part that is
/// damaged, or a file of which is damaged or missing, counts as unfinished.
class FinishedWork {
 public:
  /// folder: created with the first part.
  /// maker: program and renderer (maker_of_work); a part of every fingerprint.
  /// complete: all parts must be there, and nothing may be measured.
  /// Errors (usage): `folder` exists and is not a folder.
  FinishedWork(std::filesystem::path folder, std::string maker, bool complete = false);

  /// Reads a part and puts its files into `output` under the names that they had.
  /// key: RUN/NAME.
  /// Returns nothing if the part is not finished. A file that cannot be put into `output` is a loss of it.
  template <class T>
  [[nodiscard]] std::optional<T> find(const std::string& key, const RunFolder& output) const {
    const Json part = read(key);
    if (part.is_null()) return {};
    try {
      T value = from_json_value<T>(part["value"]);
      put_files(key, part, output);
      if (used_.insert(key).second) ++reused_;
      return value;
    } catch (const nlohmann::json::exception&) {
      return {};
    } catch (const Error&) {
      return {};
    }
  }

  /// Stores a part and the `files` of `output` (relative to it) that belong to it.
  /// Errors (machine): the folder cannot be written, the disk is full.
  template <class T>
  void store(const std::string& key, const T& value, const std::filesystem::path& output,
             const std::vector<std::string>& files = {}) const {
    write(key, to_json_value(value), output, files);
  }

  /// The keys that were found or stored through this object, sorted, and how many of them an earlier run had stored.
  [[nodiscard]] std::vector<std::string> used() const { return {used_.begin(), used_.end()}; }
  [[nodiscard]] std::size_t reused() const { return reused_; }

  /// Copies a part from another folder. Errors (usage): the part is missing or damaged there.
  void take(const std::string& key, const FinishedWork& from) const;

  /// Errors (usage): the work must be complete, and something of the `scene` is missing.
  void require_more_allowed(const std::string& scene) const;

  /// Removes all parts.
  void clear() const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const std::string& maker() const { return maker_; }
  /// Whether all parts must be there (`complete`).
  [[nodiscard]] bool is_complete() const { return complete_; }

 private:
  using Json = nlohmann::ordered_json;
  [[nodiscard]] std::filesystem::path path_of(const std::string& key) const;
  [[nodiscard]] std::filesystem::path run_folder(const std::string& key) const;
  /// Its value, and its files with their hashes; null: it is not there, or not whole.
  [[nodiscard]] Json read(const std::string& key) const;
  void put_files(const std::string& key, const Json& part, const RunFolder& output) const;
  void write(const std::string& key, Json value, const std::filesystem::path& output,
             const std::vector<std::string>& files) const;

  std::filesystem::path folder_;
  std::string maker_;
  bool complete_;
  mutable std::set<std::string> used_;  // what a run has found or stored is a log, not a part of the folder's value
  mutable std::size_t reused_ = 0;
};

/// The finished parts of one run.
class KeptParts {
 public:
  /// work: null: nothing is found, and nothing is stored.
  /// run: its fingerprint.
  /// folder: of the output, where the files of parts are.
  KeptParts(const FinishedWork* work, std::string run, RunFolder folder)
      : work_(work), run_(std::move(run)), folder_(std::move(folder)) {}

  /// Finds a part (FinishedWork::find).
  template <class T>
  [[nodiscard]] std::optional<T> find(const std::string& part) const {
    if (work_ == nullptr) return {};
    return work_->find<T>(key_of(part), folder_);
  }

  /// Stores a part (FinishedWork::store); one that cannot be stored is a loss of the folder.
  template <class T>
  void store(const std::string& part, const T& value, const std::vector<std::string>& files = {}) const {
    if (work_ != nullptr) folder_.attempt(part, [&] { work_->store(key_of(part), value, folder_.path(), files); });
  }

  /// Returns the part, or else what `make()` returns, which it stores.
  template <class Make>
  [[nodiscard]] auto kept(const std::string& part, Make make) const {
    using T = decltype(make());
    if (auto found = find<T>(part)) return *std::move(found);
    T made = make();
    store(part, made);
    return made;
  }

  [[nodiscard]] const std::string& run() const { return run_; }
  /// Whether all parts must be there.
  [[nodiscard]] bool is_complete() const { return work_ != nullptr && work_->is_complete(); }

 private:
  [[nodiscard]] std::string key_of(const std::string& part) const { return run_ + "/" + part; }

  const FinishedWork* work_;
  std::string run_;
  RunFolder folder_;
};

/// The program and the renderer of an OpenGL context, for example "llvmpipe (LLVM 15.0.6, 256 bits)": images of another
/// program or renderer may differ, so its work is not reused.
[[nodiscard]] std::string maker_of_work(std::string_view renderer);

/// Whether this program, with any renderer, is that maker.
[[nodiscard]] bool is_made_by_this_program(std::string_view maker);

/// A hash of the content of a scene, as it was loaded.
[[nodiscard]] std::string scene_content(const Scene& scene);

/// 16 hexadecimal digits: equal fingerprints mean equal figures at equal distances, except for times.
/// maker: program and renderer (maker_of_work).
/// content: scene_content of `scene`.
/// more: everything else that the figures depend on.
[[nodiscard]] std::string run_fingerprint(std::string_view maker, const RunSettings& settings, const Scene& scene,
                                          const std::string& content, const std::vector<std::string>& more = {});

/// The noise and the cost of a view's reference.
struct ReferenceWork {
  std::optional<double> wanted_noise;    ///< noise floor that it was refined to; none: not refined
  std::optional<double> standard_error;  ///< relative to its mean radiance
  double samples = 0;                    ///< per pixel, mean over the image
  double seconds = 0;                    ///< that it took
};

/// Everything that was measured in one view.
struct DistanceResult {
  double distance = 1;
  Exposure exposure;
  ReferenceWork work;
  std::string reference;                  ///< EXR, from the output folder
  std::vector<std::uint32_t> unresolved;  ///< indices of the pixels that no figure includes
  double largest_error = 0;               ///< 99th percentile of the error over pixels, the largest of all methods
  std::vector<Record> records;            ///< one per method
  std::vector<MethodPair> pairs = {};
  std::vector<SupersamplingPoint> curve = {};
  int processes = 1;  ///< that took times
  std::vector<std::string> warnings = {};
};

/// The part of a run's results that does not depend on its views.
struct ComparisonHead {
  Results results;                         ///< the reference as requested, and the warnings before those of the views
  std::size_t frames = 0;                  ///< of a path; 0: no path
  std::optional<double> error_scale = {};  ///< of all error images; none: derived from the run
  std::vector<std::string> last_warnings = {};  ///< after those of the views
};

template <>
inline constexpr bool is_private_document<Exposure> = true;
template <>
inline constexpr bool is_private_document<ReferenceSettings> = true;
template <>
inline constexpr bool is_private_document<ReferenceWork> = true;
template <>
inline constexpr bool is_private_document<DistanceResult> = true;
template <>
inline constexpr bool is_private_document<ComparisonHead> = true;

/// The name of a frame of an animation in finished work.
[[nodiscard]] std::string frame_name(std::size_t index);

/// The results of one view or more. They lack tool and backend.cpu.
[[nodiscard]] Results assemble_results(const ComparisonHead& head, const std::vector<DistanceResult>& views);

/// The results of an animation whose frames are all finished; its images go to FOLDER/images. They lack tool and
/// backend.cpu.
/// run: fingerprint of measure_views (compare.hpp).
/// Errors (usage): a frame is missing or damaged.
[[nodiscard]] Results joined_animation(const FinishedWork& finished, const std::string& run, const RunFolder& folder);

}  // namespace footprint
