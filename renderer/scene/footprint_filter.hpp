// How what lies under a pixel's footprint is filtered, as users write it: `anisotropic:8`, `shaded:2`.
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
  area,         ///< some N x N bilinear lookups: the texels of one level, each by its share of the footprint
  ewa,          ///< up to N weighted lookups along the ellipse's longer axis (Heckbert 1989, McCormack et al. 1999)
  shaded,       ///< N x N parts, each prefiltered and shaded for itself, and what they reflect averaged
  hardware,     ///< the sampler's own anisotropic filter of up to N probes
};

/// A filter and its number: of probes or parts, per axis where they tile the footprint.
struct FootprintFilter {
  FootprintFilterKind kind = FootprintFilterKind::trilinear;
  int count = 1;

  friend bool operator==(const FootprintFilter&, const FootprintFilter&) = default;
};

/// What runs where nobody says otherwise: engines have it.
inline constexpr FootprintFilter default_footprint_filter{FootprintFilterKind::anisotropic, 8};

/// A kind as it is written, and the range of its number.
struct FootprintFilterWord {
  FootprintFilterKind kind;
  std::string_view name;
  int least, most;  ///< of the number, both inclusive; 1 and 1: it takes none
};

/// All kinds, in the order of the documents.
[[nodiscard]] std::span<const FootprintFilterWord> footprint_filter_words();

/// "trilinear, anisotropic:N (1 to 16), ...": what a filter can be written as.
[[nodiscard]] std::string footprint_filter_choices();

/// Reads "anisotropic:8". Throws Error (usage) that names `place`: no such kind (with the nearest), a number that is
/// missing, out of range or not asked for.
[[nodiscard]] FootprintFilter parse_footprint_filter(std::string_view text, std::string_view place);

/// What parse_footprint_filter reads back.
[[nodiscard]] std::string footprint_filter_text(const FootprintFilter& filter);

}  // namespace footprint
