// A backend as two lines of text, and as JSON.
#include "app/backend_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace footprint {

std::string backend_text(const gl::BackendReport& report) {
  std::string name{gl::backend_name(report.backend)};
  if (report.backend == gl::Backend::egl_device) name += fmt::format(" --device {}", report.device);
  if (!report.info) return fmt::format("  {:<22} not available: {}\n", name, report.why_not);
  const gl::ContextInfo& info = *report.info;
  return fmt::format(
      "  {:<22} {}, OpenGL {}{}\n"
      "  {:<22} textures up to {} texels per side, frames up to {} without tiles, {} texture units, uniform blocks up "
      "to {} bytes\n",
      name, info.renderer, info.version, info.software ? ", software" : "", "", info.max_texture_size,
      info.max_framebuffer_size, info.max_texture_units, info.max_uniform_block_bytes);
}

nlohmann::ordered_json backend_json(const gl::BackendReport& report) {
  nlohmann::ordered_json json{
      {"name", gl::backend_name(report.backend)}, {"device", report.device}, {"available", report.info.has_value()}};
  if (!report.info) {
    json["why_not"] = report.why_not;
    return json;
  }
  const gl::ContextInfo& info = *report.info;
  json["vendor"] = info.vendor;
  json["renderer"] = info.renderer;
  json["version"] = info.version;
  json["glsl_version"] = info.glsl_version;
  json["software"] = info.software;
  json["max_texture_size"] = info.max_texture_size;
  json["max_framebuffer_size"] = info.max_framebuffer_size;
  json["max_texture_units"] = info.max_texture_units;
  json["max_uniform_block_bytes"] = info.max_uniform_block_bytes;
  return json;
}

}  // namespace footprint
