//? if conversion_table
// q = 1 - |r| of kappa from a table, as the paper has it, but over the logarithm of kappa and of q in place of |r|
// (kappa of a table of |r| over kappa itself is wrong by a third where kappa is 1 to 10).
const float table_first = 1e-2;  // of kappa
const float table_last = 1e5;

// Beyond the table's ends the root's own limits: |r| = kappa / 3, and q = 1 / (kappa - 1/2).
float tabulatedShortfall(sampler2D table, float kappa) {
  if (kappa < table_first) return 1.0 - kappa / 3.0;
  if (kappa > table_last) return 1.0 / (kappa - 0.5);
  int last = textureSize(table, 0).x - 1;
  float position = log(kappa / table_first) / log(table_last / table_first) * float(last);
  int below = clamp(int(position), 0, last - 1);
  return mix(texelFetch(table, ivec2(below, 0), 0).r, texelFetch(table, ivec2(below + 1, 0), 0).r,
             position - float(below));
}
//? end
