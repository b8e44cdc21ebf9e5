// Area lights by the lobes of a module, as linearly transformed cosines (Heitz et al. 2016). The table of fits is that
// of renderer/environment/transformed_cosines.hpp; docs/explanation/area-lights.md has the formulas.

const int disk_corners = 24;
const float disk_scale = 1.0057578;   // a polygon of 24 corners with the area of the disk
const float least_half_size = 3e-4;   // over the distance: below it 32-bit edges cancel
const float widest_view = 2.0943951;  // of the table's angles
const float wider_cosine = 1.08;      // of transformed_cosines.hpp

// A light seen from the pixel, tangent frame, in units of the distance of its centre. No side is shorter than the least
// one, and the light is as bright as if its area were `area`.
struct AreaOutline {
  vec3 centre;
  vec3 across;  // to the edges
  vec3 up;
  bool rectangle;
  float area;
};

AreaOutline outlineOf(AreaLight light, mat3 frame) {
  vec3 d = light.position_area.xyz - world_position;
  float size = max(length(d), 1e-18);
  vec2 half_size = max(vec2(light.across_half.w, light.up_half.w) / size, least_half_size);
  bool rectangle = light.direction_shape.w > 0.5;
  float area = (rectangle ? 4.0 : pi) * half_size.x * half_size.y * size * size;
  return AreaOutline((d / size) * frame, half_size.x * (light.across_half.xyz * frame),
                     half_size.y * (light.up_half.xyz * frame), rectangle, area);
}

// Corner i from the centre.
vec3 areaCorner(AreaOutline o, int i) {
  if (o.rectangle) return ((i + 1 & 2) == 0 ? o.across : -o.across) + ((i & 2) == 0 ? o.up : -o.up);
  float azimuth = 2.0 * pi / float(disk_corners) * float(i);
  return disk_scale * (cos(azimuth) * o.across + sin(azimuth) * o.up);
}

// The part of an integral over a solid angle that one edge adds: the angle that it spans about its normal (Lambert 1760).
vec3 edgeIntegral(vec3 from, vec3 way) {
  vec3 normal = cross(from, way);
  float size = length(normal);
  return size > 0.0 ? normal * (atan(size, dot(from, from + way)) / size) : vec3(0.0);
}

// Integrals of direction over the visible part of a light, in the space of the cosine and in that of the wider one.
struct AreaSums {
  vec3 first;
  vec3 wider;
};

void addEdge(inout AreaSums sums, vec3 centre, vec3 a, vec3 b, mat3 to_cosine, bool has_wider) {
  vec3 from = (centre + a) * to_cosine, way = (b - a) * to_cosine;
  sums.first += edgeIntegral(from, way);
  const vec3 narrowed = vec3(1.0 / wider_cosine, 1.0 / wider_cosine, 1.0);
  if (has_wider) sums.wider += edgeIntegral(narrowed * from, narrowed * way);
}

// The height of a point above a plane through the pixel; w 1: no plane.
float aboveArea(vec4 plane, vec3 p) { return dot(plane.xyz, p) + plane.w; }

// Sums over the edges of the light above all planes, and over the lines on which the planes cut it.
AreaSums areaSums(AreaOutline o, vec4 planes[3], mat3 to_cosine, bool has_wider) {
  AreaSums sums = AreaSums(vec3(0.0), vec3(0.0));
  vec3 leaves[3], enters[3];
  bvec3 crossed = bvec3(false);
#if FIXED_TRIPS
  const int corners = disk_corners;  // of every light: estimates count rounds of loops of constant length
#else
  int corners = o.rectangle ? 4 : disk_corners;
#endif
  vec3 corner = areaCorner(o, corners - 1);
  int i = 0;
  do {
    vec3 next = areaCorner(o, i);
    float start = 0.0, end = 1.0;
    for (int k = 0; k < 3; ++k) {
      float above = aboveArea(planes[k], o.centre + corner), above_next = aboveArea(planes[k], o.centre + next);
      if ((above > 0.0) == (above_next > 0.0)) {
        if (above <= 0.0) end = -1.0;
        continue;
      }
      float at = above / (above - above_next);
      crossed[k] = true;
      if (above > 0.0) {
        leaves[k] = mix(corner, next, at);
        end = min(end, at);
      } else {
        enters[k] = mix(corner, next, at);
        start = max(start, at);
      }
    }
    if (start < end) addEdge(sums, o.centre, mix(corner, next, start), mix(corner, next, end), to_cosine, has_wider);
    corner = next;
  } while (++i < corners);
  for (int k = 0; k < 3; ++k) {
    if (!crossed[k]) continue;
    float start = 0.0, end = 1.0;
    for (int j = 0; j < 3; ++j) {
      if (j == k) continue;
      float above = aboveArea(planes[j], o.centre + leaves[k]), above_next = aboveArea(planes[j], o.centre + enters[k]);
      float at = above / (above - above_next);
      if (above > 0.0 && above_next <= 0.0) end = min(end, at);
      if (above <= 0.0 && above_next > 0.0) start = max(start, at);
      if (above <= 0.0 && above_next <= 0.0) end = -1.0;
    }
    if (start < end)
      addEdge(sums, o.centre, mix(leaves[k], enters[k], start), mix(leaves[k], enters[k], end), to_cosine, has_wider);
  }
  return sums;
}

