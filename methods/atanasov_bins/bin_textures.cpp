// Stores integers as bytes, which textures return exactly, because the pipeline has no integer formats.
#include "methods/atanasov_bins/inverse_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include "renderer/microgeometry/direction_grid.hpp"

namespace footprint::atanasov_bins {
namespace {

static_assert(std::endian::native == std::endian::little, "words are copied as they lie in memory");

std::vector<std::uint8_t> bytes_of(std::span<const std::uint32_t> words, std::size_t count) {
  std::vector<std::uint8_t> bytes(4 * count);
  if (!words.empty()) std::memcpy(bytes.data(), words.data(), words.size_bytes());
  return bytes;
}

PrefilteredTexture words_of(std::string name, int width, int height, std::vector<std::uint8_t> bytes) {
  PrefilteredTexture texture;
  texture.name = std::move(name);
  texture.storage = Storage::unorm8;
  texture.channels = 4;
  texture.filter = TextureFilter::nearest;
  texture.levels.push_back({.width = width, .height = height, .bytes = std::move(bytes)});
  return texture;
}

// The least power of two whose square is at least the count: 2^28 integers fit 16384 x 16384.
int columns_for(std::size_t count) {
  int columns = 1;
  while (static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns) < count) columns *= 2;
  return columns;
}

int rows_for(std::size_t count, int columns) {
  const auto row = static_cast<std::size_t>(columns);
  return static_cast<int>((std::max<std::size_t>(count, 1) + row - 1) / row);
}

constexpr std::uint32_t places = 65536;  // along an axis

// Places [first, last] are those p for which floor(p m / places) is the bin. x = 1, or beyond 1 by rounding, is in the
// last bin.
std::uint32_t place_along(double x, int m) {
  const auto bin = static_cast<std::uint32_t>(std::clamp(static_cast<int>(std::floor(x * m)), 0, m - 1));
  const auto count = static_cast<std::uint32_t>(m);
  const std::uint32_t first = (bin * places + count - 1) / count;
  const std::uint32_t last = ((bin + 1) * places + count - 1) / count - 1;
  const auto place = static_cast<std::uint32_t>(std::clamp(std::floor(x * places), 0.0, places - 1.0));
  return std::clamp(place, first, std::min(last, places - 2));  // places - 1 is for no_normal
}

}  // namespace

double bin_solid_angle(int m) { return 2.0 * std::numbers::pi / (static_cast<double>(m) * m); }

std::uint32_t packed_normal(const glm::dvec3& normal, int m) {
  const glm::dvec2 point = hemisphere_to_square(normal);
  return place_along(point.y, m) << 16U | place_along(point.x, m);
}

std::uint32_t bin_of_packed(std::uint32_t packed, int m) {
  const auto count = static_cast<std::uint32_t>(m);
  return ((packed >> 16U) * count >> 16U) * count + ((packed & 0xFFFFU) * count >> 16U);
}

glm::dvec2 place_in_square(std::uint32_t packed) {
  return (glm::dvec2(packed & 0xFFFFU, packed >> 16U) + 0.5) / double{places};
}

int bins_across_for(double variance, double share, int most) {
  const double width = share * std::sqrt(std::max(variance, 1e-12));
  const double across = std::sqrt(2.0 * std::numbers::pi) / width;
  const int odd = across >= most ? most : 2 * static_cast<int>(std::ceil(0.5 * (across - 1.0))) + 1;
  return std::clamp(odd, std::min(5, most), most);
}

PrefilteredTexture word_texture(std::string name, std::span<const std::uint32_t> words) {
  const int columns = columns_for(words.size());
  const int rows = rows_for(words.size(), columns);
  return words_of(std::move(name), columns, rows,
                  bytes_of(words, static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)));
}

std::uint32_t word_at(const PrefilteredTexture& texture, std::size_t i) {
  std::uint32_t word = 0;
  std::memcpy(&word, texture.levels.front().bytes.data() + 4 * i, sizeof(word));
  return word;
}

PrefilteredTexture bin_map_texture(const BinMap& map, const TextureCoordinates& coordinates) {
  PrefilteredTexture texture = words_of("bins_map", map.width, map.height, bytes_of(map.normals, map.normals.size()));
  texture.coordinates = coordinates;
  return texture;
}

void add_inverse_map(const InverseMap& map, Prefiltered& out) {
  std::vector<std::uint32_t> lists;
  lists.reserve(2 * map.lists.size() + 1);
  for (const TexelList& list : map.lists) {
    lists.push_back(list.first);
    lists.push_back(list.root);
  }
  lists.push_back(static_cast<std::uint32_t>(map.texels.size()));
  const std::vector<std::uint32_t> hash = hashed_lists(map);
  out.textures.push_back(word_texture("bins_texels", map.texels));
  out.textures.push_back(word_texture("bins_forest", map.forest));
  out.textures.push_back(word_texture("bins_lists", lists));
  out.textures.push_back(word_texture("bins_hash", hash));
  const bool invalid = map.has_invalid();
  const std::size_t slots = hash.size() / 2;  // of two integers each
  out.scalars["bins_hash_slots"] = static_cast<float>(slots);
  out.scalars["bins_invalid_list"] = invalid ? static_cast<float>(map.lists.size() - 1) : -1.0F;
}

void add_list_values(std::string name, std::span<const float> values, int channels, Prefiltered& out) {
  const std::size_t lists = values.size() / static_cast<std::size_t>(channels);
  const int columns = columns_for(lists);
  Image image(columns, rows_for(lists, columns), channels);
  std::ranges::copy(values, image.texels.begin());
  out.textures.push_back(make_texture(std::move(name), {image}, Storage::fp32, {}));
  out.textures.back().filter = TextureFilter::nearest;
}

void add_classes(std::span<const WidthClass> classes, Prefiltered& out) {
  Image image(static_cast<int>(classes.size()), 1, 3);
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const std::array<double, 3> values{static_cast<double>(classes[i].across), classes[i].widest, classes[i].from};
    std::ranges::copy(values, image.texels.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  out.textures.push_back(make_texture("bins_classes", {image}, Storage::fp32, {}));
  out.textures.back().filter = TextureFilter::nearest;
  out.scalars["bins_class_count"] = static_cast<float>(classes.size());
}

}  // namespace footprint::atanasov_bins
