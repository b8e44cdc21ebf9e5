// The work of a compiled shader, counted in the compiler's own code.
#pragma once

#include <map>
#include <string>

namespace footprint {

/// The reads of one texture by one pixel.
struct TextureReads {
  double samples = 0;  ///< filtered by its sampler
  double gathers = 0;  ///< four texels of one channel
  double loads = 0;    ///< one texel, without a sampler

  [[nodiscard]] double total() const { return samples + gathers + loads; }
};

/// The binding of reads whose descriptor is not known when the program is compiled.
inline constexpr int unknown_binding = -1;

/// Instructions of one wave.
struct Instructions {
  double full = 0;     ///< vector arithmetic at full rate, interpolation included
  double quarter = 0;  ///< vector arithmetic at a quarter of the rate: 1/x, roots, exp, log, sin, cos, 32-bit products
  double scalar = 0;   ///< scalar arithmetic and branches
  double memory = 0;   ///< scalar and vector memory, local memory, exports; without textures
  std::map<int, TextureReads> textures;  ///< by binding

  /// Adds another count, times `factor`.
  void add(const Instructions& other, double factor = 1.0);
  /// The reads of all textures.
  [[nodiscard]] double texture_reads() const;
};

/// The work of one program, each loop run once and both sides of each branch taken.
struct ShaderWork {
  Instructions straight;  ///< outside of loops
  Instructions looped;    ///< inside of loops that the compiler did not unroll
};

/// Counts the instructions in ACO's code.
/// code: CompiledStage::code.
/// descriptor_bytes: between the descriptors of two bindings in a set.
/// Throws Error (machine): the text is not such code.
[[nodiscard]] ShaderWork shader_work(const std::string& code, int descriptor_bytes);

/// The bytes between two descriptors, from the code of a program that reads the textures 0 and 1, in that order.
/// Throws Error (machine): it does not.
[[nodiscard]] int descriptor_bytes(const std::string& code);

}  // namespace footprint
