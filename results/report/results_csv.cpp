// Results as comma-separated values after RFC 4180: one line a record, absent figures empty.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string_view>

#include "results/report/csv_field.hpp"
#include "results/report/figures.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

constexpr std::array csv_columns{"scene",
                                 "method",
                                 "options",
                                 "distance",
                                 "frame",
                                 "width_px",
                                 "height_px",
                                 "normalized_color_error",
                                 "relative_rmse",
                                 "relmse",
                                 "psnr_db",
                                 "energy_bias",
                                 "luminance_distance",
                                 "noise_floor",
                                 "representation_error",
                                 "filtering_error",
                                 "shading_error",
                                 "shading_floor",
                                 "shading_noise",
                                 "edges_error",
                                 "filter_error",
                                 "method_error",
                                 "light_error",
                                 "object_pixels",
                                 "unresolved_pixels",
                                 "interior_pixels",
                                 "minified_pixels",
                                 "bound_pixels",
                                 "light_pixels",
                                 "equivalent_spp",
                                 "equivalent_bound",
                                 "flicker",
                                 "flicker_p99",
                                 "node",
                                 "frame_median_ms",
                                 "frame_min_ms",
                                 "frame_p90_ms",
                                 "frame_build_ms",
                                 "frame_build",
                                 "frames_per_second",
                                 "fetches",
                                 "lobes",
                                 "ratio_to_direct_median",
                                 "ratio_to_direct_low",
                                 "ratio_to_direct_high",
                                 "precompute_s",
                                 "precompute_bytes",
                                 "precompute_bytes_per_texel",
                                 "precompute_cached",
                                 "effects_on",
                                 "effects_left_out",
                                 "image_color",
                                 "image_reference",
                                 "image_error",
                                 "image_error_shared",
                                 "image_interior",
                                 "image_standard_error",
                                 "failure"};

/// "name=value;name=value", every option in the order of its name.
std::string options_text(const Record& record) {
  std::vector<std::string> pairs;
  for (const auto& [name, value] : record.options) {
    const std::string text = std::visit([](const auto& held) { return fmt::format("{}", held); }, value);
    pairs.push_back(fmt::format("{}={}", name, text));
  }
  return fmt::format("{}", fmt::join(pairs, ";"));
}

std::array<std::string, 16> error_fields(const std::optional<RecordError>& error) {
  if (!error) return {};
  return {csv_field(error->normalized_color),
          csv_field(error->relative_rmse),
          csv_field(error->relmse),
          csv_field(error->psnr),
          csv_field(error->energy_bias),
          csv_field(error->luminance_distance),
          csv_field(error->noise_floor),
          csv_field(error->representation),
          csv_field(error->filtering),
          csv_field(error->causes.shading),
          csv_field(error->causes.shading_floor),
          csv_field(error->causes.shading_noise),
          csv_field(error->causes.edges),
          csv_field(error->causes.filter),
          csv_field(error->causes.method),
          csv_field(error->causes.light)};
}

std::array<std::string, 6> pixel_fields(const PixelCounts& pixels) {
  return {fmt::format("{}", pixels.object),
          fmt::format("{}", pixels.unresolved),
          fmt::format("{}", pixels.interior),
          fmt::format("{}", pixels.minified),
          pixels.bound ? fmt::format("{}", *pixels.bound) : "",
          pixels.light ? fmt::format("{}", *pixels.light) : ""};
}

}  // namespace

std::string csv_header() { return fmt::format("{}", fmt::join(csv_columns, ",")); }

std::string csv_line(const Record& record) {
  const FrameTime& frame = record.frame_ms;
  const TimeRatio& ratio = record.ratio_to_direct;
  const std::optional<FrameBuildTime>& build = record.frame_build;
  const std::array<std::string, csv_columns.size() - 29> after_error{
      csv_field(equivalent_spp(record)),
      equivalent_bound(record),
      csv_field(record.flicker ? std::optional(record.flicker->mean) : std::nullopt),
      csv_field(record.flicker ? std::optional(record.flicker->p99) : std::nullopt),
      csv_field(record.node),
      csv_field(frame.median),
      csv_field(frame.minimum),
      csv_field(frame.p90),
      csv_field(build ? std::optional(build->ms) : std::nullopt),
      std::string(build ? timing_name(build->timing) : ""),
      csv_field(record.fps),
      csv_field(record.work ? std::optional(record.work->fetches) : std::nullopt),
      csv_field(record.work ? std::optional(record.work->lobes) : std::nullopt),
      csv_field(ratio.median),
      csv_field(ratio.low),
      csv_field(ratio.high),
      csv_field(record.precompute_seconds),
      fmt::format("{}", record.precompute_bytes),
      csv_field(record.precompute_bytes_per_texel),
      record.precompute_cached ? "true" : "false",
      csv_field(fmt::format("{}", fmt::join(record.effects_on, ";"))),
      csv_field(fmt::format("{}", fmt::join(record.effects_left_out, ";"))),
      csv_field(record.images.color),
      csv_field(record.images.reference),
      csv_field(record.images.error),
      csv_field(record.images.error_shared),
      csv_field(record.images.interior),
      csv_field(record.images.standard_error),
      csv_field(record.failure.value_or(""))};
  return fmt::format("{},{},{},{},{},{},{},{},{},{}", csv_field(record.scene), csv_field(record.method),
                     csv_field(options_text(record)), csv_field(record.distance), record.frame, record.width,
                     record.height, fmt::join(error_fields(record.error), ","),
                     fmt::join(pixel_fields(record.pixels), ","), fmt::join(after_error, ","));
}

std::string results_csv(const Results& results) {
  std::string csv = csv_header().append(csv_line_end);
  for (const Record& record : results.records) csv.append(csv_line(record)).append(csv_line_end);
  return csv;
}

}  // namespace footprint
