// A base lobe as the von Mises-Fisher lobe of the same width, whose characteristic vector r = |r| mu averages linearly
// (Xu 2017, section 3.2), and the way back. |r| is near 1 for narrow lobes: what is computed is q = 1 - |r|.
//? include vmf.glsl

//? if distribution_blinn_phong
// Equation 14: the lobe of the same peak and of the same energy over solid angle.
float kappaOfLobe(float s) { return s + 1.0; }
float lobeOfKappa(float kappa) { return clamp(kappa - 1.0, 0.0, largest_exponent); }
//? else
float kappaOfLobe(float lobe) { return 1.0 / max(lobeVariance(lobe), 1e-12); }
float lobeOfKappa(float kappa) { return lobeFromVariance(1.0 / max(kappa, 1e-6)); }
//? end

// The energy of a base lobe over solid angle. That of a microfacet lobe grows with its width, while the mean of narrow
// ones keeps theirs: a wide lobe that stands for them is scaled by the ratio.
float energyOf(float base) {
//? if lobe_base
  return lobeEnergy(base);
//? else
  return 1.0;
//? end
}
