// Every layer by name: where it stands in the panel, what it needs, and how it is drawn in space and in the plane. The names are those of
// anisomesh-view --layer; a test holds the two lists together.
import { colours, edgeKinds, origins, rgb } from './colour.js';
import { crossSegments } from './crosses.js';
import { dotsOf, segmentsOf } from './materials.js';

/** Segments between the points of pairs (a, b) at stride 3 in `edges`: number, a, b. */
function edgeSegments(edges, points) {
  const out = new Float32Array(2 * edges.length);
  for (let i = 0; i < edges.length / 3; ++i)
    for (let end = 0; end < 2; ++end)
      for (let c = 0; c < 3; ++c) out[6 * i + 3 * end + c] = points[3 * edges[3 * i + 1 + end] + c];
  return out;
}

/** Segments of the lines of one kind, and the line that each belongs to. */
export function lineSegments(surface, domain, kind) {
  const at = surface.places(domain, 'line');
  const segments = [];
  const owners = [];
  const add = (i, p, q) => {
    segments.push(at[3 * p], at[3 * p + 1], at[3 * p + 2], at[3 * q], at[3 * q + 1], at[3 * q + 2]);
    owners.push(i);
  };
  for (let i = 0; i < surface.lineCount; ++i) {
    const line = surface.line(i);
    if (line.kind !== kind) continue;
    for (let p = line.first + 1; p < line.last; ++p) add(i, p - 1, p);
    if (line.closed && line.last - line.first > 2) add(i, line.last - 1, line.first);
  }
  return { segments: Float32Array.from(segments), owners };
}

/** The input's edges, each once: number is not known here, so 0. */
function triangleEdges(surface) {
  const seen = new Set();
  const edges = [];
  const t = surface.triangles;
  for (let i = 0; i < t.length; ++i) {
    const a = t[i];
    const b = t[i % 3 === 2 ? i - 2 : i + 1];
    const key = Math.min(a, b) * surface.vertexCount + Math.max(a, b);
    if (seen.has(key)) continue;
    seen.add(key);
    edges.push(0, a, b);
  }
  return edges;
}

const repeat = (colour, count) => Uint8Array.from({ length: 3 * count }, (_, i) => colour[i % 3]);

function drawLines(kind) {
  return (surface, domain) =>
    segmentsOf(lineSegments(surface, domain, kind).segments, { colour: rgb(kind ? colours.max : colours.min) });
}

function drawCrosses(source) {
  return (surface, domain) => {
    const { segments, kinds } = crossSegments(surface, domain, source);
    const c = new Uint8Array(3 * kinds.length);
    kinds.forEach((kind, i) => c.set(rgb(kind ? colours.max : colours.min), 3 * i));
    return segmentsOf(segments, { colours: c, width: 1.4 });
  };
}

function drawUmbilics(surface, domain) {
  const wedge = surface.arrays.umbilic_wedge;
  const c = new Uint8Array(3 * wedge.length);
  wedge.forEach((w, i) => c.set(rgb(w ? colours.wedge : colours.trisector), 3 * i));
  return dotsOf(surface.places(domain, 'umbilic'), {
    colours: c,
    shapes: Float32Array.from(wedge, (w) => (w ? 0 : 1)),
    size: 11,
  });
}

function drawEdges(key, colour, width) {
  return (surface, domain) =>
    segmentsOf(edgeSegments(surface.arrays[key], surface.pointsIn(domain)), { colour: rgb(colour), width });
}

function drawResultEdges(byKind) {
  return (result, points, bias) => {
    const segments = edgeSegments(result.arrays.edges, points);
    if (!byKind) return segmentsOf(segments, { colour: [0, 0, 0], width: 1.3, bias });
    const c = new Uint8Array(result.arrays.edges.length);
    result.arrays.edge_kind.forEach((kind, i) => c.set(rgb(edgeKinds[kind][1]), 3 * i));
    return segmentsOf(segments, { colours: c, width: 1.8, bias });
  };
}

function drawOrigins(result, points, bias) {
  const c = new Uint8Array(3 * result.vertexCount);
  result.arrays.origin.forEach((o, i) => c.set(rgb(origins[o][1]), 3 * i));
  return dotsOf(points, { colours: c, size: 7, bias: bias + 0.002 });
}

const has =
  (...keys) =>
  (model) =>
    keys.every((key) => model.arrays[key]);
const always = () => true;

