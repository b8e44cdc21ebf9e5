// What a method's module defines, and when (renderer/shaders/README.md has the meaning). `Effective` is a structure of
// the module: the state of one pixel. Directions are unit vectors in the tangent frame.
Effective effective(Footprints f);  // reads the textures, once per pixel

// f * cos, averaged over the footprint.
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo);
#if SCREEN_DERIVATIVES
// For a light whose half vector changes by `steps` to the neighbouring pixels.
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo, HalfSteps steps);
#endif

float ndf(Effective e, vec3 h);  // effective density of normals, 1/sr

#if LOBES_LISTED
int lobeCount(Effective e);                 // a loop's bound, not a constant
NormalLobe normalLobe(Effective e, int i);  // a lobe of `ndf`; weight 0 if absent
#if MICROGEOMETRY_VISIBILITY
// The factor besides the density of lobe i in f * cos, for light directions spread about wi by `sharpness`.
vec3 lobeReflectance(Effective e, int i, vec3 f0, vec3 h, vec3 wi, vec3 wo, float sharpness);
#if ENVIRONMENT_DIFFUSE
DiffuseFacets visibleFacets(Effective e, vec3 wo);
#endif
#else
// The factor besides F D in f * cos.
float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo);
vec3 meanNormal(Effective e);  // mean of the unit normals, not renormalised
#endif
#endif

#if ENVIRONMENT_SUMMED
// Sums `environmentLit` over Effectives of its choice. frame: columns are the tangent frame's axes.
vec3 environmentSum(Effective e, Surface s, vec3 wo, mat3 frame);
#endif

#if DIRECTIONS_DRAWN && !ENVIRONMENT_DENSE || AREA_SAMPLED
vec3 drawDirection(Effective e, vec3 wo, vec3 u);       // from three numbers in [0, 1); zero: none
float directionDensity(Effective e, vec3 wi, vec3 wo);  // density of drawing wi, 1/sr
#endif
