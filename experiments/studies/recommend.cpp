// One comparison a footprint filter, coarse and then full; records become candidates, material by material.
#include "experiments/studies/recommend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <ranges>
#include <utility>

#include "experiments/studies/compare.hpp"
#include "experiments/studies/frame_setup.hpp"
#include "renderer/core/names.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/figures.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

constexpr int coarse_samples = 32, coarse_repeats = 3;  // two passes, for an estimate of the noise
constexpr int smallest_coarse_side = 128;               // pixels; a smaller frame is drawn as it is
constexpr FootprintFilter plain_filter{FootprintFilterKind::trilinear, 1};

// The comparison under one footprint filter.
struct FilterRun {
  FootprintFilter filter;
  Results results = {};
  std::string folder;  ///< from the output folder
  bool coarse = false;
};

// The records of a method under a filter at each distance.
using Records = std::vector<const Record*>;

Records records_of(const FilterRun& run, const std::string& method) {
  Records records;
  for (const Record& record : run.results.records) {
    if (record.method == method) records.push_back(&record);
  }
  return records;
}

// A coarse run has a quarter of the pixels.
bool has_pixels(const Record& record, std::size_t material, bool coarse) {
  const std::size_t fewest = coarse ? too_few_pixels / 4 : too_few_pixels;
  return record.materials.size() > material && record.materials[material].pixels >= fewest &&
         record.materials[material].shading.has_value();
}

// The distances at which a material shows enough pixels in every run, as indices.
std::vector<std::size_t> distances_with_enough_pixels(const std::vector<FilterRun>& runs, std::size_t material) {
  std::vector<std::size_t> found;
  const std::size_t count = distances_of(runs.front().results).size();
  for (std::size_t d = 0; d < count; ++d) {
    const double distance = distances_of(runs.front().results)[d];
    const bool enough = std::ranges::all_of(runs, [&](const FilterRun& run) {
      const DistanceRecords records = records_at(run.results, distance);
      return std::ranges::all_of(records,
                                 [&](const Record& r) { return r.failure || has_pixels(r, material, run.coarse); });
    });
    if (enough) found.push_back(d);
  }
  return found;
}

double mean_of(const Records& records, const std::vector<std::size_t>& at, const auto& value) {
  double sum = 0;
  for (const std::size_t d : at) sum += value(*records[d]);
  return sum / static_cast<double>(at.size());
}

// The standard error of the mean over the distances: each has a reference of its own.
std::optional<double> noise_of(const Records& records, const std::vector<std::size_t>& at, std::size_t material) {
  double squares = 0;
  for (const std::size_t d : at) {
    const std::optional<double>& noise = records[d]->materials[material].noise;
    if (!noise) return {};
    squares += *noise * *noise;
  }
  return std::sqrt(squares) / static_cast<double>(at.size());
}

// The estimated cost if the run has a GPU, else the frame time, relative to `direct`.
TimeRatio cost_of(const Record& record) {
  if (record.gpu_costs.empty()) return record.ratio_to_direct;
  const double ratio = record.gpu_costs.front().ratio_to_direct.value_or(std::numeric_limits<double>::infinity());
  return {.median = ratio, .low = ratio, .high = ratio};
}

Candidate candidate_of(const FilterRun& run, const std::string& method, const std::vector<std::size_t>& at,
                       std::size_t material) {
  const Records records = records_of(run, method);
  Candidate candidate;
  candidate.method = method;
  candidate.footprint = footprint_filter_text(run.filter);
  for (const std::size_t d : at) candidate.errors.push_back(*records[d]->materials[material].shading);
  candidate.error = mean_of(records, at, [&](const Record& r) { return *r.materials[material].shading; });
  candidate.worst = std::ranges::max(candidate.errors);
  candidate.noise = noise_of(records, at, material);
  candidate.cost = {.median = mean_of(records, at, [](const Record& r) { return cost_of(r).median; }),
                    .low = mean_of(records, at, [](const Record& r) { return cost_of(r).low; }),
                    .high = mean_of(records, at, [](const Record& r) { return cost_of(r).high; })};
  candidate.bytes = records.front()->materials[material].bytes;
  candidate.bake_seconds = records.front()->precompute_seconds;
  return candidate;
}

std::vector<std::string> methods_of(const Results& results) {
  std::vector<std::string> methods = methods_in_order(results.records);
  for (const Record& record : results.records) {
    if (record.failure) std::erase(methods, record.method);
  }
  return methods;
}

