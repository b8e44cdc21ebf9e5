// The E-step's sums over samples, with the vector instructions of the processor that runs it.
#pragma once

#include <array>
#include <cstddef>

#include "methods/tan_gmm/samples.hpp"

namespace footprint::tan_gmm {

constexpr int most_components = 8;

/// log(alpha g) = constant - factor |n - mu|^2 of each component, with its mean mu.
struct Terms {
  std::array<float, most_components> x{}, y{}, constant{}, factor{};
};

/// Sums over the samples of weight * responsibility, alone and times the distance from the component's mean: along each
/// axis, and squared with the sample's spread.
struct Sums {
  std::array<double, most_components> weight{}, dx{}, dy{}, square{};
  double log_likelihood = 0;
};

/// Over all samples, for the first `components` (2 to most_components) of `terms`. Responsibilities in 32 bits by
/// log-sum-exp, sums of 256 samples in 32 bits, then in 64. The last bits depend on the processor's vector
/// instructions, never on the number of threads.
[[nodiscard]] Sums sums_over(const Samples& samples, const Terms& terms, std::size_t components);

}  // namespace footprint::tan_gmm
