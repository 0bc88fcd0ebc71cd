// Bricks and all other bodies: sun, sky, the baked look of the material and the colour of the body.
uniform vec3 sun, eye;
uniform vec2 surface;      // metalness, 1: the relief is seen
uniform float bricks;      // 1: of bricks, whose edges are dark
uniform float flatColour;  // 1: no light, for the polygon view
uniform sampler2DArray look, relief;
in vec3 worldPoint, worldNormal, base;
in vec2 place;
centroid in vec2 inFace;  // the same, never beyond the face
in vec4 tint;
flat in float layer, glow, ball;
out vec4 pixel;

const vec3 kBrick = vec3(0.215, 0.065, 0.1025);  // m: one texture to each of its three pairs of faces

// m, from the nearest edge of a face of a whole brick; far, where the texture goes on.
float toEdge() {
  int axis = int(layer) % 3;
  vec2 size = axis == 0 ? kBrick.yz : axis == 1 ? kBrick.zx : kBrick.xy;
  vec2 inside = size * (0.5 - abs(inFace - 0.5));
  return min(inside.x, inside.y) < 0.0 ? 1.0 : min(inside.x, inside.y);
}

// The baked normal, turned into the world: which way the texture runs is found from what neighbouring pixels see.
vec3 bumped(vec3 normal) {
  vec3 baked = texture(relief, vec3(place, layer)).xyz * 2.0 - 1.0;
  vec3 byX = dFdx(worldPoint), byY = dFdy(worldPoint);
  vec2 placeX = dFdx(place), placeY = dFdy(place);
  vec3 acrossX = cross(normal, byX), acrossY = cross(byY, normal);
  vec3 alongU = acrossY * placeX.x + acrossX * placeY.x, alongV = acrossY * placeX.y + acrossX * placeY.y;
  float size = max(dot(alongU, alongU), dot(alongV, alongV));
  if (size <= 0.0) return normal;
  return normalize((alongU * baked.x - alongV * baked.y) * inversesqrt(size) + normal * max(baked.z, 0.1));
}

void main() {
  if (flatColour > 0.5) {
    pixel = vec4(tint.rgb, 1.0);
    return;
  }
  vec4 baked = texture(look, vec3(place, layer));
  vec3 albedo = mix(toLinear(baked.rgb) * base, toLinear(tint.rgb), tint.a);
  if (bricks > 0.5) albedo *= edgeShade(toEdge(), max(length(dFdx(worldPoint)), length(dFdy(worldPoint))));
  float metal = surface.x * (1.0 - tint.a), rough = baked.a;
  vec3 normal = normalize(worldNormal);
  // Of the body itself: shadows know nothing of its bumps, and but for balls they begin at an edge of the mesh.
  float turned = dot(normal, sun);
#ifndef DEPTH_SHADOWS
  vec3 facet = cross(dFdx(worldPoint), dFdy(worldPoint));
  if (ball < 0.5) turned = dot(facet * sign(dot(facet, normal)), sun) * inversesqrt(max(dot(facet, facet), 1e-30));
#endif
  if (surface.y > 0.5) normal = bumped(normal);
  float facing = dot(normal, sun);
#ifdef DEPTH_SHADOWS
  // Where light only grazes, the map's texels would show as steps.
  float reaching = turned > 0.0 && facing > 0.0 ? sunReaching() * smoothstep(0.0, 0.12, turned) : 0.0;
#else
  float reaching = 1.0;
#endif
  vec3 ambient = ambientLight(normal, sun);
  vec3 steady = albedo * ambient * (1.0 - 0.9 * metal);  // without the sun
  vec3 light = albedo * kSunOnMatt * (max(facing, 0.0) * reaching * (1.0 - 0.9 * metal));
  if (metal > 0.0 || rough < 0.7) {
    // What is mirrored: the sky and the ground, and the sun's spot. Fired clay shows nothing of it.
    vec3 towards = normalize(eye - worldPoint);
    vec3 mirrored = reflect(-towards, normal);
    float edge = 1.0 - max(dot(normal, towards), 0.0), rim = edge * edge * edge * edge * edge;
    vec3 strength = mix(vec3(0.04), albedo, metal);
    strength += (1.0 - strength) * rim * (1.0 - rough) * 0.6;
    steady += strength * mix(skyLight(mirrored, sun), ambient, 0.5 * rough) * mix(0.5, 1.0, metal);
    float shine = mix(220.0, 5.0, sqrt(rough));
    float spot = pow(max(dot(mirrored, sun), 0.0), shine) * (shine + 8.0) * 0.02;
    light += strength * kSunOnMatt * spot * step(0.0, facing) * reaching;
  }
#ifndef DEPTH_SHADOWS
  // Modulative shadows darken the finished pixel, that of turned-away sides too: those are lit so that they come out right.
  light = turned > 0.0 ? steady + light : steady / kStencilLight;
#else
  light += steady;
#endif
  light += albedo * glow;
  pixel = vec4(toPixel(light), 1.0);
}
