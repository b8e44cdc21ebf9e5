// Rounds numbers, names enumerators and words sentences for every writer of a report; the list of columns, and the
// formats of their cells.
#include "results/report/figures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "renderer/core/memory.hpp"
#include "results/report/ranking.hpp"
#include "results/report/record_fields.hpp"

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

// The formats of cells.
namespace cell {

using Value = std::optional<double>;
using Format = decltype(Column::format);

constexpr Format number = [](const Value& value, const Record&) { return fmt::format("{}", value.value_or(0)); };
constexpr Format error = [](const Value& value, const Record&) { return error_text(value); };
constexpr Format figure = [](const Value& value, const Record&) { return value ? three_figures(*value) : "n/a"; };
constexpr Format counted = [](const Value& value, const Record&) { return value ? three_figures(*value) : "–"; };
constexpr Format significant = [](const Value& value, const Record&) {
  return value ? fmt::format("{:.3g}", *value) : "–";
};
constexpr Format pixels = [](const Value&, const Record& record) {
  return fmt::format("{}{}", record.pixels.interior, record.pixels.interior < few_pixels ? " !" : "");
};
constexpr Format samples = [](const Value&, const Record& record) { return equivalent_text(record); };
constexpr Format frame = [](const Value&, const Record& record) {
  return spread_text(record.frame_ms.median, record.frame_ms.min, record.frame_ms.p90);
};
constexpr Format ratio = [](const Value&, const Record& record) { return ratio_text(record.ratio_to_direct); };
constexpr Format build = [](const Value& value, const Record& record) {
  return value ? fmt::format("{}, {}", three_figures(*value), word_for(build_timing_words, *record.frame_build))
               : "none";
};
constexpr Format bytes = [](const Value&, const Record& record) { return readable_bytes(record.precompute_bytes); };
constexpr Format left_out = [](const Value&, const Record& record) {
  return list_text(record.effects_left_out, "none");
};

}  // namespace cell

constexpr std::string_view error_unit = "normalised colour error, 0 to 1";
constexpr std::string_view cause_unit = "normalised colour by cause, 0 to 2";
constexpr std::string_view part_unit = "normalised colour error over some of the pixels, 0 to 1";

