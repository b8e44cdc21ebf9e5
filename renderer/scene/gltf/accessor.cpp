// Finds elements within their buffer view, checks their ends against its length, copies and converts them one by one.
#include "renderer/scene/gltf/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

namespace footprint {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t largest_unbacked_count = std::uint64_t{1} << 20U;

/// Elements in a buffer, `stride` bytes apart, of any alignment.
struct Elements {
  const std::uint8_t* first = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
  int type = 0;

  template <typename T>
  [[nodiscard]] T get(std::size_t element, std::size_t component) const {
    T value;
    std::memcpy(&value, first + element * stride + component * sizeof(T), sizeof(T));
    return value;
  }
};

/// Finds `count` elements of `components` in a buffer view; `count` is at least 1.
Elements locate(const GltfDocument& document, const Json& at, std::uint64_t count, std::size_t components, int type,
                const std::string& place) {
  const GltfView& view = document.views[at["bufferView"].get<std::size_t>()];
  const auto offset = at.value("byteOffset", std::uint64_t{0});
  const std::uint64_t element = components * visit_component(type, [](auto kind) { return sizeof(kind); });
  const std::uint64_t stride = view.stride == 0 ? element : view.stride;
  if (stride < element)
    refuse_gltf(place, fmt::format("the stride of {} bytes is less than an element's {}", stride, element));
  const std::uint64_t end = offset + (count - 1) * stride + element;
  if (end > view.bytes.size()) {
    refuse_gltf(place, fmt::format("reads up to byte {} of a buffer view that has {}", end, view.bytes.size()));
  }
  return {view.bytes.data() + offset, static_cast<std::size_t>(stride), static_cast<std::size_t>(count), type};
}

/// Normalised integers are converted (glTF 2.0, section 3.6.2.2).
float float_component(const Elements& elements, std::size_t i, std::size_t c, bool normalized) {
  return visit_component(elements.type, [&]<class T>(T /*kind*/) {
    const auto value = static_cast<float>(elements.get<T>(i, c));
    if (!normalized || std::is_floating_point_v<T>) return value;
    return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
  });
}

std::uint32_t index_component(const Elements& elements, std::size_t i) {
  return visit_component(elements.type,
                         [&]<class T>(T /*kind*/) { return static_cast<std::uint32_t>(elements.get<T>(i, 0)); });
}

bool is_index_type(int type) {
  return type == gltf_unsigned_byte || type == gltf_unsigned_short || type == gltf_unsigned_int;
}

void check_shape(const Json& accessor, int components, const std::string& place) {
  const std::string type = components == 16 ? "MAT4" : components == 1 ? "SCALAR" : fmt::format("VEC{}", components);
  if (accessor["type"] != type) {
    refuse_gltf(place,
                fmt::format("has elements of another type than the {} components that its use needs", components));
  }
  const auto count = accessor["count"].get<std::uint64_t>();
  if (count == 0) refuse_gltf(place, "has no element");
  // Elements without bytes behind them cost a file nothing, so that it could claim any memory.
  const std::uint64_t largest = accessor.contains("bufferView") ? largest_element_count : largest_unbacked_count;
  if (count > largest) refuse_gltf(place, fmt::format("{} elements, more than the {} that are read", count, largest));
}

/// Replaces the elements that a sparse accessor names.
void substitute(const GltfDocument& document, const Json& accessor, std::size_t components, std::vector<float>& values,
                const std::string& place) {
  const Json& sparse = accessor["sparse"];
  const auto count = sparse["count"].get<std::uint64_t>(), all = accessor["count"].get<std::uint64_t>();
  const int type = sparse["indices"]["componentType"].get<int>();
  if (count < 1 || count > all) refuse_gltf(place + ".sparse", "replaces no or too many elements");
  if (!is_index_type(type)) refuse_gltf(place + ".sparse.indices", "are not unsigned integers");
  const Elements indices = locate(document, sparse["indices"], count, 1, type, place + ".sparse.indices");
  const Elements replacements = locate(document, sparse["values"], count, components,
                                       accessor["componentType"].get<int>(), place + ".sparse.values");
  const bool normalized = accessor.value("normalized", false);
  std::int64_t previous = -1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t index = index_component(indices, i);
    if (index >= all || index <= previous) {
      refuse_gltf(place + ".sparse.indices", fmt::format("index {} does not rise or is out of range", index));
    }
    previous = index;
    for (std::size_t c = 0; c < components; ++c)
      values[index * components + c] = float_component(replacements, i, c, normalized);
  }
}

}  // namespace

std::vector<float> read_floats(const GltfDocument& document, std::size_t index, int components) {
  const Json& accessor = document.json["accessors"][index];
  const std::string place = fmt::format("accessors[{}]", index);
  check_shape(accessor, components, place);
  const int type = accessor["componentType"].get<int>();
  if (!is_attribute_type(type)) refuse_gltf(place, "is neither float nor an 8 or 16 bit integer");
  const auto width = static_cast<std::size_t>(components);
  const auto count = accessor["count"].get<std::size_t>();
  Elements elements;
  if (accessor.contains("bufferView")) elements = locate(document, accessor, count, width, type, place);
  const bool normalized = accessor.value("normalized", false);
  std::vector<float> values(count * width, 0.0F);
  for (std::size_t i = 0; i < elements.count; ++i) {
    for (std::size_t c = 0; c < width; ++c) values[i * width + c] = float_component(elements, i, c, normalized);
  }
  if (accessor.contains("sparse")) substitute(document, accessor, width, values, place);
  return values;
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, std::size_t index) {
  const Json& accessor = document.json["accessors"][index];
  const std::string place = fmt::format("accessors[{}]", index);
  check_shape(accessor, 1, place);
  const int type = accessor["componentType"].get<int>();
  if (!is_index_type(type)) refuse_gltf(place, "indices must be unsigned integers");
  if (!accessor.contains("bufferView") || accessor.contains("sparse"))
    refuse_gltf(place, "indices must lie in a buffer view, not sparse");
  const Elements elements = locate(document, accessor, accessor["count"].get<std::uint64_t>(), 1, type, place);
  std::vector<std::uint32_t> indices(elements.count);
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = index_component(elements, i);
  return indices;
}

}  // namespace footprint
