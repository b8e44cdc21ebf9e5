// Reads and masks images, and takes each measure from its own function.
#include "experiments/studies/score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/image/image_io.hpp"
#include "results/report/figure_table.hpp"

namespace footprint {
namespace {

Image with_coverage(Image image, const std::string& file) {
  if (image.channels == 4) return image;
  if (image.channels != 3) {
    throw Error(ErrorKind::usage, file, fmt::format("it has {} channels", image.channels),
                "give an image of RGB, or of RGB and coverage");
  }
  Image out(image.width, image.height, 4, 1.0F);
  for (std::size_t i = 0; i < out.texel_count(); ++i) std::copy_n(&image.texels[3 * i], 3, &out.texels[4 * i]);
  return out;
}

// An image whose alpha is 0 everywhere would count as black, whatever its colours.
void require_covered(const Image& image, const std::string& file) {
  for (std::size_t i = 3; i < image.texels.size(); i += 4) {
    if (image.texels[i] > 0.0F) return;
  }
  throw Error(ErrorKind::usage, file, "its alpha is 0 everywhere, so it covers no pixel",
              "store coverage in alpha (A), or leave alpha out");
}

// The object pixels in one row: a background would dominate a median.
Image object_row(const Image& radiance, const Image& object) {
  Image row(0, 1, 4);
  for (std::size_t i = 0; i < object.texel_count(); ++i) {
    if (object.texels[i] <= 0.0F) continue;
    ++row.width;
    row.texels.insert(row.texels.end(), &radiance.texels[4 * i], &radiance.texels[4 * i] + 4);
  }
  return row;
}

double mean_over(const Image& map, const Image& object) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < map.texels.size(); ++i) {
    if (object.texels[i] <= 0.0F) continue;
    sum += map.texels[i];
    ++count;
  }
  return sum / count;
}

void require_size(const Image& image, const Image& reference, const std::string& name) {
  if (image.width == reference.width && image.height == reference.height) return;
  throw Error(
      ErrorKind::usage, name,
      fmt::format("it is {} x {}, the reference {} x {}", image.width, image.height, reference.width, reference.height),
      "give images of one size and view");
}

// Makes a pixel uncovered, and so not an object pixel, without changing its colour.
void exclude(Image& reference, std::size_t pixel) {
  float& coverage = reference.texels[4 * pixel + 3];
  coverage = std::min(coverage, 0.5F);
}

// The measure of a figure that any two images have.
ScoreMetric metric_of(const Figure& figure) {
  return {.key = metric_name(figure),
          .title = figure.title,
          .value =
              [&figure](const PictureScore& score) {
                if (score.displayed && figure.is_of_radiance) return std::optional<double>();
                return metric_value(*figure.metric, score.error);
              },
          .is_better_larger = figure.is_better_larger};
}

std::vector<ScoreMetric> every_metric() {
  std::vector<ScoreMetric> metrics;
  for (const Figure& figure : record_figures()) {
    if (figure.metric) metrics.push_back(metric_of(figure));
  }
  metrics.push_back({"ldr_flip", "LDR-FLIP", [](const PictureScore& s) { return std::optional(s.ldr_flip); }});
  metrics.push_back({"hdr_flip", "HDR-FLIP", [](const PictureScore& s) { return s.hdr_flip; }});
  const auto after_the_mean = std::ranges::find(metrics, "normalized_color", &ScoreMetric::key) + 1;
  metrics.insert(after_the_mean, {"normalized_color_p99", "99th perc.",
                                  [](const PictureScore& s) { return std::optional(error_percentile(s, 99.0)); }});
  return metrics;
}

constexpr double standard_errors = 3.0;
constexpr double rounding = 1e-5;  // of displayed values: the error of sums of 32-bit floats

double displayed(float value, float exposure) {
  return std::clamp(static_cast<double>(exposure) * static_cast<double>(value), 0.0, 1.0);
}

// Colours that are not covered count as black, as in errors.
double channel(std::span<const float> texel, std::size_t c, float exposure) {
  return texel[3] > 0.0F ? displayed(texel[c], exposure) : 0.0;
}

