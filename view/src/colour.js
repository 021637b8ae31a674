// Colours: maps that people with any colour vision can read, robust ranges, and the fixed colours of what is drawn.

const stops = {
  viridis: '440154 482475 414487 355f8d 2a788e 21918c 22a884 44bf70 7ad151 bddf26 fde725',
  coolwarm: '3b4cc0 5977e3 7b9ff9 9ebeff c0d4f5 dddcdc f2cbb7 f7ac8e ee8468 d65244 b40426',
};

export const colours = {
  background: '#ffffff',
  plain: '#d7dce2',
  missing: '#8a8a8a',
  min: '#1f5fd0',
  max: '#d62728',
  feature: '#1a9850',
  border: '#000000',
  seam: '#8c510a',
  triangles: '#9aa0a8',
  wedge: '#ffb000',
  trisector: '#9b30d9',
  sample: '#000000',
  conforming: '#e08a00',
  selected: '#ff00c8',
};

/** By number of corners; the last stands for all above. */
export const degreeColours = { 3: '#f6c177', 4: '#9ecae1', 5: '#7fc8a0', 6: '#c3a5d8', 7: '#ef8fa8' };
export const edgeKinds = [
  ['min', colours.min],
  ['max', colours.max],
  ['feature', colours.feature],
  ['border', colours.border],
  ['conforming', colours.conforming],
];
export const origins = [
  ['crossing', '#555555'],
  ['feature', colours.feature],
  ['corner', '#e41a8c'],
  ['border', '#000000'],
  ['isotropic', colours.wedge],
  ['line', colours.min],
];

export function rgb(hex) {
  const n = parseInt(hex.slice(-6), 16);
  return [n >> 16, (n >> 8) & 255, n & 255];
}

const tables = Object.fromEntries(Object.entries(stops).map(([name, text]) => [name, text.split(' ').map(rgb)]));

/** Writes the colour at t in [0, 1] to out[at...at + 2], 0 to 255. */
export function mapColour(map, t, out, at) {
  const table = tables[map];
  const x = Math.min(Math.max(t, 0), 1) * (table.length - 1);
  const i = Math.min(Math.floor(x), table.length - 2);
  for (let c = 0; c < 3; ++c) out[at + c] = Math.round(table[i][c] + (x - i) * (table[i + 1][c] - table[i][c]));
}

/** What a colour map runs over: the values without their outermost 2 % at either end, symmetric about 0 for a diverging map. Between
 *  `from` and `to` there are values: of a symmetric map a part may be empty. */
export function robustRange(values, { diverging, fromZero }) {
  const sorted = Float32Array.from(values.filter((v) => Number.isFinite(v))).sort();
  if (!sorted.length) return spanOf(0, 1);
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  const [low, high] = [at(0.02), at(0.98)];
  const [least, most] = [sorted[0], sorted[sorted.length - 1]];
  if (diverging) {
    const largest = Math.max(Math.abs(low), Math.abs(high)) || Math.max(Math.abs(least), Math.abs(most)) || 1;
    return { ...spanOf(-largest, largest), ...(high > low ? { from: low, to: high } : {}) };
  }
  if (fromZero) return spanOf(0, high > 0 ? high : most);
  return spanOf(low, high);
}

/** A range that is not empty, and all of it in use. */
export function spanOf(low, high) {
  const end = high > low ? high : low + (Math.abs(low) || 1) * 1e-6;
  return { low, high: end, from: low, to: end };
}
