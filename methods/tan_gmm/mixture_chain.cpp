// Fits levels in parallel fronts of texels that have the result of scanline order.
#include "methods/tan_gmm/mixture_chain.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <utility>

#include "methods/tan_gmm/em.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint::tan_gmm {
namespace {

// The mixtures of one level, row by row.
struct Level {
  int width, height;
  std::size_t components;
  std::vector<Gaussian> gaussians = std::vector<Gaussian>(static_cast<std::size_t>(width * height) * components);

  [[nodiscard]] std::span<Gaussian> at(int x, int y) {
    return std::span(gaussians).subspan(static_cast<std::size_t>(y * width + x) * components, components);
  }
};

struct Workspace {
  Samples samples;
  CellPool cells;
};

// Fits the texels of one level, after the coarser one.
struct LevelFit {
  const NormalField& normals;
  const PooledTiles& tiles;
  const FitSettings& settings;
  Moment moment;
  Level* coarser;
  Level& level;
  std::span<Image> stored;
  tbb::enumerable_thread_specific<Workspace>& workspaces;

  // A texel needs its neighbours W, NW, N and NE, which have a smaller x + 2 y. Therefore texels of one sum run in
  // parallel, and every texel reads the same neighbours as in scanline order.
  void run(const std::function<void(double)>& report) const {
    const int fronts = level.width + 2 * (level.height - 1);
    for (int front = 0; front < fronts; ++front) {
      const int first = std::max(0, (front - level.width + 2) / 2), last = std::min(level.height - 1, front / 2);
      tbb::parallel_for(first, last + 1, [&](int y) { fit(front - 2 * y, y, workspaces.local()); });
      report((front + 1.0) / fronts);
    }
  }

  [[nodiscard]] std::span<const Gaussian> parent(int x, int y) const {
    if (coarser == nullptr || !settings.align) return {};
    return coarser->at(std::min(x / 2, coarser->width - 1), std::min(y / 2, coarser->height - 1));
  }

  [[nodiscard]] Prior prior(int x, int y) const {
    Prior prior(settings.prior_weight);
    if (!settings.align) return prior;
    constexpr std::array<std::pair<int, int>, 4> done{{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    for (const auto& [dx, dy] : done) {
      const bool inside = x + dx >= 0 && x + dx < level.width && y + dy >= 0;
      if (inside) prior.add(level.at(x + dx, y + dy));
    }
    prior.add(parent(x, y));
    return prior;
  }

  void fit(int x, int y, Workspace& workspace) const {
    Samples& samples = workspace.samples;
    tiles.gather(level.width, level.height, x, y, samples);
    const double coverage = normals.coverage(level.width, level.height, samples);
    merge_repeats(samples);
    workspace.cells.pool(samples);
    const std::span<Gaussian> mixture = level.at(x, y);
    const Prior known = prior(x, y);
    fit_texel(samples, known, parent(x, y), settings, mixture);
    if (settings.full_covariance) {
      fit_whole(samples, known, coverage, mixture, x, y);
      return;
    }
    for (std::size_t i = 0; i < mixture.size(); ++i) store(mixture[i], coverage, stored[i].at(x, y));
  }

  // Fits full covariances from the isotropic mixture, and replaces it by their round Gaussians for the neighbours.
  void fit_whole(const Samples& samples, const Prior& known, double coverage, std::span<Gaussian> mixture, int x,
                 int y) const {
    std::array<FullGaussian, most_components> storage{};
    const std::span<FullGaussian> full(storage.data(), mixture.size());
    fit_full(samples, known, settings, mixture, full);
    for (std::size_t i = 0; i < full.size(); ++i) {
      mixture[i] = rounded(full[i]);
      const FullGaussian& g = full[i];
      const double alpha = g.alpha * coverage;
      const std::array<double, 6> moments{1.0, g.x, g.y, g.xx + g.x * g.x, g.xy + g.x * g.y, g.yy + g.y * g.y};
      for (std::size_t c = 0; c < moments.size(); ++c) {
        const std::size_t channel = moments.size() * i + c;
        stored[channel / 4].at(x, y)[channel % 4] = static_cast<float>(alpha * moments[c]);
      }
    }
  }

  // In double precision, because the shader subtracts |mu|^2.
  void store(const Gaussian& g, double coverage, std::span<float> texel) const {
    const double alpha = g.alpha * coverage;
    const double square = static_cast<double>(g.x) * g.x + static_cast<double>(g.y) * g.y;
    const double variance = g.variance > variance_floor ? g.variance : 0.0;  // a single normal has the floor
    texel[0] = static_cast<float>(alpha);
    texel[1] = static_cast<float>(alpha * g.x);
    texel[2] = static_cast<float>(alpha * g.y);
    texel[3] = static_cast<float>(alpha * (square + (moment == Moment::corrected ? 2.0 : 1.0) * variance));
  }
};

}  // namespace

MixtureChain mixture_chain(const NormalField& normals, const FitSettings& settings, Moment moment,
                           const Progress& progress) {
  const int levels = mip_level_count(normals.width(), normals.height());
  MixtureChain chain(layers_of(settings), std::vector<Image>(static_cast<std::size_t>(levels)));
  const PooledTiles tiles(normals);
  tbb::enumerable_thread_specific<Workspace> workspaces;
  Level coarser{0, 0, settings.components};
  for (int index = levels - 1; index >= 0; --index) {
    const int width = std::max(normals.width() >> index, 1);
    const int height = std::max(normals.height() >> index, 1);
    Level level{width, height, settings.components};
    std::vector<Image> stored;  // constructed in place: copies took a tenth of an easy map's fit
    for (std::size_t i = 0; i < chain.size(); ++i) stored.emplace_back(width, height, 4);
    const LevelFit fit{normals, tiles,  settings,  moment, index == levels - 1 ? nullptr : &coarser,
                       level,   stored, workspaces};
    const std::string what = fmt::format("fitting mixtures, {} x {}", width, height);
    const int done = levels - 1 - index;  // each level takes about as long, because it visits every normal
    fit.run([&](double fraction) { progress(what, (done + fraction) / levels); });
    for (std::size_t i = 0; i < stored.size(); ++i) chain[i][static_cast<std::size_t>(index)] = std::move(stored[i]);
    coarser = std::move(level);
  }
  return chain;
}

}  // namespace footprint::tan_gmm
