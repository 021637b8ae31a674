// What a click shows: for each thing under the pointer a heading with its number, its properties, and the segments that mark it.
import { edgeKinds, origins } from './colour.js';
import { surfaceFields } from './fields.js';
import { lineSegments } from './layers.js';
import { nearestPoint, nearestSegment } from './pick.js';

const ends = ['an umbilic', 'a feature', 'the border', 'its own beginning', 'another line too near', 'the step limit'];
const show = (x) => String(+x.toPrecision(6));
const vector = (x) => `(${[...x].map(show).join(', ')})`;

/** The distance between two points at indices a and b of `points`. */
const distance = (points, a, b) => Math.hypot(...[0, 1, 2].map((c) => points[3 * a + c] - points[3 * b + c]));

export class Describer {
  /** \param header has the centre and scale that model units come from */
  constructor(header) {
    this.header = header;
  }

  #position(points, v) {
    return vector([0, 1, 2].map((c) => points[3 * v + c] * this.header.scale + this.header.centre[c]));
  }

  /** \param hit of firstTriangle in this domain \param radius within which something is under the pointer */
  surface(stage, domain, hit, radius) {
    const { surface } = stage;
    const a = surface.arrays;
    const face = hit.triangle;
    const corners = surface.triangles.subarray(3 * face, 3 * face + 3);
    const points = surface.pointsIn(domain);
    const things = [];
    const umbilic = a.umbilic_faces?.indexOf(face) ?? -1;
    const rows = [
      ['vertices', corners.join(', ')],
      ['barycentric', vector(hit.barycentric)],
    ];
    const at = [0, 1, 2].map((c) =>
      corners.reduce((sum, v, i) => sum + hit.barycentric[i] * surface.points[3 * v + c], 0),
    );
    rows.unshift(['position', vector(at.map((x, c) => x * this.header.scale + this.header.centre[c]))]);
    if (umbilic >= 0) rows.push(['umbilic', a.umbilic_wedge[umbilic] ? 'wedge, index +1/2' : 'trisector, index −1/2']);
    for (const [name, field] of Object.entries(surfaceFields))
      if (field.needs.every((need) => a[need])) {
        const values = surface.values(name, field);
        const value = corners.reduce((sum, v, i) => sum + hit.barycentric[i] * values[v], 0);
        rows.push([name === 'stretch' ? 'stretch' : name, show(name === 'stretch' ? 2 ** value : value)]);
      }
    things.push({ kind: 'face', title: 'Face', number: face, rows, marks: this.#outline(points, corners) });

    const corner = nearestPoint(
      Float32Array.from([...corners].flatMap((v) => [...points.subarray(3 * v, 3 * v + 3)])),
      hit.point,
      radius,
    );
    if (corner >= 0) things.push(this.#vertex(surface, corners[corner]));
    for (const [layer, kind] of [
      ['min-lines', 0],
      ['max-lines', 1],
    ])
      if (stage.isOn(layer)) {
        const { segments, owners } = lineSegments(surface, domain, kind);
        const i = nearestSegment(segments, hit.point, radius);
        if (i >= 0) things.push(this.#line(surface, owners[i], segments, owners));
      }
    for (const [layer, title] of [
      ['features', 'Feature edge'],
      ['border', 'Border edge'],
    ])
      if (stage.isOn(layer)) {
        const edges = a[layer];
        const segments = Float32Array.from(
          { length: 2 * edges.length },
          (_, k) => points[3 * edges[3 * Math.floor(k / 6) + 1 + (k % 6 > 2)] + (k % 3)],
        );
        const i = nearestSegment(segments, hit.point, radius);
        if (i >= 0)
          things.push({
            kind: 'edge',
            title,
            number: edges[3 * i],
            rows: [['vertices', `${edges[3 * i + 1]}, ${edges[3 * i + 2]}`]],
            marks: segments.subarray(6 * i, 6 * i + 6),
          });
      }
    if (stage.isOn('umbilics')) {
      const i = nearestPoint(surface.places(domain, 'umbilic'), hit.point, 1.5 * radius);
      if (i >= 0)
        things.push({
          kind: 'umbilic',
          title: 'Umbilic of face',
          number: a.umbilic_faces[i],
          rows: [['kind', a.umbilic_wedge[i] ? 'wedge, index +1/2' : 'trisector, index −1/2']],
        });
    }
    if (stage.isOn('samples')) {
      const i = nearestPoint(surface.places(domain, 'sample'), hit.point, radius);
      if (i >= 0)
        things.push({ kind: 'sample', title: 'Isotropic sample', number: i, rows: [['face', a.sample_faces[i]]] });
    }
    return things;
  }

  #outline(points, corners) {
    const out = [];
    for (let i = 0; i < corners.length; ++i)
      for (const v of [corners[i], corners[(i + 1) % corners.length]]) out.push(...points.subarray(3 * v, 3 * v + 3));
    return out;
  }

  #vertex(surface, v) {
    const a = surface.arrays;
    const rows = [['position', this.#position(surface.points, v)]];
    for (const [name, field] of Object.entries(surfaceFields))
      if (field.needs.every((need) => a[need]))
        rows.push([name, show(name === 'stretch' ? a.stretch[v] : field.of(a, v))]);
    for (const name of ['gamma_min', 'gamma_max'])
      if (a[name]) rows.push([name, vector(Array.from(a[name].subarray(3 * v, 3 * v + 3), (x) => x / 32767))]);
    if (a.uv) rows.push(['uv', vector([a.uv[2 * v] * this.header.scale, a.uv[2 * v + 1] * this.header.scale])]);
    if (a.tensor2d) rows.push(['tensor2d', vector(a.tensor2d.subarray(3 * v, 3 * v + 3))]);
    return { kind: 'vertex', title: 'Vertex', number: v, rows };
  }

  #line(surface, i, segments, owners) {
    const line = surface.line(i);
    const inSpace = surface.places('space', 'line');
    let length = line.closed ? distance(inSpace, line.last - 1, line.first) : 0;
    for (let p = line.first + 1; p < line.last; ++p) length += distance(inSpace, p - 1, p);
    const rows = [
      ['points', line.last - line.first],
      ['length', show(length * this.header.scale)],
    ];
    if (line.closed) rows.push(['closed', 'yes']);
    else rows.push(['begins at', ends[line.begin]], ['ends at', ends[line.end]]);
    const marks = [];
    owners.forEach((owner, s) => owner === i && marks.push(...segments.subarray(6 * s, 6 * s + 6)));
    return { kind: 'line', title: line.kind ? 'Max line' : 'Min line', number: i, rows, marks };
  }

  result(stage, hit, radius) {
    const { result } = stage;
    const a = result.arrays;
    const face = result.triangleFaces[hit.triangle];
    const corners = result.polygon(face);
    const rows = [
      ['corners', corners.length],
      ['vertices', corners.join(', ')],
      ['bend', `${show(result.bend(face))} degrees`],
    ];
    if (a.face_error)
      rows.push([
        'rms distance to the input',
        `${show(a.face_error[face])} (${show((100 * a.face_error[face]) / result.scale)} %)`,
      ]);
    const things = [
      { kind: 'polygon', title: 'Polygon', number: face, rows, marks: this.#outline(result.points, corners) },
    ];
    const near = nearestPoint(
      Float32Array.from([...corners].flatMap((v) => [...result.points.subarray(3 * v, 3 * v + 3)])),
      hit.point,
      radius,
    );
    if (near >= 0) {
      const v = corners[near];
      const vertex = [['position', this.#position(result.points, v)]];
      if (a.origin) vertex.push(['origin', origins[a.origin[v]]?.[0] ?? a.origin[v]]);
      if (a.source_faces) vertex.push(['from face', a.source_faces[v]]);
      if (a.error) vertex.push(['distance to the input', show(a.error[v])]);
      things.push({ kind: 'result-vertex', title: 'Vertex of the result', number: v, rows: vertex });
    }
    const edges = a.edges;
    const segments = new Float32Array(2 * edges.length);
    for (let k = 0; k < segments.length; ++k)
      segments[k] = result.points[3 * edges[3 * Math.floor(k / 6) + 1 + (k % 6 > 2)] + (k % 3)];
    const e = nearestSegment(segments, hit.point, radius);
    if (e >= 0) {
      const edge = [
        ['vertices', `${edges[3 * e + 1]}, ${edges[3 * e + 2]}`],
        ['length', show(distance(result.points, edges[3 * e + 1], edges[3 * e + 2]) * result.scale)],
      ];
      if (a.edge_kind) edge.push(['kind', edgeKinds[a.edge_kind[e]]?.[0] ?? a.edge_kind[e]]);
      things.push({
        kind: 'result-edge',
        title: 'Edge of the result',
        number: edges[3 * e],
        rows: edge,
        marks: segments.subarray(6 * e, 6 * e + 6),
      });
    }
    return things;
  }
}