/** In the order of the panel. `of` is what a layer is drawn from. */
export const layers = [
  { name: 'surface', group: 'Panes', label: 'input', of: 'surface', available: always },
  { name: 'plane', group: 'Panes', label: 'input in the plane', of: 'surface', available: has('uv') },
  { name: 'result', group: 'Panes', label: 'result', of: 'result', available: always },
  { name: 'overlay', group: 'Panes', label: 'result over input', of: 'both', available: always },

  { name: 'k-min', group: 'Colour of the input', label: 'k_min', of: 'surface', field: true, available: has('k_min') },
  { name: 'k-max', group: 'Colour of the input', label: 'k_max', of: 'surface', field: true, available: has('k_max') },
  {
    name: 'mean',
    group: 'Colour of the input',
    label: 'mean curvature',
    of: 'surface',
    field: true,
    available: has('k_min', 'k_max'),
  },
  {
    name: 'gauss',
    group: 'Colour of the input',
    label: 'Gaussian curvature',
    of: 'surface',
    field: true,
    available: has('k_min', 'k_max'),
  },
  {
    name: 'anisotropy',
    group: 'Colour of the input',
    label: 'anisotropy',
    of: 'surface',
    field: true,
    available: has('k_min', 'k_max'),
  },
  {
    name: 'stretch',
    group: 'Colour of the input',
    label: 'area stretch',
    of: 'surface',
    field: true,
    available: has('stretch'),
  },

  {
    name: 'triangles',
    group: 'On the input',
    label: 'triangles',
    of: 'surface',
    available: always,
    draw: (s, d) =>
      segmentsOf(edgeSegments(triangleEdges(s), s.pointsIn(d)), {
        colour: rgb(colours.triangles),
        width: 1,
        bias: 0.001,
      }),
  },
  {
    name: 'border',
    group: 'On the input',
    label: 'border',
    of: 'surface',
    available: has('border'),
    draw: drawEdges('border', colours.border, 2),
    swatch: [['border', colours.border]],
  },
  {
    name: 'features',
    group: 'On the input',
    label: 'features',
    of: 'surface',
    available: has('features'),
    draw: drawEdges('features', colours.feature, 3),
    swatch: [['features', colours.feature]],
  },
  {
    name: 'seams',
    group: 'On the input',
    label: 'seams of charts',
    of: 'surface',
    available: has('seams'),
    draw: drawEdges('seams', colours.seam, 3),
    swatch: [['seams', colours.seam]],
  },
  {
    name: 'crosses',
    group: 'On the input',
    label: 'principal directions',
    of: 'surface',
    available: has('k_min', 'k_max', 'gamma_min', 'gamma_max'),
    draw: drawCrosses('estimated'),
    swatch: [
      ['min direction', colours.min],
      ['max direction', colours.max],
    ],
  },
  {
    name: 'smoothed-crosses',
    group: 'On the input',
    label: 'smoothed directions',
    of: 'surface',
    available: (s) => has('uv', 'tensor2d')(s) || has('smoothed_k')(s),
    draw: drawCrosses('smoothed'),
    swatch: [
      ['smoothed min direction', colours.min],
      ['smoothed max direction', colours.max],
    ],
  },
  {
    name: 'min-lines',
    group: 'On the input',
    label: 'min lines',
    of: 'surface',
    available: has('line_table'),
    draw: drawLines(0),
    swatch: [['min lines', colours.min]],
  },
  {
    name: 'max-lines',
    group: 'On the input',
    label: 'max lines',
    of: 'surface',
    available: has('line_table'),
    draw: drawLines(1),
    swatch: [['max lines', colours.max]],
  },
  {
    name: 'samples',
    group: 'On the input',
    label: 'isotropic samples',
    of: 'surface',
    available: has('sample_faces'),
    draw: (s, d) =>
      dotsOf(s.places(d, 'sample'), { colours: repeat(rgb(colours.sample), s.arrays.sample_faces.length), size: 6 }),
    swatch: [['isotropic samples', colours.sample, 'disc']],
  },
  {
    name: 'umbilics',
    group: 'On the input',
    label: 'umbilics',
    of: 'surface',
    available: has('umbilic_wedge'),
    draw: drawUmbilics,
    swatch: [
      ['wedges', colours.wedge, 'disc'],
      ['trisectors', colours.trisector, 'triangle'],
    ],
  },

  { name: 'degree', group: 'Colour of the result', label: 'degree', of: 'result', field: true, available: always },
  {
    name: 'error',
    group: 'Colour of the result',
    label: 'error',
    of: 'result',
    field: true,
    available: has('face_error'),
  },
  { name: 'bend', group: 'Colour of the result', label: 'bend', of: 'result', field: true, available: always },

  {
    name: 'polygons',
    group: 'On the result',
    label: 'edges',
    of: 'result',
    available: always,
    draw: drawResultEdges(false),
  },
  {
    name: 'edge-kinds',
    group: 'On the result',
    label: 'edges by kind',
    of: 'result',
    available: has('edge_kind'),
    draw: drawResultEdges(true),
    swatch: edgeKinds,
  },
  {
    name: 'origins',
    group: 'On the result',
    label: 'vertices by origin',
    of: 'result',
    available: has('origin'),
    draw: drawOrigins,
    swatch: origins.map(([what, colour]) => [what, colour, 'disc']),
  },
  {
    name: 'plane-polygons',
    group: 'On the result',
    label: 'polygons in the plane',
    of: 'both',
    available: (model, surface) => Boolean(surface && surface.arrays.uv && model.arrays.source_faces),
  },
];

export const layerOf = Object.fromEntries(layers.map((layer) => [layer.name, layer]));
