// Local URIs as files, tried in the ways in which exporters write them, and why there is none.
#include <fmt/format.h>

#include <charconv>

#include "renderer/core/names.hpp"
#include "renderer/scene/gltf/document.hpp"

namespace footprint {
namespace {

// A URI without the scheme `file` and the local host; a URI of another scheme as it is.
std::string local_part(const std::string& uri) {
  if (lower_case(uri.substr(0, 5)) != "file:") return uri;
  std::string path = uri.substr(5);
  for (const char* host : {"//localhost/", "///"})
    if (path.starts_with(host)) return path.substr(std::string_view(host).size() - 1);
  return path;
}

bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

// Why no file is at a path, as far as its URI tells.
std::string missing_file(const std::filesystem::path& path, const std::string& name) {
  if (name.find('\\') != std::string::npos) return "no such file: its URI has a backslash, where `/` separates folders";
  std::error_code error;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string other = entry.path().filename().string();
    if (lower_case(other) == lower_case(path.filename().string()))
      return fmt::format("no such file: `{:.120}` beside it differs in upper and lower case", other);
  }
  if (name.find_first_of("#?") != std::string::npos)
    return "no such file: in a URI `#` begins a fragment and `?` a query; names have %23 and %3F for them";
  return "no such file";
}

}  // namespace

std::string percent_decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::uint8_t code = 0;
    const bool encoded = text[i] == '%' && i + 2 < text.size() &&
                         std::from_chars(&text[i + 1], &text[i] + 3, code, 16).ptr == &text[i] + 3;
    out += encoded ? static_cast<char>(code) : text[i];
    if (encoded) i += 2;
  }
  return out;
}

GltfFile gltf_file(const GltfDocument& document, const std::string& uri) {
  const std::filesystem::path folder = document.file.parent_path();
  const std::string local = local_part(uri), decoded = percent_decoded(local);
  if (decoded.find('\0') != std::string::npos) return {folder, "its URI has a byte of 0"};
  const std::string path = percent_decoded(local.substr(0, local.find_first_of("#?")));
  for (const std::string& name : {decoded, local, path})
    if (!name.empty() && is_there(folder / name)) return {folder / name};
  return {folder / decoded, missing_file(folder / decoded, decoded)};
}

}  // namespace footprint
