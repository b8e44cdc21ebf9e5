// Stores an image of floats, or a packed one with its decoder.
#include "renderer/scene/map_texels.hpp"

#include <utility>

#include "renderer/core/memory.hpp"
#include "renderer/image/packed_image.hpp"

namespace footprint {

struct MapTexels::Content {
  std::shared_ptr<const Image> floats;  // or else:
  PackedImage packed;
  Decode decode;             // none: the packed image is the map
  std::vector<float> first;  // texel of the map: as many channels as that has
  int width = 0, height = 0;

  [[nodiscard]] Image decoded() const {
    if (floats) return *floats;
    return decode ? decode(packed.unpacked()) : packed.unpacked();
  }
};

namespace {

std::vector<float> first_texel(const Image& image) {
  if (image.empty()) return {};
  return {image.at(0, 0).begin(), image.at(0, 0).end()};
}

}  // namespace

MapTexels::MapTexels(std::shared_ptr<const Image> image) {
  if (!image) return;
  Content content{.floats = {},
                  .packed = {},
                  .decode = {},
                  .first = first_texel(*image),
                  .width = image->width,
                  .height = image->height};
  content.floats = std::move(image);
  content_ = std::make_shared<const Content>(std::move(content));
}

MapTexels MapTexels::packed(const Image& image) { return packed(image, image, {}); }

MapTexels MapTexels::packed(const Image& map, const Image& stored, Decode decode) {
  MapTexels out;
  out.content_ = std::make_shared<const Content>(Content{.floats = {},
                                                         .packed = PackedImage(stored),
                                                         .decode = std::move(decode),
                                                         .first = first_texel(map),
                                                         .width = map.width,
                                                         .height = map.height});
  return out;
}

int MapTexels::width() const { return content_->width; }

int MapTexels::height() const { return content_->height; }

int MapTexels::channels() const { return static_cast<int>(content_->first.size()); }

std::size_t MapTexels::texel_count() const {
  return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
}

std::span<const float> MapTexels::first() const { return content_->first; }

Image MapTexels::decoded() const {
  require_texels(width(), height(), texel_count() * content_->first.size() * sizeof(float), "a decoded map");
  return content_->decoded();
}

const void* MapTexels::identity() const {
  if (!content_) return nullptr;
  return content_->floats ? static_cast<const void*>(content_->floats.get()) : content_.get();
}

std::size_t MapTexels::byte_count() const {
  return content_->floats ? content_->floats->texels.size() * sizeof(float) : content_->packed.byte_count();
}

}  // namespace footprint
