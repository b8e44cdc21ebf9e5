// Bytes at rest, in memory or in a file, that are read piece by piece: a large file need never lie in memory whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace footprint {

/// Bytes that do not change. Copies share the open file.
class StoredBytes {
 public:
  /// Of memory, which is to outlive this.
  StoredBytes(std::span<const std::uint8_t> bytes)  // NOLINT(google-explicit-constructor): they are just that
      : bytes_(bytes), size_(bytes.size()) {}
  StoredBytes(const std::vector<std::uint8_t>& bytes)  // NOLINT(google-explicit-constructor): the same
      : StoredBytes(std::span(bytes)) {}
  /// Of a file, which may be replaced meanwhile: what was opened is read. None where it is no regular file, or cannot
  /// be read.
  [[nodiscard]] static std::optional<StoredBytes> of_file(const std::filesystem::path& file);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Reads the bytes from `from` on, as many as `out` has. False where there are not so many, or they cannot be read.
  [[nodiscard]] bool read(std::uint64_t from, std::span<std::uint8_t> out) const;
  /// Without those behind the first `size`.
  [[nodiscard]] StoredBytes first(std::uint64_t size) const;

 private:
  StoredBytes() = default;

  std::shared_ptr<const int> file_;  // its descriptor; none: `bytes_`
  std::span<const std::uint8_t> bytes_;
  std::uint64_t size_ = 0;
};

}  // namespace footprint