std::vector<Candidate> candidates_of(const std::vector<FilterRun>& runs, const std::vector<std::size_t>& at,
                                     std::size_t material) {
  std::vector<Candidate> candidates;
  if (at.empty()) return candidates;
  for (const FilterRun& run : runs) {
    for (const std::string& method : methods_of(run.results))
      candidates.push_back(candidate_of(run, method, at, material));
  }
  std::ranges::stable_sort(candidates, {}, [](const Candidate& c) { return c.cost.median; });
  return candidates;
}

// Half of each side, if that leaves enough pixels to separate candidates.
glm::ivec2 coarse_size(const glm::ivec2& full) {
  return std::min(full.x, full.y) < 2 * smallest_coarse_side ? full : full / 2;
}

// The run of a filter with some of the methods.
RunSettings settings_of(const RecommendSettings& settings, const FootprintFilter& filter,
                        std::vector<MethodSpec> methods, const std::optional<glm::ivec2>& coarse) {
  RunSettings run = settings.run;
  run.methods = std::move(methods);
  run.footprint = filter;
  run.timing.unit = plain_filter;
  run.by_material = true;
  run.reference.bound = BoundUse::off;
  run.reference.by_cause = false;
  run.reference.supersampling = {1};
  if (!coarse) return run;
  run.view.size = coarse;
  run.reference.by_noise = false;
  run.reference.spp = std::min(run.reference.spp, coarse_samples);
  run.timing.repeats = std::min(run.timing.repeats, coarse_repeats);
  return run;
}

// Everything is compared with plain `direct`.
std::vector<MethodSpec> with_plain(std::vector<MethodSpec> methods, const FootprintFilter& filter) {
  if (filter == plain_filter && std::ranges::find(methods, "direct", &MethodSpec::text) == methods.end())
    methods.insert(methods.begin(), {.text = "direct", .name = "direct", .options = {}});
  return methods;
}

std::size_t material_count(const std::vector<FilterRun>& runs) {
  const std::vector<Record>& records = runs.front().results.records;
  return records.empty() ? 0 : records.front().materials.size();
}

std::optional<std::array<double, 2>> closer_than_plain(const std::vector<FilterRun>& runs, const Candidate& chosen,
                                                       const std::vector<double>& distances, std::size_t material) {
  std::array<double, 2> sum{};
  std::size_t count = 0;
  for (const FilterRun& run : runs) {
    if (footprint_filter_text(run.filter) != chosen.footprint) continue;
    for (const MethodPair& pair : run.results.pairs) {
      const bool first = pair.methods[0] == "direct" && pair.methods[1] == chosen.method;
      const bool second = pair.methods[1] == "direct" && pair.methods[0] == chosen.method;
      if (!(first || second) || std::ranges::find(distances, pair.distance) == distances.end()) continue;
      const auto& closer = pair.materials.at(material);
      sum[0] += closer.at(first ? 1 : 0);
      sum[1] += closer.at(first ? 0 : 1);
      ++count;
    }
  }
  if (count == 0) return {};
  return std::array<double, 2>{sum[0] / static_cast<double>(count), sum[1] / static_cast<double>(count)};
}

// Null: none meets the limits.
const Candidate* chosen_of(const MaterialAdvice& advice) {
  return advice.choice.chosen ? &advice.candidates[*advice.choice.chosen] : nullptr;
}

MaterialAdvice advice_of(const RecommendSettings& settings, const std::vector<FilterRun>& runs, std::size_t material) {
  const std::vector<std::size_t> at = distances_with_enough_pixels(runs, material);
  const std::vector<double> distances = distances_of(runs.front().results);
  const Records direct = records_of(runs.front(), methods_of(runs.front().results).front());
  MaterialAdvice advice;
  advice.material = direct.front()->materials[material].material;
  for (const std::size_t d : at) {
    advice.distances.push_back(distances[d]);
    advice.pixels.push_back(direct[d]->materials[material].pixels);
  }
  advice.candidates = candidates_of(runs, at, material);
  advice.choice = choose(advice.candidates, settings.limits);
  if (const Candidate* const chosen = chosen_of(advice); chosen != nullptr && !is_plain(*chosen)) {
    if (chosen->bytes > 0)
      advice.command = fmt::format("footprint bake {} --method {} --footprint {} -o maps", settings.run.scene,
                                   chosen->method, chosen->footprint);
    advice.closer_than_plain = closer_than_plain(runs, *chosen, advice.distances, material);
  }
  advice.words = advice_sentences(advice, settings.limits);
  return advice;
}

