// What stuff looks like at a point of a body, in the body's own space, so that patterns move with it and go on through it: the
// shader's side of apps/appearance/surface.cpp, with the same patterns at the same sizes, so that page, viewer and films agree. A
// pattern that is finer than a pixel fades to its mean: it neither flickers nor costs time.

// -1 .. 1 with one bump a unit of length; noiseSlope has the value in w and its slope in xyz.
const kNoise = `
  // Values at the corners of a cell, from a hash of each: (0, 0), (1, 0), (0, 1) and (1, 1) along x and y, near and far along z. Worked out
  // for all eight at once: where the processor draws, most of what the shader costs is this.
  void cornersOf(vec3 cell, out vec4 near, out vec4 far) {
    vec4 xy = fract(vec4(cell.xy, cell.xy + 1.0) * vec4(0.1031, 0.1030, 0.1031, 0.1030));
    vec2 z = fract(vec2(cell.z, cell.z + 1.0) * 0.0973);
    vec4 x = xy.xzxz, y = xy.yyww;
    vec4 level = x * (y + 33.33) + y * (x + 33.33);
    vec2 up = z * (z + 33.33);
    vec4 sum = x + y, add = level + up.x;
    near = fract((sum + 2.0 * add) * (z.x + add)) * 2.0 - 1.0;
    add = level + up.y;
    far = fract((sum + 2.0 * add) * (z.y + add)) * 2.0 - 1.0;
  }
  float noiseAt(vec3 p) {
    vec3 i = floor(p), f = p - i, u = f * f * (3.0 - 2.0 * f);
    vec4 near, far;
    cornersOf(i, near, far);
    vec4 c = mix(near, far, u.z);
    return mix(mix(c.x, c.y, u.x), mix(c.z, c.w, u.x), u.y);
  }
  vec4 noiseSlope(vec3 p) {
    vec3 i = floor(p), f = p - i, u = f * f * (3.0 - 2.0 * f), rise = 6.0 * f * (1.0 - f);
    vec4 near, far;
    cornersOf(i, near, far);
    vec4 c = mix(near, far, u.z), d = far - near;
    return vec4(mix(c.y - c.x, c.w - c.z, u.y) * rise.x, mix(c.z - c.x, c.w - c.y, u.x) * rise.y,
                mix(mix(d.x, d.y, u.x), mix(d.z, d.w, u.x), u.y) * rise.z, mix(mix(c.x, c.y, u.x), mix(c.z, c.w, u.x), u.y));
  }
  float seenShare(float wavelength, float pixel) { return clamp(0.5 * wavelength / pixel - 0.5, 0.0, 1.0); }
  // Each pattern of a body lies elsewhere in the noise, and no body's patterns where another's are.
  vec3 placeOf(float salt) { return vSeed * vec3(611.0, 397.0, 523.0) + salt * vec3(31.7, 17.3, 23.9); }
  float grain(vec3 p, float wavelength, float salt, float pixel) {
    float seen = seenShare(wavelength, pixel);
    return seen > 0.0 ? seen * noiseAt(p / wavelength + placeOf(salt)) : 0.0;
  }
  // 0 .. 1: holes where the noise is highest. The fewer, the larger the place from which on (0 .. 1).
  float pits(vec3 p, float wavelength, float salt, float pixel, float from) {
    float seen = seenShare(wavelength, pixel);
    return seen > 0.0 ? seen * smoothstep(from, from + 0.3, noiseAt(p / wavelength + placeOf(salt))) : 0.0;
  }
  // Rows of the noise shall not lie along the faces.
  const mat3 kSlant = mat3(0.36, -0.80, 0.48, 0.48, 0.60, 0.64, -0.80, 0.0, 0.60);`;

