// Pools the normals under every texel of every level from the level below, and stores what a fit makes of them.
#include "methods/fournier/peak_chain.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/fournier/peaks.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint::fournier {
namespace {

constexpr int channels = 4;
constexpr float shortest_normal = 1e-3F;
constexpr std::size_t texels_per_report = 256;
constexpr double without_fit = 0.01;  // of the time of a fit: a texel whose normals are its peaks

void store(const Layer& layer, std::span<float> texel) { std::ranges::copy(layer, texel.begin()); }

Peak stored(std::span<const float> texel) {
  const double deviation = texel[2];
  return {texel[3], direction_from_disc({texel[0], texel[1]}), deviation * deviation};
}

class ChainBuilder {
 public:
  ChainBuilder(const Image& normals, const ChainSettings& settings, const FitTexel& fit, const Progress& progress)
      : settings_(&settings), fit_(&fit), progress_(&progress) {
    chain_.rest.resize(std::max<std::size_t>(settings.layers, 2) - 1);
    add_finest_level(normals);
  }

  PeakChain build() {
    while (chain_.first.back().texel_count() > 1) add_level();
    if (chain_.first.size() == 1)
      for (std::vector<Image>& layer : chain_.rest) layer.emplace_back(1, 1, channels);
    if (fitted_area_ > 0.0) chain_.statistics.mean_error = error_by_area_ / fitted_area_;
    return std::move(chain_);
  }

 private:
  void add_finest_level(const Image& normals) {
    Image& level = chain_.first.emplace_back(normals.width, normals.height, channels);
    for (std::size_t i = 0; i < level.texels.size(); i += channels) {
      const Eigen::Vector3d normal = Eigen::Map<const Eigen::Vector3f>(&normals.texels[i]).cast<double>();
      const bool is_valid = normals.texels[i + 3] > 0.0F && normal.norm() >= shortest_normal;
      if (!is_valid) continue;
      const double spread = settings_->groups.empty() ? 0.0 : settings_->group_spreads[group_of(i / channels)];
      store(layer_of({1.0, normal.normalized(), spread}), std::span(level.texels).subspan(i, channels));
    }
    const auto levels = static_cast<std::size_t>(mip_level_count(normals.width, normals.height));
    for (std::size_t i = 1; i < levels; ++i) whole_work_ += work_of(i);
  }

  [[nodiscard]] std::uint32_t group_of(std::size_t texel) const {
    return settings_->groups.empty() ? 0 : settings_->groups[texel];
  }

  // The work of a level, in fits. A texel with no more normals than peaks needs no fit.
  [[nodiscard]] double work_of(std::size_t level) const {
    const Image& finest = chain_.first.front();
    const double texels = std::max(finest.width >> level, 1) * static_cast<double>(std::max(finest.height >> level, 1));
    const bool fits = static_cast<double>(finest.texel_count()) > static_cast<double>(settings_->peaks) * texels;
    return texels * (fits ? 1.0 : without_fit);
  }

  void add_level() {
    const Image& fine = chain_.first.back();
    Image coarse(std::max(fine.width / 2, 1), std::max(fine.height / 2, 1), channels);
    for (std::vector<Image>& layer : chain_.rest) layer.emplace_back(coarse.width, coarse.height, channels);
    std::vector<NormalBins> bins(coarse.texel_count());
    std::vector<TexelFit> outcomes(coarse.texel_count());
    const std::string what = fmt::format("fitting peaks of {}x{} texels", coarse.width, coarse.height);
    for (std::size_t begin = 0; begin < bins.size(); begin += texels_per_report) {
      const double part = static_cast<double>(begin) / static_cast<double>(bins.size());
      (*progress_)(what, (work_done_ + part * work_of(chain_.first.size())) / whole_work_);
      const std::size_t end = std::min(begin + texels_per_report, bins.size());
      tbb::parallel_for(begin, end, [&](std::size_t i) { outcomes[i] = make_texel(i, coarse, bins[i]); });
    }
    count_outcomes(outcomes);
    work_done_ += work_of(chain_.first.size());
    chain_.first.push_back(std::move(coarse));
    bins_ = std::move(bins);
  }

  TexelFit make_texel(std::size_t i, Image& coarse, NormalBins& bins) {
    const auto width = static_cast<std::size_t>(coarse.width);
    const int x = static_cast<int>(i % width);
    const int y = static_cast<int>(i / width);
    std::vector<Moments> children;
    gather(x, y, children, bins);
    unite_cells(bins);
    std::vector<Peak> target = target_of(bins, settings_->group_spreads);
    TexelFit fit;
    if (target.size() > settings_->peaks) {
      fit = (*fit_)({chain_.first.size(), i}, target, std::move(children));
    } else {
      std::ranges::stable_sort(target, std::greater{}, &Peak::weight);
      for (const Peak& peak : target) fit.layers.push_back(layer_of(peak));
    }
    for (std::size_t k = 0; k < fit.layers.size(); ++k)
      store(fit.layers[k], k == 0 ? coarse.at(x, y) : chain_.rest[k - 1].back().at(x, y));
    fit.layers = {};
    return fit;
  }

