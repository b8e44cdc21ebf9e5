// Rounds numbers, names enumerators and words sentences for every writer of a report.
#include "results/report/figures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "results/report/ranking.hpp"

namespace footprint {
namespace {

std::string plural(const std::string& count, std::string_view noun) {
  return count == "1" ? fmt::format("1 {}", noun) : fmt::format("{} {}s", count, noun);
}

std::string reference_text(const ReferenceInfo& reference) {
  std::string text = fmt::format("{} per pixel", plural(std::to_string(reference.spp), "sample"));
  if (reference.samples > reference.spp)
    text += fmt::format(" at first, {} on average after refinement", three_figures(reference.samples));
  text += fmt::format(", {} s, filter {}, seed {}", three_figures(reference.seconds), reference.filter, reference.seed);
  if (reference.environment) text += fmt::format(", environment {}", *reference.environment);
  std::vector<double> known;
  for (const std::optional<double>& error : reference.standard_errors) {
    if (error) known.push_back(*error);
  }
  if (!known.empty()) {
    const auto [least, most] = std::ranges::minmax(known);
    text += fmt::format(", standard error {}", range_text(least, most));
  }
  return text;
}

std::string scene_text(const SceneInfo& scene) {
  return fmt::format("{} ({}, {}, {}) from {}", scene.name, plural(std::to_string(scene.triangles), "triangle"),
                     plural(std::to_string(scene.materials), "material"), plural(std::to_string(scene.lights), "light"),
                     scene.source);
}

// How frames were accumulated, each form once.
std::vector<std::string> histories_of(const Results& results) {
  std::vector<std::string> texts;
  for (const Record& record : results.records) {
    if (!record.history) continue;
    const auto& [frames, alpha, clamp, jitter] = *record.history;
    std::string text = fmt::format("{} frames, alpha {:g}, clamp {}, jitter {} (docs/explanation/temporal.md)", frames,
                                   alpha, word_for(history_clamps, clamp), jitter ? "on" : "off");
    if (std::ranges::find(texts, text) == texts.end()) texts.push_back(std::move(text));
  }
  return texts;
}

std::string csv_text(const nlohmann::ordered_json& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  if (!value.is_structured()) return value.dump();
  std::vector<std::string> parts;
  for (const auto& [name, part] : value.items())
    parts.push_back(value.is_object() ? fmt::format("{}={}", name, csv_text(part)) : csv_text(part));
  return fmt::format("{}", fmt::join(parts, ";"));
}

}  // namespace

std::string timing_text(const TimingInfo& timing) {
  return fmt::format("at most {} {} per method in {}, interleaved", timing.frames,
                     timing.frames == 1 ? "frame" : "frames",
                     timing.processes == 1 ? "one process" : fmt::format("each of {} processes", timing.processes));
}

std::string range_text(double low, double high) {
  const std::string a = error_text(low), b = error_text(high);
  return a == b ? a : fmt::format("{} to {}", a, b);
}

std::string error_text(double error) {
  if (!std::isfinite(error)) return "n/a";
  if (error == 0) return "0";
  return std::abs(error) < 5e-4 ? fmt::format("{:.1e}", error) : fmt::format("{:.5f}", error);
}

std::string error_text(const std::optional<double>& error) { return error ? error_text(*error) : "n/a"; }

std::string three_figures(double value) {
  if (!std::isfinite(value)) return "n/a";
  const double size = std::abs(value);
  return size >= 99.95 && size < 1e6 ? fmt::format("{:.0f}", value) : fmt::format("{:#.3g}", value);
}

std::string spread_text(double median, double low, double high) {
  if (!std::isfinite(median)) return "n/a";
  return fmt::format("{} ({}-{})", three_figures(median), three_figures(low), three_figures(high));
}

std::string ratio_text(const TimeRatio& ratio) { return spread_text(ratio.median, ratio.low, ratio.high); }

std::optional<double> equivalent_spp(const Record& record) {
  const bool within = record.equivalent && record.equivalent->side == CurveSide::within;
  return within ? std::optional(record.equivalent->spp) : std::nullopt;
}

std::string equivalent_bound(const Record& record) {
  if (!record.equivalent) return "n/a";
  const auto [spp, side] = *record.equivalent;
  if (side == CurveSide::within) return {};
  return fmt::format("{}{:g}", side == CurveSide::below ? '<' : '>', spp);
}

std::string equivalent_text(const Record& record) {
  const std::optional<double> spp = equivalent_spp(record);
  if (!spp) return equivalent_bound(record);
  const std::string text = *spp < 9.95 ? fmt::format("{:.1f}", *spp) : fmt::format("{:.0f}", *spp);
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

bool at_noise_floor(const Record& record) {
  return record.error && record.error->noise_floor && record.error->normalized_color <= *record.error->noise_floor;
}

bool shading_at_noise_floor(const Record& record) {
  if (!record.error) return false;
  const ErrorCauses& causes = record.error->causes;
  return causes.shading && causes.shading_floor && *causes.shading <= *causes.shading_floor;
}

std::string list_text(const std::vector<std::string>& words, const std::string& none) {
  return words.empty() ? none : fmt::format("{}", fmt::join(words, ", "));
}

std::vector<Provenance> provenance(const Results& results) {
  const SceneInfo& scene = results.scene;
  std::vector<Provenance> lines{
      {"Tool", fmt::format("{} {}", results.tool.name, results.tool.version)},
      {"Backend", fmt::format("{}: {}, {}", results.backend.name, results.backend.renderer, results.backend.version)},
      {"Processor", results.backend.cpu},
      {"Scene", scene_text(scene)},
      {"Exposure", fmt::format("{} ({})", three_figures(scene.exposure), scene.exposure_source)},
      {"Reference", reference_text(results.reference)},
      {"Footprint filter", fmt::format("{} (docs/reference/filters.md)", results.footprint)}};
  for (std::string& history : histories_of(results)) lines.push_back({"History", std::move(history)});
  if (results.timing.frames > 0) lines.push_back({"Timing", timing_text(results.timing)});
  lines.push_back({"Supplied", list_text(scene.defaults, "none")});
  for (const std::string& warning : scene.warnings) lines.push_back({"Warning", warning});
  return lines;
}

std::vector<double> distances_of(const Results& results) {
  std::vector<double> distances;
  for (const Record& record : results.records) {
    if (std::ranges::find(distances, record.distance) == distances.end()) distances.push_back(record.distance);
  }
  return distances;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char character : text) quoted.append(character == '"' ? 2 : 1, character);
  return quoted + '"';
}

std::string csv_field(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{}", *value) : std::string();
}

std::string csv_value(const nlohmann::ordered_json& value) { return csv_field(csv_text(value)); }

std::string plain(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> replacements{
      {{"–", "-"}, {"×", "x"}, {"’", "'"}, {"\u00a0", " "}}};
  std::string replaced(text);
  for (const auto& [from, to] : replacements) {
    for (std::size_t at = 0; (at = replaced.find(from, at)) != std::string::npos;)
      replaced.replace(at, from.size(), to);
  }
  return replaced;
}

}  // namespace footprint
