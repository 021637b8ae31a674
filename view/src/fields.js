// The scalars that a colour map can show: how each comes from what the stages wrote, its map and its range.

import { spanOf } from './colour.js';

const curvature = { map: 'coolwarm', diverging: true };
const tick = (v) =>
  v === 0 ? '0' : Math.abs(v) >= 1e4 || Math.abs(v) < 1e-3 ? v.toExponential(1) : String(+v.toPrecision(3));

/** On the vertices of the input: of(a, i) is the value at vertex i, from the arrays. */
export const surfaceFields = {
  'k-min': { ...curvature, label: 'k_min, 1/length', needs: ['k_min'], of: (a, i) => a.k_min[i] },
  'k-max': { ...curvature, label: 'k_max, 1/length', needs: ['k_max'], of: (a, i) => a.k_max[i] },
  mean: {
    ...curvature,
    label: 'mean curvature, 1/length',
    needs: ['k_min', 'k_max'],
    of: (a, i) => (a.k_min[i] + a.k_max[i]) / 2,
  },
  gauss: {
    ...curvature,
    label: 'Gaussian curvature, 1/length²',
    needs: ['k_min', 'k_max'],
    of: (a, i) => a.k_min[i] * a.k_max[i],
  },
  anisotropy: {
    map: 'viridis',
    range: spanOf(0, 1),
    label: 'anisotropy ||k_max| − |k_min|| / (|k_max| + |k_min|)',
    needs: ['k_min', 'k_max'],
    of: (a, i) => {
      const [low, high] = [Math.abs(a.k_min[i]), Math.abs(a.k_max[i])];
      return low + high > 0 ? Math.abs(high - low) / (low + high) : 0;
    },
  },
  stretch: {
    ...curvature,
    label: 'area in the plane / area on the surface',
    needs: ['stretch'],
    of: (a, i) => Math.log2(a.stretch[i]),
    tick: (v) => `×${tick(2 ** v)}`,
  },
};

/** On the faces of a result. */
export const resultFields = {
  degree: { label: 'corners', categories: true },
  error: { map: 'viridis', fromZero: true, label: 'rms distance to the input, % of its diagonal' },
  bend: { map: 'viridis', fromZero: true, label: 'bend along the flatter diagonal, degrees' },
};

export function formatTick(field, value) {
  return (field.tick ?? tick)(value);
}
