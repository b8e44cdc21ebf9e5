// footprint_ndf_rank MAP...: how well any R functions of the half vector can represent the distributions of normals of
// a map's texels, beside a method's own error in the same norm (docs/results/ndf-rank.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "experiments/studies/ndf_inspection.hpp"
#include "experiments/studies/picture_files.hpp"
#include "methods/ndf_atlas/atlas.hpp"
#include "methods/registry.hpp"
#include "renderer/bake/baked_method.hpp"
#include "renderer/core/error.hpp"
#include "renderer/ndf/method_ndf.hpp"
#include "renderer/ndf/reference_ndf.hpp"
#include "scripts/studies/linear_bases.hpp"

namespace footprint {
namespace {

constexpr int rounds = 60;         // of the non-negative functions
constexpr std::uint64_t seed = 1;  // of texels and non-negative functions
constexpr double step = 0.73;      // of directions, in deviations of the lobe's peak, as in ndf_atlas
constexpr double smallest = 1e-9;  // error that a geometric mean counts

struct Request {
  std::vector<std::string> maps;
  std::vector<std::string> lobes{"ggx:0.1", "ggx:0.2", "ggx:0.4"};
  std::vector<int> levels{2, 3, 4};
  std::vector<int> terms{8, 16, 32};
  std::string methods = "ndf_atlas:nodes=128";
  int middle = 256;
  int texels = 512;
};

// The middle of a normal map.
Material cut(Material material, int edge) {
  const Image whole = material.normal_map->image.decoded();
  const int width = std::min(edge, whole.width), height = std::min(edge, whole.height);
  auto part = std::make_shared<Image>(width, height, whole.channels);
  paste(whole, -(whole.width - width) / 2, -(whole.height - height) / 2, *part);
  material.normal_map->image = part;
  return material;
}

// Directions above the surface, of equal solid angles, about all normals and what their lobes reach.
std::vector<glm::vec3> directions_of(const Material& material) {
  const ndf_atlas::Lattice lattice = ndf_atlas::lattice_over(*ndf_atlas::collect_facets(material, false), step);
  std::vector<glm::vec3> directions;
  for (int j = 0; j < lattice.nodes.y; ++j) {
    for (int i = 0; i < lattice.nodes.x; ++i) {
      const glm::dvec3 direction = ndf_atlas::direction_over(lattice.point(i, j));
      if (direction.z > 0.0) directions.emplace_back(direction);
    }
  }
  return directions;
}

// Texels of a level: all of them, or `most` that a seed draws.
std::vector<FootprintRect> texels_of(const Material& material, int level, int most) {
  const int width = material.normal_map->image.width() >> level, height = material.normal_map->image.height() >> level;
  std::vector<int> numbers(static_cast<std::size_t>(std::max(width, 0)) *
                           static_cast<std::size_t>(std::max(height, 0)));
  std::iota(numbers.begin(), numbers.end(), 0);
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i + 1 < numbers.size(); ++i)
    std::swap(numbers[i], numbers[i + random() % (numbers.size() - i)]);
  numbers.resize(std::min(numbers.size(), static_cast<std::size_t>(most)));
  std::vector<FootprintRect> rects;
  const glm::dvec2 edge = 1.0 / glm::dvec2(width, height);
  for (const int number : numbers) {
    const glm::dvec2 lower = edge * glm::dvec2(number % width, number / width);
    rects.push_back({lower, lower + edge});
  }
  return rects;
}

// The exact densities of texels, one row each, over their norms.
struct Rows {
  Eigen::MatrixXd unit;
  std::vector<double> norms;
};

Rows rows_of(const Material& material, const std::vector<FootprintRect>& rects,
             const std::vector<glm::vec3>& directions) {
  Rows out{Eigen::MatrixXd(static_cast<Eigen::Index>(rects.size()), static_cast<Eigen::Index>(directions.size())), {}};
  for (std::size_t i = 0; i < rects.size(); ++i) {
    const ReferenceNdf exact(material.brdf.distribution, texels_under(material, rects[i]).facets);
    const std::vector<double> row = exact.densities(directions, no_progress);
    const Eigen::Map<const Eigen::RowVectorXd> values(row.data(), static_cast<Eigen::Index>(row.size()));
    out.norms.push_back(values.norm());
    out.unit.row(static_cast<Eigen::Index>(i)) = values / values.norm();
  }
  return out;
}

// The relative errors of texels: root mean square, and median.
struct Errors {
  double rms = 0.0, median = 0.0;
};

Errors errors_of(std::vector<double> each) {
  double squares = 0.0;
  for (const double error : each) squares += error * error;
  const auto middle = each.begin() + static_cast<std::ptrdiff_t>(each.size() / 2);
  std::ranges::nth_element(each, middle);
  return {std::sqrt(squares / static_cast<double>(each.size())), *middle};
}

Errors errors_of(const auto& vector) { return errors_of(std::vector<double>(vector.begin(), vector.end())); }

// The errors of a method over one material at texels of all levels.
class MethodRows {
 public:
  MethodRows(const gl::Context& context, const Material& material, const MethodSpec& spec)
      : scene_(scene_of_facets(material)),
        gpu_(context.info(), scene_, effects()),
        baked_(bake(find_method(spec), spec, scene_, effects(), no_progress)),
        ndf_(context.info(), gpu_, baked_, scene_.materials.front(), {.kind = FootprintFilterKind::trilinear}) {}

