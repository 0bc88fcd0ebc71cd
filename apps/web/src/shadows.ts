// How much of the sun reaches a point, by its depth map: a square of samples, each of them weighed over two texels by the sampler itself, so that
// the edge of a shadow is soft. three.js turns its samples anew at each pixel, which leaves grain where a shadow is wider than what it falls on.
import { ShaderChunk } from 'three';

const kSamplesApart = 2; // texels: as far as one of them reaches

// As ShaderChunk.shadowmap_pars_fragment; `across`: samples each way.
export function shadowLookup(across: number): string {
  const chunk = ShaderChunk.shadowmap_pars_fragment;
  const from = chunk.indexOf('float phi ='), end = ') * 0.2;';
  const to = chunk.indexOf(end, from);
  if (from < 0 || to < 0) throw new Error('three.js looks up shadows in another way');
  return `${chunk.slice(0, from)}
    vec2 apart = ${kSamplesApart.toFixed(1)} * texelSize;
    shadow = 0.0;
    for (int i = 0; i < ${across * across}; i++) {
      vec2 aside = vec2(i % ${across}, i / ${across}) - ${((across - 1) / 2).toFixed(1)};
      shadow += texture(shadowMap, vec3(shadowCoord.xy + aside * apart, shadowCoord.z));
    }
    shadow /= ${(across * across).toFixed(1)};
  ${chunk.slice(to + end.length)}`;
}
