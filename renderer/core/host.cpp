// The name as POSIX gives it.
#include "renderer/core/host.hpp"

#include <unistd.h>

#include <array>

namespace footprint {

std::string host_name() {
  std::array<char, 256> name{};  // POSIX: HOST_NAME_MAX is 255 at most
  if (::gethostname(name.data(), name.size() - 1) != 0 || name.front() == '\0') return "?";
  return name.data();
}

}  // namespace footprint