  // The peaks and bins of the finer level under texel (x, y), weighted by their area in it.
  void gather(int x, int y, std::vector<Moments>& children, NormalBins& bins) const {
    const Image& fine = chain_.first.back();
    const MipTaps across = mip_taps(fine.width, x);
    const MipTaps down = mip_taps(fine.height, y);
    for (int j = 0; j < down.count; ++j) {
      for (int i = 0; i < across.count; ++i) {
        const double share = across.weight[static_cast<std::size_t>(i)] * down.weight[static_cast<std::size_t>(j)];
        if (settings_->from_children) add_peaks(across.first + i, down.first + j, share, children);
        add_bins(across.first + i, down.first + j, share, bins);
      }
    }
  }

  void add_peaks(int x, int y, double share, std::vector<Moments>& children) const {
    const auto add = [&](std::span<const float> texel) {
      Moments scaled;
      scaled.add(moments_of(stored(texel)), share);
      children.push_back(scaled);
    };
    add(chain_.first.back().at(x, y));
    if (chain_.first.size() == 1) return;
    const std::size_t level = chain_.first.size() - 2;
    for (const std::vector<Image>& layer : chain_.rest) add(layer[level].at(x, y));
  }

  void add_bins(int x, int y, double share, NormalBins& bins) const {
    const Image& fine = chain_.first.back();
    const auto index = static_cast<std::size_t>(y) * static_cast<std::size_t>(fine.width) + static_cast<std::size_t>(x);
    if (bins_.empty()) {  // the finest level: one normal per texel
      const Peak peak = stored(fine.at(x, y));
      if (peak.weight > 0.0)
        bins.push_back({settings_->cells.cell_of(peak.axis), group_of(index), {share, share * peak.axis}});
      return;
    }
    for (const NormalBin& bin : bins_[index]) {
      NormalBin& added = bins.emplace_back();
      added.cell = bin.cell;
      added.group = bin.group;
      added.moments.add(bin.moments, share);
    }
  }

  void count_outcomes(const std::vector<TexelFit>& outcomes) {
    const double area = 1.0 / static_cast<double>(outcomes.size());
    for (const TexelFit& outcome : outcomes) {
      if (!outcome.fitted) continue;
      ++chain_.statistics.fits;
      chain_.statistics.not_converged += outcome.converged ? 0 : 1;
      fitted_area_ += area;
      error_by_area_ += area * outcome.error;
    }
  }

  const ChainSettings* settings_;
  const FitTexel* fit_;
  const Progress* progress_;
  double work_done_ = 0.0, whole_work_ = 0.0;  // in fits
  PeakChain chain_;
  std::vector<NormalBins> bins_;  // of the last finished level; empty for the finest
  double fitted_area_ = 0.0;
  double error_by_area_ = 0.0;
};

}  // namespace

Layer layer_of(const Peak& peak) {
  const Eigen::Vector2d on_disc = disc_from_direction(peak.axis);
  return {static_cast<float>(on_disc.x()), static_cast<float>(on_disc.y()), static_cast<float>(std::sqrt(peak.spread)),
          static_cast<float>(peak.weight)};
}

PeakChain fit_chain(const Image& normals, const ChainSettings& settings, const FitTexel& fit,
                    const Progress& progress) {
  return ChainBuilder(normals, settings, fit, progress).build();
}

void add_peaks(const std::string& method, PeakChain chain, const Material& material, Storage storage,
               const EffectSet& effects, Prefiltered& out) {
  if (chain.statistics.not_converged > 0) {
    out.notes.push_back(fmt::format(
        "{} of {} fits of peaks stopped before they converged; the mean error of all is {:.2g} of the distribution's "
        "norm",
        chain.statistics.not_converged, chain.statistics.fits, chain.statistics.mean_error));
  }
  const TextureCoordinates coordinates = normal_coordinates(material);
  std::vector<std::vector<Image>> first;  // an initializer list would copy the chain
  first.push_back(std::move(chain.first));
  out.textures.push_back(
      make_array_texture(method + "_first", std::move(first), storage, coordinates, TextureFilter::nearest));
  out.textures.push_back(
      make_array_texture(method + "_rest", std::move(chain.rest), storage, coordinates, TextureFilter::nearest));
  if (has(effects, Effect::diffuse))
    out.textures.push_back(make_texture(method + "_mean", mean_normal_chain(material), storage, coordinates));
}

PeakChain fit_peak_chain(const Image& normals, double base_variance, std::size_t count, FitRule rule,
                         const Progress& progress) {
  const auto fit = [&](const TexelPlace&, const std::vector<Peak>& target, std::vector<Moments> children) {
    const std::vector<Peak> from = rule.start == Start::own ? clustered_peaks(target, count, std::sqrt(base_variance))
                                                            : merged_peaks(std::move(children), count);
    const Fit found = fit_peaks(target, from, base_variance, rule.evaluations);
    TexelFit out{.layers = {}, .fitted = true, .converged = found.converged, .error = found.error};
    for (const Peak& peak : found.peaks) out.layers.push_back(layer_of(peak));
    return out;
  };
  return fit_chain(
      normals, {.cells = NormalCells::of_lobe(base_variance), .peaks = count, .layers = count, .from_children = true},
      fit, progress);
}

}  // namespace footprint::fournier
