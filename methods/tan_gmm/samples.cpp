// Gathers the points of a texel by shares of whole texels, merges repeats, and pools them.
#include "methods/tan_gmm/samples.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace footprint::tan_gmm {
namespace {

constexpr int cells_across = 256;
constexpr double cell_size = 2.0 / cells_across;

int cell_of(float coordinate) {
  return std::clamp(static_cast<int>((static_cast<double>(coordinate) + 1.0) / cell_size), 0, cells_across - 1);
}

double centre_of(int cell) { return (cell + 0.5) * cell_size - 1.0; }

// The part of `fine` texels that texel i of `coarse` ones covers, in 1 / coarse of a fine texel: borders are integers.
struct Span {
  std::int64_t begin, end, coarse;

  Span(int fine_size, int coarse_size, int i)
      : begin(static_cast<std::int64_t>(i) * fine_size),
        end(static_cast<std::int64_t>(i + 1) * fine_size),
        coarse(coarse_size) {}
  [[nodiscard]] int first() const { return static_cast<int>(begin / coarse); }
  [[nodiscard]] int past() const { return static_cast<int>((end + coarse - 1) / coarse); }
  [[nodiscard]] double share(int fine) const {
    const std::int64_t overlap = std::min(end, (fine + 1) * coarse) - std::max(begin, fine * coarse);
    return static_cast<double>(overlap) / static_cast<double>(coarse);
  }
};

// Keeps the order.
void remove_weightless(Samples& samples) {
  if (std::ranges::find(samples.weight, 0.0F) == samples.weight.end()) return;
  std::size_t count = 0;
  for (std::size_t j = 0; j < samples.size(); ++j) {
    if (samples.weight[j] <= 0.0F) continue;
    for (std::vector<float>* column : {&samples.x, &samples.y, &samples.spread, &samples.weight})
      (*column)[count] = (*column)[j];
    ++count;
  }
  samples.resize(count);
}

}  // namespace

double Samples::total_weight() const { return std::accumulate(weight.begin(), weight.end(), 0.0); }

void Samples::add(float x_, float y_, float spread_, float weight_) {
  x.push_back(x_);
  y.push_back(y_);
  spread.push_back(spread_);
  weight.push_back(weight_);
}

void Samples::append(const Samples& others) {
  x.insert(x.end(), others.x.begin(), others.x.end());
  y.insert(y.end(), others.y.begin(), others.y.end());
  spread.insert(spread.end(), others.spread.begin(), others.spread.end());
  weight.insert(weight.end(), others.weight.begin(), others.weight.end());
}

void Samples::clear() { resize(0); }

void Samples::resize(std::size_t size) {
  for (std::vector<float>* column : {&x, &y, &spread, &weight}) column->resize(size);
}

NormalField::NormalField(const Image& normals)
    : width_(normals.width),
      height_(normals.height),
      x_(normals.texel_count()),
      y_(normals.texel_count()),
      weight_(normals.texel_count()) {
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const float* const n = &normals.texels[4 * i];
    const float across = std::hypot(n[0], n[1]);
    const float length = n[2] > 0.0F ? std::hypot(across, n[2]) : across;  // below the surface: to the rim
    const bool valid = n[3] > 0.0F && std::isfinite(std::hypot(across, n[2])) && length >= 1e-3F;
    x_[i] = valid ? n[0] / length : 0.0F;
    y_[i] = valid ? n[1] / length : 0.0F;
    weight_[i] = valid ? n[3] : 0.0F;
  }
}

void NormalField::gather(int level_width, int level_height, int column, int row, Samples& out) const {
  const Span across(width_, level_width, column);
  const Span down(height_, level_height, row);
  const int first = across.first();
  const auto columns = static_cast<std::size_t>(across.past() - first);
  const auto share_first = static_cast<float>(across.share(first));
  const auto share_last = static_cast<float>(across.share(across.past() - 1));
  out.resize(columns * static_cast<std::size_t>(down.past() - down.first()));
  std::ranges::fill(out.spread, 0.0F);
  std::size_t to = 0;
  for (int j = down.first(); j < down.past(); ++j, to += columns) {
    const std::size_t from = static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + first;
    const auto share = static_cast<float>(down.share(j));
    for (std::size_t i = 0; i < columns; ++i) {
      out.x[to + i] = x_[from + i];
      out.y[to + i] = y_[from + i];
      out.weight[to + i] = share * weight_[from + i];
    }
    out.weight[to] *= share_first;
    if (columns > 1) out.weight[to + columns - 1] *= share_last;
  }
  remove_weightless(out);
}

