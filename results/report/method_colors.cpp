// Methods choose one after the other, in the order of the palette.
#include "results/report/method_colors.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "renderer/core/embedded_texts.hpp"

namespace footprint {

extern const EmbeddedTexts page_texts;

namespace {

Palette read_palette() {
  const auto json = nlohmann::json::parse(find_text(page_texts, "palette.json")->text);
  return {.light = json.at("light"), .dark = json.at("dark"), .methods = json.at("methods")};
}

// "toksvig" of "toksvig:storage=fp16".
std::string name_of(const std::string& method) { return method.substr(0, method.find(':')); }

// The number of each method's name: that of the palette, or one behind it.
std::vector<std::size_t> numbers_of(const std::vector<std::string>& methods) {
  std::vector<std::string> known = report_palette().methods;
  std::vector<std::size_t> numbers;
  for (const std::string& method : methods) {
    const auto found = std::ranges::find(known, name_of(method));
    numbers.push_back(static_cast<std::size_t>(found - known.begin()));
    if (found == known.end()) known.push_back(name_of(method));
  }
  return numbers;
}

}  // namespace

const Palette& report_palette() {
  static const Palette palette = read_palette();
  return palette;
}

std::vector<std::size_t> color_places(const std::vector<std::string>& methods) {
  const std::size_t count = report_palette().light.size();
  const std::vector<std::size_t> numbers = numbers_of(methods);
  std::vector<std::size_t> order(methods.size()), places(methods.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return numbers[i]; });
  std::set<std::size_t> taken;
  for (const std::size_t i : order) {
    if (taken.size() == count) taken.clear();
    places[i] = numbers[i] % count;
    while (!taken.insert(places[i]).second) places[i] = (places[i] + 1) % count;
  }
  return places;
}

}  // namespace footprint