const vec4 no_plane = vec4(0.0, 0.0, 0.0, 1.0);

// A plane unless it nearly is one of two others, where both would count the line on which they cut the light.
vec4 ownPlane(vec3 n, vec4 a, vec4 b) {
  return max(dot(n, a.xyz), dot(n, b.xyz)) > 1.0 - 1e-6 ? no_plane : vec4(n, 0.0);
}

// The plane of the surface, below which light does not count.
vec4 surfacePlane() {
#if HORIZON_OPEN
  return no_plane;
#else
  return vec4(0.0, 0.0, 1.0, 0.0);
#endif
}

// A fit from the table, about a lobe in the tangent frame.
struct AreaCosine {
  mat3 to_cosine;    // a direction times it is in the space of the cosine
  mat3 to_tangent;   // and back
  float excess;      // weight of the first cosine over 1, and of the wider one below 0
  vec2 share;        // of both cosines above the plane of the axis
  float energy;      // of F0 and F90 of Schlick's term together
  float schlick;     // of F90
};

// The alpha of a lobe's row in the table.
float areaAlpha(NormalLobe lobe) {
#if DISTRIBUTION_BLINN_PHONG
  return clamp(inversesqrt(0.5 * (lobe.sharpness + 1.0)), smallest_alpha, 1.0);
#else
  return clamp(inversesqrt(0.5 * lobe.sharpness), smallest_alpha, 1.0);
#endif
}

// The share of a transformed cosine above the plane at `angle` from its z.
float shareOfCosine(float along, float shear, float angle) {
  float x = along * sin(angle), z = cos(angle) - shear * sin(angle);
  return 0.5 + 0.5 * z * inversesqrt(x * x + z * z);
}

