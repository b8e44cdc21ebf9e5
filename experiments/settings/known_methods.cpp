// Checks the options of each method in a text.
#include "experiments/settings/known_methods.hpp"

#include "methods/registry.hpp"
#include "renderer/bake/baked_method.hpp"

namespace footprint {

std::vector<MethodSpec> parse_known_methods(const std::string& text) {
  std::vector<MethodSpec> methods = parse_methods(text);
  for (const MethodSpec& method : methods) (void)options_of(find_method(method.name), method);
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
    if (method->info().slow_frame) continue;
    methods.push_back({.text = method->info().name, .name = method->info().name, .options = {}});
  }
  return methods;
}

}  // namespace footprint
