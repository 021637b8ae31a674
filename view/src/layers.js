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

function drawSamples(surface, domain) {
  return dotsOf(surface.places(domain, 'sample'), {
    colours: repeat(rgb(colours.sample), surface.arrays.sample_faces.length),
    size: 6,
  });
}

function drawTriangles(surface, domain) {
  const segments = edgeSegments(triangleEdges(surface), surface.pointsIn(domain));
  return segmentsOf(segments, { colour: rgb(colours.triangles), width: 1, bias: 0.001 });
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

/** The layers of one part of the panel: what they share, and what each adds to it. */
const group = (title, of, shared, ...members) =>
  members.map((member) => ({ group: title, of, available: always, ...shared, ...member }));

const curvatures = { available: has('k_min', 'k_max') };
const lines = (name, kind, colour) => ({
  name: `${name}-lines`,
  label: `${name} lines`,
  available: has('line_table'),
  draw: drawLines(kind),
  swatch: [[`${name} lines`, colour]],
});
const edges = (name, label, colour, width) => ({
  name,
  label,
  available: has(name),
  draw: drawEdges(name, colour, width),
  swatch: [[name, colour]],
});
const crosses = (name, label, source, swatch, available) => ({
  name,
  label,
  available,
  draw: drawCrosses(source),
  swatch: [
    [`${swatch}min direction`, colours.min],
    [`${swatch}max direction`, colours.max],
  ],
});

/** In the order of the panel. `of` is what a layer is drawn from. */
export const layers = [
  ...group(
    'Panes',
    'surface',
    {},
    { name: 'surface', label: 'input' },
    { name: 'plane', label: 'input in the plane', available: has('uv') },
    { name: 'result', label: 'result', of: 'result' },
    { name: 'overlay', label: 'result over input', of: 'both' },
  ),
  ...group(
    'Colour of the input',
    'surface',
    { field: true },
    { name: 'k-min', label: 'k_min', ...curvatures },
    { name: 'k-max', label: 'k_max', ...curvatures },
    { name: 'mean', label: 'mean curvature', ...curvatures },
    { name: 'gauss', label: 'Gaussian curvature', ...curvatures },
    { name: 'anisotropy', label: 'anisotropy', ...curvatures },
    { name: 'stretch', label: 'area stretch', available: has('stretch') },
  ),
  ...group(
    'On the input',
    'surface',
    {},
    { name: 'triangles', label: 'triangles', draw: drawTriangles },
    edges('border', 'border', colours.border, 2),
    edges('features', 'features', colours.feature, 3),
    edges('seams', 'seams of charts', colours.seam, 3),
    crosses('crosses', 'principal directions', 'estimated', '', has('k_min', 'k_max', 'gamma_min', 'gamma_max')),
    crosses(
      'smoothed-crosses',
      'smoothed directions',
      'smoothed',
      'smoothed ',
      (s) => has('uv', 'tensor2d')(s) || has('smoothed_k')(s),
    ),
    lines('min', 0, colours.min),
    lines('max', 1, colours.max),
    {
      name: 'samples',
      label: 'isotropic samples',
      available: has('sample_faces'),
      draw: drawSamples,
      swatch: [['isotropic samples', colours.sample, 'disc']],
    },
    {
      name: 'umbilics',
      label: 'umbilics',
      available: has('umbilic_wedge'),
      draw: drawUmbilics,
      swatch: [
        ['wedges', colours.wedge, 'disc'],
        ['trisectors', colours.trisector, 'triangle'],
      ],
    },
  ),
  ...group(
    'Colour of the result',
    'result',
    { field: true },
    { name: 'degree', label: 'degree' },
    { name: 'error', label: 'error', available: has('face_error') },
    { name: 'bend', label: 'bend' },
  ),
  ...group(
    'On the result',
    'result',
    {},
    { name: 'polygons', label: 'edges', draw: drawResultEdges(false) },
    {
      name: 'edge-kinds',
      label: 'edges by kind',
      available: has('edge_kind'),
      draw: drawResultEdges(true),
      swatch: edgeKinds,
    },
    {
      name: 'origins',
      label: 'vertices by origin',
      available: has('origin'),
      draw: drawOrigins,
      swatch: origins.map(([what, colour]) => [what, colour, 'disc']),
    },
    {
      name: 'plane-polygons',
      label: 'polygons in the plane',
      of: 'both',
      available: (model, surface) => Boolean(surface && surface.arrays.uv && model.arrays.source_faces),
    },
  ),
];

export const layerOf = Object.fromEntries(layers.map((layer) => [layer.name, layer]));
