// Sizes are checked before the library sees them: it asserts what it asks for, and fills what it is given.
#include "renderer/scene/gltf/meshopt.hpp"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/scene/gltf/refusal.hpp"

namespace footprint {
namespace {

constexpr const char* extension_name = "EXT_meshopt_compression";

bool is_fallback(const nlohmann::json& buffer) {
  const auto extensions = buffer.find("extensions");
  if (buffer.contains("uri") || extensions == buffer.end() || !extensions->is_object()) return false;
  const auto extension = extensions->find(extension_name);
  return extension != extensions->end() && extension->is_object() && extension->contains("fallback");
}

bool is_compressed(const nlohmann::json& view) {
  const auto extensions = view.find("extensions");
  return extensions != view.end() && extensions->contains(extension_name);
}

// What the extension says of one buffer view.
struct Encoding {
  std::size_t count = 0, stride = 0;
  std::string mode, filter;
  const unsigned char* data = nullptr;
  std::size_t size = 0;
};

std::size_t whole(const tinygltf::Value& extension, const char* key) {
  return extension.Has(key) ? static_cast<std::size_t>(extension.Get(key).GetNumberAsInt()) : 0;
}

Encoding encoding_of(const tinygltf::Model& model, const tinygltf::Value& extension) {
  Encoding out{.count = whole(extension, "count"),
               .stride = whole(extension, "byteStride"),
               .mode = extension.Get("mode").Get<std::string>(),
               .filter = extension.Has("filter") ? extension.Get("filter").Get<std::string>() : "NONE",
               .data = nullptr,
               .size = whole(extension, "byteLength")};
  const auto& bytes = model.buffers[whole(extension, "buffer")].data;
  const std::size_t offset = whole(extension, "byteOffset");
  if (offset > bytes.size() || out.size > bytes.size() - offset)
    refuse_gltf(extension_name, "its data does not lie within its buffer");
  out.data = bytes.data() + offset;
  return out;
}

// The table of the extension's section "Fallback buffers": what each mode and filter may be used with.
void check(const Encoding& encoding, std::size_t length) {
  const auto& [count, stride, mode, filter, data, size] = encoding;
  if (count * stride != length)
    refuse_gltf(extension_name,
                fmt::format("{} elements of {} bytes are not the {} bytes of the buffer view", count, stride, length));
  if (mode == "ATTRIBUTES") {
    if (stride % 4 != 0 || stride == 0 || stride > 256)
      refuse_gltf(extension_name, fmt::format("a stride of {} bytes is not allowed", stride));
    const bool fits = filter == "NONE" || filter == "EXPONENTIAL" ||
                      (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
                      (filter == "QUATERNION" && stride == 8);
    if (!fits)
      refuse_gltf(extension_name, fmt::format("filter `{:.20}` does not go with a stride of {} bytes", filter, stride));
  } else if (mode == "TRIANGLES" || mode == "INDICES") {
    if (stride != 2 && stride != 4)
      refuse_gltf(extension_name, fmt::format("indices of {} bytes are not allowed", stride));
    if (mode == "TRIANGLES" && count % 3 != 0)
      refuse_gltf(extension_name, fmt::format("{} indices are not whole triangles", count));
    if (filter != "NONE") refuse_gltf(extension_name, "indices have no filter");
  } else {
    refuse_gltf(extension_name, fmt::format("`{:.20}` is none of ATTRIBUTES, TRIANGLES, INDICES", mode));
  }
}

std::vector<unsigned char> decoded(const Encoding& encoding) {
  const auto& [count, stride, mode, filter, data, size] = encoding;
  require_memory(count * stride, "decoding a compressed buffer view", "use a smaller model, or free memory");
  std::vector<unsigned char> out(count * stride);
  const int failed = mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(out.data(), count, stride, data, size)
                     : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(out.data(), count, stride, data, size)
                                           : meshopt_decodeIndexSequence(out.data(), count, stride, data, size);
  if (failed != 0) refuse_gltf(extension_name, "its data is damaged");
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), count, stride);
  return out;
}

}  // namespace

bool fill_fallback_buffers(nlohmann::json& document) {
  const nlohmann::json buffers = document.value("buffers", nlohmann::json::array());
  if (std::ranges::none_of(buffers, is_fallback)) return false;
  const nlohmann::json views = document.value("bufferViews", nlohmann::json::array());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto buffer = views[i]["buffer"].get<std::size_t>();
    if (is_fallback(buffers[buffer]) && !is_compressed(views[i]))
      refuse_gltf(fmt::format("bufferViews[{}]", i),
                  fmt::format("is not compressed, and buffers[{}] has no bytes of its own", buffer));
  }
  for (const auto& image : document.value("images", nlohmann::json::array())) {
    if (image.contains("bufferView") && is_compressed(views[image["bufferView"].get<std::size_t>()]))
      refuse_gltf(extension_name, "an image lies in a compressed buffer view");
  }
  for (auto& buffer : document["buffers"]) {
    if (!is_fallback(buffer)) continue;
    buffer["uri"] = "data:application/octet-stream;base64,AA==";
    buffer["byteLength"] = 1;
  }
  return true;
}

void decode_meshopt(tinygltf::Model& model) {
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    tinygltf::BufferView& view = model.bufferViews[i];
    const auto extension = view.extensions.find(extension_name);
    if (extension == view.extensions.end()) continue;
    try {
      const Encoding encoding = encoding_of(model, extension->second);
      check(encoding, view.byteLength);
      std::vector<unsigned char> bytes = decoded(encoding);
      view.buffer = static_cast<int>(model.buffers.size());
      view.byteOffset = 0;
      model.buffers.emplace_back().data = std::move(bytes);
    } catch (const Error& error) {
      throw error.within(fmt::format("bufferViews[{}]", i));
    }
  }
}

}  // namespace footprint
