// Reads at an offset, so that copies of one open file do not disturb each other.
#include "renderer/core/stored_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace footprint {

std::optional<StoredBytes> StoredBytes::of_file(const std::filesystem::path& file) {
  // A pipe would wait for its other end.
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return {};
  StoredBytes out;
  out.file_ = {new int(descriptor), [](const int* opened) {
                 ::close(*opened);
                 delete opened;
               }};
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return {};
  out.size_ = static_cast<std::uint64_t>(status.st_size);
  return out;
}

bool StoredBytes::read(std::uint64_t from, std::span<std::uint8_t> out) const {
  if (from > size_ || out.size() > size_ - from) return false;
  if (!file_) {
    std::ranges::copy(bytes_.subspan(static_cast<std::size_t>(from), out.size()), out.begin());
    return true;
  }
  while (!out.empty()) {
    const ssize_t count = ::pread(*file_, out.data(), out.size(), static_cast<off_t>(from));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    from += static_cast<std::uint64_t>(count);
    out = out.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

StoredBytes StoredBytes::first(std::uint64_t size) const {
  StoredBytes out = *this;
  out.size_ = std::min(size, size_);
  return out;
}

}  // namespace footprint
