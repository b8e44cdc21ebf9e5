// Writes a shadow map: linear depth along its axis, with the alpha test.
in float depth;
//? if alpha_mask
in vec2 uv0;
in vec2 uv1;
//? if vertex_color
in float vertex_alpha;
//? end

//? include alpha_mask.glsl
//? end

void main() {
//? if alpha_mask
  if (isCutOut()) discard;
//? end
  gl_FragDepth = depth;
}
