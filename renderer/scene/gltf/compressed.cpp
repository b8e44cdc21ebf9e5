// Checks all sizes, counts and indices around the two libraries, which trust their input.
#include "renderer/scene/gltf/document.hpp"

#include <draco/compression/decode.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"

namespace footprint {
namespace {

using Json = nlohmann::json;

constexpr const char* meshopt_extension = "EXT_meshopt_compression";

// The parameters of a compressed buffer view.
struct Encoding {
  std::size_t count = 0, stride = 0;
  std::string mode, filter;
  const unsigned char* data = nullptr;
  std::size_t size = 0;
};

Encoding encoding_of(const tinygltf::Model& model, const Json& extension) {
  Encoding out{.count = extension["count"].get<std::size_t>(),
               .stride = extension["byteStride"].get<std::size_t>(),
               .mode = extension["mode"].get<std::string>(),
               .filter = extension.value("filter", "NONE"),
               .data = nullptr,
               .size = extension["byteLength"].get<std::size_t>()};
  const auto& bytes = model.buffers[extension["buffer"].get<std::size_t>()].data;
  const auto offset = extension.value("byteOffset", std::size_t{0});
  if (offset > bytes.size() || out.size > bytes.size() - offset)
    refuse_gltf(meshopt_extension, "its data does not lie within its buffer");
  out.data = bytes.data() + offset;
  return out;
}

// The valid combinations of the extension's section "Fallback buffers".
void check(const Encoding& encoding, std::size_t length) {
  const auto& [count, stride, mode, filter, data, size] = encoding;
  if (count * stride != length)
    refuse_gltf(meshopt_extension,
                fmt::format("{} elements of {} bytes are not the {} bytes of the buffer view", count, stride, length));
  if (mode == "ATTRIBUTES") {
    if (stride % 4 != 0 || stride == 0 || stride > 256)
      refuse_gltf(meshopt_extension, fmt::format("a stride of {} bytes is not allowed", stride));
    const bool fits = filter == "NONE" || filter == "EXPONENTIAL" ||
                      (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
                      (filter == "QUATERNION" && stride == 8);
    if (!fits)
      refuse_gltf(meshopt_extension,
                  fmt::format("filter `{:.20}` does not go with a stride of {} bytes", filter, stride));
  } else if (mode == "TRIANGLES" || mode == "INDICES") {
    if (stride != 2 && stride != 4)
      refuse_gltf(meshopt_extension, fmt::format("indices of {} bytes are not allowed", stride));
    if (mode == "TRIANGLES" && count % 3 != 0)
      refuse_gltf(meshopt_extension, fmt::format("{} indices are not whole triangles", count));
    if (filter != "NONE") refuse_gltf(meshopt_extension, "indices have no filter");
  } else {
    refuse_gltf(meshopt_extension, fmt::format("`{:.20}` is none of ATTRIBUTES, TRIANGLES, INDICES", mode));
  }
}

std::vector<unsigned char> decoded(const Encoding& encoding) {
  const auto& [count, stride, mode, filter, data, size] = encoding;
  require_memory(count * stride, "decoding a compressed buffer view", "use a smaller model, or free memory");
  std::vector<unsigned char> out(count * stride);
  const int failed = mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(out.data(), count, stride, data, size)
                     : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(out.data(), count, stride, data, size)
                                           : meshopt_decodeIndexSequence(out.data(), count, stride, data, size);
  if (failed != 0) refuse_gltf(meshopt_extension, "its data is damaged");
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), count, stride);
  return out;
}

constexpr const char* draco_extension = "KHR_draco_mesh_compression";

using Bytes = std::vector<unsigned char>;

std::unique_ptr<draco::Mesh> decoded(const tinygltf::Model& model, std::size_t view) {
  const std::span<const std::uint8_t> bytes = view_bytes(model, view);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  try {
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok())
      refuse_gltf(draco_extension, fmt::format("its data cannot be decoded: {:.200}", mesh.status().error_msg()));
    return std::move(mesh).value();
  } catch (const std::bad_alloc&) {
    refuse_gltf(draco_extension, "its data cannot be decoded: it needs more memory than there is");
  } catch (const std::length_error&) {
    refuse_gltf(draco_extension, "its data cannot be decoded: it needs more memory than there is");
  }
}

// Appends a buffer with one view of all of it; gives the view's index.
int add_view(tinygltf::Model& model, Bytes bytes) {
  tinygltf::BufferView view;
  view.buffer = static_cast<int>(model.buffers.size());
  view.byteLength = bytes.size();
  model.buffers.emplace_back().data = std::move(bytes);
  model.bufferViews.push_back(std::move(view));
  return static_cast<int>(model.bufferViews.size()) - 1;
}

void point_at(tinygltf::Accessor& accessor, int view) {
  accessor.bufferView = view;
  accessor.byteOffset = 0;
}

// Whether the values of all points are within the attribute's buffer.
bool is_whole(const draco::PointAttribute& attribute, std::uint32_t points) {
  const auto stride = static_cast<std::uint64_t>(attribute.byte_stride());
  const auto offset = static_cast<std::uint64_t>(attribute.byte_offset());
  if (attribute.buffer() == nullptr || stride == 0) return false;
  if (offset + attribute.size() * stride > attribute.buffer()->data_size()) return false;
  if (!attribute.is_mapping_identity() && attribute.indices_map_size() < points) return false;
  for (std::uint32_t i = 0; i < points; ++i)
    if (attribute.mapped_index(draco::PointIndex(i)).value() >= attribute.size()) return false;
  return true;
}