double NormalField::coverage(int level_width, int level_height, const Samples& samples) const {
  const double area = static_cast<double>(width_) / level_width * height_ / level_height;
  return std::min(samples.total_weight() / area, 1.0);
}

void merge_repeats(Samples& samples) {
  std::size_t last = 0;
  for (std::size_t j = 1; j < samples.size(); ++j) {
    if (samples.x[j] == samples.x[last] && samples.y[j] == samples.y[last] &&
        samples.spread[j] == samples.spread[last]) {
      samples.weight[last] += samples.weight[j];
      continue;
    }
    ++last;
    for (std::vector<float>* column : {&samples.x, &samples.y, &samples.spread, &samples.weight})
      (*column)[last] = (*column)[j];
  }
  samples.resize(std::min(last + 1, samples.size()));
}

CellPool::CellPool() : cells_(static_cast<std::size_t>(cells_across) * cells_across) {}

void CellPool::pool(Samples& samples) {
  if (samples.size() < fewest) return;
  touched_.clear();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const int column = cell_of(samples.x[i]);
    const int row = cell_of(samples.y[i]);
    const auto index = static_cast<std::uint32_t>(row * cells_across + column);
    Cell& cell = cells_[index];
    if (cell.weight == 0.0) touched_.push_back(index);
    const double dx = samples.x[i] - centre_of(column);
    const double dy = samples.y[i] - centre_of(row);
    cell.weight += samples.weight[i];
    cell.x += samples.weight[i] * dx;
    cell.y += samples.weight[i] * dy;
    cell.square += samples.weight[i] * (dx * dx + dy * dy + samples.spread[i]);
  }
  samples.clear();
  for (const std::uint32_t index : touched_) {
    Cell& cell = cells_[index];
    const double x = cell.x / cell.weight;
    const double y = cell.y / cell.weight;
    const double spread = std::max(cell.square / cell.weight - x * x - y * y, 0.0);
    samples.add(static_cast<float>(x + centre_of(static_cast<int>(index % cells_across))),
                static_cast<float>(y + centre_of(static_cast<int>(index / cells_across))), static_cast<float>(spread),
                static_cast<float>(cell.weight));
    cell = {};
  }
}

PooledTiles::PooledTiles(const NormalField& normals)
    : normals_(&normals), across_(normals.width() / side), down_(normals.height() / side) {
  if (!fit(across_, down_)) return;
  tiles_.resize(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_));
  tbb::enumerable_thread_specific<std::pair<CellPool, Samples>> workspaces;
  tbb::parallel_for(0, across_ * down_, [&](int i) {
    auto& [cells, samples] = workspaces.local();
    normals_->gather(across_, down_, i % across_, i / across_, samples);
    cells.pool(samples);
    tiles_[static_cast<std::size_t>(i)] = samples;
  });
}

bool PooledTiles::fit(int level_width, int level_height) const {
  return level_width > 0 && level_height > 0 && normals_->width() % (level_width * side) == 0 &&
         normals_->height() % (level_height * side) == 0;
}

void PooledTiles::gather(int level_width, int level_height, int column, int row, Samples& out) const {
  if (!fit(level_width, level_height)) return normals_->gather(level_width, level_height, column, row, out);
  out.clear();
  const int columns = across_ / level_width;
  const int rows = down_ / level_height;
  for (int j = row * rows; j < (row + 1) * rows; ++j) {
    for (int i = column * columns; i < (column + 1) * columns; ++i) {
      out.append(tiles_[static_cast<std::size_t>(j) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(i)]);
    }
  }
}

}  // namespace footprint::tan_gmm
