// The rows, how they find their figure in a record, and the formats of their cells.
#include "results/report/figure_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

#include "renderer/core/memory.hpp"
#include "results/report/figures.hpp"

namespace footprint {
namespace {

using Number = std::optional<double>;

template <class Value>
Number number_of(const Value& value) {
  if constexpr (requires { value.has_value(); }) {
    return value ? number_of(*value) : Number();
  } else {
    return static_cast<double>(value);
  }
}

// The number at the end of a path of members; none where a part of it is absent.
template <auto member, auto... more, class Owner>
Number number_in(const Owner& owner) {
  if constexpr (requires { owner.has_value(); }) {
    return owner ? number_in<member, more...>(*owner) : Number();
  } else if constexpr (sizeof...(more) == 0) {
    return number_of(owner.*member);
  } else {
    return number_in<more...>(owner.*member);
  }
}

template <auto... path>
constexpr auto at = [](const Record& record) { return number_in<path...>(record); };

template <std::string Record::*member>
constexpr auto word = [](const Record& record) { return record.*member; };

template <std::string RecordImages::*member>
constexpr auto image = [](const Record& record) { return record.images.*member; };

template <std::vector<std::string> Record::*member>
constexpr auto names = [](const Record& record) { return fmt::format("{}", fmt::join(record.*member, ";")); };

std::string options_text(const Record& record) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : record.options) {
    const std::string text = std::visit([](const auto& one) { return fmt::format("{}", one); }, value);
    parts.push_back(fmt::format("{}={}", name, text));
  }
  return fmt::format("{}", fmt::join(parts, ";"));
}

std::string build_text(const Record& record) {
  return record.frame_build ? std::string(word_for(build_timing_words, *record.frame_build)) : std::string();
}

std::string cached_text(const Record& record) { return record.precompute_cached ? "true" : "false"; }

std::string failure_text(const Record& record) { return record.failure.value_or(""); }

// A frame without what is rebuilt in it, whether or not the timed frames rebuilt it.
Number without_build_ms(const Record& record) {
  const bool is_timed = record.frame_build == BuildTiming::every_frame;
  return record.frame_ms.median - (is_timed ? record.frame_build_ms.value_or(0.0) : 0.0);
}

Number with_build_ms(const Record& record) { return *without_build_ms(record) + record.frame_build_ms.value_or(0.0); }

Number uncached_bake_s(const Record& record) {
  return record.precompute_cached ? Number() : Number(record.precompute_seconds);
}

// The formats of cells.
namespace cell {

using Format = decltype(Figure::format);

constexpr Format number = [](const Number& value, const Record&) { return fmt::format("{}", value.value_or(0)); };
constexpr Format error = [](const Number& value, const Record&) { return error_text(value); };
constexpr Format figure = [](const Number& value, const Record&) { return value ? three_figures(*value) : "n/a"; };
constexpr Format counted = [](const Number& value, const Record&) { return value ? three_figures(*value) : "–"; };
constexpr Format significant = [](const Number& value, const Record&) {
  return value ? fmt::format("{:.3g}", *value) : "–";
};
constexpr Format pixels = [](const Number&, const Record& record) {
  return fmt::format("{}{}", record.pixels.interior, record.pixels.interior < few_pixels ? " !" : "");
};
constexpr Format samples = [](const Number&, const Record& record) { return equivalent_text(record); };
constexpr Format frame = [](const Number&, const Record& record) {
  return spread_text(record.frame_ms.median, record.frame_ms.min, record.frame_ms.p90);
};
constexpr Format ratio = [](const Number&, const Record& record) { return ratio_text(record.ratio_to_direct); };
constexpr Format build = [](const Number& value, const Record& record) {
  return value ? fmt::format("{}, {}", three_figures(*value), build_text(record)) : "none";
};
constexpr Format bytes = [](const Number&, const Record& record) { return readable_bytes(record.precompute_bytes); };
constexpr Format left_out = [](const Number&, const Record& record) {
  return list_text(record.effects_left_out, "none");
};

}  // namespace cell

