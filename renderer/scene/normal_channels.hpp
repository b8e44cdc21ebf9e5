// How files of normal maps store a normal.
#pragma once

namespace footprint {

/// What the channels of a stored normal map are.
enum class NormalChannels {
  xyz,  ///< of a file of two channels none the less x and y
  xy,   ///< as BC5 has it: z is what makes the normal a unit vector, and what the file has beyond y does not count
};

}  // namespace footprint
