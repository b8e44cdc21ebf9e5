// Images of any origin against a reference: every measure of metrics.md, FLIP, and which of two images is closer
// at each pixel.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/image/flip.hpp"
#include "renderer/image/image.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "results/report/experiment_report.hpp"

namespace footprint {

/// An image to be scored.
struct ScoredPicture {
  std::string name;                  ///< as given
  Image radiance;                    ///< RGBA, linear; displayed colours are divided by the exposure
  bool displayed = false;            ///< its file stores displayed colours, which clip at white
  std::vector<std::string> notes{};  ///< what of its file is left out, one line each
};

/// Reads an image: files of floats store linear radiance, others displayed colours for a display of `exposure`, both as
/// they declare (Transfer::declared). Three channels are covered everywhere. Errors (usage): those of read_file_image;
/// other than 3 or 4 channels; alpha is 0 everywhere.
[[nodiscard]] ScoredPicture read_scored(const std::string& file, float exposure);

/// Reads a reference, which stores linear radiance. Errors (usage): as read_scored, but for alpha; displayed colours.
[[nodiscard]] ScoredPicture read_reference(const std::string& file);

/// The reference without the pixels at which `mask` (any channels, the size of the reference) is black: they are no
/// longer object pixels. Errors (usage): sizes differ; no object pixel is left.
[[nodiscard]] Image masked(Image reference, const Image& mask, const std::string& mask_name);

/// Excludes the pixels that the reference does not resolve (renderer/pipeline/unresolved.hpp), as a comparison does,
/// and returns their number. `standard_error`: RGB. Errors (usage): sizes differ.
std::size_t leave_out_unresolved(Image& reference, const Image& standard_error, float exposure);

/// Radiance times exposure in RGB; black where nothing is covered. radiance: RGBA.
[[nodiscard]] Image shown(const Image& radiance, float exposure);

struct PictureScore {
  std::string name;
  bool displayed = false;
  ErrorFigures error;
  double ldr_flip = 0;                  ///< mean over object pixels
  std::optional<double> hdr_flip;       ///< the same; none for displayed colours
  Image ldr_map, hdr_map;               ///< over all pixels; hdr_map is empty if hdr_flip is none
  std::vector<float> pixel_errors;      ///< normalised colour error of each object pixel, ascending; one or more
  std::optional<std::size_t> rejected;  ///< object pixels that are off by more than noise; none: not tested
};

/// The error that `percent` (0 to 100) of the object pixels do not exceed, by nearest rank.
[[nodiscard]] double error_percentile(const PictureScore& score, double percent);

/// The noise that a test per pixel compares differences with.
struct PixelTest {
  Image reference_error;       ///< standard error of the reference, RGB
  Image picture_error;         ///< of the image; empty: it has no noise
  double significance = 0.01;  ///< probability that a correct image has any rejected pixel, above 0 and below 1
};

/// The object pixels at which an image differs from the reference by more than noise: a two-sided test of the normal
/// distribution per pixel and channel, with Šidák's correction over all of them (1 - (1 - significance)^(1 / tests)),
/// as in Mitsuba's tests. Radiance is compared, without exposure. Errors (usage): sizes differ.
[[nodiscard]] std::size_t rejected_pixels(const Image& picture, const Image& reference, const PixelTest& test);

/// A measure of a score: an image metric of figure_table.hpp, or one that only scores have. In the order of tables and
/// of score.json.
struct ScoreMetric {
  std::string_view key, title;
  std::function<std::optional<double>(const PictureScore& score)> value;  ///< none for displayed colours if of radiance
  bool is_better_larger = false;                                          ///< it has no upper limit
};

[[nodiscard]] std::span<const ScoreMetric> score_metrics();

/// `reference`: its coverage selects the object pixels. `pixels_per_degree`: for FLIP. Errors (usage) name the image:
/// sizes differ, a value is not finite, there is no object pixel.
[[nodiscard]] PictureScore score_picture(const ScoredPicture& picture, const Image& reference, float exposure,
                                         double pixels_per_degree);

/// Decides per pixel which of two RGBA images is closer to the reference, by the normalised colour error (metrics.md)
/// and beyond three standard errors of the reference: one channel, 1 for `a`, -1 for `b`, 0 if noise does not decide or
/// the pixel is not an object pixel. standard_error: of the reference, RGB.
[[nodiscard]] Image closer_beyond_noise(const Image& a, const Image& b, const Image& reference,
                                        const Image& standard_error, float exposure);

/// Verdicts as display values: blue where `a` is closer, vermilion where `b` is, grey where neither is, white outside
/// `object` (one channel, above 0).
[[nodiscard]] Image verdict_picture(const Image& verdicts, const Image& object);

/// Shares of the mask's pixels (one channel, above 0) in which each image is closer; none if the mask is empty.
[[nodiscard]] std::optional<std::array<double, 2>> closer_shares(const Image& verdicts, const Image& mask);

/// The closer one of two images, pixel by pixel.
struct PairScore {
  std::array<double, 2> shares{};
  Image verdicts, object;
  bool beyond_noise = false;  ///< by three standard errors of the reference; otherwise any difference counts
};

/// `standard_error`: RGB of the reference's size, or empty if it is not known. Errors (usage): its size differs.
[[nodiscard]] PairScore score_pair(const ScoredPicture& a, const ScoredPicture& b, const Image& reference,
                                   const Image& standard_error, float exposure);

/// A limit as `--max NAME=VALUE` writes it. NAME is a measure of score_metrics() (its absolute value; not of one that
/// is better if larger), `pN` (the Nth percentile of the normalised colour error over object pixels, 0 to 100),
/// `share_above:E` (the share of object pixels whose error is above E), or `rejected` (pixels that the test per pixel
/// rejects).
struct ScoreLimit {
  std::string text;  ///< as written
  std::string name;
  double most = 0;
  double parameter = 0;  ///< N or E
};

/// Errors (usage): not that form, an unknown measure with the nearest one, a number out of range.
[[nodiscard]] ScoreLimit parse_score_limit(const std::string& text);

/// The figure that a limit is about; none where the image has none, as measures of radiance of displayed colours.
[[nodiscard]] std::optional<double> figure_of(const ScoreLimit& limit, const PictureScore& score);

/// An outcome per limit, in the suite of the image. A figure that the image does not have fails.
[[nodiscard]] std::vector<CheckOutcome> limit_outcomes(std::span<const ScoreLimit> limits, const PictureScore& score);

}  // namespace footprint