constexpr std::string_view error_unit = "normalised colour error, 0 to 1";
constexpr std::string_view cause_unit = "normalised colour by cause, 0 to 2";
constexpr std::string_view part_unit = "normalised colour error over some of the pixels, 0 to 1";
constexpr std::string_view no_bound = "the bound was not drawn";

constexpr auto all_figures = std::to_array<Figure>({
    {.key = "scene", .place = "/scene", .unit = "text", .text = word<&Record::scene>},
    {.key = "method", .place = "/method", .unit = "text", .text = word<&Record::method>},
    {.key = "options", .place = "/options", .unit = "text, `name=value;name=value`", .text = options_text},
    {.key = "history_frames",
     .place = "/history/frames",
     .unit = "frames before the image",
     .number = at<&Record::history, &HistorySettings::frames>},
    {.key = "distance",
     .place = "/distance",
     .unit = "factor on the scene's own distance",
     .number = at<&Record::distance>,
     .title = "Distance",
     .meaning = "Camera distance, as a multiple of the scene’s own.",
     .format = cell::number},
    {.key = "degrees", .place = "/degrees", .unit = "angle since the first frame", .number = at<&Record::degrees>},
    {.key = "seconds", .place = "/seconds", .unit = "time of the animation, s", .number = at<&Record::seconds>},
    {.key = "frame", .place = "/frame", .unit = "number from 0", .number = at<&Record::frame>},
    {.key = "width_px", .place = "/size/0", .unit = "pixels", .number = at<&Record::width>},
    {.key = "height_px", .place = "/size/1", .unit = "pixels", .number = at<&Record::height>},
    {.key = "normalized_color_error",
     .place = "/error/normalized_color",
     .unit = error_unit,
     .metric = &ErrorFigures::normalized_color,
     .noise = at<&Record::error, &RecordError::noise_floor>,
     .title = "Error",
     .meaning =
         "Normalised colour error against the reference, 0 to 1: mean over the object’s pixels. Lower is better.",
     .format = cell::error,
     .call = {.name = "error", .needs = FigureNeeds::other_reference}},
    {.key = "relative_rmse",
     .place = "/error/relative_rmse",
     .unit = "none",
     .metric = &ErrorFigures::relative_rmse,
     .title = "Rel. RMSE",
     .meaning = "Root of the summed squared difference over the summed squared reference, on linear radiance.",
     .format = cell::figure,
     .call = {.name = "relative_rmse"},
     .is_of_radiance = true},
    {.key = "relmse",
     .place = "/error/relmse",
     .unit = "none",
     .metric = &ErrorFigures::relmse,
     .title = "relMSE",
     .meaning = "Mean squared difference relative to the squared reference, on linear radiance.",
     .format = cell::figure,
     .call = {.name = "relmse"},
     .is_of_radiance = true},
    {.key = "psnr_db",
     .place = "/error/psnr",
     .unit = "dB",
     .metric = &ErrorFigures::psnr,
     .title = "PSNR dB",
     .meaning = "Peak signal-to-noise ratio of displayed values. Higher is better.",
     .format = cell::figure,
     .call = {.name = "psnr"},
     .is_better_larger = true},
    {.key = "energy_bias",
     .place = "/error/energy_bias",
     .unit = "none",
     .metric = &ErrorFigures::energy_bias,
     .title = "Energy",
     .meaning = "Summed radiance over the reference’s, minus 1.",
     .format = cell::figure,
     .call = {.name = "energy_bias"},
     .is_of_radiance = true},
    {.key = "luminance_distance",
     .place = "/error/luminance_distance",
     .unit = "luminance as shown, 0 to 1",
     .metric = &ErrorFigures::luminance_distance,
     .title = "Lum. dist.",
     .meaning = "Mean distance of the sorted displayed luminances of image and reference: whether it sparkles as much.",
     .format = cell::error,
     .call = {.name = "luminance_distance"}},
    {.key = "smape",
     .place = "/error/smape",
     .unit = "none, 0 to 1",
     .metric = &ErrorFigures::smape,
     .title = "SMAPE",
     .meaning = "Difference over the sum of image and reference, on linear radiance: mean over interior pixels.",
     .format = cell::error,
     .call = {.name = "smape", .absent = "no pixel is interior"},
     .is_of_radiance = true},
    {.key = "ssim",
     .place = "/error/ssim",
     .unit = "none, -1 to 1",
     .metric = &ErrorFigures::ssim,
     .title = "SSIM",
     .meaning = "Structural similarity of displayed luminances, mean over windows of 11 x 11 pixels. Higher is better.",
     .format = cell::error,
     .call = {.name = "ssim", .absent = "no object pixel is five or more pixels from the border"},
     .is_better_larger = true},
    {.key = "noise_floor",
     .place = "/error/noise_floor",
     .unit = error_unit,
     .number = at<&Record::error, &RecordError::noise_floor>,
     .call = {.name = "noise_floor"}},
    {.key = "representation_error",
     .place = "/error/representation",
     .unit = error_unit,
     .number = at<&Record::error, &RecordError::representation>,
     .title = "Lobe fit",
     .meaning = "Error of the method’s finest level, supersampled. It remains without any filtering.",
     .format = cell::error,
     .call = {.name = "representation"}},
    {.key = "filtering_error",
     .place = "/error/filtering",
     .unit = error_unit,
     .number = at<&Record::error, &RecordError::filtering>,
     .call = {.name = "filtering"}},
    {.key = "shading_error",
     .place = "/error/shading",
     .unit = part_unit,
     .number = at<&Record::error, &RecordError::causes, &ErrorCauses::shading>,
     .noise = at<&Record::error, &RecordError::causes, &ErrorCauses::shading_floor>,
     .title = "Shading",
     .meaning = "Mean error over interior pixels, in which the reference sees one smooth piece of surface. Methods are "
                "ranked by it.",
     .format = cell::error,
     .call = {.name = "shading_error", .absent = "no pixel is interior"}},
    {.key = "shading_floor",
     .place = "/error/shading_floor",
     .unit = part_unit,
     .number = at<&Record::error, &RecordError::causes, &ErrorCauses::shading_floor>},
    {.key = "shading_noise",
     .place = "/error/shading_noise",
     .unit = part_unit,
     .number = at<&Record::error, &RecordError::causes, &ErrorCauses::shading_noise>},
    {.key = "edges_error",
     .place = "/error/edges",
     .unit = part_unit,
     .number = at<&Record::error, &RecordError::causes, &ErrorCauses::edges>,
     .title = "Edges",
     .meaning = "Mean error over the object’s other pixels, which no method filters.",
     .format = cell::error,
     .call = {.name = "edge_error", .absent = "no pixel has an edge"}},
    {.key = "filter_error",
     .place = "/error/filter",
     .unit = part_unit,
     .number = at<&Record::error, &RecordError::causes, &ErrorCauses::filter>,
     .title = "Filter",
     .meaning = "Error of the exact normal distribution under the same footprint filter.",
     .format = cell::error,
     .call = {.name = "filter_error", .absent = no_bound}},
    {.key = "method_error",
     .place = "/error/method",
     .unit = part_unit,
     .number = at<&Record::error, &RecordError::causes, &ErrorCauses::method>,
     .title = "Own error",
     .meaning = "Difference between the method’s image and that of the exact normal distribution.",
     .format = cell::error,
     .call = {.name = "method_error", .absent = no_bound}},
    {.key = "light_error",
     .place = "/error/light",
     .unit = part_unit,
     .number = at<&Record::error, &RecordError::causes, &ErrorCauses::light>,
     .title = "Light",
     .meaning = "Error of the environment lookup, compared with the whole environment.",
     .format = cell::error,
     .call = {.name = "light_error", .absent = "there is no environment"}},
    {.key = "object_pixels",
     .place = "/pixels/object",
     .unit = "pixels",
     .number = at<&Record::pixels, &PixelCounts::object>},
    {.key = "unresolved_pixels",
     .place = "/pixels/unresolved",
     .unit = "pixels",
     .number = at<&Record::pixels, &PixelCounts::unresolved>},
    {.key = "interior_pixels",
     .place = "/pixels/interior",
     .unit = "pixels",
     .number = at<&Record::pixels, &PixelCounts::interior>,
     .title = "Pixels",
     .meaning = "Number of interior pixels; ! marks fewer than 100.",
     .format = cell::pixels,
     .call = {.name = "interior_pixels"}},
    {.key = "minified_pixels",
     .place = "/pixels/minified",
     .unit = "pixels",
     .number = at<&Record::pixels, &PixelCounts::minified>},
    {.key = "bound_pixels",
     .place = "/pixels/bound",
     .unit = "pixels",
     .number = at<&Record::pixels, &PixelCounts::bound>},
    {.key = "light_pixels",
     .place = "/pixels/light",
     .unit = "pixels",
     .number = at<&Record::pixels, &PixelCounts::light>},
    {.key = "equivalent_spp",
     .place = "/equivalent_spp",
     .unit = "frames of `direct`",
     .number = equivalent_spp,
     .title = "=\u00a0spp",
     .meaning = "Samples per pixel of plain supersampling with the same shading error.",
     .format = cell::samples},
    {.key = "equivalent_spp_or_end",
     .number = at<&Record::equivalent, &EquivalentSamples::spp>,
     .call = {.name = "equivalent_spp"}},
    {.key = "equivalent_bound",
     .place = "/equivalent_bound",
     .unit = "`<1`, `>64` or `n/a` where there is no figure",
     .text = equivalent_bound},
    {.key = "flicker",
     .place = "/flicker/mean",
     .unit = "normalised colour, 0 to 2",
     .number = at<&Record::flicker, &Flicker::mean>,
     .noise = at<&Record::flicker, &Flicker::noise_floor>,
     .title = "Flicker",
     .meaning = "How much the change since the previous frame differs from the reference’s, 0 to 2.",
     .format = cell::significant,
     .call = {.name = "flicker", .needs = FigureNeeds::frame_before}},
    {.key = "flicker_p99",
     .place = "/flicker/p99",
     .unit = "normalised colour, 0 to 2",
     .number = at<&Record::flicker, &Flicker::p99>,
     .call = {.name = "flicker_p99", .needs = FigureNeeds::frame_before}},
    {.key = "flicker_noise_floor",
     .place = "/flicker/noise_floor",
     .unit = "normalised colour, 0 to 2",
     .number = at<&Record::flicker, &Flicker::noise_floor>},
    {.key = "ghosting",
     .place = "/flicker/ghosting",
     .unit = part_unit,
     .number = at<&Record::flicker, &Flicker::ghosting>},
    {.key = "flicker_shading",
     .place = "/flicker/shading/mean",
     .unit = cause_unit,
     .number = at<&Record::flicker, &Flicker::causes, &FlickerCauses::shading, &FlickerFigures::mean>},
    {.key = "flicker_shading_p99",
     .place = "/flicker/shading/p99",
     .unit = cause_unit,
     .number = at<&Record::flicker, &Flicker::causes, &FlickerCauses::shading, &FlickerFigures::p99>},
    {.key = "flicker_edges",
     .place = "/flicker/edges/mean",
     .unit = cause_unit,
     .number = at<&Record::flicker, &Flicker::causes, &FlickerCauses::edges, &FlickerFigures::mean>},
    {.key = "flicker_edges_p99",
     .place = "/flicker/edges/p99",
     .unit = cause_unit,
     .number = at<&Record::flicker, &Flicker::causes, &FlickerCauses::edges, &FlickerFigures::p99>},
    {.key = "flicker_filter",
     .place = "/flicker/filter/mean",
     .unit = cause_unit,
     .number = at<&Record::flicker, &Flicker::causes, &FlickerCauses::filter, &FlickerFigures::mean>},
    {.key = "flicker_filter_p99",
     .place = "/flicker/filter/p99",
     .unit = cause_unit,
     .number = at<&Record::flicker, &Flicker::causes, &FlickerCauses::filter, &FlickerFigures::p99>},
    {.key = "flicker_method",
     .place = "/flicker/method/mean",
     .unit = cause_unit,
     .number = at<&Record::flicker, &Flicker::causes, &FlickerCauses::method, &FlickerFigures::mean>},
    {.key = "flicker_method_p99",
     .place = "/flicker/method/p99",
     .unit = cause_unit,
     .number = at<&Record::flicker, &Flicker::causes, &FlickerCauses::method, &FlickerFigures::p99>},
    {.key = "highlight_energy",
     .place = "/highlight_energy",
     .unit = "exposed luminance",
     .number = at<&Record::highlight_energy>},
    {.key = "reference_highlight_energy",
     .place = "/reference_highlight_energy",
     .unit = "exposed luminance",
     .number = at<&Record::reference_highlight_energy>},
    {.key = "node",
     .place = "/time/node",
     .unit = "name of the machine that the times were taken on",
     .text = word<&Record::node>},
    {.key = "frame_median_ms",
     .place = "/time/frame_ms/median",
     .unit = "milliseconds",
     .number = at<&Record::frame_ms, &FrameTime::median>,
     .title = "Frame ms",
     .meaning = "Time per frame: median (minimum–90th percentile of the repeats).",
     .format = cell::frame,
     .call = {.name = "time"},
     .is_of_machine = true},
    {.key = "frame_min_ms",
     .place = "/time/frame_ms/min",
     .unit = "milliseconds",
     .number = at<&Record::frame_ms, &FrameTime::min>},
    {.key = "frame_p90_ms",
     .place = "/time/frame_ms/p90",
     .unit = "milliseconds",
     .number = at<&Record::frame_ms, &FrameTime::p90>},
    {.key = "frame_build_ms",
     .place = "/time/frame_build_ms",
     .unit = "milliseconds",
     .number = at<&Record::frame_build_ms>,
     .title = "Build ms",
     .meaning = "Time to rebuild maps when something moves, and whether frame times include it.",
     .format = cell::build,
     .call = {.name = "build"},
     .is_of_machine = true},
    {.key = "frame_without_build_ms", .number = without_build_ms, .call = {.name = "shading"}, .is_of_machine = true},
    {.key = "frame_with_build_ms", .number = with_build_ms, .call = {.name = "total"}, .is_of_machine = true},
    {.key = "frame_build",
     .place = "/time/frame_build",
     .unit = "`every frame`, or `reused`: the frame times have no build in them",
     .text = build_text},
    {.key = "frames_per_second",
     .place = "/time/fps",
     .unit = "1/s",
     .number = at<&Record::fps>,
     .title = "fps",
     .meaning = "Frames per second at the median frame time.",
     .format = cell::figure,
     .call = {.name = "fps"},
     .is_of_machine = true},
    {.key = "fetches",
     .place = "/time/fetches",
     .unit = "texture lookups per pixel",
     .number = at<&Record::fetches>,
     .title = "Fetches",
     .meaning = "Texture lookups per pixel, counted; – for methods whose frames take seconds.",
     .format = cell::counted},
    {.key = "lobes",
     .place = "/time/lobes",
     .unit = "lobes evaluated per pixel",
     .number = at<&Record::lobes>,
     .title = "Lobes",
     .meaning = "Lobes evaluated per pixel over all lights, counted; – for methods whose frames take seconds.",
     .format = cell::counted},
    {.key = "ratio_to_direct_median",
     .place = "/time/ratio_to_direct/median",
     .unit = "none",
     .number = at<&Record::ratio_to_direct, &TimeRatio::median>,
     .title = "× direct",
     .meaning = "Frame time relative to direct under the same footprint filter: median (95% interval of the median).",
     .format = cell::ratio,
     .call = {.name = "ratio"}},
    {.key = "ratio_to_direct_low",
     .place = "/time/ratio_to_direct/low",
     .unit = "none",
     .number = at<&Record::ratio_to_direct, &TimeRatio::low>},
    {.key = "ratio_to_direct_high",
     .place = "/time/ratio_to_direct/high",
     .unit = "none",
     .number = at<&Record::ratio_to_direct, &TimeRatio::high>},
    {.key = "precompute_s",
     .place = "/precompute/seconds",
     .unit = "seconds",
     .number = at<&Record::precompute_seconds>,
     .title = "Bake s",
     .meaning = "Bake time in seconds.",
     .format = cell::figure},
    {.key = "precompute_uncached_s",
     .number = uncached_bake_s,
     .call = {.name = "precompute", .absent = "the bake came from the cache (give --no-cache)"}},
    {.key = "precompute_bytes",
     .place = "/precompute/bytes",
     .unit = "bytes",
     .number = at<&Record::precompute_bytes>,
     .title = "Maps",
     .meaning = "Memory of the baked maps.",
     .format = cell::bytes,
     .call = {.name = "bytes"}},
    {.key = "precompute_bytes_per_texel",
     .place = "/precompute/bytes_per_texel",
     .unit = "bytes per texel",
     .number = at<&Record::precompute_bytes_per_texel>,
     .title = "B/texel",
     .meaning = "Bytes per texel of the finest level.",
     .format = cell::figure,
     .call = {.name = "bytes_per_texel"}},
    {.key = "precompute_cached", .place = "/precompute/cached", .unit = "`true` or `false`", .text = cached_text},
    {.key = "effects_on", .place = "/effects/on", .unit = "names with `;` between", .text = names<&Record::effects_on>},
    {.key = "effects_left_out",
     .place = "/effects/left_out",
     .unit = "names with `;` between",
     .text = names<&Record::effects_left_out>,
     .title = "Left out",
     .meaning = "Effects of the scene that the method cannot render.",
     .format = cell::left_out,
     .is_words = true},
    {.key = "image_color",
     .place = "/images/color",
     .unit = "paths from the output folder",
     .text = image<&RecordImages::color>},
    {.key = "image_reference",
     .place = "/images/reference",
     .unit = "paths from the output folder",
     .text = image<&RecordImages::reference>},
    {.key = "image_error",
     .place = "/images/error",
     .unit = "paths from the output folder",
     .text = image<&RecordImages::error>},
    {.key = "image_error_shared",
     .place = "/images/error_shared",
     .unit = "paths from the output folder",
     .text = image<&RecordImages::error_shared>},
    {.key = "image_flip",
     .place = "/images/flip",
     .unit = "paths from the output folder",
     .text = image<&RecordImages::flip>},
    {.key = "image_interior",
     .place = "/images/interior",
     .unit = "paths from the output folder",
     .text = image<&RecordImages::interior>},
    {.key = "image_standard_error",
     .place = "/images/standard_error",
     .unit = "paths from the output folder",
     .text = image<&RecordImages::standard_error>},
    {.key = "failure", .place = "/failure", .unit = "text; empty if the method did not fail", .text = failure_text},
    {.key = "rank",
     .title = "Rank",
     .meaning = "By shading error. Methods that differ by no more than the reference’s noise share a rank; – if too "
                "few pixels are interior."},
});

