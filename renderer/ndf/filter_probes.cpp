// The probes of each filter; sources are in docs/reference/filters.md.
#include "renderer/ndf/filter_probes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace footprint {
namespace {

using Kind = FootprintFilterKind;

double longer_edge(const TexelFootprint& f) { return std::max(glm::length(f.dx), glm::length(f.dy)); }

// The principal axes of the ellipse that the edges map the unit circle to.
struct Ellipse {
  double major = 1.0, minor = 1.0;  // radii, texels
  glm::dvec2 along{1.0, 0.0};       // unit
};

Ellipse ellipse_of(const TexelFootprint& f) {
  const double a = f.dx.x * f.dx.x + f.dy.x * f.dy.x;
  const double b = f.dx.x * f.dx.y + f.dy.x * f.dy.y;
  const double c = f.dx.y * f.dx.y + f.dy.y * f.dy.y;
  const double root = std::hypot(a - c, 2.0 * b);
  Ellipse out;
  out.major = std::sqrt(std::max(0.5 * (a + c + root), 1e-24));
  out.minor = std::abs(f.dx.x * f.dy.y - f.dx.y * f.dy.x) / out.major;  // the difference of the roots would cancel
  const double angle = 0.5 * std::atan2(2.0 * b, a - c);
  out.along = {std::cos(angle), std::sin(angle)};
  return out;
}

ProbeSet tiling(const TexelFootprint& f, int parts) {
  ProbeSet out{std::log2(longer_edge(f) / parts), {}};
  for (int i = 0; i < parts * parts; ++i) {
    const glm::dvec2 at = (glm::dvec2(i % parts, i / parts) + 0.5) / static_cast<double>(parts) - 0.5;
    out.probes.push_back({f.centre + f.dx * at.x + f.dy * at.y, 1.0 / (parts * parts)});
  }
  return out;
}

ProbeSet along_the_longer_edge(const TexelFootprint& f, int most) {
  const double x = glm::length(f.dx), y = glm::length(f.dy);
  const double major = std::max(x, y);
  const double ratio = 0.999 * major / std::max(std::min(x, y), 1e-12);  // ignores rounding differences
  const int count = static_cast<int>(std::ceil(std::min(ratio, static_cast<double>(most))));
  ProbeSet out{std::log2(major / count), {}};
  for (int i = 0; i < count; ++i) {
    out.probes.push_back({f.centre + (x > y ? f.dx : f.dy) * ((i + 1.0) / (count + 1.0) - 0.5), 1.0 / count});
  }
  return out;
}

ProbeSet along_the_ellipse(const TexelFootprint& f, int most) {
  const Ellipse ellipse = ellipse_of(f);
  double width = std::max(ellipse.minor, 1.0);
  const int count = std::clamp(static_cast<int>(std::ceil(2.0 * ellipse.major / width - 1.0)), 1, most);
  width = std::max(width, 2.0 * ellipse.major / (count + 1));
  const double reach = std::max(ellipse.major - width, 0.0);
  // The Gaussian's variance along the ellipse without that of a probe, major^2 / 4 - width^2 / 4.
  const double variance = 0.25 * (ellipse.major + width) * reach;
  ProbeSet out{std::log2(width), {}};
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const double x = count > 1 ? reach * (2.0 * i / (count - 1) - 1.0) : 0.0;
    const double weight = x == 0.0 ? 1.0 : std::exp(-0.5 * x * x / variance);
    out.probes.push_back({f.centre + ellipse.along * x, weight});
    sum += weight;
  }
  for (Probe& probe : out.probes) probe.weight /= sum;
  return out;
}

// The position of a point along an axis: two box functions of different widths convolved about 0.
// renderer/shaders/footprint_area.glsl has the derivation.
class Boxes {
 public:
  Boxes(double a, double b) : a_(std::max(a, narrowest)), b_(std::max(b, narrowest)) {}

  [[nodiscard]] double reach() const { return 0.5 * (a_ + b_); }
  [[nodiscard]] double below(double x) const {
    const double t = std::abs(x), rest = std::max(reach() - t, 0.0);
    const double beyond = t < 0.5 * std::abs(a_ - b_) ? 0.5 - t / std::max(a_, b_) : rest * rest / (2.0 * a_ * b_);
    return x < 0.0 ? beyond : 1.0 - beyond;
  }

  static constexpr double narrowest = 1.0 / 1024.0;

 private:
  double a_, b_;
};

// The share of a pair of texels about `middle`, and the second texel's part of it.
struct PairShare {
  double whole = 0.0, second = 0.5;
};

PairShare pair_share(const Boxes& boxes, double middle, bool first, bool last) {
  const double low = first ? 0.0 : boxes.below(middle - 1.0), high = last ? 1.0 : boxes.below(middle + 1.0);
  const double whole = std::max(high - low, 0.0);
  return {whole, whole > 1e-6 ? std::clamp((high - boxes.below(middle)) / whole, 0.0, 1.0) : 0.5};
}

constexpr double widest_hem = 0.35;
double hem_of(double extent) { return std::max(widest_hem * std::min(0.5 * extent, 1.0), 2.0 * Boxes::narrowest); }
int pairs_of(double extent) { return static_cast<int>(std::ceil(0.5 * (std::ceil(extent) + 1.0))); }

