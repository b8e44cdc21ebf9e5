// Finds methods' figures by their names, and measures those that an experiment asks for.
#include "experiments/runner/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "methods/registry.hpp"
#include "renderer/bake/baked_method.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/suggest.hpp"

namespace footprint {

namespace {

const Material& material_of(const NamedQuantity& named, const Scene& scene) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) {
    if (named.material.empty() || material.name == named.material) return material;
    names.push_back(material.name);
  }
  throw Error(ErrorKind::usage, scene.source, fmt::format("has no material `{:.80}`", named.material),
              suggestion(named.material, names));
}

}  // namespace

const Quantity* find_quantity(const Method& method, const std::string& name) {
  const auto all = quantities_of(method);
  const auto found = std::ranges::find(all, name, &Quantity::name);
  return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> quantity_names(std::span<const MethodSpec> methods) {
  std::vector<std::string> names;
  for (const MethodSpec& method : methods) {
    for (const Quantity& quantity : quantities_of(find_method(method.name))) {
      if (std::ranges::find(names, quantity.name) == names.end()) names.push_back(quantity.name);
    }
  }
  return names;
}

std::vector<QuantityFigure> measure_quantities(const Experiment& experiment, const Scene& scene,
                                               const Progress& progress) {
  std::vector<QuantityFigure> figures;
  if (experiment.quantities.empty()) return figures;
  ProgressParts parts(progress, static_cast<double>(experiment.quantities.size() * experiment.run.methods.size()));
  for (const NamedQuantity& named : experiment.quantities) {
    for (const MethodSpec& spec : experiment.run.methods) {
      parts.next(1, "")(fmt::format("{} of {}", named.name, spec.text), 0.0);
      const Method& method = find_method(spec.name);
      const Quantity* const quantity = find_quantity(method, named.quantity);
      if (quantity == nullptr) continue;
      try {
        const Options options = options_of(method, spec);
        const Options parameters(quantity->parameters, named.parameters, "figure " + named.quantity);
        const double value = quantity->measure(material_of(named, scene), options, parameters);
        figures.push_back({.name = named.name, .method = spec.text, .quantity = named.quantity, .value = value});
      } catch (const Error& error) {
        throw error.within(fmt::format("[[quantity]] {} of {}", named.name, spec.text));
      }
    }
  }
  return figures;
}

}  // namespace footprint
