// Parts as JSON under a checksum; files are hard links where the file system allows them. Structured bindings list
// the settings for the fingerprint, so a new one does not compile until it is considered here. Views are joined: their
// records in order, the worst of their errors, and all warnings.
#include "experiments/studies/finished_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <system_error>
#include <utility>

#include "experiments/studies/frame_setup.hpp"
#include "experiments/studies/given_bakes.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/stage.hpp"
#include "experiments/studies/view_path.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/core/files.hpp"
#include "results/report/figures.hpp"
#include "results/report/ranking.hpp"

namespace footprint {

template <>
inline constexpr bool is_private_document<RunView> = true;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t largest_file = std::uint64_t{64} << 30U;

std::optional<std::vector<std::uint8_t>> bytes_of(const fs::path& file) {
  try {
    return read_file_bytes(file, largest_file);
  } catch (const Error&) {
    return {};
  }
}

std::string hash_of(const auto& content) {
  ContentHash hash;
  hash.add(std::as_bytes(std::span(content)));
  return hash.hex();
}

std::string hash_of_file(const fs::path& file) {
  const auto bytes = bytes_of(file);
  return bytes ? hash_of(*bytes) : std::string();
}

// Parts come from other machines: a name must stay below the folder.
bool is_within(const fs::path& name) {
  return name.is_relative() && name.has_filename() && std::ranges::find(name, fs::path("..")) == name.end();
}

void make_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (!failed) return;
  throw Error(ErrorKind::machine, folder.string(), "cannot be created: " + failed.message(),
              "choose a folder that you can write to");
}

// Gives a file a second name, or copies it. Both names are only ever replaced by renaming, so neither changes the
// other.
void link_or_copy(const fs::path& from, const fs::path& to) {
  make_folder(to.parent_path());
  std::error_code failed;
  fs::remove(to, failed);
  fs::create_hard_link(from, to, failed);
  if (failed) write_file_atomically(to, read_file_bytes(from, largest_file));
}

void add(ContentHash& hash, const auto& value) { hash.add(to_json_value(value).dump()); }

// A distance does not depend on the others, except for the first, which decides an automatic exposure, and for the
// frame before it in a zoom.
void add_view(ContentHash& hash, const ViewSettings& view, double first_time, const Scene& scene) {
  const auto& [size, quick_size, distances, zoom, path, exposure, error_scale] = view;
  const auto& [kind, degrees, axis, until] = path;
  const glm::ivec2 pixels = frame_size(scene, size);
  const glm::dvec3 turned = axis.value_or(glm::dvec3(0.0));
  const std::vector<PlannedView> all = plan_views(view, first_time, scene);
  const bool depends_on_path = kind_of(view) != RunKind::comparison;
  for (const PlannedView& place : std::span(all).first(depends_on_path ? all.size() : 1)) add(hash, place.at);
  add(hash, std::tuple(pixels.x, pixels.y, exposure, zoom.frames, error_scale));
  add(hash, std::tuple(kind, degrees, until, turned.x, turned.y, turned.z));
}

void append(std::vector<std::string>& texts, const std::vector<std::string>& more) {
  texts.insert(texts.end(), more.begin(), more.end());
}

std::vector<std::string> warnings_of(const DistanceResult& result) {
  std::vector<std::string> warnings;
  for (const Record& record : result.records) {
    if (record.failure)
      warnings.push_back(fmt::format("distance {:g}: {} failed: {}", record.distance, record.method, *record.failure));
  }
  append(warnings, result.warnings);
  if (auto warning = linear_measures_warning(result.distance, result.work.standard_error))
    warnings.push_back(std::move(*warning));
  return warnings;
}

// The scales of false-colour images, which an animation has none of.
void set_error_scales(Results& results, const ComparisonHead& head, const std::vector<DistanceResult>& views) {
  if (results.animation) return;
  double largest_error = 0;
  for (const DistanceResult& result : views) {
    largest_error = std::max(largest_error, result.largest_error);
    results.error_scales.push_back(
        {.distance = result.distance, .error = error_scale(result.largest_error, head.error_scale)});
  }
  results.error_scale = error_scale(largest_error, head.error_scale);
}

}  // namespace

FinishedWork::FinishedWork(fs::path folder, std::string maker, bool complete)
    : folder_(std::move(folder)), maker_(std::move(maker)), complete_(complete) {
  std::error_code unknown;
  const fs::file_status status = fs::status(folder_, unknown);
  if (!fs::exists(status) || fs::is_directory(status)) return;
  throw Error(ErrorKind::usage, folder_.string(), "is not a folder, and a run stores its finished work in it",
              "move it away, or choose another output folder");
}

fs::path FinishedWork::path_of(const std::string& key) const { return folder_ / (key + ".json"); }

fs::path FinishedWork::run_folder(const std::string& key) const { return path_of(key).parent_path(); }

// The first line of a part is the hash of the rest.
Json FinishedWork::read(const std::string& key) const {
  const auto bytes = is_within(key) ? bytes_of(path_of(key)) : std::nullopt;
  if (!bytes) return {};
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const std::size_t line = std::min(text.find('\n'), text.size() - 1);
  if (hash_of(text.substr(line + 1)) != text.substr(0, line)) return {};
  const Json document = Json::parse(text.substr(line + 1), nullptr, false);
  if (!document.is_object() || !document.contains("files") || !document.contains("value")) return {};
  if (!document.contains("key") || document["key"] != key) return {};
  for (const auto& [name, hash] : document["files"].items()) {
    if (!is_within(name) || Json(hash_of_file(run_folder(key) / name)) != hash) return {};
  }
  return document;
}

