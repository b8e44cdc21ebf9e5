// Files are read at an offset, so that copies of one open file do not disturb each other. A checksum is the last field,
// a hash of everything before it.
#include "renderer/core/bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr std::size_t checksum_length = 16;
constexpr std::size_t piece_length = std::size_t{1} << 20U;  // read at once to compute a checksum

// The checksum of all bytes; none if they cannot be read.
std::optional<std::string> compute_checksum(const ByteSource& bytes) {
  std::vector<std::uint8_t> piece;
  std::uint64_t sum = fnv1a_start;
  for (std::uint64_t at = 0; at < bytes.size(); at += piece.size()) {
    piece.resize(static_cast<std::size_t>(std::min<std::uint64_t>(piece_length, bytes.size() - at)));
    if (!bytes.read(at, piece)) return {};
    sum = fnv1a(std::as_bytes(std::span(piece)), sum);
  }
  return checksum(sum);
}

}  // namespace

std::uint64_t fnv1a(std::span<const std::byte> bytes, std::uint64_t state) {
  constexpr std::uint64_t prime = 0x100000001b3U;
  for (const std::byte byte : bytes) state = (state ^ std::to_integer<std::uint64_t>(byte)) * prime;
  return state;
}

void ContentHash::add(std::span<const std::byte> field) {
  const std::uint64_t length = field.size();
  state_ = fnv1a(std::as_bytes(std::span(&length, 1)), state_);
  state_ = fnv1a(field, state_);
}

void ContentHash::add(std::string_view field) { add(std::as_bytes(std::span(field))); }

std::string checksum(std::uint64_t sum) { return fmt::format("{:016x}", sum); }

std::string ContentHash::hex() const { return checksum(state_); }

std::optional<ByteSource> ByteSource::of_file(const std::filesystem::path& file) {
  // A pipe would wait for its other end.
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return {};
  ByteSource out;
  out.file_ = {new int(descriptor), [](const int* opened) {
                 ::close(*opened);
                 delete opened;
               }};
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return {};
  out.size_ = static_cast<std::uint64_t>(status.st_size);
  return out;
}

bool ByteSource::read(std::uint64_t from, std::span<std::uint8_t> out) const {
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

ByteSource ByteSource::first(std::uint64_t size) const {
  ByteSource out = *this;
  out.size_ = std::min(size, size_);
  return out;
}

std::vector<std::uint8_t> read_file_bytes(const std::filesystem::path& file, std::uint64_t largest) {
  const auto fail = [&](const std::string& message, const std::string& hint) {
    return Error(ErrorKind::usage, file.string(), message, hint);
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw fail("no such file", "check the path");
  // A device such as /dev/zero never ends, and a pipe may block.
  if (!std::filesystem::is_regular_file(status)) throw fail("not a regular file", "name a file");
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw fail("cannot be read: " + error.message(), "check the permissions");
  if (size == 0) throw fail("the file is empty", "give the whole file");
  if (size > largest) {
    throw fail(fmt::format("{} bytes, more than the {} that are read", size, largest), "make the file smaller");
  }
  std::vector<std::uint8_t> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    throw fail("cannot be read", "check the permissions");
  }
  return bytes;
}

void ByteArchive::pass(bool& value) {
  auto byte = static_cast<std::uint8_t>(value);
  pass(byte);
  whole_ = whole_ && byte <= 1;
  if (in_) value = byte == 1;  // what is written may be constant
}

void ByteArchive::pass(std::string& text) {
  const std::size_t size = pass_count(text.size(), 1);
  if (in_) text.resize(size);
  pass_bytes({reinterpret_cast<std::uint8_t*>(text.data()), text.size()});
}

std::size_t ByteArchive::pass_count(std::uint64_t count, std::size_t unit) {
  pass(count);
  whole_ = whole_ && (!in_ || count <= left()) && count % unit == 0;
  return whole_ ? static_cast<std::size_t>(count / unit) : 0;
}

void ByteArchive::pass_bytes(std::span<std::uint8_t> bytes) {
  if (!in_) return out_(bytes);
  whole_ = whole_ && in_->read(at_, bytes);
  if (whole_) at_ += bytes.size();
  if (!whole_) std::ranges::fill(bytes, std::uint8_t{0});
}

std::optional<ByteSource> without_checksum(const ByteSource& bytes) {
  if (bytes.size() < checksum_length) return {};
  ByteSource body = bytes.first(bytes.size() - checksum_length);
  std::string last(checksum_length, '\0');
  if (!bytes.read(body.size(), {reinterpret_cast<std::uint8_t*>(last.data()), last.size()})) return {};
  return compute_checksum(body) == last ? std::optional(body) : std::nullopt;
}

}  // namespace footprint