// Which of two displayed colours a, b is closer to r is a question of sides: |r - a| < |r - b| if
//
//   (r - (a + b) / 2) . (a - b) > 0,
//
// which is linear in r. Noise of standard error s_c per channel therefore gives the left side a standard error of at
// most sum_c |a_c - b_c| s_c, which it has if the channels err together, as under one light.
float verdict(std::span<const float> a, std::span<const float> b, std::span<const float> mean,
              std::span<const float> standard_error, float exposure) {
  double side = 0, noise = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double first = channel(a, c, exposure), second = channel(b, c, exposure);
    const double error = static_cast<double>(exposure) * static_cast<double>(standard_error[c]);
    side += (displayed(mean[c], exposure) - (first + second) / 2) * (first - second);
    noise += std::abs(first - second) * (standard_errors * error + rounding);
  }
  if (std::abs(side) <= noise) return 0.0F;
  return side > 0 ? 1.0F : -1.0F;
}

// Okabe and Ito's colours, which all kinds of colour vision can distinguish.
using Color = std::array<float, 3>;  // display values; results/report/page.css has them too

constexpr Color first_closer{0.0F, 0.447F, 0.698F}, second_closer{0.835F, 0.369F, 0.0F}, undecided{0.8F, 0.8F, 0.8F};
constexpr Color outside{1.0F, 1.0F, 1.0F};

Color color_of(float verdict, bool on_object) {
  if (!on_object) return outside;
  return verdict > 0.0F ? first_closer : verdict < 0.0F ? second_closer : undecided;
}

constexpr std::string_view share_prefix = "share_above:";
constexpr std::string_view rejected_name = "rejected";

const ScoreMetric* metric_named(std::string_view name) {
  const auto found = std::ranges::find(score_metrics(), name, &ScoreMetric::key);
  return found == score_metrics().end() ? nullptr : &*found;
}

double number_in(const std::string& text, const std::string& place, double least, double most) {
  const auto number = parse_whole_of<double>(text);
  if (number && *number >= least && *number <= most) return *number;
  throw Error(ErrorKind::usage, place, fmt::format("`{:.80}` is not a number from {:g} to {:g}", text, least, most),
              "write --max normalized_color=0.02");
}

bool is_percentile(const std::string& name) {
  return name.size() > 1 && name.front() == 'p' && (std::isdigit(static_cast<unsigned char>(name[1])) != 0);
}

// The part of a name that is a number, which is taken off it.
double take_parameter(std::string& name, const std::string& place) {
  if (is_percentile(name)) {
    const double percent = number_in(name.substr(1), place, 0.0, 100.0);
    name = "p";
    return percent;
  }
  if (!name.starts_with(share_prefix)) return 0.0;
  const double error = number_in(name.substr(share_prefix.size()), place, 0.0, 1.0);
  name = share_prefix;
  return error;
}

}  // namespace

std::span<const ScoreMetric> score_metrics() {
  static const std::vector<ScoreMetric> metrics = every_metric();
  return metrics;
}

Image shown(const Image& radiance, float exposure) {
  Image out(radiance.width, radiance.height, 3);
  for (std::size_t i = 0; i < out.texel_count(); ++i) {
    if (radiance.texels[4 * i + 3] <= 0.0F) continue;
    for (std::size_t c = 0; c < 3; ++c) out.texels[3 * i + c] = exposure * radiance.texels[4 * i + c];
  }
  return out;
}

ScoredPicture read_scored(const std::string& file, float exposure) {
  FileImage read = read_file_image(file, Transfer::declared);
  ScoredPicture out{file, with_coverage(std::move(read.image), file), !read.floats, std::move(read.notes)};
  require_covered(out.radiance, file);
  if (!out.displayed) return out;
  for (std::size_t i = 0; i < out.radiance.texels.size(); ++i)
    if (i % 4 < 3) out.radiance.texels[i] /= exposure;
  return out;
}

ScoredPicture read_reference(const std::string& file) {
  FileImage read = read_file_image(file, Transfer::declared);
  ScoredPicture out{file, with_coverage(std::move(read.image), file), false, std::move(read.notes)};
  if (read.floats) return out;
  throw Error(ErrorKind::usage, file, "it stores displayed colours, but a reference needs linear radiance",
              "give an EXR, as `footprint render SCENE --method reference -o reference.exr` writes it");
}

