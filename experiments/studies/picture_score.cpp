// Reads, masks, and takes each measure from where it is.
#include "experiments/studies/picture_score.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/core/error.hpp"
#include "renderer/core/file_names.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/pipeline/unresolved.hpp"

namespace footprint {
namespace {

bool holds_radiance(const std::string& file) { return is_exr(file) || lower_extension(file) == ".hdr"; }

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

// What is displayed: black where nothing is covered.
Image shown(const Image& radiance, float exposure) {
  Image out(radiance.width, radiance.height, 3);
  for (std::size_t i = 0; i < out.texel_count(); ++i) {
    if (radiance.texels[4 * i + 3] <= 0.0F) continue;
    for (std::size_t c = 0; c < 3; ++c) out.texels[3 * i + c] = exposure * radiance.texels[4 * i + c];
  }
  return out;
}

// The object's pixels in a row: a background would lead a median.
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

// The object has covered pixels alone; what is shown of this one stays.
void exclude(Image& reference, std::size_t pixel) {
  float& coverage = reference.texels[4 * pixel + 3];
  coverage = std::min(coverage, 0.5F);
}

}  // namespace

ScoredPicture read_scored(const std::string& file, float exposure) {
  ScoredPicture out{file, with_coverage(read_image(file, Transfer::srgb), file), !holds_radiance(file)};
  if (!out.displayed) return out;
  for (std::size_t i = 0; i < out.radiance.texels.size(); ++i)
    if (i % 4 < 3) out.radiance.texels[i] /= exposure;
  return out;
}

Image read_reference(const std::string& file) {
  Image image = with_coverage(read_image(file, Transfer::srgb), file);
  if (holds_radiance(file)) return image;
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

}  // namespace footprint
