// Writes parameters into materials. Tables mix linearly, because a sum of BRDFs is a BRDF.
#include "experiments/studies/brdf_edit.hpp"

#include <fmt/format.h>

#include <glm/glm.hpp>

#include "renderer/core/error.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint {
namespace {

void require(bool has, const Material& material, const std::string& parameter, const char* why) {
  if (has) return;
  throw Error(ErrorKind::usage, fmt::format("--set brdf.{}", parameter),
              fmt::format("material {} {}", material.name, why),
              "set a parameter that its base BRDF has (docs/explanation/base-brdf.md)");
}

bool takes(NormalDistribution distribution, const std::string& parameter) {
  switch (distribution) {
    case NormalDistribution::blinn_phong:
      return parameter == "exponent";
    case NormalDistribution::vmf:
      return parameter == "kappa";
    default:
      return parameter == "alpha";
  }
}

void set_width(const std::string& parameter, float value, Material& material) {
  require(material.lobes.empty(), material, parameter, "has lobes of its own");
  require(width_map(material) == nullptr && !material.lobe_parameter_map, material, parameter,
          "has its width from a map");
  if (parameter == "roughness") {
    material.roughness = value;
    material.lobe_parameter.reset();
    return;
  }
  require(takes(material.brdf.distribution, parameter), material, parameter, "has another distribution");
  material.lobe_parameter = value;
}

std::shared_ptr<const Microgeometry> with_table(const Microgeometry& patch, const MeasuredPair& tables, float share) {
  TabulatedBrdf mixed = tables.from;
  for (std::size_t i = 0; i < mixed.values.size(); ++i)
    mixed.values[i] = glm::mix(tables.from.values[i], tables.to.values[i], share);
  Microgeometry changed = patch;
  changed.brdf = std::make_shared<const TabulatedBrdf>(std::move(mixed));
  return std::make_shared<const Microgeometry>(std::move(changed));
}

void set(const std::string& parameter, float value, const MeasuredPair* tables, Material& material) {
  if (parameter == measured_parameter) {
    require(material.microgeometry != nullptr, material, parameter, "has no small-scale geometry");
    material.microgeometry = with_table(*material.microgeometry, *tables, value);
  } else if (parameter == "specular") {
    material.dielectric_specular = glm::vec3(value);
  } else if (parameter == "metallic") {
    require(metallic_map(material) == nullptr, material, parameter, "has its metalness from a map");
    material.metallic = value;
  } else {
    set_width(parameter, value, material);
  }
}

}  // namespace

const std::vector<OptionSpec>& brdf_parameters() {
  static const std::vector<OptionSpec> parameters{
      number_option("roughness", 0.5, 0.0, 1.0, "perceptual roughness; alpha is its square"),
      number_option("exponent", 64.0, 1e-3, 1e6, "exponent of blinn_phong"),
      number_option("alpha", 0.25, smallest_alpha, 1.0, "alpha of beckmann and ggx"),
      number_option("kappa", 64.0, 1e-3, 1e6, "concentration of vmf"),
      number_option("specular", 0.04, 0.0, 1.0, "reflectance of dielectrics at normal incidence, all channels"),
      number_option("metallic", 0.0, 0.0, 1.0, "metalness"),
      number_option(measured_parameter, 0.0, 0.0, 1.0, "share of the second of two MERL files")};
  return parameters;
}

void set_brdf(const std::map<std::string, std::string>& values, const MeasuredPair* tables, Scene& scene) {
  for (Material& material : scene.materials) {
    for (const auto& [parameter, value] : values) set(parameter, std::stof(value), tables, material);
  }
}

}  // namespace footprint