// A value of results.csv; empty if it is absent.
std::string csv_cell(const Figure& figure, const Record& record) {
  return figure.text != nullptr ? csv_field(figure.text(record)) : csv_field(figure.of(record));
}

}  // namespace

std::optional<double> metric_value(const ImageMetric& metric, const ErrorFigures& figures) {
  return std::visit([&](auto member) { return number_of(figures.*member); }, metric);
}

std::optional<double> Figure::of(const Record& record) const {
  if (metric) return record.error ? metric_value(*metric, *record.error) : std::nullopt;
  return number != nullptr ? number(record) : std::nullopt;
}

std::span<const Figure> record_figures() { return all_figures; }

const Figure& figure_of(std::string_view key) {
  const auto found = std::ranges::find(all_figures, key, &Figure::key);
  if (found == all_figures.end()) throw std::logic_error("no figure `" + std::string(key) + "`");
  return *found;
}

const char* metric_name(const Figure& figure) { return figure.place + std::string_view(figure.place).rfind('/') + 1; }

std::string cell_text(const Figure& figure, const Record& record) { return figure.format(figure.of(record), record); }

std::string csv_header() {
  std::vector<std::string_view> names;
  for (const Figure& figure : all_figures) {
    if (*figure.place != '\0') names.push_back(figure.key);
  }
  return fmt::format("{}", fmt::join(names, ","));
}

std::string csv_line(const Record& record) {
  std::vector<std::string> values;
  for (const Figure& figure : all_figures) {
    if (*figure.place != '\0') values.push_back(csv_cell(figure, record));
  }
  return fmt::format("{}", fmt::join(values, ","));
}

}  // namespace footprint
