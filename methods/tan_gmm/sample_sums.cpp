// Sums blocks of samples, one vector at a time. Highway compiles HWY_NAMESPACE once for each set of vector
// instructions, by including this file again, and selects one at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/tan_gmm/sample_sums.cpp"
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)  // no arrays of their vectors
#include <hwy/foreach_target.h>
// These have to come first.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <algorithm>
#include <utility>

#include "methods/tan_gmm/samples.hpp"

HWY_BEFORE_NAMESPACE();
namespace footprint::tan_gmm::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
constexpr std::size_t most_lanes = 16;
using Lanes = hn::CappedTag<float, most_lanes>;
using Vector = hn::Vec<Lanes>;

// Responsibilities below e^-60 are negligible. Far below it products are subnormal and a hundred times as slow.
constexpr float least_exponent = -60.0F;

// A vector of samples; those past the end have weight 0.
struct Points {
  Vector x, y, spread, weight;
};

Points points_at(const Samples& samples, std::size_t begin, std::size_t end) {
  const Lanes lanes;
  const auto load = [&](const std::vector<float>& column) {
    if (begin + hn::Lanes(lanes) <= end) return hn::LoadU(lanes, &column[begin]);
    HWY_ALIGN std::array<float, most_lanes> padded{};
    std::copy(&column[begin], column.data() + end, padded.begin());
    return hn::Load(lanes, padded.data());
  };
  return {load(samples.x), load(samples.y), load(samples.spread), load(samples.weight)};
}

template <std::size_t components>
class BlockSums {
 public:
  explicit BlockSums(const Terms& terms) : terms_(&terms), log_likelihood_(hn::Zero(Lanes())) {
    for (std::size_t i = 0; i < components; ++i) weight_[i] = dx_[i] = dy_[i] = square_[i] = hn::Zero(Lanes());
  }

  void add(const Points& p) {
    const Lanes lanes;
    Vectors square;
    Vectors share;
    Vector peak = hn::Set(lanes, std::numeric_limits<float>::lowest());
    for (std::size_t i = 0; i < components; ++i) {
      const Vector dx = hn::Sub(p.x, hn::Set(lanes, terms_->x[i]));
      const Vector dy = hn::Sub(p.y, hn::Set(lanes, terms_->y[i]));
      square[i] = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, p.spread));
      share[i] = hn::NegMulAdd(hn::Set(lanes, terms_->factor[i]), square[i], hn::Set(lanes, terms_->constant[i]));
      peak = hn::Max(peak, share[i]);
    }
    Vector total = hn::Zero(lanes);
    for (std::size_t i = 0; i < components; ++i) {
      share[i] = hn::Exp(lanes, hn::Max(hn::Sub(share[i], peak), hn::Set(lanes, least_exponent)));
      total = hn::Add(total, share[i]);
    }
    log_likelihood_ = hn::MulAdd(p.weight, hn::Add(peak, hn::Log(lanes, total)), log_likelihood_);
    const Vector scale = hn::Div(p.weight, total);
    for (std::size_t i = 0; i < components; ++i) {
      const Vector z = hn::Mul(share[i], scale);
      weight_[i] = hn::Add(weight_[i], z);
      dx_[i] = hn::MulAdd(z, hn::Sub(p.x, hn::Set(lanes, terms_->x[i])), dx_[i]);
      dy_[i] = hn::MulAdd(z, hn::Sub(p.y, hn::Set(lanes, terms_->y[i])), dy_[i]);
      square_[i] = hn::MulAdd(z, square[i], square_[i]);
    }
  }

  void add_to(Sums& sums) const {
    for (std::size_t i = 0; i < components; ++i) {
      sums.weight[i] += over_lanes(weight_[i]);
      sums.dx[i] += over_lanes(dx_[i]);
      sums.dy[i] += over_lanes(dy_[i]);
      sums.square[i] += over_lanes(square_[i]);
    }
    sums.log_likelihood += over_lanes(log_likelihood_);
  }

 private:
  using Vectors = std::array<Vector, components>;

  static double over_lanes(const Vector& v) { return static_cast<double>(hn::GetLane(hn::SumOfLanes(Lanes(), v))); }

  const Terms* terms_;
  Vectors weight_, dx_, dy_, square_;
  Vector log_likelihood_;
};

template <std::size_t components>
void sum(const Samples& samples, const Terms& terms, Sums& sums) {
  constexpr std::size_t block_size = 256;
  for (std::size_t begin = 0; begin < samples.size(); begin += block_size) {
    const std::size_t end = std::min(begin + block_size, samples.size());
    BlockSums<components> block(terms);
    for (std::size_t at = begin; at < end; at += hn::Lanes(Lanes())) block.add(points_at(samples, at, end));
    block.add_to(sums);
  }
}

}  // namespace

void sum_for_target(const Samples& samples, const Terms& terms, std::size_t components, Sums& sums) {
  const auto call = [&]<std::size_t... count>(std::index_sequence<count...>) {
    ((components == count + 2 ? sum<count + 2>(samples, terms, sums) : void()), ...);
  };
  call(std::make_index_sequence<most_components - 1>());
}

}  // namespace footprint::tan_gmm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footprint::tan_gmm {

HWY_EXPORT(sum_for_target);

Sums sums_over(const Samples& samples, const Terms& terms, std::size_t components) {
  Sums sums;
  HWY_DYNAMIC_DISPATCH(sum_for_target)(samples, terms, components, sums);
  return sums;
}

}  // namespace footprint::tan_gmm
#endif
