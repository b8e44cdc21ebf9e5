// The filters of a pixel's footprint and their text form: `anisotropic:8`, `shaded:2`, `stochastic:1:2`.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace footprint {

/// The kinds of filters; docs/reference/filters.md has their kernels.
enum class FootprintFilterKind {
  trilinear,    ///< one lookup at the level of the footprint's longer edge
  anisotropic,  ///< up to N lookups along that edge, by the formulas of EXT_texture_filter_anisotropic
  box,          ///< N x N lookups that tile the footprint
  area,         ///< about N x N bilinear lookups that weight the texels of one level by their share of the footprint
  ewa,          ///< up to N weighted lookups along the ellipse's longer axis (Heckbert 1989, McCormack et al. 1999)
  shaded,       ///< N x N parts that are filtered and shaded separately, then averaged
  hardware,     ///< the sampler's own anisotropic filter with up to N probes
  stochastic,   ///< N texels drawn from the pixel's parallelogram, shaded each and averaged
  stochastic_gaussian,   ///< N texels drawn from the Gaussian of `ewa`
  stochastic_trilinear,  ///< N texels drawn with the weights of `trilinear`
};

/// The depth of a stochastic filter that draws texels of the finest level: pure filtering after shading.
inline constexpr int finest_depth = -1;

/// A filter with its number of probes, parts or draws, per axis if they tile the footprint.
struct FootprintFilter {
  FootprintFilterKind kind = FootprintFilterKind::trilinear;
  int count = 1;
  int depth = finest_depth;  ///< of a stochastic filter: levels between the footprint's and that of the drawn texels

  friend bool operator==(const FootprintFilter&, const FootprintFilter&) = default;
};

/// The default, as in engines.
inline constexpr FootprintFilter default_footprint_filter{FootprintFilterKind::anisotropic, 8};

/// The name of a kind, and the range of its number.
struct FootprintFilterWord {
  FootprintFilterKind kind;
  std::string_view name;
  int least, most;          ///< of the number, inclusive; 1 and 1: without a number
  bool stochastic = false;  ///< the number may be absent (1), and a depth may follow it
};

/// Whether a filter draws its texels at random, so that an image depends on the seed and on the number of its frame.
[[nodiscard]] bool is_stochastic(const FootprintFilter& filter);

/// Throws Error (usage): a stochastic filter, at a place that needs one lookup for each footprint.
/// place: names the caller in the message.
void require_one_lookup(const FootprintFilter& filter, std::string_view place);

/// All kinds, in the order of the documents.
[[nodiscard]] std::span<const FootprintFilterWord> footprint_filter_words();

/// The valid filters: "trilinear, anisotropic:N (1 to 16), ...".
[[nodiscard]] std::string footprint_filter_choices();

/// Parses "anisotropic:8", "stochastic", "stochastic:4:2". Throws Error (usage) that names `place`: unknown kind (with
/// the nearest), or a number that is missing, out of range or unexpected.
[[nodiscard]] FootprintFilter parse_footprint_filter(std::string_view text, std::string_view place);

/// The text of a filter, which parse_footprint_filter reads.
[[nodiscard]] std::string footprint_filter_text(const FootprintFilter& filter);

}  // namespace footprint
