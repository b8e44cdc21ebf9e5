// A folder belongs to the method whose name and options its manifest has.
#include "experiments/studies/given_bakes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <map>
#include <vector>

#include "experiments/settings/setting.hpp"
#include "methods/registry.hpp"
#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr const char* option = "--bakes";

std::string difference(const BakeFolder& folder, const MethodSpec& spec) {
  const Method& method = find_method(spec);
  return folder.difference(method, options_of(method, spec));
}

// The differences from all methods of the run; with several from those of the same name alone, if there are any.
std::string differences(const BakeFolder& folder, std::span<const MethodSpec> methods) {
  if (methods.empty()) return "the run renders the reference, which has no maps";
  if (methods.size() == 1) return difference(folder, methods.front());
  std::vector<std::string> lines;
  for (const MethodSpec& spec : methods) {
    if (folder.method().starts_with(spec.name))
      lines.push_back(fmt::format("{}: {}", spec.text, difference(folder, spec)));
  }
  return lines.empty() ? fmt::format("the run has {}", fmt::join(texts_of(methods), ", "))
                       : fmt::format("{}", fmt::join(lines, "; "));
}

// The first method of the run whose maps a folder has; those that differ in their history share them.
const MethodSpec& method_of(const BakeFolder& folder, std::span<const MethodSpec> methods) {
  for (const MethodSpec& spec : methods) {
    if (difference(folder, spec).empty()) return spec;
  }
  throw Error(ErrorKind::usage, fmt::format("{} {}", option, folder.folder().string()),
              fmt::format("has the maps of `{}`, which is none of the run's methods: {}", folder.method(),
                          differences(folder, methods)),
              "render that method, or name a folder of this one");
}

}  // namespace

std::optional<BakeFolder> given_bake(std::span<const std::filesystem::path> folders, const MethodSpec& method) {
  for (const std::filesystem::path& path : folders) {
    BakeFolder folder(path);
    if (difference(folder, method).empty()) return folder;
  }
  return {};
}

void require_given_bakes(std::span<const std::filesystem::path> folders, std::span<const MethodSpec> methods,
                         const Scene& scene, const EffectSet& effects) {
  std::map<std::string, std::filesystem::path> known;
  for (const std::filesystem::path& path : folders) {
    const BakeFolder folder(path);
    const MethodSpec& spec = method_of(folder, methods);
    const auto [other, is_new] = known.emplace(spec.text, path);
    if (!is_new)
      throw Error(ErrorKind::usage, fmt::format("{} {}", option, path.string()),
                  fmt::format("has the maps of {}, as {} does", spec.text, other->second.string()), "give one of them");
    folder.require_fit(make_bake(find_method(spec), spec), scene, effects);
  }
}

std::string hash_given_bakes(std::span<const std::filesystem::path> folders) {
  std::string content;
  for (const std::filesystem::path& path : folders) content += BakeFolder(path).content();
  return content;
}

}  // namespace footprint