template <typename T>
Bytes values_of(const draco::PointAttribute& attribute, std::uint32_t points) {
  const auto components = static_cast<std::size_t>(attribute.num_components());
  Bytes bytes(points * components * sizeof(T));
  std::vector<T> values(components);
  for (std::uint32_t i = 0; i < points; ++i) {
    if (!attribute.ConvertValue<T>(attribute.mapped_index(draco::PointIndex(i)), static_cast<std::int8_t>(components),
                                   values.data()))
      refuse_gltf(draco_extension, "an attribute has values of another type than its accessor");
    std::memcpy(&bytes[i * components * sizeof(T)], values.data(), components * sizeof(T));
  }
  return bytes;
}

void take_attribute(tinygltf::Model& model, const draco::Mesh& mesh, const std::string& name, int id,
                    std::size_t accessor) {
  tinygltf::Accessor& target = model.accessors[accessor];
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
  if (attribute == nullptr) refuse_gltf(draco_extension, fmt::format("{}: its data has no attribute {}", name, id));
  if (target.count != mesh.num_points())
    refuse_gltf(draco_extension, fmt::format("{}: {} elements are decoded, accessors[{}] has {}", name,
                                             mesh.num_points(), accessor, target.count));
  const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(target.type));
  if (attribute->num_components() != components)
    refuse_gltf(draco_extension, fmt::format("{}: {} components are decoded, accessors[{}] has {}", name,
                                             attribute->num_components(), accessor, components));
  if (!is_whole(*attribute, mesh.num_points()))
    refuse_gltf(draco_extension, fmt::format("{}: its data is damaged", name));
  if (!is_attribute_type(target.componentType))
    refuse_gltf(draco_extension, fmt::format("{} is not a component type of an attribute", target.componentType));
  point_at(target, add_view(model, visit_component(target.componentType, [&]<class T>(T /*kind*/) {
                              return values_of<T>(*attribute, mesh.num_points());
                            })));
}

void take_indices(tinygltf::Model& model, const draco::Mesh& mesh, std::size_t accessor) {
  tinygltf::Accessor& target = model.accessors[accessor];
  const std::uint64_t count = std::uint64_t{3} * mesh.num_faces();
  if (target.count != count)
    refuse_gltf(draco_extension,
                fmt::format("indices: {} are decoded, accessors[{}] has {}", count, accessor, target.count));
  Bytes bytes(count * sizeof(std::uint32_t));
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t index = mesh.face(draco::FaceIndex(i))[corner].value();
      std::memcpy(&bytes[(3 * std::size_t{i} + corner) * sizeof index], &index, sizeof index);
    }
  }
  target.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  point_at(target, add_view(model, std::move(bytes)));
}

void decode_primitive(tinygltf::Model& model, const Json& primitive, const Json& extension) {
  const Json& attributes = primitive["attributes"];
  if (!attributes.contains("POSITION") || !primitive.contains("indices"))
    refuse_gltf(draco_extension, "a compressed primitive needs accessors for POSITION and indices");
  if (model.accessors[attributes["POSITION"].get<std::size_t>()].bufferView >= 0) return;
  if (primitive.value("mode", TINYGLTF_MODE_TRIANGLES) != TINYGLTF_MODE_TRIANGLES)
    refuse_gltf(draco_extension, "only triangles are read, no strips");
  const std::unique_ptr<draco::Mesh> mesh = decoded(model, extension["bufferView"].get<std::size_t>());
  for (const auto& [name, id] : extension["attributes"].items()) {
    if (attributes.contains(name))
      take_attribute(model, *mesh, name, id.get<int>(), attributes[name].get<std::size_t>());
  }
  take_indices(model, *mesh, primitive["indices"].get<std::size_t>());
}

}  // namespace

bool is_fallback(const Json& buffer) {
  const Json::json_pointer extension("/extensions/EXT_meshopt_compression");
  return !buffer.contains("uri") && buffer.contains(extension) && buffer[extension].contains("fallback");
}

bool is_compressed(const Json& view) {
  return view.contains(Json::json_pointer("/extensions/EXT_meshopt_compression"));
}

void decode_meshopt(GltfDocument& document) {
  const Json views = document.json.value("bufferViews", Json::array());
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!is_compressed(views[i])) continue;
    try {
      tinygltf::BufferView& view = document.model.bufferViews[i];
      const Encoding encoding = encoding_of(document.model, views[i]["extensions"][meshopt_extension]);
      check(encoding, view.byteLength);
      std::vector<unsigned char> bytes = decoded(encoding);
      view.buffer = static_cast<int>(document.model.buffers.size());
      view.byteOffset = 0;
      document.model.buffers.emplace_back().data = std::move(bytes);
    } catch (const Error& error) {
      throw error.within(fmt::format("bufferViews[{}]", i));
    }
  }
}

void decode_draco(GltfDocument& document) {
  const Json::json_pointer draco = Json::json_pointer("/extensions") / draco_extension;
  const Json meshes = document.json.value("meshes", Json::array());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (std::size_t p = 0; p < meshes[m]["primitives"].size(); ++p) {
      const Json& primitive = meshes[m]["primitives"][p];
      if (!primitive.contains(draco)) continue;
      try {
        decode_primitive(document.model, primitive, primitive[draco]);
      } catch (const Error& error) {
        throw error.within(fmt::format("mesh {} `{:.80}`, primitive {}", m, meshes[m].value("name", ""), p));
      }
    }
  }
}

}  // namespace footprint
