// Pictures of any origin against a reference: every measure of docs/metrics.md, FLIP, and which of two is closer where.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/significance.hpp"
#include "renderer/image/flip.hpp"
#include "renderer/image/image.hpp"
#include "renderer/image/metrics.hpp"

namespace footprint {

/// A picture as it is scored.
struct ScoredPicture {
  std::string name;  ///< as given
  Image radiance;    ///< RGBA, linear; of a picture of displayed colours these, divided by the exposure
  /// Read from a format of displayed colours: it says nothing beyond white, and measures of radiance are left out.
  bool displayed = false;
};

/// Reads a picture: EXR and Radiance HDR hold linear radiance, anything else displayed colours in sRGB, for a display
/// of `exposure`. Three channels are covered everywhere. Errors (usage): what read_image refuses; other than 3 or 4
/// channels.
[[nodiscard]] ScoredPicture read_scored(const std::string& file, float exposure);

/// Reads a reference: linear radiance alone. Errors (usage): as read_scored; a format of displayed colours.
[[nodiscard]] Image read_reference(const std::string& file);

/// The reference with the pixels at which `mask` (any channels, the size of the reference) is black taken out of the
/// object. Errors (usage): sizes differ; no object pixel is left.
[[nodiscard]] Image masked(Image reference, const Image& mask, const std::string& mask_name);

/// Takes the pixels that the reference does not resolve (renderer/pipeline/unresolved.hpp) out of the object, as a
/// comparison does. Gives by how many pixels the object is smaller. `standard_error`: RGB. Errors (usage): sizes
/// differ.
std::size_t leave_out_unresolved(Image& reference, const Image& standard_error, float exposure);

struct PictureScore {
  std::string name;
  bool displayed = false;
  ErrorFigures error;
  double ldr_flip = 0;             ///< mean over object pixels
  std::optional<double> hdr_flip;  ///< the same; none of displayed colours
  Image ldr_map, hdr_map;          ///< of every pixel; hdr_map empty where hdr_flip is none
};

/// `reference` tells which pixels count by its coverage; `pixels_per_degree` for FLIP. Errors (usage): sizes differ, a
/// value that is not finite, no object pixel; each names the picture.
[[nodiscard]] PictureScore score_picture(const ScoredPicture& picture, const Image& reference, float exposure,
                                         double pixels_per_degree);

/// Which of two is closer, pixel by pixel.
struct PairScore {
  CloserShares shares;
  Image verdicts, object;
  bool beyond_noise = false;  ///< by three standard errors of the reference; otherwise any difference counts
};

/// `standard_error`: RGB of the reference's size, or empty where it is not known. Errors (usage): its size differs.
[[nodiscard]] PairScore score_pair(const ScoredPicture& a, const ScoredPicture& b, const Image& reference,
                                   const Image& standard_error, float exposure);

}  // namespace footprint