class Advisor {
 public:
  Advisor(const RecommendSettings& settings, RunFolder folder, const FinishedWork& finished,
          const RecommendListener& listener, const Progress& progress)
      : settings_(settings),
        folder_(std::move(folder)),
        finished_(finished),
        listener_(listener),
        parts_(progress, (settings.exhaustive ? 0.0 : 1.0) + 3.0),
        scene_(std::make_shared<PreparedScene>(
            load_scene(settings.run.scene, settings.run.scene_library, settings.run.overrides), settings.run)),
        content_(scene_content(scene_->scene)) {}

  Recommendation run() {
    MethodsByFilter methods;
    for (const FootprintFilter& filter : settings_.filters)
      methods.push_back(with_plain(settings_.run.methods, filter));
    std::optional<std::size_t> tried;
    if (!settings_.exhaustive) {
      coarse_size_ = coarse_size(frame_size(scene_->scene, settings_.run.view.size));
      tried = count_of(methods);
      const std::vector<FilterRun> coarse = run_all(methods, true);
      tell_first_answer(coarse, *tried);
      methods = still_in_question(coarse, methods);
    }
    const std::vector<FilterRun> runs = run_all(methods, false);
    Recommendation result = described(runs);
    result.measured = count_of(methods);
    result.tried = tried.value_or(result.measured);
    result.left_out = left_out_;
    return result;
  }

 private:
  // Methods of each footprint filter.
  using MethodsByFilter = std::vector<std::vector<MethodSpec>>;

  static std::size_t count_of(const MethodsByFilter& methods) {
    std::size_t count = 0;
    for (const auto& own : methods) count += own.size();
    return count;
  }

  void tell_first_answer(const std::vector<FilterRun>& coarse, std::size_t tried) {
    const glm::ivec2 full = frame_size(scene_->scene, settings_.run.view.size);
    const auto pixels = [](const glm::ivec2& size) { return static_cast<double>(size.x) * size.y; };
    Recommendation answer = described(coarse);
    answer.coarse = pixels(*coarse_size_) / pixels(full);
    answer.tried = tried;
    answer.left_out = left_out_;
    listener_.first_answer(answer);
  }

  // Leaves out the methods that failed at any distance, under this filter and those that follow.
  void leave_out_failed(const Results& results, MethodsByFilter& methods) {
    for (const Record& record : results.records) {
      if (!record.failure) continue;
      const auto is_it = [&](const auto& method) { return method.method == record.method; };
      if (std::ranges::any_of(left_out_, is_it)) continue;
      left_out_.push_back({.method = record.method, .reason = *record.failure});
      for (auto& left : methods)
        std::erase_if(left, [&](const MethodSpec& method) { return method.text == record.method; });
    }
  }

  // Whether no method under a filter can pass the limit of cost, because a few frames show that even `direct` does not.
  bool is_too_expensive(const FootprintFilter& filter, const RunFolder& own, const Progress& progress,
                        SharedWork& shared) {
    if (!settings_.limits.max_cost || filter == plain_filter) return false;
    const std::vector<MethodSpec> direct{{.text = "direct", .name = "direct", .options = {}}};
    const Results results =
        run_compare(settings_of(settings_, filter, direct, coarse_size_), own, progress, with(shared));
    const auto costs = std::views::transform(results.records, [](const Record& r) { return cost_of(r).median; });
    const double least = std::ranges::min(costs);
    if (least * (1.0 - coarse_cost_share) <= *settings_.limits.max_cost) return false;
    left_out_.push_back({.method = fmt::format("every method under {}", footprint_filter_text(filter)),
                         .reason = fmt::format("`direct` alone costs {:.1f} times as much there", least)});
    return true;
  }

  [[nodiscard]] CompareContext with(SharedWork& shared) const {
    return {.finished = &finished_, .shared = &shared, .gpu_compiler = settings_.gpu_compiler};
  }

