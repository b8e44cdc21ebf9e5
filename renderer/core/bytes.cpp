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

std::string checksum(std::uint64_t sum) { return fmt::format("{:016x}", sum); }

// The checksum of all bytes; none if they cannot be read.
std::optional<std::string> checksum_of(const ByteSource& bytes) {
  std::vector<std::uint8_t> piece;
  std::uint64_t sum = fnv1a_start;
  for (std::uint64_t at = 0; at < bytes.size(); at += piece.size()) {
    piece.resize(static_cast<std::size_t>(std::min<std::uint64_t>(piece_length, bytes.size() - at)));
    if (!bytes.read(at, piece)) return {};
    sum = fnv1a(std::as_bytes(std::span(piece)), sum);
  }
  return checksum(sum);
}

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
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

std::string ContentHash::hex() const { return fmt::format("{:016x}", state_); }

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

void ChecksummedWriter::put(std::span<const std::uint8_t> bytes) {
  sum_ = fnv1a(std::as_bytes(bytes), sum_);
  out_(bytes);
}

void ChecksummedWriter::add_block(std::span<const std::uint8_t> block) {
  add<std::uint64_t>(block.size());
  put(block);
}

void ChecksummedWriter::add_text(std::string_view text) { add_block(bytes_of(text)); }

void ChecksummedWriter::finish() && { out_(bytes_of(checksum(sum_))); }

std::vector<std::uint8_t> write_checksummed(std::string_view form,
                                            const std::function<void(ChecksummedWriter&)>& fill) {
  std::vector<std::uint8_t> bytes;
  ChecksummedWriter writer(form, appending_to(bytes));
  fill(writer);
  std::move(writer).finish();
  return bytes;
}

std::optional<ChecksummedReader> ChecksummedReader::open(const ByteSource& bytes, std::string_view form) {
  if (bytes.size() < checksum_length) return {};
  const ByteSource body = bytes.first(bytes.size() - checksum_length);
  std::string last(checksum_length, '\0');
  if (!bytes.read(body.size(), {reinterpret_cast<std::uint8_t*>(last.data()), last.size()})) return {};
  if (checksum_of(body) != last) return {};
  ChecksummedReader reader(body);
  if (reader.get_text() != form) return {};
  return reader;
}

std::string ChecksummedReader::get_text() {
  const std::vector<char> text = get_values<char>();
  return {text.begin(), text.end()};
}

std::uint64_t ChecksummedReader::get_count(std::size_t least) {
  const auto count = get<std::uint64_t>();
  whole_ = whole_ && count <= left() / least;
  return whole_ ? count : 0;
}

bool ChecksummedReader::take(std::span<std::uint8_t> out) {
  whole_ = whole_ && body_.read(at_, out);
  if (whole_) at_ += out.size();
  return whole_;
}

}  // namespace footprint