AreaCosine areaCosine(NormalLobe lobe, vec3 wo) {
  float c = clamp(dot(lobe.axis, wo), -1.0, 1.0);
  vec3 side = wo - c * lobe.axis;
  float sine = length(side);
  float view = atan(sine, c), alpha = areaAlpha(lobe);
  if (sine < 1e-6) side = cross(lobe.axis, abs(lobe.axis.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
  side = normalize(side);
  vec2 size = vec2(textureSize(area_cosines, 0).xy);
  vec2 place = vec2(min(view / widest_view, 1.0), log(alpha / smallest_alpha) / -log(smallest_alpha));
  vec2 uv = (place * (size - 1.0) + 0.5) / size;
#if DISTRIBUTION_GGX
  float layer = lobe.tailed ? 0.0 : 2.0;
#else
  const float layer = 0.0;
#endif
  countLookups(2);
  vec4 shape = textureLod(area_cosines, vec3(uv, layer), 0.0);
  vec4 energies = textureLod(area_cosines, vec3(uv, layer + 1.0), 0.0);
  float angle = view + shape.x, along = alpha * exp(shape.y), across = alpha * exp(shape.z), shear = alpha * shape.w;
  vec3 x = -cos(angle) * side - sin(angle) * lobe.axis;
  vec3 y = cross(lobe.axis, side);
  vec3 z = cos(angle) * lobe.axis - sin(angle) * side;
  return AreaCosine(mat3((x - shear * z) / along, y / across, z), mat3(along * x, across * y, shear * x + z), energies.z,
                    vec2(shareOfCosine(along, shear, angle), shareOfCosine(wider_cosine * along, shear, angle)),
                    energies.x, energies.y);
}

// The factor of a module's geometry term over that in the table, for light from wi.
float areaGeometry(Effective e, NormalLobe lobe, vec3 wi, vec3 wo) {
  if (!halfVectorIsDefined(wi, wo)) return 1.0;
  vec3 h = halfVector(wi, wo);
  float table = geometryFactor(lobeFromAlpha(areaAlpha(lobe)), lobe.axis, h, wi, wo);
  return table > 0.0 ? min(lobeGeometry(e, lobe, h, wi, wo) / table, 4.0) : 0.0;
}

// The light that one lobe reflects from a light of radiance 1.
vec3 areaLobe(Effective e, NormalLobe lobe, AreaOutline o, vec3 f0, vec3 wo) {
  AreaCosine fit = areaCosine(lobe, wo);
  vec4 planes[3];
  planes[0] = surfacePlane();
  planes[1] = ownPlane(lobe.axis, planes[0], no_plane);
  planes[2] = ownPlane(fit.to_cosine[2], planes[0], vec4(lobe.axis, 0.0));
  AreaSums sums = areaSums(o, planes, fit.to_cosine, fit.excess > 0.0);
  vec2 covered = abs(vec2(sums.first.z, sums.wider.z)) / (2.0 * pi * max(fit.share, 1e-4));
  float share = max(covered.x + fit.excess * (covered.x - covered.y), 0.0);
  if (share <= 0.0) return vec3(0.0);
  vec3 towards = fit.to_tangent * (sums.first.z < 0.0 ? -sums.first : sums.first);
  float size = length(towards);
  float geometry = size > 0.0 ? areaGeometry(e, lobe, towards / size, wo) : 1.0;
#if FRESNEL && FRESNEL_SCHLICK
  vec3 energy = f0 * (fit.energy - fit.schlick) + fit.schlick;
#else
  vec3 energy = f0 * fit.energy;
#endif
  return energy * (lobe.weight * share * geometry);
}

#if DIFFUSE
// Lambert's term of facets with a mean normal: the irradiance of a polygon (Lambert 1760) about its direction.
vec3 areaDiffuse(vec3 mean_normal, AreaOutline o, Surface s, vec3 wo) {
  float size = length(mean_normal);
  vec3 n = size > 1e-6 ? mean_normal / size : vec3(0.0, 0.0, 1.0);
  vec4 planes[3];
  planes[0] = surfacePlane();
  planes[1] = ownPlane(n, planes[0], no_plane);
  planes[2] = no_plane;
  vec3 sum = areaSums(o, planes, mat3(1.0), false).first;
  float lit = abs(dot(sum, n)) / (2.0 * pi);
  vec3 reflected = s.albedo * (min(size, 1.0) * lit);
#if FRESNEL
  float from = length(sum);
  if (from > 0.0) reflected *= transmitted(s.f0, sum * (sign(dot(sum, n)) / from), wo);
#endif
  return reflected;
}
#endif

vec3 areaLightLit(SurfacePoint p, AreaLight light) {
  vec3 d = light.position_area.xyz - world_position;
  if (dot(d, light.direction_shape.xyz) >= 0.0) return vec3(0.0);
  AreaOutline o = outlineOf(light, p.frame);
  vec3 radiance = vec3(0.0);
#if DIFFUSE
  radiance += areaDiffuse(meanNormal(p.effective), o, p.surface, p.wo);
#endif
  int count = lobesHere(lobeCount(p.effective));
  int i = 0;
  do {
    NormalLobe lobe = normalLobe(p.effective, i);
    if (lobe.weight <= 0.0) continue;
    countLobes(1);
    radiance += areaLobe(p.effective, lobe, o, p.surface.f0, p.wo);
  } while (++i < count);
  radiance *= light.intensity.rgb / o.area;
#if CAST_SHADOW
  radiance *= clearOfShadow(light.intensity.w, world_position, seen_facet, -d);
#endif
  return radiance;
}

vec3 areaLit(SurfacePoint p) {
  vec3 radiance = vec3(0.0);
  int number = 0;
  do {
    radiance += areaLightLit(p, areaLight(number, world_position));
  } while (number++ < area_light_count - 1);
  return radiance;
}