  [[nodiscard]] Errors errors(const std::vector<FootprintRect>& rects, const Rows& rows,
                              const std::vector<glm::vec3>& directions) const {
    std::vector<double> each;
    for (std::size_t i = 0; i < rects.size(); ++i) {
      const std::vector<float> own = ndf_.densities(rects[i], directions);
      const Eigen::Map<const Eigen::RowVectorXf> values(own.data(), static_cast<Eigen::Index>(own.size()));
      each.push_back((values.cast<double>() / rows.norms[i] - rows.unit.row(static_cast<Eigen::Index>(i))).norm());
    }
    return errors_of(std::move(each));
  }

 private:
  static EffectSet effects() { return EffectSet().set(static_cast<std::size_t>(Effect::normal_variation)); }

  Scene scene_;
  GpuScene gpu_;
  BakedMethod baked_;
  MethodNdf ndf_;
};

// At each level, for each number of terms the best functions and non-negative ones, then each method.
std::vector<std::vector<Errors>> errors_by_level(const gl::Context& context, const Request& request,
                                                 const Material& material) {
  const std::vector<glm::vec3> directions = directions_of(material);
  std::vector<std::unique_ptr<MethodRows>> methods;
  for (const MethodSpec& spec : parse_methods(request.methods))
    methods.push_back(std::make_unique<MethodRows>(context, material, spec));
  std::vector<std::vector<Errors>> levels;
  for (const int level : request.levels) {
    const std::vector<FootprintRect> rects = texels_of(material, level, request.texels);
    if (rects.empty())
      throw Error(ErrorKind::usage, material.name, fmt::format("it has no level {}", level), "give a larger --middle");
    const Rows rows = rows_of(material, rects, directions);
    const BestBases best(rows.unit);
    const Eigen::MatrixXf single = rows.unit.cast<float>();
    std::vector<Errors>& errors = levels.emplace_back();
    for (const int terms : request.terms) {
      errors.push_back(errors_of(best.distances(terms)));
      errors.push_back(errors_of(nonnegative_distances(single, terms, rounds, seed)));
    }
    for (const auto& method : methods) errors.push_back(method->errors(rects, rows, directions));
  }
  return levels;
}

std::string head_of(const Request& request) {
  std::vector<std::string> titles{"| lobe | level"};
  for (const int terms : request.terms) titles.push_back(fmt::format("R = {} | not negative", terms));
  for (const MethodSpec& spec : parse_methods(request.methods)) titles.push_back(fmt::format("`{}`", spec.text));
  const std::string head = fmt::format("{} |", fmt::join(titles, " | "));
  const std::vector<std::string> rule(static_cast<std::size_t>(std::ranges::count(head, '|')) - 2, "---:|");
  return fmt::format("{}\n|---|{}", head, fmt::join(rule, ""));
}

// Geometric mean over maps.
double mean_of(const std::vector<std::vector<Errors>>& maps, std::size_t column, double Errors::*part) {
  double sum = 0.0;
  for (const std::vector<Errors>& map : maps) sum += std::log(std::max(map[column].*part, smallest));
  return std::exp(sum / static_cast<double>(maps.size()));
}

std::string table_of(const Request& request) {
  const gl::Context context({});
  std::string table = head_of(request);
  for (const std::string& lobe : request.lobes) {
    std::vector<std::vector<std::vector<Errors>>> levels(request.levels.size());  // by map and column
    for (const std::string& map : request.maps) {
      const NdfSource source = load_ndf_source({.path = map}, "", {});
      const auto errors = errors_by_level(context, request,
                                          cut(with_lobe(source.material, parse_lobe("--lobes", lobe)), request.middle));
      for (std::size_t i = 0; i < levels.size(); ++i) levels[i].push_back(errors[i]);
    }
    for (std::size_t i = 0; i < levels.size(); ++i) {
      table += fmt::format("\n| `{}` | {} |", lobe, request.levels[i]);
      for (std::size_t column = 0; column < levels[i].front().size(); ++column)
        table += fmt::format(" {:.3g}; {:.3g} |", mean_of(levels[i], column, &Errors::rms),
                             mean_of(levels[i], column, &Errors::median));
    }
  }
  return table;
}

int run(int count, char** arguments) {
  Request request;
  CLI::App app(
      "The error that R functions of the half vector leave of the distributions of normals of a map's texels: "
      "the best functions, non-negative ones (an upper bound), and methods. Relative L2 over solid angle: root "
      "mean square over texels; median. Geometric means over maps.",
      "footprint_ndf_rank");
  app.add_option("maps", request.maps, "Normal maps, as `footprint ndf` takes them")->type_name("MAP")->required();
  app.add_option("--lobes", request.lobes, "Base lobes, as `footprint ndf` takes them")->delimiter(',');
  app.add_option("--levels", request.levels, "Mip levels")->delimiter(',')->check(CLI::Range(0, 14));
  app.add_option("--terms", request.terms, "Numbers R of functions")->delimiter(',')->check(CLI::Range(1, 1024));
  app.add_option("--methods", request.methods, "Methods beside them")->capture_default_str();
  app.add_option("--middle", request.middle, "The edge of the part of the map, in its middle, in texels")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  app.add_option("--texels", request.texels, "Texels of a level at most, drawn by a fixed seed")
      ->check(CLI::Range(2, 4096))
      ->capture_default_str();
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ErrorKind::usage);
  }
  fmt::print("{}\n", table_of(request));
  return 0;
}

}  // namespace
}  // namespace footprint

int main(int count, char** arguments) {
  try {
    return footprint::run(count, arguments);
  } catch (const footprint::Error& error) {
    fmt::print(stderr, "footprint_ndf_rank: {}\n", error.what());
    return static_cast<int>(error.kind());
  }
}