// Of each kind of stuff: the colour at a point, from its own (`bare`). p: m; q: p slanted; n: of the face; wear: 0 .. 1, where edges
// are rubbed off.
const kPaints: Record<string, string> = {
  brick: `
    float cloud = grain(q, 0.07, 0.0, pixel), patchy = grain(q, 0.024, 1.0, pixel);
    float light = 1.0 + 0.16 * cloud + 0.11 * patchy;
    colour *= vec3(1.0 - 0.04 * cloud, 1.0 + 0.05 * cloud, 1.0 + 0.12 * cloud);
    vec3 a = abs(n);
    bool isEnd = a.x >= a.y && a.x >= a.z, isBed = !isEnd && a.y >= a.z;
    if (isEnd) light *= 0.88 + 0.08 * cloud;
    // The long sides were cut by a wire: lines along the brick.
    if (!isEnd && !isBed) light *= 1.0 + 0.06 * grain(p * vec3(0.05, 1, 1), 0.004, 2.0, pixel);
    light *= 1.0 + 0.10 * grain(q, 0.008, 3.0, pixel) + 0.12 * grain(q, 0.0024, 4.0, pixel) + 0.12 * grain(q, 0.0009, 5.0, pixel);
    colour *= max(light, 0.2);
    // Grains of sand, and lime that rose or stuck: thick on beds, a veil on faces.
    colour = mix(colour, vec3(0.47, 0.34, 0.24), 0.3 * pits(q, 0.0019, 6.0, pixel, 0.55));
    float from = isBed ? -0.2 : 0.3;
    float lime = smoothstep(from, from + 0.8, grain(q, 0.05, 7.0, pixel) + 0.4 * patchy);
    colour = mix(colour, vec3(0.50, 0.44, 0.38), (isBed ? 0.3 : 0.15) * lime * (1.0 + 0.6 * grain(q, 0.006, 8.0, pixel)));
    colour *= 1.0 - 0.4 * pits(q, 0.0036, 9.0, pixel, 0.6);
    colour = mix(colour, mix(bare * 1.2, vec3(0.5, 0.38, 0.30), 0.35), 0.5 * wear);`,
  concrete: `
    float light = 1.0 + 0.10 * grain(q, 0.16, 0.0, pixel) + 0.07 * grain(q, 0.035, 1.0, pixel) + 0.06 * grain(q, 0.005, 2.0, pixel)
      + 0.05 * grain(q, 0.0015, 3.0, pixel);
    colour *= light * (1.0 - 0.4 * pits(q, 0.010, 4.0, pixel, 0.66));
    colour = mix(colour, vec3(0.5, 0.48, 0.44), 0.3 * wear);`,
  stone: `
    float warp = grain(q, 0.12, 0.0, pixel);
    float vein = 1.0 - abs(grain(q + 0.05 * warp, 0.06, 1.0, pixel));
    float light = 1.0 + 0.15 * warp + 0.12 * grain(q, 0.02, 2.0, pixel) + 0.12 * grain(q, 0.004, 3.0, pixel)
      - 0.15 * smoothstep(0.9, 1.0, vein) * seenShare(0.06, pixel);
    colour *= max(light, 0.2);
    colour *= 1.0 + 0.15 * wear;`,
  // Rings about an axis that lies beside the piece: boards are not cut through the heart.
  wood: `
    vec3 along = uHalf.y > uHalf.x && uHalf.y >= uHalf.z ? p.yzx : uHalf.z > uHalf.x ? p.zxy : p;
    float sway = 0.010 * noiseAt(vec3(along.x * 0.08, along.yz) * 12.0 + placeOf(0.0));
    float radius = length(along.yz + vec2(0.10 + 0.1 * fract(vSeed * 57.3), 0.05 * (fract(vSeed * 91.7) - 0.5))) + sway;
    float ring = fract(radius / 0.008), seen = seenShare(0.008, pixel);
    float late = smoothstep(0.3, 0.9, ring) * (1.0 - smoothstep(0.92, 1.0, ring)) * seen + 0.4 * (1.0 - seen);
    float fibre = grain(vec3(along.x * 0.05, along.yz), 0.0022, 1.0, pixel);
    colour *= mix(vec3(1.08, 1.12, 1.2), vec3(0.68, 0.66, 0.66), late) * (1.0 + 0.12 * fibre);`,
  steel: `
    float smear = grain(p, 0.05, 0.0, pixel);
    colour = mix(colour, vec3(0.56, 0.55, 0.53), 0.6) * (1.0 + 0.05 * smear); // bare steel reflects more than a painter's colour for it says
    roughnessHere += 0.06 * smear + 0.03 * grain(p, 0.004, 1.0, pixel);`,
  // A trodden floor: clouds, then grains, light and dark, and lone bits of gravel.
  ground: `
    float light = 1.0 + 0.07 * grain(q, 1.9, 0.0, pixel) + 0.05 * grain(q, 0.35, 1.0, pixel) + 0.05 * grain(q, 0.06, 2.0, pixel)
      + 0.06 * grain(q, 0.013, 3.0, pixel) + 0.08 * grain(q, 0.0035, 4.0, pixel) + 0.07 * grain(q, 0.0012, 5.0, pixel);
    colour *= max(light, 0.2);
    colour = mix(colour, vec3(0.42, 0.40, 0.37), 0.35 * pits(q, 0.012, 7.0, pixel, 0.6));`,
  floor: 'colour *= floorShade(p.xz, fwidth(p.xz));',
  rubber: 'colour *= 1.0 + 0.04 * grain(p, 0.03, 0.0, pixel);',
  plain: 'colour *= 1.0 + 0.04 * grain(p, 0.03, 0.0, pixel);',
};

