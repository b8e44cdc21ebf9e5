// A way to OpenGL in words and as JSON, for `info` and `list`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "renderer/gl/context.hpp"

namespace footprint {

/// One backend: a line with renderer and version and one with its limits, or one line that says why it is not there.
[[nodiscard]] std::string backend_text(const gl::BackendReport& report);

/// The same as an object: name, device, available, and what there is to say of either.
[[nodiscard]] nlohmann::ordered_json backend_json(const gl::BackendReport& report);

}  // namespace footprint