  std::vector<FilterRun> run_all(MethodsByFilter& methods, bool coarse) {
    const std::optional<glm::ivec2> size = coarse ? coarse_size_ : std::nullopt;
    std::vector<FilterRun> runs;
    SharedWork shared{.scene = scene_, .content = content_};
    ProgressParts parts(parts_.next(coarse ? 1.0 : 3.0, coarse ? "coarse, " : ""), static_cast<double>(methods.size()));
    for (std::size_t f = 0; f < methods.size(); ++f) {
      const FootprintFilter& filter = settings_.filters[f];
      const Progress part = parts.next(1.0, footprint_filter_text(filter) + ", ");
      if (methods[f].empty()) continue;
      FilterRun run{.filter = filter, .folder = file_stem(footprint_filter_text(filter)), .coarse = coarse};
      const RunFolder own = coarse ? RunFolder(folder_ / "coarse") : folder_.below(run.folder);
      std::filesystem::create_directories(own.path());
      ProgressParts steps(part, 4.0);
      if (coarse && is_too_expensive(filter, own, steps.next(1.0, ""), shared)) {
        methods[f].clear();
        std::filesystem::remove_all(own.path());
        continue;
      }
      run.results =
          run_compare(settings_of(settings_, filter, methods[f], size), own, steps.next(3.0, ""), with(shared));
      leave_out_failed(run.results, methods);
      const bool is_of_use = !methods_of(run.results).empty();
      if (coarse || !is_of_use) std::filesystem::remove_all(own.path());
      if (!is_of_use) continue;
      if (!coarse) listener_.results(run.results, own);
      runs.push_back(std::move(run));
    }
    if (runs.empty())
      throw Error(ErrorKind::machine, settings_.run.scene, "this machine takes none of the methods",
                  left_out_.empty() ? "" : left_out_.back().reason);
    return runs;
  }

  // The methods under each filter that some material may still use.
  [[nodiscard]] MethodsByFilter still_in_question(const std::vector<FilterRun>& runs,
                                                  const MethodsByFilter& methods) const {
    MethodsByFilter wanted(methods.size());
    for (std::size_t f = 0; f < methods.size(); ++f) {
      const std::string filter = footprint_filter_text(settings_.filters[f]);
      std::ranges::copy_if(methods[f], std::back_inserter(wanted[f]),
                           [&](const MethodSpec& method) { return is_wanted(runs, method.text, filter); });
    }
    return wanted;
  }

  [[nodiscard]] bool is_wanted(const std::vector<FilterRun>& runs, const std::string& method,
                               const std::string& filter) const {
    if (method == "direct" && filter == footprint_filter_text(plain_filter)) return true;
    for (std::size_t material = 0; material < material_count(runs); ++material) {
      const auto candidates = candidates_of(runs, distances_with_enough_pixels(runs, material), material);
      for (const std::size_t i : contenders(candidates, settings_.limits, coarse_error_share, coarse_cost_share)) {
        if (candidates[i].method == method && candidates[i].footprint == filter) return true;
      }
    }
    return false;
  }

  [[nodiscard]] Recommendation described(const std::vector<FilterRun>& runs) const {
    const Results& first = runs.front().results;
    Recommendation result;
    result.tool = first.tool;
    result.backend = first.backend;
    result.scene = first.scene;
    result.reference = first.reference;
    result.width = first.records.front().width;
    result.height = first.records.front().height;
    result.distances = distances_of(first);
    result.limits = settings_.limits;
    result.exhaustive = settings_.exhaustive;
    for (std::size_t material = 0; material < material_count(runs); ++material)
      result.materials.push_back(advice_of(settings_, runs, material));
    if (runs.front().coarse) return result;
    for (const FilterRun& run : runs) result.reports.push_back(run.folder + "/index.html");
    add_pictures(runs, result);
    return result;
  }

  // Adds the images of all chosen candidates at every distance, and of plain `direct`.
  static void add_pictures(const std::vector<FilterRun>& runs, Recommendation& result) {
    for (const FilterRun& run : runs) {
      const std::string filter = footprint_filter_text(run.filter);
      for (const Record& record : run.results.records) {
        const bool is_chosen = std::ranges::any_of(result.materials, [&](const MaterialAdvice& advice) {
          const Candidate* const chosen = chosen_of(advice);
          return chosen != nullptr && chosen->method == record.method && chosen->footprint == filter;
        });
        const bool is_direct = record.method == "direct" && run.filter == plain_filter;
        if (!is_chosen && !is_direct) continue;
        const auto in_folder = [&](const std::string& file) { return run.folder + "/" + file; };
        result.pictures.push_back({.distance = record.distance,
                                   .method = record.method,
                                   .footprint = filter,
                                   .picture = in_folder(record.images.color),
                                   .reference = in_folder(record.images.reference),
                                   .error = in_folder(record.images.error)});
      }
    }
  }

  const RecommendSettings& settings_;
  RunFolder folder_;
  const FinishedWork& finished_;
  const RecommendListener& listener_;
  ProgressParts parts_;
  std::shared_ptr<PreparedScene> scene_;
  std::string content_;
  std::optional<glm::ivec2> coarse_size_;
  std::vector<LeftOutMethod> left_out_;
};

}  // namespace

Recommendation run_recommend(const RecommendSettings& settings, const RunFolder& folder, const FinishedWork& finished,
                             const RecommendListener& listener, const Progress& progress) {
  return Advisor(settings, folder, finished, listener, progress).run();
}

}  // namespace footprint
