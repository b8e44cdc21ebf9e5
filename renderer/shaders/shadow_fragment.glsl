// Writes a shadow map: linear depth along its axis, with the alpha test.
in float depth;
//? if alpha_mask
in vec2 uv0;
in vec2 uv1;
in float vertex_alpha;  //? if vertex_color

//? include alpha_mask.glsl
//? end

void main() {
  if (isCutOut()) discard;  //? if alpha_mask
  gl_FragDepth = depth;
}
