// Results as comma-separated values (RFC 4180): one line per record, absent figures empty.
#include <array>

#include "results/report/csv_field.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

constexpr std::array csv_columns{CsvColumn{"scene", "/scene"},
                                 CsvColumn{"method", "/method"},
                                 CsvColumn{"options", "/options"},
                                 CsvColumn{"distance", "/distance"},
                                 CsvColumn{"degrees", "/degrees"},
                                 CsvColumn{"frame", "/frame"},
                                 CsvColumn{"width_px", "/size/0"},
                                 CsvColumn{"height_px", "/size/1"},
                                 CsvColumn{"normalized_color_error", "/error/normalized_color"},
                                 CsvColumn{"relative_rmse", "/error/relative_rmse"},
                                 CsvColumn{"relmse", "/error/relmse"},
                                 CsvColumn{"psnr_db", "/error/psnr"},
                                 CsvColumn{"energy_bias", "/error/energy_bias"},
                                 CsvColumn{"luminance_distance", "/error/luminance_distance"},
                                 CsvColumn{"noise_floor", "/error/noise_floor"},
                                 CsvColumn{"representation_error", "/error/representation"},
                                 CsvColumn{"filtering_error", "/error/filtering"},
                                 CsvColumn{"shading_error", "/error/shading"},
                                 CsvColumn{"shading_floor", "/error/shading_floor"},
                                 CsvColumn{"shading_noise", "/error/shading_noise"},
                                 CsvColumn{"edges_error", "/error/edges"},
                                 CsvColumn{"filter_error", "/error/filter"},
                                 CsvColumn{"method_error", "/error/method"},
                                 CsvColumn{"light_error", "/error/light"},
                                 CsvColumn{"object_pixels", "/pixels/object"},
                                 CsvColumn{"unresolved_pixels", "/pixels/unresolved"},
                                 CsvColumn{"interior_pixels", "/pixels/interior"},
                                 CsvColumn{"minified_pixels", "/pixels/minified"},
                                 CsvColumn{"bound_pixels", "/pixels/bound"},
                                 CsvColumn{"light_pixels", "/pixels/light"},
                                 CsvColumn{"equivalent_spp", "/equivalent_spp"},
                                 CsvColumn{"equivalent_bound", "/equivalent_bound"},
                                 CsvColumn{"flicker", "/flicker/mean"},
                                 CsvColumn{"flicker_p99", "/flicker/p99"},
                                 CsvColumn{"flicker_noise_floor", "/flicker/noise_floor"},
                                 CsvColumn{"flicker_shading", "/flicker/shading/mean"},
                                 CsvColumn{"flicker_shading_p99", "/flicker/shading/p99"},
                                 CsvColumn{"flicker_edges", "/flicker/edges/mean"},
                                 CsvColumn{"flicker_edges_p99", "/flicker/edges/p99"},
                                 CsvColumn{"flicker_filter", "/flicker/filter/mean"},
                                 CsvColumn{"flicker_filter_p99", "/flicker/filter/p99"},
                                 CsvColumn{"flicker_method", "/flicker/method/mean"},
                                 CsvColumn{"flicker_method_p99", "/flicker/method/p99"},
                                 CsvColumn{"highlight_energy", "/highlight_energy"},
                                 CsvColumn{"reference_highlight_energy", "/reference_highlight_energy"},
                                 CsvColumn{"node", "/time/node"},
                                 CsvColumn{"frame_median_ms", "/time/frame_ms/median"},
                                 CsvColumn{"frame_min_ms", "/time/frame_ms/min"},
                                 CsvColumn{"frame_p90_ms", "/time/frame_ms/p90"},
                                 CsvColumn{"frame_build_ms", "/time/frame_build_ms"},
                                 CsvColumn{"frame_build", "/time/frame_build"},
                                 CsvColumn{"frames_per_second", "/time/fps"},
                                 CsvColumn{"fetches", "/time/fetches"},
                                 CsvColumn{"lobes", "/time/lobes"},
                                 CsvColumn{"ratio_to_direct_median", "/time/ratio_to_direct/median"},
                                 CsvColumn{"ratio_to_direct_low", "/time/ratio_to_direct/low"},
                                 CsvColumn{"ratio_to_direct_high", "/time/ratio_to_direct/high"},
                                 CsvColumn{"precompute_s", "/precompute/seconds"},
                                 CsvColumn{"precompute_bytes", "/precompute/bytes"},
                                 CsvColumn{"precompute_bytes_per_texel", "/precompute/bytes_per_texel"},
                                 CsvColumn{"precompute_cached", "/precompute/cached"},
                                 CsvColumn{"effects_on", "/effects/on"},
                                 CsvColumn{"effects_left_out", "/effects/left_out"},
                                 CsvColumn{"image_color", "/images/color"},
                                 CsvColumn{"image_reference", "/images/reference"},
                                 CsvColumn{"image_error", "/images/error"},
                                 CsvColumn{"image_error_shared", "/images/error_shared"},
                                 CsvColumn{"image_interior", "/images/interior"},
                                 CsvColumn{"image_standard_error", "/images/standard_error"},
                                 CsvColumn{"failure", "/failure"}};

}  // namespace

std::string csv_header() { return csv_header(csv_columns); }

std::string csv_line(const Record& record) { return csv_line(csv_columns, to_json_value(record)); }

std::string results_csv(const Results& results) {
  std::string csv = csv_header().append(csv_line_end);
  for (const Record& record : results.records) csv.append(csv_line(record)).append(csv_line_end);
  return csv;
}

}  // namespace footprint
