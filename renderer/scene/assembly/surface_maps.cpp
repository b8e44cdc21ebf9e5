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

#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"

namespace footprint {
namespace {

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
  constexpr double smallest_z = 1e-6;
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

// The number of texels with a unit vector, directly and as an encoding c of 2 c - 1. Texels without a direction (zero,
// not finite) are ignored.
struct UnitCounts {
  std::size_t texels = 0, as_stored = 0, as_encoded = 0;
};

UnitCounts count_unit_vectors(const Image& stored) {
  constexpr double tolerance = 0.02;  // of a length: half floats and bytes that were decoded stay within
  UnitCounts counts;
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) {
      const auto in = stored.at(x, y);
      const glm::dvec3 v(in[0], in[1], in[2]);
      const double length = glm::length(v);
      if (!std::isfinite(length) || length < 1e-3) continue;
      ++counts.texels;
      if (std::abs(length - 1.0) < tolerance) ++counts.as_stored;
      if (std::abs(glm::length(2.0 * v - 1.0) - 1.0) < tolerance) ++counts.as_encoded;
    }
  }
  return counts;
}

// Most texels must be unit vectors.
void require_unit_vectors(const Image& stored) {
  const UnitCounts counts = count_unit_vectors(stored);
  if (2 * counts.as_stored < counts.texels && 2 * counts.as_encoded >= counts.texels) {
    throw Error(ErrorKind::usage, {},
                "its values are normals encoded as 0 to 1, but an EXR must store x, y, z of -1 to 1",
                "store 2 c - 1, or give the map as PNG");
  }
  if (2 * counts.as_stored < counts.texels) {
    throw Error(
        ErrorKind::usage, {},
        fmt::format("{} of {} texels do not contain a unit vector", counts.texels - counts.as_stored, counts.texels),
        "store unit normals, x, y, z of -1 to 1 in the first three channels");
  }
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
  if (!xy) require_unit_vectors(stored);
  return to_normal_map(
      stored, [](const auto& v) { return v; }, xy, scale);
}

MapTexels stored_normals(const Image& stored, const std::function<NormalMap(const Image&)>& decode,
                         const std::string& name, std::vector<std::string>& faults) {
  const NormalMap map = decode(stored);
  std::ranges::move(describe_faults(map, name), std::back_inserter(faults));
  return MapTexels::packed(map.image, stored, [decode](const Image& again) { return decode(again).image; });
}

MapTexels read_normal_map(const std::filesystem::path& file, double scale, NormalChannels channels,
                          std::vector<std::string>& faults) {
  const Image stored = read_image(file, Transfer::linear);
  const auto decode = [scale, channels, unit = is_exr(file)](const Image& image) {
    return unit ? decode_unit_normals(image, scale, channels) : decode_normal_map(image, scale, channels);
  };
  try {
    return stored_normals(stored, decode, file.filename().string(), faults);
  } catch (const Error& error) {
    throw error.within(file.string());
  }
}

void scale_slopes(Image& normals, double strength) {
  for (std::size_t i = 0; i < normals.texels.size(); i += 4) {
    float* const n = &normals.texels[i];
    const glm::dvec3 scaled = glm::normalize(glm::dvec3{strength * n[0], strength * n[1], n[2]});
    for (int c = 0; c < 3; ++c) n[c] = static_cast<float>(scaled[c]);
  }
}

NormalMap normals_of_heights(const Image& stored, double strength) {
  NormalMap map{Image(stored.width, stored.height, 4), 0, 0};
  const auto height = [&](int x, int y) {
    return static_cast<double>(
        stored.at((x + stored.width) % stored.width, (y + stored.height) % stored.height).front());
  };
  const double per_texel = 0.5 * strength * stored.width;  // texels are square
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) {
      const double dx = per_texel * (height(x + 1, y) - height(x - 1, y));
      const double dy = per_texel * (height(x, y - 1) - height(x, y + 1));  // rows run down, the normal's y up
      const bool valid = std::isfinite(dx) && std::isfinite(dy);
      map.invalid += valid ? 0 : 1;
      const glm::vec3 normal = valid ? glm::vec3(glm::normalize(glm::dvec3{-dx, -dy, 1.0})) : glm::vec3{0, 0, 1};
      std::ranges::copy(std::array{normal.x, normal.y, normal.z, valid ? 1.0F : 0.0F}, map.image.at(x, y).begin());
    }
  }
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

Image decode_metallic_roughness(const Image& stored, float roughness_factor, float metallic_factor) {
  const bool color = stored.channels >= 3;
  Image map(stored.width, stored.height, 2);
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) {
      const auto in = stored.at(x, y);
      map.at(x, y)[0] = roughness_factor * clamped_to_unit(in[color ? 1 : 0]);
      map.at(x, y)[1] = metallic_factor * clamped_to_unit(in[color ? 2 : 0]);
    }
  }
  return map;
}

Image decode_factor(const Image& stored, int channel, float factor) {
  const auto from = static_cast<std::size_t>(stored.channels >= 3 ? channel : 0);
  Image map(stored.width, stored.height, 1);
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) map.at(x, y)[0] = factor * clamped_to_unit(stored.at(x, y)[from]);
  }
  return map;
}

Image decode_lobe_parameter(const Image& stored, double least, double most) {
  // In 32 bits like the map, because the double 0.001 is larger than the float.
  const auto lowest = static_cast<float>(least), highest = static_cast<float>(most);
  Image map(stored.width, stored.height, 1);
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) {
      const float value = stored.at(x, y)[0];
      if (!(value >= lowest && value <= highest)) {
        throw Error(ErrorKind::usage, fmt::format("texel ({}, {})", x, y),
                    fmt::format("contains {}, not within {} to {}", value, least, most),
                    "store the lobe parameter itself, as 32-bit floats");
      }
      map.at(x, y)[0] = value;
    }
  }
  return map;
}

std::vector<Image> decode_indices(const Image& stored, std::size_t count) {
  constexpr float rounding = 1e-3F;  // of 8 bits as floats from 0 to 1
  std::vector<Image> shares(count, Image(stored.width, stored.height, 1));
  for (std::size_t i = 0; i < stored.texel_count(); ++i) {
    const float value = stored.texels[i * static_cast<std::size_t>(stored.channels)];
    const float whole = std::round(value);
    if (!(std::abs(value - whole) <= rounding && whole >= 0.0F && whole < static_cast<float>(count))) {
      const auto width = static_cast<std::size_t>(stored.width);
      throw Error(ErrorKind::usage, "map of indices",
                  fmt::format("texel ({}, {}) contains {}, which is not an index of the {} materials", i % width,
                              i / width, value, count),
                  fmt::format("store whole numbers from 0 to {} in the red channel", count - 1));
    }
    shares[static_cast<std::size_t>(whole)].texels[i] = 1.0F;
  }
  return shares;
}

Image to_rgb(const Image& stored) {
  const bool color = stored.channels >= 3;
  Image map(stored.width, stored.height, 3);
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) map.at(x, y)[c] = clamped_to_unit(stored.at(x, y)[color ? c : 0]);
    }
  }
  return map;
}

Image to_rgba(const Image& stored) {
  const bool color = stored.channels >= 3;
  const bool alpha = stored.channels % 2 == 0;
  Image map(stored.width, stored.height, 4, 1.0F);
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) {
      const auto in = stored.at(x, y);
      const auto out = map.at(x, y);
      for (std::size_t c = 0; c < 3; ++c) out[c] = clamped_to_unit(in[color ? c : 0]);
      if (alpha) out[3] = clamped_to_unit(in.back());
    }
  }
  return map;
}

}  // namespace footprint
