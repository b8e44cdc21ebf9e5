// Images encoded in memory, so that there is one way of writing files and of finding a full disk.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>
#include <vector>

namespace footprint {

/// The bytes of a file of that format.
/// name: for error messages; format: as OpenImageIO calls it; texels: of `type`, as many as `spec` says.
/// Throws Error (machine): it cannot be encoded.
[[nodiscard]] std::vector<unsigned char> encoded_image(const std::string& name, const char* format,
                                                       const OIIO::ImageSpec& spec, const OIIO::TypeDesc& type,
                                                       const void* texels);

}  // namespace footprint
