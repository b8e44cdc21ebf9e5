// The luminance of linear colours with the primaries of Rec. 709.
#pragma once

namespace footprint {

template <typename Value>
[[nodiscard]] Value luminance(Value red, Value green, Value blue) {
  return static_cast<Value>(0.2126) * red + static_cast<Value>(0.7152) * green + static_cast<Value>(0.0722) * blue;
}

}  // namespace footprint
