// A result: polygons, cut into triangles for drawing, with what can be said of each.
import { ShapeUtils, Vector2 } from 'three';

const sub = (p, a, b) => [p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const angle = (a, b) => (Math.atan2(Math.hypot(...cross(a, b)), dot(a, b)) * 180) / Math.PI;

export class Result {
  constructor(model, scale) {
    this.name = model.name;
    this.arrays = model.arrays;
    this.points = model.arrays.points;
    this.scale = scale;
    this.vertexCount = this.points.length / 3;
    this.faceCount = model.arrays.offsets.length - 1;
    this.edgeCount = model.arrays.edges.length / 3;
    this.#triangulate();
  }

  polygon(f) {
    return this.arrays.corners.subarray(this.arrays.offsets[f], this.arrays.offsets[f + 1]);
  }

  triangle(a, b, c) {
    return cross(sub(this.points, b, a), sub(this.points, c, a));
  }

  #triangulate() {
    const triangles = [];
    const faces = [];
    for (let f = 0; f < this.faceCount; ++f)
      for (const t of this.#cut(this.polygon(f))) {
        triangles.push(...t);
        faces.push(f);
      }
    this.triangleFaces = Uint32Array.from(faces);
    this.cornerPoints = new Float32Array(3 * triangles.length);
    this.cornerNormals = new Float32Array(3 * triangles.length);
    for (let i = 0; i < triangles.length; ++i)
      for (let c = 0; c < 3; ++c) this.cornerPoints[3 * i + c] = this.points[3 * triangles[i] + c];
    for (let t = 0; t < triangles.length; t += 3) {
      const n = this.triangle(...triangles.slice(t, t + 3));
      const length = Math.hypot(...n) || 1;
      for (let i = 0; i < 9; ++i) this.cornerNormals[3 * t + i] = n[i % 3] / length;
    }
  }

  /** A quad along the shorter diagonal that leaves no triangle turned over, as the ruler does; larger ones by ears. */
  #cut(p) {
    if (p.length === 3) return [[...p]];
    if (p.length === 4) {
      const along02 = [
        [p[0], p[1], p[2]],
        [p[0], p[2], p[3]],
      ];
      const along13 = [
        [p[1], p[2], p[3]],
        [p[1], p[3], p[0]],
      ];
      const turned = (cut) => dot(this.triangle(...cut[0]), this.triangle(...cut[1])) < 0;
      if (turned(along02) !== turned(along13)) return turned(along02) ? along13 : along02;
      const length = (a, b) => Math.hypot(...sub(this.points, a, b));
      return length(p[0], p[2]) <= length(p[1], p[3]) ? along02 : along13;
    }
    const n = [0, 0, 0];
    for (let i = 2; i < p.length; ++i) this.triangle(p[0], p[i - 1], p[i]).forEach((x, c) => (n[c] += x));
    const axis = Math.abs(n[0]) < Math.abs(n[1]) ? [1, 0, 0] : [0, 1, 0];
    const u = cross(axis, n);
    const length = Math.hypot(...u) || 1;
    const v = cross(n, u).map((x) => x / (length * (Math.hypot(...n) || 1)));
    const flat = [...p].map((q) => {
      const d = sub(this.points, q, p[0]);
      return new Vector2(dot(d, u) / length, dot(d, v));
    });
    return ShapeUtils.triangulateShape(flat, []).map((t) => t.map((i) => p[i]));
  }

  /** The angle that a quad is bent by along the diagonal where it is less: along the other one a corner that three edges pass straight
   *  through would count as a fold. For other polygons, of a corner to the whole. Degrees. */
  bend(f) {
    const p = this.polygon(f);
    if (p.length === 3) return 0;
    if (p.length === 4)
      return Math.min(
        angle(this.triangle(p[0], p[1], p[2]), this.triangle(p[0], p[2], p[3])),
        angle(this.triangle(p[1], p[2], p[3]), this.triangle(p[1], p[3], p[0])),
      );
    const n = [0, 0, 0];
    for (let i = 2; i < p.length; ++i) this.triangle(p[0], p[i - 1], p[i]).forEach((x, c) => (n[c] += x));
    let most = 0;
    for (let i = 0; i < p.length; ++i) {
      const corner = this.triangle(p[(i + p.length - 1) % p.length], p[i], p[(i + 1) % p.length]);
      most = Math.max(most, Math.min(angle(corner, n), 180 - angle(corner, n)));
    }
    return most;
  }

  /** A field's value at each face; nothing where it is not known. */
  values(name) {
    this.cache ??= {};
    const make = {
      degree: () => Float32Array.from({ length: this.faceCount }, (_, f) => this.polygon(f).length),
      error: () => this.arrays.face_error && this.arrays.face_error.map((e) => (100 * e) / this.scale),
      bend: () => Float32Array.from({ length: this.faceCount }, (_, f) => this.bend(f)),
    };
    return (this.cache[name] ??= make[name]());
  }

  /** Where the vertices lie in the plane of the surface they come from; nothing where that is not known. */
  planePoints(surface) {
    const faces = this.arrays.source_faces;
    if (!faces || !surface?.planePoints || faces.some((f) => f >= surface.faceCount)) return null;
    return surface.places.call({ arrays: this.arrays, place: surface.place.bind(surface) }, 'plane', 'source');
  }
}