// A footprint in texels of a level, with the centre of the first texel at 0. Rows run across the axis along which the
// footprint is longer.
struct RowedFootprint {
  bool turned = false;
  glm::dvec2 centre{}, edge{}, other{};  // both edges upwards, `edge` over more rows

  RowedFootprint(const TexelFootprint& f, double level)
      : turned(std::abs(f.dx.x) + std::abs(f.dy.x) > std::abs(f.dx.y) + std::abs(f.dy.y)) {
    const auto of_rows = [&](const glm::dvec2& v) { return (turned ? glm::dvec2(v.y, v.x) : v) * std::exp2(-level); };
    const auto upwards = [](const glm::dvec2& v) { return v.y < 0.0 ? -v : v; };
    centre = of_rows(f.centre) - 0.5;
    edge = upwards(of_rows(f.dx));
    other = upwards(of_rows(f.dy));
    if (edge.y < other.y) std::swap(edge, other);
    edge.y = std::max(edge.y, Boxes::narrowest * std::exp2(-level));
  }

  [[nodiscard]] double lean() const { return edge.x / edge.y; }
  [[nodiscard]] double height() const { return edge.y + other.y; }
  [[nodiscard]] double across() const { return other.x - other.y * lean(); }
  [[nodiscard]] double widest() const {
    return std::abs(across()) * std::min(edge.y / std::max(other.y, 1e-12 * edge.y), 1.0);
  }
};

// The finest level at which 2N x 2N texels cover a footprint.
double area_level(const TexelFootprint& f, int lookups) {
  const RowedFootprint p(f, 0.0);
  constexpr double rim = 1.0 - 2.0 * widest_hem;
  const double high = p.height() + 1.0, wide = p.widest() + 1.0, slanted = rim + 2.0 * std::abs(p.lean());
  const double linear = high * slanted + wide * rim, missing = 4.0 * lookups * lookups - rim * slanted;
  const double s = 2.0 * missing / (linear + std::sqrt(linear * linear + 4.0 * high * wide * missing));
  return std::max(std::ceil(-std::log2(s)), 0.0);
}

// The lookups of two rows: `row` above the centre of the footprint and the next.
void add_strip(ProbeSet& out, const RowedFootprint& p, double row, const PairShare& rows) {
  const double smear = std::exp2(-out.level), reach = 0.5 * p.height();
  const double low = std::max(row - 0.5, -reach), high = std::min(row + 1.5, reach);
  const double halfway = std::clamp(0.5 * (low + high), -reach, reach);
  const double rise = std::max(p.other.y, 1e-6 * p.edge.y);
  const double from = std::max((halfway - 0.5 * p.edge.y) / rise, -0.5);
  const double to = std::min((halfway + 0.5 * p.edge.y) / rise, 0.5);
  const double middle = p.lean() * halfway + p.across() * 0.5 * (from + to);
  const Boxes section(std::abs(p.across()) * (to - from), std::hypot(p.lean() * std::max(high - low, 0.0), smear));
  const double hem = hem_of(p.widest());
  const double lean_over = p.lean() * std::min(p.height(), 2.0);
  const int pairs = pairs_of(p.widest() + std::hypot(lean_over, smear) - 2.0 * hem);
  double column = std::floor(p.centre.x + middle - section.reach() + hem + 0.5) - p.centre.x;
  for (int i = 0; i < pairs; ++i, column += 2.0) {
    const PairShare columns = pair_share(section, column + 0.5 - middle, i == 0, i == pairs - 1);
    const glm::dvec2 at = p.centre + glm::dvec2(column + columns.second, row + rows.second) + 0.5;
    out.probes.push_back({(p.turned ? glm::dvec2(at.y, at.x) : at) * std::exp2(out.level), rows.whole * columns.whole});
  }
}

ProbeSet texels_by_area(const TexelFootprint& f, int lookups) {
  ProbeSet out{area_level(f, lookups), {}};
  const RowedFootprint p(f, out.level);
  const Boxes boxes(p.edge.y, std::hypot(p.other.y, std::exp2(-out.level)));
  const double hem = hem_of(p.height());
  const int strips = pairs_of(2.0 * (boxes.reach() - hem));
  double row = std::floor(p.centre.y - boxes.reach() + hem + 0.5) - p.centre.y;
  for (int i = 0; i < strips; ++i, row += 2.0)
    add_strip(out, p, row, pair_share(boxes, row + 0.5, i == 0, i == strips - 1));
  return out;
}

}  // namespace

ProbeSet probes_of(const FootprintFilter& filter, const TexelFootprint& footprint) {
  switch (filter.kind) {
    case Kind::trilinear:
      return tiling(footprint, 1);
    case Kind::box:
    case Kind::shaded:
      return tiling(footprint, filter.count);
    case Kind::anisotropic:
    case Kind::hardware:
      return along_the_longer_edge(footprint, filter.count);
    case Kind::area:
      return texels_by_area(footprint, filter.count);
    case Kind::ewa:
      return along_the_ellipse(footprint, filter.count);
    case Kind::stochastic:
    case Kind::stochastic_gaussian:
    case Kind::stochastic_trilinear:
      require_one_lookup(filter, "the lookups of a footprint");
  }
  throw std::logic_error("not a footprint filter");
}

}  // namespace footprint
