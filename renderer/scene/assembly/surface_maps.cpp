// Decodes texel by texel; normals without a direction get weight 0, those that point inwards are laid flat.
#include "renderer/scene/assembly/surface_maps.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/glm.hpp>
#include <iterator>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/lobes/convolution.hpp"

namespace footprint {
namespace {

constexpr double smallest_z = 1e-6;

/// Clamps to [0, 1]. NaN becomes 0, which std::clamp would not do.
float clamped_to_unit(float value) { return value > 0.0F ? std::min(value, 1.0F) : 0.0F; }

void require_two_channels(const Image& stored) {
  if (stored.channels >= 2) return;
  throw Error(ErrorKind::usage, {}, "a normal map needs two channels or three, this image has one",
              "store the normal's x, y, z in red, green, blue, or x and y in two channels");
}

bool holds_xy(const Image& stored, NormalChannels channels) {
  return stored.channels == 2 || channels == NormalChannels::xy;
}

// z of a unit vector over x and y; 0 where they leave nothing for it.
glm::dvec3 with_z(const glm::dvec2& xy) { return {xy, std::sqrt(std::max(1.0 - glm::dot(xy, xy), 0.0))}; }

template <class Decode>
NormalMap to_normal_map(const Image& stored, Decode decode, bool xy, double scale) {
  NormalMap map{Image(stored.width, stored.height, 4), 0, 0};
  std::atomic<std::size_t> invalid = 0, inverted = 0;
  tbb::parallel_for(0, stored.height, [&](int y) {
    for (int x = 0; x < stored.width; ++x) {
      const auto in = stored.at(x, y);
      const auto out = map.image.at(x, y);
      glm::dvec3 normal = xy ? with_z(decode(glm::dvec2{in[0], in[1]})) : decode(glm::dvec3{in[0], in[1], in[2]});
      const double length = glm::length(normal);
      if (!std::isfinite(length) || length < 1e-3) {
        ++invalid;
        std::ranges::copy(std::array{0.0F, 0.0F, 1.0F, 0.0F}, out.begin());
        continue;
      }
      if (normal.z <= 0.0) {
        ++inverted;
        normal.z = smallest_z;
      }
      normal = glm::normalize(normal * glm::dvec3{scale, scale, 1.0});
      std::ranges::copy(
          std::array{static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z), 1.0F},
          out.begin());
    }
  });
  map.invalid = invalid;
  map.inverted = inverted;
  return map;
}

constexpr double unit_tolerance = 0.02;  // of a length: half floats and bytes that were decoded stay within

// The texels of a normal map that are unit vectors as stored, or once decoded from 0 to 1. Those without a direction
// (zero, not finite) do not count.
struct UnitCounts {
  std::size_t texels = 0, as_stored = 0, as_encoded = 0;
};

UnitCounts count_unit_vectors(const Image& stored) {
  UnitCounts counts;
  for (std::size_t i = 0; i < stored.texel_count(); ++i) {
    const float* const in = &stored.texels[i * static_cast<std::size_t>(stored.channels)];
    const glm::dvec3 v(in[0], in[1], in[2]);
    const double length = glm::length(v);
    if (!std::isfinite(length) || length < 1e-3) continue;
    ++counts.texels;
    if (std::abs(length - 1.0) < unit_tolerance) ++counts.as_stored;
    if (std::abs(glm::length(2.0 * v - 1.0) - 1.0) < unit_tolerance) ++counts.as_encoded;
  }
  return counts;
}

Error encoded_normals(const std::string& hint) {
  return {
      ErrorKind::usage, {}, "its values are normals encoded as 0 to 1, but an EXR must store x, y, z of -1 to 1", hint};
}

void require_unit_vectors(const Image& stored) {
  const UnitCounts counts = count_unit_vectors(stored);
  if (2 * counts.as_stored >= counts.texels) return;
  if (2 * counts.as_encoded >= counts.texels) throw encoded_normals("store 2 c - 1, or give the map as PNG");
  throw Error(
      ErrorKind::usage, {},
      fmt::format("{} of {} texels do not contain a unit vector", counts.texels - counts.as_stored, counts.texels),
      "store unit normals, x, y, z of -1 to 1 in the first three channels");
}

// The finite x and y of a map: their mean and range, and how many are longer than a unit vector.
struct XyRange {
  glm::dvec2 sum{0.0}, least{1e30}, most{-1e30};
  std::size_t texels = 0, too_long = 0;