void FinishedWork::put_files(const std::string& key, const Json& part, const RunFolder& output) const {
  for (const auto& entry : part["files"].items())
    output.attempt(entry.key(), [&] { link_or_copy(run_folder(key) / entry.key(), output / entry.key()); });
}

void FinishedWork::write(const std::string& key, Json value, const fs::path& output,
                         const std::vector<std::string>& files) const {
  Json hashes = Json::object();
  for (const std::string& name : files) {
    if (run_folder(key) != output) link_or_copy(output / name, run_folder(key) / name);
    hashes[name] = hash_of_file(output / name);
  }
  const Json document{{"key", key}, {"files", std::move(hashes)}, {"value", std::move(value)}};
  const std::string text = document.dump(1, ' ', false, Json::error_handler_t::replace);
  make_folder(run_folder(key));
  write_file_atomically(path_of(key), std::string_view(hash_of(text) + "\n" + text));
  used_.insert(key);
}

void FinishedWork::take(const std::string& key, const FinishedWork& from) const {
  const Json part = from.read(key);
  if (part.is_null())
    throw Error(ErrorKind::usage, from.path_of(key).string(), "is missing or damaged, or one of its files is",
                "run that part again");
  std::vector<std::string> names;
  for (const auto& [name, hash] : part["files"].items()) names.push_back(name);
  write(key, part["value"], from.run_folder(key), names);
}

void FinishedWork::require_more_allowed(const std::string& scene) const {
  if (!complete_) return;
  throw Error(ErrorKind::usage, folder_.string(), fmt::format("lacks finished work of {}", scene),
              "the scene, or a file of it, is not what it was when the parts were run: run them again");
}

void FinishedWork::clear() const {
  std::error_code ignored;  // a part that stays is complete or counts as unfinished
  fs::remove_all(folder_, ignored);
}

std::string maker_of_work(std::string_view renderer) {
  ContentHash hash;
  add_program(hash);
  return fmt::format("{} {}", hash.hex(), renderer);
}

bool is_made_by_this_program(std::string_view maker) { return maker.starts_with(maker_of_work("")); }

std::string scene_content(const Scene& scene) {
  ContentHash hash;
  add_content(hash, scene);
  return hash.hex();
}

std::string run_fingerprint(std::string_view maker, const RunSettings& settings, const Scene& scene,
                            const std::string& content, const std::vector<std::string>& more) {
  ContentHash hash;
  hash.add(maker);
  hash.add(content);
  hash.add(scene.source);
  hash.add(settings.without.to_string());
  hash.add(fmt::format("{} {} {}", settings.backend.tile, settings.by_material,
                       footprint_filter_text(footprint_filter_of(settings.footprint, scene))));
  for (const MethodSpec& method : settings.methods) {
    hash.add(method.text);
    if (method.file) hash.add(method.file->file_content);
  }
  if (!settings.bakes.empty()) hash.add(hash_given_bakes(settings.bakes));
  add(hash, settings.gpus);
  add_view(hash, settings.view, first_time(settings.overrides), scene);
  add(hash, settings.reference);
  if (settings.history.frames > 0) add(hash, settings.history);
  const auto& [repeats, processes, unit] = settings.timing;
  hash.add(fmt::format("{} {} {}", repeats, processes, unit ? footprint_filter_text(*unit) : "the methods'"));
  for (const std::string& text : more) hash.add(text);
  return hash.hex();
}

std::string frame_name(std::size_t index) { return fmt::format("frame_{:04}", index); }

Results assemble_results(const ComparisonHead& head, const std::vector<DistanceResult>& views) {
  Results results = head.results;
  const Exposure& exposure = views.front().exposure;
  results.scene.exposure = exposure.factor;
  results.scene.exposure_source = word_for(exposure_sources, exposure.source);
  results.timing.processes = views.back().processes;
  for (const DistanceResult& result : views) {
    results.reference.standard_errors.push_back(result.work.standard_error);
    results.reference.samples += result.work.samples;
    results.reference.seconds += result.work.seconds;
    std::ranges::copy(result.records, std::back_inserter(results.records));
    std::ranges::copy(result.pairs, std::back_inserter(results.pairs));
    std::ranges::copy(result.curve, std::back_inserter(results.supersampling));
    if (!results.animation)
      append(results.scene.warnings, warnings_of(result));  // ranking_warnings has one for all frames
  }
  append(results.scene.warnings, head.last_warnings);
  results.reference.samples /= static_cast<double>(views.size());
  set_error_scales(results, head, views);
  return results;
}

Results joined_animation(const FinishedWork& finished, const std::string& run, const RunFolder& folder) {
  const auto damaged = [&](const std::string& what) {
    return Error(ErrorKind::usage, finished.folder().string(), what + " is missing or damaged",
                 "run the part that has it again");
  };
  const auto head = finished.find<ComparisonHead>(run + "/head", folder);
  if (!head) throw damaged("the description of the animation");
  std::vector<DistanceResult> frames;
  for (std::size_t i = 0; i < head->frames; ++i) {
    auto frame = finished.find<DistanceResult>(run + "/" + frame_name(i), folder);
    if (!frame) throw damaged(fmt::format("frame {} of {}", i + 1, head->frames));
    frames.push_back(std::move(*frame));
  }
  return assemble_results(*head, frames);
}

}  // namespace footprint