std::size_t leave_out_unresolved(Image& reference, const Image& standard_error, float exposure) {
  require_size(standard_error, reference, "the standard error");
  Supersampled whole;
  whole.mean = reference;
  whole.standard_error = standard_error;
  const Image mask = unresolved(whole, exposure);
  const std::size_t before = object_pixel_count(reference);
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    if (mask.texels[i] > 0.0F) exclude(reference, i);
  }
  return before - object_pixel_count(reference);
}

Image masked(Image reference, const Image& mask, const std::string& mask_name) {
  require_size(mask, reference, mask_name);
  for (std::size_t i = 0; i < reference.texel_count(); ++i) {
    const auto texel =
        std::span(mask.texels)
            .subspan(i * static_cast<std::size_t>(mask.channels), static_cast<std::size_t>(std::min(mask.channels, 3)));
    const bool counts = std::ranges::any_of(texel, [](float value) { return value > 0.0F; });
    if (!counts) exclude(reference, i);
  }
  if (object_pixel_count(reference) > 0) return reference;
  throw Error(ErrorKind::usage, mask_name, "it leaves no pixel that the reference covers whole",
              "pixels that are not black in the mask count");
}

PictureScore score_picture(const ScoredPicture& picture, const Image& reference, float exposure,
                           double pixels_per_degree) {
  require_size(picture.radiance, reference, picture.name);
  try {
    const auto error = compare_images(picture.radiance, reference, exposure);
    if (!error) {
      throw Error(ErrorKind::usage, "reference", "no pixel is covered whole",
                  "give a reference whose alpha is 1 on the object, or none");
    }
    const Image object = object_pixels(reference);
    PictureScore out;
    out.name = picture.name;
    out.displayed = picture.displayed;
    out.error = *error;
    const Image errors = error_map(picture.radiance, reference, exposure);
    for (std::size_t i = 0; i < object.texel_count(); ++i) {
      if (object.texels[i] > 0.0F) out.pixel_errors.push_back(errors.texels[i]);
    }
    std::ranges::sort(out.pixel_errors);
    out.ldr_map = ldr_flip(shown(picture.radiance, exposure), shown(reference, exposure), pixels_per_degree);
    out.ldr_flip = mean_over(out.ldr_map, object);
    if (picture.displayed) return out;
    out.hdr_map = hdr_flip(shown(picture.radiance, 1.0F), shown(reference, 1.0F),
                           flip_exposures(object_row(reference, object)), pixels_per_degree);
    out.hdr_flip = mean_over(out.hdr_map, object);
    return out;
  } catch (const Error& error) {
    throw error.within(picture.name);
  }
}