  explicit XyRange(const Image& stored) {
    for (std::size_t i = 0; i < stored.texel_count(); ++i) {
      const float* const in = &stored.texels[i * static_cast<std::size_t>(stored.channels)];
      const glm::dvec2 xy(in[0], in[1]);
      if (!std::isfinite(xy.x) || !std::isfinite(xy.y)) continue;
      ++texels;
      sum += xy;
      least = glm::min(least, xy);
      most = glm::max(most, xy);
      if (glm::length(xy) > 1.0 + unit_tolerance) ++too_long;
    }
  }

  // Bumps lean to all sides, so that x and y of -1 to 1 have both signs, and encoded ones a mean about 0.5.
  [[nodiscard]] bool seems_encoded() const {
    const auto is_half = [&](int axis) { return std::abs(sum[axis] / static_cast<double>(texels) - 0.5) < 0.25; };
    const bool in_range = std::min(least.x, least.y) >= 0.0 && std::max(most.x, most.y) <= 1.0 + unit_tolerance;
    return in_range && (too_long > 0 || (is_half(0) && is_half(1)));
  }
};

void require_unit_xy(const Image& stored) {
  const XyRange range(stored);
  if (range.texels == 0) return;
  if (range.seems_encoded()) {
    throw encoded_normals(
        "store 2 c - 1, or give the map as PNG; if these are unit normals, store their z as a third channel");
  }
  if (2 * range.too_long > range.texels) {
    throw Error(ErrorKind::usage, {},
                fmt::format("x and y of {} of {} texels are longer than a unit vector", range.too_long, range.texels),
                "store x and y of unit normals, of -1 to 1");
  }
}

// Throws Error (usage) that names the first texel whose first channel is not `valid`.
template <class Valid>
void require_values(const Image& stored, const Valid& valid, const std::string& fault, const std::string& hint) {
  for_each_texel(stored, [&](int x, int y) {
    const float value = stored.at(x, y)[0];
    if (valid(value)) return;
    throw Error(ErrorKind::usage, fmt::format("texel ({}, {})", x, y), fmt::format("contains {}, {}", value, fault),
                hint);
  });
}

Image first_channel(const Image& stored) {
  return mapped(stored, 1, [](const auto& in, const auto& out) { out[0] = in[0]; });
}

// A row or column from -1 to `size`, within the map. A mirrored map repeats its border texel.
int neighbour(int at, int size, Wrap wrap) {
  return wrap == Wrap::repeat ? (at + size) % size : std::clamp(at, 0, size - 1);
}

// The weights of three rows in a difference two texels wide.
std::array<double, 3> row_weights(SlopeFilter filter) {
  if (filter == SlopeFilter::sobel) return {1.0 / 8.0, 2.0 / 8.0, 1.0 / 8.0};
  if (filter == SlopeFilter::scharr) return {3.0 / 32.0, 10.0 / 32.0, 3.0 / 32.0};
  return {0.0, 0.5, 0.0};
}

// Whether an image of several texels is the same everywhere in some channels.
bool is_constant(const Image& image, std::span<const std::size_t> channels) {
  const auto same = [&](std::size_t texel, std::size_t channel) {
    return image.texels[texel * static_cast<std::size_t>(image.channels) + channel] == image.texels[channel];
  };
  for (std::size_t i = 1; i < image.texel_count(); ++i) {
    if (!std::ranges::all_of(channels, [&](std::size_t channel) { return same(i, channel); })) return false;
  }
  return image.texel_count() > 1;
}

// The values of some channels that are not 0 to 1.
struct UnitRange {
  std::size_t not_finite = 0, outside = 0;
  float least = 0.0F, most = 1.0F;  // of all values and of 0 and 1

  UnitRange(const Image& image, std::span<const std::size_t> channels) {
    for (std::size_t i = 0; i < image.texel_count(); ++i) {
      for (const std::size_t channel : channels)
        add(image.texels[i * static_cast<std::size_t>(image.channels) + channel]);
    }
  }

