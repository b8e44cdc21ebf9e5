// Writes a call down, and finds the method that it means.
#include "experiments/runner/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "experiments/runner/functions.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"

namespace footprint {

std::string measure_text(const Measure& measure) {
  std::string text = fmt::format("{}({}", measure.function->name, measure.method);
  const auto add = [&text](Selector selector, const auto& value) {
    if (value) text += fmt::format(", {}={}", selector_name(selector), *value);
  };
  add(Selector::distance, measure.distance);
  add(Selector::frame, measure.frame);
  for (const auto& [axis, value] : measure.slice) text += fmt::format(", {}={}", axis, value);
  add(Selector::footprint, measure.footprint);
  add(Selector::name, measure.name);
  add(Selector::gpu, measure.gpu);
  add(Selector::spp, measure.spp);
  return text + ")";
}

std::size_t select_method(const std::string& wanted, std::span<const std::string> methods) {
  std::vector<std::size_t> of_name;
  std::vector<std::string> known(methods.begin(), methods.end());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (methods[i] == wanted) return i;
    const std::string name = methods[i].substr(0, methods[i].find(':'));
    if (name == wanted) of_name.push_back(i);
    if (std::ranges::find(known, name) == known.end()) known.push_back(name);
  }
  if (of_name.size() == 1) return of_name.front();
  if (of_name.empty()) {
    throw Error(ErrorKind::usage, "", fmt::format("the experiment has no method `{:.80}`", wanted),
                suggestion(wanted, known));
  }
  throw Error(ErrorKind::usage, "", fmt::format("`{}` is {} of the experiment's methods", wanted, of_name.size()),
              "write it with its options, as in the experiment");
}

}  // namespace footprint