// m, height of the bumps; and how deep the holes of the kind are, in that height, how wide (m) and from which place in the noise.
const kReliefs: Record<string, { height: number; pits?: [number, number, number] }> = {
  brick: { height: 0.0006, pits: [1.2, 0.0036, 9] },
  concrete: { height: 0.0005, pits: [2, 0.010, 4] },
  stone: { height: 0.001 },
  wood: { height: 0.0003 },
  rubber: { height: 0.0002 },
  ground: { height: 0.0012 },
};
const kReliefEnd = 0.006; // m a pixel, from which on bumps are too small to be seen

// GLSL's numbers have a point.
const real = (value: number): string => value.toFixed(7);

function reliefOf(kind: string): string {
  const relief = kReliefs[kind];
  if (!relief) return 'vec3 reliefSlope(vec3 q, float pixel) { return vec3(0.0); }';
  const bump = (share: number, wavelength: number, salt: number): string =>
    `if (seenShare(${real(wavelength)}, pixel) > 0.0) slope += noiseSlope(q / ${real(wavelength)} + placeOf(${real(salt)})).xyz
      * (seenShare(${real(wavelength)}, pixel) * ${real((share * relief.height) / wavelength)});\n`;
  const from = kind === 'concrete' ? 0.66 : 0.6;
  const holes = relief.pits
    ? `if (seenShare(${real(relief.pits[1])}, pixel) > 0.0) {
        vec4 hole = noiseSlope(q / ${real(relief.pits[1])} + placeOf(${real(relief.pits[2])}));
        float t = clamp((hole.w - ${real(from)}) / 0.3, 0.0, 1.0);
        slope -= hole.xyz * (6.0 * t * (1.0 - t) / 0.3 * seenShare(${real(relief.pits[1])}, pixel) * ${real((relief.pits[0] * relief.height) / relief.pits[1])});
      }\n`
    : '';
  return `vec3 reliefSlope(vec3 q, float pixel) {
    if (pixel >= ${real(kReliefEnd)}) return vec3(0.0);
    vec3 slope = vec3(0.0);
    ${bump(0.8, 0.018, 21)}${bump(0.55, 0.006, 22)}${bump(0.4, 0.0022, 23)}${holes}
    return slope * (1.0 - smoothstep(0.5, 1.0, pixel / ${real(kReliefEnd)}));
  }`;
}

// The functions of a kind: the colour at a point, and the slope of its bumps there.
export function patternsOf(kind: string, isFloor: boolean): string {
  return `${kNoise}
  ${reliefOf(kind)}
  vec3 reliefAt(vec3 p, float pixel) { return reliefSlope(kSlant * p, pixel) * kSlant; }
  vec3 paintAt(vec3 colour, vec3 p, vec3 n, float wear, float pixel, inout float roughnessHere) {
    vec3 bare = colour, q = kSlant * p;
    ${kPaints[kind]}
    ${isFloor ? kPaints.floor : ''}
    return colour;
  }`;
}
