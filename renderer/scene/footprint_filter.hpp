// The filters of a pixel's footprint and their text form: `anisotropic:8`, `shaded:2`.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace footprint {

/// The kinds of filters; docs/filters.md has their kernels.
enum class FootprintFilterKind {
  trilinear,    ///< one lookup at the level of the footprint's longer edge
  anisotropic,  ///< up to N lookups along that edge, by the formulas of EXT_texture_filter_anisotropic
  box,          ///< N x N lookups that tile the footprint
  area,         ///< about N x N bilinear lookups that weight the texels of one level by their share of the footprint
  ewa,          ///< up to N weighted lookups along the ellipse's longer axis (Heckbert 1989, McCormack et al. 1999)
  shaded,       ///< N x N parts that are filtered and shaded separately, then averaged
  hardware,     ///< the sampler's own anisotropic filter with up to N probes
};

/// A filter with its number of probes or parts, per axis if they tile the footprint.
struct FootprintFilter {
  FootprintFilterKind kind = FootprintFilterKind::trilinear;
  int count = 1;

  friend bool operator==(const FootprintFilter&, const FootprintFilter&) = default;
};

/// The default, as in engines.
inline constexpr FootprintFilter default_footprint_filter{FootprintFilterKind::anisotropic, 8};

/// The name of a kind, and the range of its number.
struct FootprintFilterWord {
  FootprintFilterKind kind;
  std::string_view name;
  int least, most;  ///< of the number, inclusive; 1 and 1: without a number
};

/// All kinds, in the order of the documents.
[[nodiscard]] std::span<const FootprintFilterWord> footprint_filter_words();

/// The valid filters: "trilinear, anisotropic:N (1 to 16), ...".
[[nodiscard]] std::string footprint_filter_choices();

/// Parses "anisotropic:8". Throws Error (usage) that names `place`: unknown kind (with the nearest), or a number that
/// is missing, out of range or unexpected.
[[nodiscard]] FootprintFilter parse_footprint_filter(std::string_view text, std::string_view place);

/// The text of a filter, which parse_footprint_filter reads.
[[nodiscard]] std::string footprint_filter_text(const FootprintFilter& filter);

}  // namespace footprint
