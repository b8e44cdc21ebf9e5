// Reads methods that are files, checks the options of each method in a text, and finds figures by their names.
#include "experiments/settings/known_methods.hpp"

#include <algorithm>

#include "methods/registry.hpp"
#include "renderer/bake/baked_method.hpp"
#include "renderer/bake/method_file.hpp"

namespace footprint {

void take_known(std::span<MethodSpec> methods, const std::filesystem::path& folder) {
  for (MethodSpec& method : methods) {
    if (names_method_file(method.name)) method.file = read_method_file(method.name, folder);
    (void)options_of(find_method(method), method);
  }
}

std::vector<MethodSpec> parse_known_methods(const std::string& text, const std::filesystem::path& folder) {
  std::vector<MethodSpec> methods = parse_methods(text);
  take_known(methods, folder);
  return methods;
}

std::vector<std::string> texts_of(const std::vector<MethodSpec>& methods) {
  std::vector<std::string> texts;
  texts.reserve(methods.size());
  for (const MethodSpec& method : methods) texts.push_back(method.text);
  return texts;
}

std::vector<MethodSpec> every_method() {
  std::vector<MethodSpec> methods;
  for (const Method* method : all_methods()) {
    if (method->info.slow_frame) continue;
    methods.push_back({.text = method->info.name, .name = method->info.name, .options = {}});
  }
  return methods;
}

const Quantity* find_quantity(const Method& method, const std::string& name) {
  const auto all = quantities_of(method);
  const auto found = std::ranges::find(all, name, &Quantity::name);
  return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> quantity_names(std::span<const MethodSpec> methods) {
  std::vector<std::string> names;
  for (const MethodSpec& method : methods) {
    for (const Quantity& quantity : quantities_of(find_method(method))) {
      if (std::ranges::find(names, quantity.name) == names.end()) names.push_back(quantity.name);
    }
  }
  return names;
}

}  // namespace footprint
