// Characters that every file system takes, and numbers where two names would meet.
#include "renderer/core/file_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace footprint {
namespace {

constexpr std::size_t longest_stem = 100;  // file systems take 255 bytes, and what is added needs some

}  // namespace

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string lower_extension(const std::filesystem::path& path) { return lower_case(path.extension().string()); }

std::string file_stem(const std::string& text) {
  std::string stem = text;
  std::ranges::replace_if(
      stem, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.' && c != '_'; }, '_');
  return stem;
}

std::vector<std::string> distinct_stems(const std::vector<std::string>& names) {
  std::vector<std::string> stems;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string stem = file_stem(names[i]).substr(0, longest_stem);
    if (stem.empty() || stem.front() == '.') stem.insert(0, "_");
    while (!taken.insert(lower_case(stem)).second) stem += fmt::format(".{}", i);
    stems.push_back(std::move(stem));
  }
  return stems;
}

}  // namespace footprint
