// The pictures of a run as files: what they are called and how they are written. Error images are made from the images
// that were written, on the scale of each distance and on the scale that all distances share. A picture that cannot be
// written is a loss of the run's folder, not an error.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/options.hpp"
#include "renderer/core/run_folder.hpp"
#include "renderer/image/image.hpp"

namespace footprint {

struct DistanceResult;

/// Copies `part` into `picture`, its first texel to column `left` and row `top`, as far as it is inside. Both have
/// equally many channels.
void paste(const Image& part, int left, int top, Image& picture);

/// Two pictures of equally many channels, the first on top, both from the left edge on.
[[nodiscard]] Image stacked(const Image& top, const Image& bottom);

/// Images of one height, as labelled_strip takes them.
struct Strip {
  std::vector<Image> pictures{};
  std::vector<std::string> captions{};

  void add(Image picture, const std::string& caption);
  [[nodiscard]] Image drawn() const;
};

/// The file name part of the method at `index`. Names that differ only in characters that no file name has would
/// overwrite each other, and so would one that is called `reference`: such a method has its number added.
[[nodiscard]] std::string method_stem(std::span<const MethodSpec> methods, std::size_t index);

/// The file name part of something at a distance: "d2.5_WHAT".
[[nodiscard]] std::string distance_stem(double distance, const std::string& what);

/// Writes FOLDER/images/STEM.exr (linear radiance, coverage in alpha) and STEM.png beside it (exposed, sRGB); returns
/// "images/STEM.exr".
std::string write_picture(const RunFolder& folder, const std::string& stem, const Image& radiance, float exposure);

/// Writes the files of write_picture, and STEM_values.js beside them, from which the page reads its values.
/// left_out: a mask of the pixels that no figure includes; empty: there are none.
std::string write_page_picture(const RunFolder& folder, const std::string& stem, const Image& radiance, float exposure,
                               const Image& left_out = {});

/// The files that write_page_picture makes of "images/STEM.exr".
[[nodiscard]] std::vector<std::string> page_picture_files(const std::string& exr);

/// Writes a mask, one channel of 1 and 0, as FOLDER/images/STEM.exr and STEM.png beside it; returns "images/STEM.exr".
std::string write_mask(const RunFolder& folder, const std::string& stem, const Image& mask);

/// The 99th percentile of an error image over the pixels that have an error.
[[nodiscard]] double error_percentile(const Image& error);

/// The top of the false-colour scale for errors up to `largest`: two digits, 0.01 or more.
/// given: the scale that was requested, which is then returned.
[[nodiscard]] double error_scale(double largest, const std::optional<double>& given);

/// Writes strips of all images of a distance and of their errors over the legend of the scale, its maps of FLIP and its
/// error images on the scale `top`, and names them in the records; the images on the shared scale are the same until
/// write_shared_error_images. folder: output folder with the images of `result`.
void write_error_images(const RunFolder& folder, DistanceResult& result, double top);

/// Writes the error images of a distance on the scale `top` that all distances share, and names them in the records.
void write_shared_error_images(const RunFolder& folder, DistanceResult& result, double top);

}  // namespace footprint
