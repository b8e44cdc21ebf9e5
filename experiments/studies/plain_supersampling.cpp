// Points of the reference's kind of sequence, and sums in double.
#include "experiments/studies/plain_supersampling.hpp"

#include "renderer/pipeline/sample_sequence.hpp"

namespace footprint {

std::vector<glm::dvec2> frame_offsets(int count, std::uint64_t seed) {
  const std::uint32_t folded = static_cast<std::uint32_t>(seed) ^ static_cast<std::uint32_t>(seed >> 32U);
  const auto in_pixel = [&](std::uint32_t digits, std::uint32_t dimension) {
    return double{unit_interval(scrambled(digits, combined_seed(folded, dimension)))} - 0.5;
  };
  std::vector<glm::dvec2> offsets;
  for (int i = 0; i < count; ++i) {
    const SampleDigits digits = sample_digits(SamplePair::pixel, static_cast<std::uint32_t>(i));
    offsets.emplace_back(in_pixel(digits.x, 0), in_pixel(digits.y, 1));
  }
  return offsets;
}

FrameMean::FrameMean(const glm::ivec2& size)
    : size_(size), sums_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4, 0.0) {}

void FrameMean::add(const Image& frame) {
  for (std::size_t t = 0; t < sums_.size(); ++t) sums_[t] += frame.texels[t];  // 0 where a pixel is not covered
  ++count_;
}

Image FrameMean::mean() const {
  Image mean(size_.x, size_.y, 4);
  for (std::size_t t = 0; t < sums_.size(); t += 4) {
    const double covered = sums_[t + 3];
    for (std::size_t c = t; c < t + 3; ++c) mean.texels[c] = static_cast<float>(covered > 0 ? sums_[c] / covered : 0.0);
    mean.texels[t + 3] = static_cast<float>(covered / count_);
  }
  return mean;
}

}  // namespace footprint
