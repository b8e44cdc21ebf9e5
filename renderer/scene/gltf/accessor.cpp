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

constexpr std::uint64_t largest_unbacked_count = std::uint64_t{1} << 20U;

/// Elements in a buffer, `stride` bytes apart, of any alignment.
struct Elements {
  const unsigned char* first = nullptr;
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

/// Finds `count` elements of `components` in a buffer view; `count` is at least 1. The view itself is within its
/// buffer (check_gltf_json). A stride of 0 means tightly packed.
Elements locate(const tinygltf::Model& model, int view_index, std::uint64_t offset, std::uint64_t count,
                std::size_t components, int type, const std::string& place) {
  const auto& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  const std::uint64_t element = components * visit_component(type, [](auto kind) { return sizeof(kind); });
  const std::uint64_t stride = view.byteStride == 0 ? element : view.byteStride;
  if (stride < element)
    refuse_gltf(place, fmt::format("the stride of {} bytes is less than an element's {}", stride, element));
  const std::uint64_t end = offset + (count - 1) * stride + element;
  if (end > view.byteLength) {
    refuse_gltf(place, fmt::format("reads up to byte {} of a buffer view that has {}", end, view.byteLength));
  }
  const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  return {data.data() + view.byteOffset + offset, static_cast<std::size_t>(stride), static_cast<std::size_t>(count),
          type};
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
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

void check_shape(const tinygltf::Accessor& accessor, int components, const std::string& place) {
  const int width = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  const bool matrix = accessor.type >= TINYGLTF_TYPE_MAT2 && accessor.type <= TINYGLTF_TYPE_MAT4;
  if (matrix != (components == 16) || width != components) {
    refuse_gltf(place,
                fmt::format("has elements of another type than the {} components that its use needs", components));
  }
  if (accessor.count == 0) refuse_gltf(place, "has no element");
  // Elements without bytes behind them cost a file nothing, so that it could claim any memory.
  const std::uint64_t largest = accessor.bufferView < 0 ? largest_unbacked_count : largest_element_count;
  if (accessor.count > largest) {
    refuse_gltf(place, fmt::format("{} elements, more than the {} that are read", accessor.count, largest));
  }
}

/// Replaces the elements that a sparse accessor names.
void substitute(const tinygltf::Model& model, const tinygltf::Accessor& accessor, std::size_t components,
                std::vector<float>& values, const std::string& place) {
  const auto& sparse = accessor.sparse;
  const auto count = static_cast<std::uint64_t>(sparse.count);
  if (count < 1 || count > accessor.count) refuse_gltf(place + ".sparse", "replaces no or too many elements");
  if (!is_index_type(sparse.indices.componentType)) refuse_gltf(place + ".sparse.indices", "are not unsigned integers");
  const Elements indices =
      locate(model, sparse.indices.bufferView, static_cast<std::uint64_t>(sparse.indices.byteOffset), count, 1,
             sparse.indices.componentType, place + ".sparse.indices");
  const Elements replacements =
      locate(model, sparse.values.bufferView, static_cast<std::uint64_t>(sparse.values.byteOffset), count, components,
             accessor.componentType, place + ".sparse.values");
  std::int64_t previous = -1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t index = index_component(indices, i);
    if (index >= accessor.count || index <= previous) {
      refuse_gltf(place + ".sparse.indices", fmt::format("index {} does not rise or is out of range", index));
    }
    previous = index;
    for (std::size_t c = 0; c < components; ++c) {
      values[index * components + c] = float_component(replacements, i, c, accessor.normalized);
    }
  }
}

}  // namespace

std::vector<float> read_floats(const GltfDocument& document, std::size_t index, int components) {
  const tinygltf::Accessor& accessor = document.model.accessors[index];
  const std::string place = fmt::format("accessors[{}]", index);
  check_shape(accessor, components, place);
  const int type = accessor.componentType;
  if (!is_attribute_type(type)) refuse_gltf(place, "is neither float nor an 8 or 16 bit integer");
  const auto width = static_cast<std::size_t>(components);
  Elements elements;
  if (accessor.bufferView >= 0) {
    elements = locate(document.model, accessor.bufferView, accessor.byteOffset, accessor.count, width, type, place);
  }
  std::vector<float> values(accessor.count * width, 0.0F);
  for (std::size_t i = 0; i < elements.count; ++i) {
    for (std::size_t c = 0; c < width; ++c) {
      values[i * width + c] = float_component(elements, i, c, accessor.normalized);
    }
  }
  if (accessor.sparse.isSparse) substitute(document.model, accessor, width, values, place);
  return values;
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, std::size_t index) {
  const tinygltf::Accessor& accessor = document.model.accessors[index];
  const std::string place = fmt::format("accessors[{}]", index);
  check_shape(accessor, 1, place);
  if (!is_index_type(accessor.componentType)) refuse_gltf(place, "indices must be unsigned integers");
  if (accessor.bufferView < 0 || accessor.sparse.isSparse)
    refuse_gltf(place, "indices must lie in a buffer view, not sparse");
  const Elements elements = locate(document.model, accessor.bufferView, accessor.byteOffset, accessor.count, 1,
                                   accessor.componentType, place);
  std::vector<std::uint32_t> indices(elements.count);
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = index_component(elements, i);
  return indices;
}

}  // namespace footprint
