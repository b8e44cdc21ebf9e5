// The pixels on the right and above, by differences within a quad, for modules that use screen-space changes of normal
// and half vector.
struct Neighbour {
  vec3 position;
  mat3 frame;
};
Neighbour beside[2];  // of the pixel

// Call before any pixel is removed. Frames are orthonormal, so the transpose is the inverse.
void fetchNeighbourFrames(mat3 frame, inout Footprints f) {
  mat3 right = mat3(dFdx(frame[0]), dFdx(frame[1]), dFdx(frame[2]));
  mat3 up = mat3(dFdy(frame[0]), dFdy(frame[1]), dFdy(frame[2]));
  f.frame_dx = transpose(frame) * right;
  f.frame_dy = transpose(frame) * up;
  beside[0] = Neighbour(world_position + dFdx(world_position), frame + right);
  beside[1] = Neighbour(world_position + dFdy(world_position), frame + up);
}

// The half vector of a neighbour in its own frame.
vec3 halfVectorAt(Neighbour n, vec4 source) {
#if ORTHOGRAPHIC
  vec3 to_viewer = to_camera;
#else
  vec3 to_viewer = normalize(camera_position - n.position);
#endif
  return halfVector(normalize(source.xyz - source.w * n.position), to_viewer) * n.frame;
}

// For light along wi from `source` in world space: a position (w 1) or a direction (w 0).
HalfSteps halfSteps(vec3 wi, vec4 source, vec3 wo) {
  vec3 h = halfVector(wi, wo);
  HalfSteps steps = HalfSteps(halfVectorAt(beside[0], source) - h, halfVectorAt(beside[1], source) - h);
#if FILTER_PARTS
  steps = HalfSteps(steps.dx * part_edges[0].x + steps.dy * part_edges[0].y,
                    steps.dx * part_edges[1].x + steps.dy * part_edges[1].y);
#endif
  return steps;
}