constexpr std::array<Column, 75> all_columns{
    {{"scene", "/scene", "text"},
     {"method", "/method", "text"},
     {"options", "/options", "text, `name=value;name=value`"},
     {"history_frames", "/history/frames", "frames before the image"},
     {"distance", "/distance", "factor on the scene's own distance", "Distance",
      "Camera distance, as a multiple of the scene’s own.", cell::number},
     {"degrees", "/degrees", "angle since the first frame"},
     {"seconds", "/seconds", "time of the animation, s"},
     {"frame", "/frame", "number from 0"},
     {"width_px", "/size/0", "pixels"},
     {"height_px", "/size/1", "pixels"},
     {"normalized_color_error", "/error/normalized_color", error_unit, "Error",
      "Normalised colour error against the reference, 0 to 1: mean over the object’s pixels. Lower is better.",
      cell::error},
     {"relative_rmse", "/error/relative_rmse", "none"},
     {"relmse", "/error/relmse", "none"},
     {"psnr_db", "/error/psnr", "dB"},
     {"energy_bias", "/error/energy_bias", "none"},
     {"luminance_distance", "/error/luminance_distance", "luminance as shown, 0 to 1"},
     {"noise_floor", "/error/noise_floor", error_unit},
     {"representation_error", "/error/representation", error_unit, "Lobe fit",
      "Error of the method’s finest level, supersampled. It remains without any filtering.", cell::error},
     {"filtering_error", "/error/filtering", error_unit},
     {"shading_error", "/error/shading", part_unit, "Shading",
      "Mean error over interior pixels, in which the reference sees one smooth piece of surface. Methods are ranked by "
      "it.",
      cell::error},
     {"shading_floor", "/error/shading_floor", part_unit},
     {"shading_noise", "/error/shading_noise", part_unit},
     {"edges_error", "/error/edges", part_unit, "Edges",
      "Mean error over the object’s other pixels, which no method filters.", cell::error},
     {"filter_error", "/error/filter", part_unit, "Filter",
      "Error of the exact normal distribution under the same footprint filter.", cell::error},
     {"method_error", "/error/method", part_unit, "Own error",
      "Difference between the method’s image and that of the exact normal distribution.", cell::error},
     {"light_error", "/error/light", part_unit, "Light",
      "Error of the environment lookup, compared with the whole environment.", cell::error},
     {"object_pixels", "/pixels/object", "pixels"},
     {"unresolved_pixels", "/pixels/unresolved", "pixels"},
     {"interior_pixels", "/pixels/interior", "pixels", "Pixels", "Number of interior pixels; ! marks fewer than 100.",
      cell::pixels},
     {"minified_pixels", "/pixels/minified", "pixels"},
     {"bound_pixels", "/pixels/bound", "pixels"},
     {"light_pixels", "/pixels/light", "pixels"},
     {"equivalent_spp", "/equivalent_spp", "frames of `direct`", "=\u00a0spp",
      "Samples per pixel of plain supersampling with the same shading error.", cell::samples},
     {"equivalent_bound", "/equivalent_bound", "`<1`, `>64` or `n/a` where there is no figure"},
     {"flicker", "/flicker/mean", "normalised colour, 0 to 2", "Flicker",
      "How much the change since the previous frame differs from the reference’s, 0 to 2.", cell::significant},
     {"flicker_p99", "/flicker/p99", "normalised colour, 0 to 2"},
     {"flicker_noise_floor", "/flicker/noise_floor", "normalised colour, 0 to 2"},
     {"ghosting", "/flicker/ghosting", part_unit},
     {"flicker_shading", "/flicker/shading/mean", cause_unit},
     {"flicker_shading_p99", "/flicker/shading/p99", cause_unit},
     {"flicker_edges", "/flicker/edges/mean", cause_unit},
     {"flicker_edges_p99", "/flicker/edges/p99", cause_unit},
     {"flicker_filter", "/flicker/filter/mean", cause_unit},
     {"flicker_filter_p99", "/flicker/filter/p99", cause_unit},
     {"flicker_method", "/flicker/method/mean", cause_unit},
     {"flicker_method_p99", "/flicker/method/p99", cause_unit},
     {"highlight_energy", "/highlight_energy", "exposed luminance"},
     {"reference_highlight_energy", "/reference_highlight_energy", "exposed luminance"},
     {"node", "/time/node", "name of the machine that the times were taken on"},
     {"frame_median_ms", "/time/frame_ms/median", "milliseconds", "Frame ms",
      "Time per frame: median (minimum–90th percentile of the repeats).", cell::frame},
     {"frame_min_ms", "/time/frame_ms/min", "milliseconds"},
     {"frame_p90_ms", "/time/frame_ms/p90", "milliseconds"},
     {"frame_build_ms", "/time/frame_build_ms", "milliseconds", "Build ms",
      "Time to rebuild maps when something moves, and whether frame times include it.", cell::build},
     {"frame_build", "/time/frame_build", "`every frame`, or `reused`: the frame times have no build in them"},
     {"frames_per_second", "/time/fps", "1/s", "fps", "Frames per second at the median frame time.", cell::figure},
     {"fetches", "/time/fetches", "texture lookups per pixel", "Fetches",
      "Texture lookups per pixel, counted; – for methods whose frames take seconds.", cell::counted},
     {"lobes", "/time/lobes", "lobes evaluated per pixel", "Lobes",
      "Lobes evaluated per pixel over all lights, counted; – for methods whose frames take seconds.", cell::counted},
     {"ratio_to_direct_median", "/time/ratio_to_direct/median", "none", "× direct",
      "Frame time relative to direct under the same footprint filter: median (95% interval of the median).",
      cell::ratio},
     {"ratio_to_direct_low", "/time/ratio_to_direct/low", "none"},
     {"ratio_to_direct_high", "/time/ratio_to_direct/high", "none"},
     {"precompute_s", "/precompute/seconds", "seconds", "Bake s", "Bake time in seconds.", cell::figure},
     {"precompute_bytes", "/precompute/bytes", "bytes", "Maps", "Memory of the baked maps.", cell::bytes},
     {"precompute_bytes_per_texel", "/precompute/bytes_per_texel", "bytes per texel", "B/texel",
      "Bytes per texel of the finest level.", cell::figure},
     {"precompute_cached", "/precompute/cached", "`true` or `false`"},
     {"effects_on", "/effects/on", "names with `;` between"},
     {"effects_left_out", "/effects/left_out", "names with `;` between", "Left out",
      "Effects of the scene that the method cannot render.", cell::left_out, true},
     {"image_color", "/images/color", "paths from the output folder"},
     {"image_reference", "/images/reference", "paths from the output folder"},
     {"image_error", "/images/error", "paths from the output folder"},
     {"image_error_shared", "/images/error_shared", "paths from the output folder"},
     {"image_flip", "/images/flip", "paths from the output folder"},
     {"image_interior", "/images/interior", "paths from the output folder"},
     {"image_standard_error", "/images/standard_error", "paths from the output folder"},
     {"failure", "/failure", "text; empty if the method did not fail"},
     {"rank", "", "", "Rank",
      "By shading error. Methods that differ by no more than the reference’s noise share a rank; – if too few pixels "
      "are interior."}}};

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

std::string csv_header() {
  std::vector<std::string_view> names;
  for (const Column& column : all_columns) {
    if (*column.place != '\0') names.push_back(column.key);
  }
  return fmt::format("{}", fmt::join(names, ","));
}

std::string csv_line(const Record& record) {
  const nlohmann::ordered_json document = to_json_value(record);
  std::vector<std::string> values;
  for (const Column& column : all_columns) {
    if (*column.place == '\0') continue;
    const nlohmann::ordered_json::json_pointer place(column.place);
    values.push_back(document.contains(place) ? csv_value(document.at(place)) : std::string());
  }
  return fmt::format("{}", fmt::join(values, ","));
}

std::string results_csv(const Results& results) {
  std::string csv = csv_header().append(csv_line_end);
  for (const Record& record : results.records) csv.append(csv_line(record)).append(csv_line_end);
  return csv;
}

std::span<const Column> record_columns() { return all_columns; }

const Column& column_of(std::string_view key) {
  const auto found = std::ranges::find(all_columns, key, &Column::key);
  if (found == all_columns.end()) throw std::logic_error("no column `" + std::string(key) + "`");
  return *found;
}

std::string cell_text(const Column& column, const Record& record, const nlohmann::ordered_json& json) {
  const nlohmann::ordered_json::json_pointer place(column.place);
  const bool is_number = json.contains(place) && json.at(place).is_number();
  return column.format(is_number ? std::optional(json.at(place).get<double>()) : std::nullopt, record);
}

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
