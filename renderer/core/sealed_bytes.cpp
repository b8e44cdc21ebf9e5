// The checksum is the last field: a hash of everything before it, form included.
#include "renderer/core/sealed_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace footprint {
namespace {

constexpr std::size_t checksum_length = 16;
constexpr std::size_t piece_length = std::size_t{1} << 20U;  // of what is read for its checksum alone

std::string checksum(std::uint64_t sum) { return fmt::format("{:016x}", sum); }

// Of all bytes; none where they cannot be read.
std::optional<std::string> checksum_of(const StoredBytes& bytes) {
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

void SealedWriter::put(std::span<const std::uint8_t> bytes) {
  sum_ = fnv1a(std::as_bytes(bytes), sum_);
  out_(bytes);
}

void SealedWriter::add_block(std::span<const std::uint8_t> block) {
  add<std::uint64_t>(block.size());
  put(block);
}

void SealedWriter::add_text(std::string_view text) { add_block(bytes_of(text)); }

void SealedWriter::seal() && { out_(bytes_of(checksum(sum_))); }

std::vector<std::uint8_t> sealed(std::string_view form, const std::function<void(SealedWriter&)>& fill) {
  std::vector<std::uint8_t> bytes;
  SealedWriter writer(form, appending_to(bytes));
  fill(writer);
  std::move(writer).seal();
  return bytes;
}

std::optional<SealedReader> SealedReader::open(const StoredBytes& bytes, std::string_view form) {
  if (bytes.size() < checksum_length) return {};
  const StoredBytes body = bytes.first(bytes.size() - checksum_length);
  std::string last(checksum_length, '\0');
  if (!bytes.read(body.size(), {reinterpret_cast<std::uint8_t*>(last.data()), last.size()})) return {};
  if (checksum_of(body) != last) return {};
  SealedReader reader(body);
  if (reader.get_text() != form) return {};
  return reader;
}

std::string SealedReader::get_text() {
  const std::vector<char> text = get_values<char>();
  return {text.begin(), text.end()};
}

std::uint64_t SealedReader::get_count(std::size_t least) {
  const auto count = get<std::uint64_t>();
  whole_ = whole_ && count <= left() / least;
  return whole_ ? count : 0;
}

bool SealedReader::take(std::span<std::uint8_t> out) {
  whole_ = whole_ && body_.read(at_, out);
  if (whole_) at_ += out.size();
  return whole_;
}

}  // namespace footprint