 private:
  void add(float value) {
    if (!std::isfinite(value)) {
      ++not_finite;
    } else if (value < 0.0F || value > 1.0F) {
      ++outside;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
};

MapTexels stored_heights(const FileImage& file, double scale, const HeightSettings& settings, const std::string& name,
                         std::vector<std::string>& faults) {
  const std::string title = fmt::format("height map `{}`", name);
  std::ranges::move(describe_file(file, first_channel_alone, title), std::back_inserter(faults));
  const Image heights = first_channel(file.image);
  const auto decode = [scale, settings](const Image& again) { return normals_of_heights(again, scale, settings); };
  return MapTexels::packed(decode(heights), heights, decode);
}

void require_one_grid(const TextureMap& kappa, const Material& material) {
  constexpr const char* place = "[maps] normal_kappa";
  if (!material.lobes.empty()) {
    throw Error(ErrorKind::usage, place, fmt::format("`{}` has several lobes per facet", material.name),
                "leave the map out, or give the material one lobe");
  }
  if (material.anisotropy && material.anisotropy->strength > 0.0F) {
    throw Error(ErrorKind::usage, place, fmt::format("`{}` is anisotropic", material.name),
                "leave the map out, or give anisotropy = 0 in [brdf]");
  }
  if (const TextureMap* const width = width_map(material);
      width != nullptr && width->coordinates != kappa.coordinates) {
    throw Error(ErrorKind::usage, place,
                fmt::format("`{}` has a map of lobe widths with other texture coordinates", material.name),
                "give both maps the same `uv`");
  }
}

Lobe lobe_at(const Material& material, float width) {
  const NormalDistribution distribution = material.brdf.distribution;
  return material.lobe_parameter_map ? Lobe{distribution, width} : lobe_from_alpha(distribution, width * width);
}

}  // namespace

NormalMap decode_normal_map(const Image& stored, double scale, NormalChannels channels) {
  require_two_channels(stored);
  return to_normal_map(
      stored, [](const auto& v) { return 2.0 * v - 1.0; }, holds_xy(stored, channels), scale);
}

NormalMap decode_unit_normals(const Image& stored, double scale, NormalChannels channels) {
  require_two_channels(stored);
  const bool xy = holds_xy(stored, channels);
  if (xy) {
    require_unit_xy(stored);
  } else {
    require_unit_vectors(stored);
  }
  return to_normal_map(
      stored, [](const auto& v) { return v; }, xy, scale);
}

void require_encoded_normals(const Image& stored, NormalChannels channels) {
  const bool xy = holds_xy(stored, channels);
  const UnitCounts counts = xy ? UnitCounts() : count_unit_vectors(stored);
  const XyRange range(stored);
  const bool negative = range.texels > 0 && std::min(range.least.x, range.least.y) < -unit_tolerance;
  if (!negative && (2 * counts.as_encoded >= counts.texels || 2 * counts.as_stored < counts.texels)) return;
  throw Error(ErrorKind::usage, {}, "its values are normals of -1 to 1, which only an EXR may store",
              "save it as an EXR, or store (n + 1) / 2");
}

MapTexels stored_normals(const FileImage& file, const std::function<NormalMap(const Image&)>& decode,
                         const std::string& name, std::vector<std::string>& faults) {
  const NormalMap map = decode(file.image);
  const auto counted = std::span(color_channels).first(static_cast<std::size_t>(std::min(file.image.channels, 3)));
  std::ranges::move(describe_file(file, counted, fmt::format("normal map `{}`", name)), std::back_inserter(faults));
  std::ranges::move(describe_faults(map, name), std::back_inserter(faults));
  return MapTexels::packed(map.image, file.image, [decode](const Image& again) { return decode(again).image; });
}

MapTexels read_normals(const NormalFile& file, std::vector<std::string>& faults) {
  const FileImage stored = read_file_image(file.path, Transfer::linear);
  const std::string name = file.path.filename().string();
  try {
    if (file.heights) return stored_heights(stored, file.scale, *file.heights, name, faults);
    const bool unit = is_exr(file.path);
    if (stored.floats && !unit) require_encoded_normals(stored.image, file.channels);
    const auto decode = [scale = file.scale, channels = file.channels, unit](const Image& image) {
      return unit ? decode_unit_normals(image, scale, channels) : decode_normal_map(image, scale, channels);
    };
    return stored_normals(stored, decode, name, faults);
  } catch (const Error& error) {
    throw error.within(file.path.string());
  }
}

std::vector<std::string> describe_file(const FileImage& file, std::span<const std::size_t> channels,
                                       const std::string& title) {
  std::vector<std::string> lines;
  for (const std::string& note : file.notes) lines.push_back(fmt::format("{}: {}", title, note));
  if (file.floats && is_constant(file.image, channels))
    lines.push_back(fmt::format("{}: every texel has the same value", title));
  return lines;
}

std::vector<std::string> describe_unit_values(const FileImage& file, std::span<const std::size_t> channels,
                                              const std::string& name) {
  const std::span<const std::size_t> counted = file.image.channels >= 3 ? channels : first_channel_alone;
  std::vector<std::string> lines = describe_file(file, counted, fmt::format("map `{}`", name));
  if (!file.floats) return lines;
  const UnitRange range(file.image, counted);
  if (range.not_finite > 0)
    lines.push_back(fmt::format("map `{}`: {} values are not finite and are taken as 0 or 1", name, range.not_finite));
  if (range.outside > 0) {
    lines.push_back(fmt::format("map `{}`: {} values are outside of 0 to 1 ({:.4g} to {:.4g}) and are clamped", name,
                                range.outside, range.least, range.most));
  }
  return lines;
}

Image read_unit_map(const std::filesystem::path& file, Transfer transfer, std::span<const std::size_t> channels,
                    std::vector<std::string>& warnings) {
  FileImage read = read_file_image(file, transfer);
  std::ranges::move(describe_unit_values(read, channels, file.filename().string()), std::back_inserter(warnings));
  return std::move(read.image);
}

void scale_slopes(Image& normals, double strength) {
  for (std::size_t i = 0; i < normals.texels.size(); i += 4) {
    float* const n = &normals.texels[i];
    const glm::dvec3 scaled = glm::normalize(glm::dvec3{strength * n[0], strength * n[1], n[2]});
    for (int c = 0; c < 3; ++c) n[c] = static_cast<float>(scaled[c]);
  }
}

Image normals_of_heights(const Image& stored, double scale, const HeightSettings& settings) {
  require_values(
      stored, [](float height) { return std::isfinite(height); }, "which is not a height",
      "store finite heights in the first channel");
  const auto height = [&](int x, int y) {
    return static_cast<double>(
        stored.at(neighbour(x, stored.width, settings.wrap[0]), neighbour(y, stored.height, settings.wrap[1]))[0]);
  };
  const double per_texel = scale * stored.width;  // texels are square
  const std::array<double, 3> weights = row_weights(settings.filter);
  Image map(stored.width, stored.height, 4, 1.0F);
  tbb::parallel_for(0, stored.height, [&](int y) {
    for (int x = 0; x < stored.width; ++x) {
      glm::dvec2 slope{0.0};
      for (int i = -1; i <= 1; ++i) {
        const double weight = per_texel * weights.at(static_cast<std::size_t>(i + 1));
        slope.x += weight * (height(x + 1, y + i) - height(x - 1, y + i));
        slope.y += weight * (height(x + i, y - 1) - height(x + i, y + 1));  // rows run down, the normal's y up
      }
      const glm::dvec3 normal = glm::normalize(glm::dvec3{-slope, 1.0});
      const auto out = map.at(x, y);
      for (int c = 0; c < 2; ++c) out[static_cast<std::size_t>(c)] = static_cast<float>(normal[c]);
      out[2] = static_cast<float>(std::max(normal.z, smallest_z));
    }
  });
  return map;
}

std::vector<std::string> describe_faults(const NormalMap& map, const std::string& name) {
  std::vector<std::string> lines;
  if (map.invalid > 0) {
    lines.push_back(
        fmt::format("normal map `{}`: {} texels do not contain a direction and do not count", name, map.invalid));
  }
  if (map.inverted > 0) {
    lines.push_back(
        fmt::format("normal map `{}`: {} texels point into the surface and are laid flat on it", name, map.inverted));
  }
  return lines;
}

std::span<const float> texel_under(const Image& map, int x, int y, int width, int height) {
  return map.at((2 * x + 1) * map.width / (2 * width), (2 * y + 1) * map.height / (2 * height));
}

Image decode_metallic_roughness(const Image& stored, float roughness_factor, float metallic_factor) {
  const bool color = stored.channels >= 3;
  return mapped(stored, 2, [&](const auto& in, const auto& out) {
    out[0] = roughness_factor * clamped_to_unit(in[color ? 1 : 0]);
    out[1] = metallic_factor * clamped_to_unit(in[color ? 2 : 0]);
  });
}

Image decode_factor(const Image& stored, int channel, float factor) {
  const auto from = static_cast<std::size_t>(stored.channels >= 3 ? channel : 0);
  return mapped(stored, 1, [&](const auto& in, const auto& out) { out[0] = factor * clamped_to_unit(in[from]); });
}

Image decode_lobe_parameter(const Image& stored, double least, double most) {
  // In 32 bits like the map, because the double 0.001 is larger than the float.
  const auto lowest = static_cast<float>(least), highest = static_cast<float>(most);
  require_values(
      stored, [&](float value) { return value >= lowest && value <= highest; },
      fmt::format("not within {} to {}", least, most), "store the lobe parameter itself, as 32-bit floats");
  return first_channel(stored);
}

std::vector<Image> decode_indices(const Image& stored, std::size_t count) {
  constexpr float rounding = 1e-3F;  // of 8 bits as floats from 0 to 1
  require_values(
      stored,
      [&](float value) {
        const float whole = std::round(value);
        return std::abs(value - whole) <= rounding && whole >= 0.0F && whole < static_cast<float>(count);
      },
      fmt::format("which is not an index of the {} materials", count),
      fmt::format("store whole numbers from 0 to {} in the red channel", count - 1));
  const Image indices = first_channel(stored);
  std::vector<Image> shares(count, Image(stored.width, stored.height, 1));
  for (std::size_t i = 0; i < indices.texels.size(); ++i)
    shares[static_cast<std::size_t>(std::round(indices.texels[i]))].texels[i] = 1.0F;
  return shares;
}

Image to_rgb(const Image& stored) {
  const bool color = stored.channels >= 3;
  return mapped(stored, 3, [&](const auto& in, const auto& out) {
    for (std::size_t c = 0; c < 3; ++c) out[c] = clamped_to_unit(in[color ? c : 0]);
  });
}

Image to_rgba(const Image& stored) {
  const bool color = stored.channels >= 3;
  const bool alpha = stored.channels % 2 == 0;
  const auto write = [&](const auto& in, const auto& out) {
    for (std::size_t c = 0; c < 3; ++c) out[c] = clamped_to_unit(in[color ? c : 0]);
    if (alpha) out[3] = clamped_to_unit(in.back());
  };
  return mapped(stored, 4, write, 1.0F);
}

void spread_normals(const TextureMap& kappa, Material& material) {
  require_one_grid(kappa, material);
  const TextureMap* const width = width_map(material);
  const Image spreads = kappa.image.decoded(), widths = width != nullptr ? width->image.decoded() : Image(1, 1, 1);
  const bool beside_metalness = metallic_map(material) != nullptr;
  Image out(std::max(spreads.width, widths.width), std::max(spreads.height, widths.height), beside_metalness ? 2 : 1);
  for_each_texel(out, [&](int x, int y) {
    const auto own = texel_under(widths, x, y, out.width, out.height);
    const Lobe base = width != nullptr ? lobe_at(material, own[0]) : lobe_of(material);
    const Lobe lobe = convolved(base, texel_under(spreads, x, y, out.width, out.height)[0]);
    out.at(x, y)[0] = beside_metalness ? lobe_roughness(lobe) : static_cast<float>(lobe.parameter);
    if (beside_metalness) out.at(x, y)[1] = own[1];
  });
  std::optional<TextureMap>& map = beside_metalness ? material.metallic_roughness_map : material.lobe_parameter_map;
  map = TextureMap{kappa.name, MapTexels::packed(out), kappa.coordinates};
  material.lobe_parameter.reset();
}

}  // namespace footprint
