// Decodes to bytes by libwebp; walks the chunks of the container for metadata.
#include "renderer/image/webp_file.hpp"

#include <OpenImageIO/imageio.h>
#include <webp/decode.h>

#include <string_view>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

// The content of a RIFF chunk, such as "EXIF"; empty if there is none.
std::string_view chunk_of(std::span<const std::uint8_t> bytes, std::string_view type) {
  constexpr std::size_t container_size = 12, head_size = 8;
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (std::size_t start = container_size; start + head_size <= all.size();) {
    std::size_t length = 0;
    for (std::size_t i = 8; i-- > 4;) length = length << 8U | bytes[start + i];
    const std::size_t content = start + head_size;
    if (all.substr(start, 4) == type) return all.substr(content, length);
    start = content + length + length % 2;
  }
  return {};
}

Error damaged(const std::string& name) {
  return {ErrorKind::usage, name, "is truncated or damaged", "give a whole WebP"};
}

}  // namespace

WebpHeader read_webp_header(std::span<const std::uint8_t> bytes, const std::string& name) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK) throw damaged(name);
  if (features.has_animation != 0) throw Error(ErrorKind::usage, name, "is an animation", "give a WebP of one image");
  WebpHeader header{
      .width = features.width, .height = features.height, .channels = features.has_alpha != 0 ? 4 : 3, .declared = {}};
  header.declared.orientation = exif_orientation(chunk_of(bytes, "EXIF"));
  if (!chunk_of(bytes, "ICCP").empty()) header.declared.profile = "of a WebP";
  return header;
}

Image decode_webp(std::span<const std::uint8_t> bytes, const WebpHeader& header, const std::string& name) {
  const auto channels = static_cast<std::size_t>(header.channels);
  const std::size_t row = static_cast<std::size_t>(header.width) * channels;
  std::vector<std::uint8_t> texels(row * static_cast<std::size_t>(header.height));
  const auto decode = header.channels == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
  if (decode(bytes.data(), bytes.size(), texels.data(), texels.size(), static_cast<int>(row)) == nullptr)
    throw damaged(name);
  Image image(header.width, header.height, header.channels);
  OIIO::convert_pixel_values(OIIO::TypeDesc::UINT8, texels.data(), OIIO::TypeDesc::FLOAT, image.texels.data(),
                             static_cast<int>(texels.size()));
  return image;
}

}  // namespace footprint