double error_percentile(const PictureScore& score, double percent) {
  const double rank = std::ceil(percent / 100.0 * static_cast<double>(score.pixel_errors.size()));
  return score.pixel_errors[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

std::size_t rejected_pixels(const Image& picture, const Image& reference, const PixelTest& test) {
  require_size(test.reference_error, reference, "the standard error");
  const bool noisy = !test.picture_error.empty();
  if (noisy) require_size(test.picture_error, reference, "the image's standard error");
  const Image object = object_pixels(reference);
  const double tests = 3.0 * static_cast<double>(object_pixel_count(reference));
  const double least = -std::expm1(std::log1p(-test.significance) / tests);
  const auto is_off = [&](int x, int y, std::size_t c) {
    const double difference = static_cast<double>(picture.at(x, y)[c]) - static_cast<double>(reference.at(x, y)[c]);
    const double own = noisy ? static_cast<double>(test.picture_error.at(x, y)[c]) : 0.0;
    const double error = std::hypot(static_cast<double>(test.reference_error.at(x, y)[c]), own);
    return difference != 0.0 && std::erfc(std::abs(difference) / (std::numbers::sqrt2 * error)) < least;
  };
  std::size_t rejected = 0;
  for (int y = 0; y < object.height; ++y) {
    for (int x = 0; x < object.width; ++x) {
      if (object.at(x, y)[0] > 0.0F && (is_off(x, y, 0) || is_off(x, y, 1) || is_off(x, y, 2))) ++rejected;
    }
  }
  return rejected;
}

Image verdict_picture(const Image& verdicts, const Image& object) {
  Image picture(verdicts.width, verdicts.height, 3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x)
      std::ranges::copy(color_of(verdicts.at(x, y)[0], object.at(x, y)[0] > 0.0F), picture.at(x, y).begin());
  }
  return picture;
}

Image closer_beyond_noise(const Image& a, const Image& b, const Image& mean, const Image& standard_error,
                          float exposure) {
  const Image object = object_pixels(mean);
  Image verdicts(object.width, object.height, 1);
  for (int y = 0; y < object.height; ++y) {
    for (int x = 0; x < object.width; ++x) {
      if (object.at(x, y)[0] > 0.0F)
        verdicts.at(x, y)[0] = verdict(a.at(x, y), b.at(x, y), mean.at(x, y), standard_error.at(x, y), exposure);
    }
  }
  return verdicts;
}

std::optional<std::array<double, 2>> closer_shares(const Image& verdicts, const Image& mask) {
  std::size_t pixels = 0, a = 0, b = 0;
  for (std::size_t i = 0; i < mask.texel_count(); ++i) {
    if (mask.texels[i] <= 0.0F) continue;
    ++pixels;
    a += verdicts.texels[i] > 0.0F ? 1 : 0;
    b += verdicts.texels[i] < 0.0F ? 1 : 0;
  }
  if (pixels == 0) return std::nullopt;
  const auto all = static_cast<double>(pixels);
  return std::array{static_cast<double>(a) / all, static_cast<double>(b) / all};
}

PairScore score_pair(const ScoredPicture& a, const ScoredPicture& b, const Image& reference,
                     const Image& standard_error, float exposure) {
  const bool known = !standard_error.empty();
  if (known) require_size(standard_error, reference, "standard error");
  PairScore out;
  out.beyond_noise = known;
  out.object = object_pixels(reference);
  out.verdicts = closer_beyond_noise(a.radiance, b.radiance, reference,
                                     known ? standard_error : Image(reference.width, reference.height, 3), exposure);
  out.shares = closer_shares(out.verdicts, out.object).value();
  return out;
}

ScoreLimit parse_score_limit(const std::string& text) {
  const std::string place = fmt::format("--max {:.200}", text);
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error(ErrorKind::usage, place, "is not NAME=VALUE", "write --max normalized_color=0.02");
  ScoreLimit limit{.text = text, .name = text.substr(0, equals)};
  limit.most = number_in(text.substr(equals + 1), place, -1e300, 1e300);
  limit.parameter = take_parameter(limit.name, place);
  const ScoreMetric* const metric = metric_named(limit.name);
  if (metric != nullptr && metric->is_better_larger)
    throw Error(ErrorKind::usage, place, fmt::format("a larger {} is better, so it has no upper limit", limit.name),
                "limit normalized_color");
  if (limit.name == "p" || limit.name == share_prefix || limit.name == rejected_name || metric != nullptr) return limit;
  std::vector<std::string> names{"p99", std::string(share_prefix) + "0.1", std::string(rejected_name)};
  for (const ScoreMetric& each : score_metrics()) names.emplace_back(each.key);
  throw Error(ErrorKind::usage, place, fmt::format("`{:.80}` is no measure of a score", limit.name),
              suggestion(limit.name, names));
}

std::optional<double> figure_of(const ScoreLimit& limit, const PictureScore& score) {
  if (const ScoreMetric* metric = metric_named(limit.name)) {
    const std::optional<double> value = metric->value(score);
    return value ? std::optional(std::abs(*value)) : value;
  }
  if (limit.name == "p") return error_percentile(score, limit.parameter);
  if (limit.name == rejected_name) {
    if (!score.rejected) return {};
    return static_cast<double>(*score.rejected);
  }
  const auto first = std::ranges::upper_bound(score.pixel_errors, static_cast<float>(limit.parameter));
  const auto above = static_cast<double>(score.pixel_errors.end() - first);
  return above / static_cast<double>(score.pixel_errors.size());
}

std::vector<CheckOutcome> limit_outcomes(std::span<const ScoreLimit> limits, const PictureScore& score) {
  std::vector<CheckOutcome> outcomes;
  for (const ScoreLimit& limit : limits) {
    const std::optional<double> figure = figure_of(limit, score);
    std::string failure;
    if (!figure) {
      failure = limit.name == rejected_name ? "there was no test: give --significance" : "the image has no such figure";
    } else if (!(*figure <= limit.most)) {
      failure = fmt::format("it is {:.4g}", *figure);
    }
    outcomes.push_back(
        {.suite = score.name, .name = "limit " + limit.text, .failure = std::move(failure), .place = score.name});
  }
  return outcomes;
}

}  // namespace footprint
