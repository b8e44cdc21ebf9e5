// The method to use for a material: the measurements of each candidate, and the choice within a limit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "results/report/records.hpp"

namespace footprint {

/// A method under a footprint filter, for one material, over the distances tried.
struct Candidate {
  std::string method, footprint;  ///< as written
  std::vector<double> errors;     ///< shading error at each distance that counts
  double error = 0;               ///< their mean, which candidates are ranked by
  double worst = 0;               ///< the largest, which limits are compared with
  std::optional<double> noise;    ///< standard error of `error`, of the reference's noise; none: it is not known
  /// Whole frames over those of `direct` under trilinear lookups, or their estimated costs; means over distances.
  TimeRatio cost;
  std::uint64_t bytes = 0;  ///< that are baked of the material
  double bake_seconds = 0;  ///< for the whole scene
};
void fields(auto& archive, Is<Candidate> auto& value) {
  archive("method", value.method);
  archive("footprint", value.footprint);
  archive("errors", value.errors);
  archive("error", value.error);
  archive("worst", value.worst);
  archive("noise", value.noise);
  archive("cost", value.cost);
  archive("bytes", value.bytes);
  archive("bake_seconds", value.bake_seconds);
}

/// At most one is given.
struct Limits {
  std::optional<double> max_error;         ///< at every distance: the cheapest within it
  std::optional<double> max_cost;          ///< times `direct`: the best within it
  std::string gpu{};                       ///< on which costs are estimated; empty: costs are frame times
  std::optional<std::uint64_t> max_bytes;  ///< of the material: the best within it
};
void fields(auto& archive, Is<Limits> auto& value) {
  archive("max_error", value.max_error);
  archive("max_cost", value.max_cost);
  archive("gpu", value.gpu);
  archive("max_bytes", value.max_bytes);
}

/// The choice among candidates. Indices are into the candidates.
struct Choice {
  std::optional<std::size_t> chosen;  ///< none: none passes the limit, or nothing was measured
  std::vector<std::size_t> tied;      ///< candidates that are as good: they differ within noise
  std::optional<std::size_t> better;  ///< the cheapest that is closer to the reference than the chosen one beyond noise
  std::optional<std::size_t> nearest;  ///< where none is chosen: the one that comes closest to the limit
  bool filter_nothing = false;  ///< the chosen one is plain `direct`, and no candidate gains more than noise over it
};
void fields(auto& archive, Is<Choice> auto& value) {
  archive("chosen", value.chosen);
  archive("tied", value.tied);
  archive("better", value.better);
  archive("nearest", value.nearest);
  archive("filter_nothing", value.filter_nothing);
}

/// `direct` under the trilinear filter: no filtering at all.
[[nodiscard]] bool is_plain(const Candidate& candidate);

/// Chooses among the candidates that pass the limits. With max_error it takes the cheapest, among equal costs the most
/// accurate. Otherwise it takes the most accurate, among errors that noise does not separate the cheapest. If that is
/// not closer than plain `direct` beyond noise, and `direct` passes, it takes `direct`.
[[nodiscard]] Choice choose(const std::vector<Candidate>& candidates, const Limits& limits);

/// The candidates that could be chosen under any limit, if errors are off by `error_share` of themselves and
/// costs by `cost_share`: those to which no other is better and cheaper (and, where bytes are limited, smaller) by more
/// than that. Plain `direct` always is.
[[nodiscard]] std::vector<std::size_t> contenders(const std::vector<Candidate>& candidates, const Limits& limits,
                                                  double error_share, double cost_share);

/// A material's advice, with its reasons.
struct MaterialAdvice {
  std::string material;
  std::vector<double> distances;    ///< those that count: with pixels enough
  std::vector<std::size_t> pixels;  ///< interior ones that show it, at each of them
  Choice choice;
  /// The chosen one against plain `direct`, pixel by pixel, mean over the distances: shares of pixels in which each is
  /// closer to the reference beyond noise. None where it is that, or is under another filter.
  std::optional<std::array<double, 2>> closer_than_plain;
  std::string command;             ///< that bakes it; empty where there is nothing to bake
  std::vector<std::string> words;  ///< advice_sentences of all this
  std::vector<Candidate> candidates;
};
void fields(auto& archive, Is<MaterialAdvice> auto& value) {
  archive("material", value.material);
  archive("distances", value.distances);
  archive("pixels", value.pixels);
  fields(archive, value.choice);
  archive("closer_than_plain", value.closer_than_plain);
  archive("command", value.command);
  archive("words", value.words);
  archive("candidates", value.candidates);
}

/// A picture pair of the page: reference and method at a distance, as paths from the output folder.
struct AdvicePicture {
  double distance = 1;
  std::string method, footprint;
  std::string picture, reference, error;
};

/// A method that was to be tried and that this machine refused.
struct LeftOutMethod {
  std::string method;
  std::string reason;  ///< as the error says it
};
void fields(auto& archive, Is<LeftOutMethod> auto& value) {
  archive("method", value.method);
  archive("reason", value.reason);
}

/// A whole recommendation.
struct Recommendation {
  ToolInfo tool;
  BackendInfo backend;
  SceneInfo scene;
  ReferenceInfo reference;
  int width = 0, height = 0;
  std::vector<double> distances;  ///< all that were tried
  Limits limits;
  bool exhaustive = false;            ///< every candidate was measured in full
  std::size_t tried = 0;              ///< candidates, before any was dropped
  std::size_t measured = 0;           ///< in full
  std::optional<double> coarse = {};  ///< the share of the pixels, where it is the first answer, of the coarse pass
  std::vector<LeftOutMethod> left_out;
  std::vector<MaterialAdvice> materials;
  std::vector<AdvicePicture> pictures;
  std::vector<std::string> reports;  ///< pages of the full runs, as paths from the output folder
};

/// "at most 0.01 of error at every distance", "the least error".
[[nodiscard]] std::string limits_text(const Limits& limits);

/// The findings on a material, in sentences.
[[nodiscard]] std::vector<std::string> advice_sentences(const MaterialAdvice& advice, const Limits& limits);

/// The text that the program prints, recommend.json (docs/recommend.schema.json, "schema": "footprint-recommend/1") and
/// index.html.
[[nodiscard]] std::string recommendation_text(const Recommendation& recommendation);
[[nodiscard]] std::string recommendation_json(const Recommendation& recommendation);
[[nodiscard]] std::string recommendation_page(const Recommendation& recommendation);

}  // namespace footprint
