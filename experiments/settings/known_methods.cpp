// The methods of a text, each held against the table of its options.
#include "experiments/settings/known_methods.hpp"

#include "methods/registry.hpp"

namespace footprint {

std::vector<MethodSpec> parse_known_methods(const std::string& text) {
  std::vector<MethodSpec> methods = parse_methods(text);
  for (const MethodSpec& method : methods) {
    (void)Options(find_method(method.name).info().options, method.options, "method " + method.name);
  }
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
