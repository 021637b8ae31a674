// The input: triangles in space and, where it has uv, in the plane, with points on them given by face and barycentric coordinates.

const creaseCosine = Math.cos((40 * Math.PI) / 180);

export class Surface {
  constructor(model) {
    this.name = model.name;
    this.numbers = model.numbers;
    this.arrays = model.arrays;
    this.points = model.arrays.points;
    this.triangles = model.arrays.triangles;
    this.vertexCount = this.points.length / 3;
    this.faceCount = this.triangles.length / 3;
    this.planePoints = model.arrays.uv ? this.#centredPlane(model.arrays.uv) : null;
    this.corners = { space: this.#expand(this.points), plane: this.planePoints && this.#expand(this.planePoints) };
  }

  /** (u, v, 0) around the middle of the plane's box. */
  #centredPlane(uv) {
    const low = [Infinity, Infinity];
    const high = [-Infinity, -Infinity];
    for (let i = 0; i < uv.length; ++i) {
      low[i % 2] = Math.min(low[i % 2], uv[i]);
      high[i % 2] = Math.max(high[i % 2], uv[i]);
    }
    const out = new Float32Array((uv.length / 2) * 3);
    for (let v = 0; v < uv.length / 2; ++v)
      for (let c = 0; c < 2; ++c) out[3 * v + c] = uv[2 * v + c] - (low[c] + high[c]) / 2;
    return out;
  }

  /** Three points a triangle. */
  #expand(points) {
    const out = new Float32Array(this.triangles.length * 3);
    for (let i = 0; i < this.triangles.length; ++i) {
      const v = 3 * this.triangles[i];
      out[3 * i] = points[v];
      out[3 * i + 1] = points[v + 1];
      out[3 * i + 2] = points[v + 2];
    }
    return out;
  }

  pointsIn(domain) {
    return domain === 'plane' ? this.planePoints : this.points;
  }

  /** Writes the surface point with these first two barycentric coordinates to out[at...at + 2]. */
  place(domain, face, a, b, out, at) {
    const points = this.corners[domain];
    const c = 1 - a - b;
    for (let i = 0; i < 3; ++i)
      out[at + i] = a * points[9 * face + i] + b * points[9 * face + 3 + i] + c * points[9 * face + 6 + i];
  }

  /** The surface points kept under KEY_faces and KEY_shares, as positions. */
  places(domain, key) {
    const faces = this.arrays[`${key}_faces`];
    const shares = this.arrays[`${key}_shares`];
    const out = new Float32Array(3 * faces.length);
    for (let i = 0; i < faces.length; ++i)
      this.place(domain, faces[i], shares[2 * i] / 65535, shares[2 * i + 1] / 65535, out, 3 * i);
    return out;
  }

  /** Line i: its kind, ends and the range of its points. */
  line(i) {
    const t = this.arrays.line_table;
    const end = 5 * (i + 1) < t.length ? t[5 * (i + 1) + 4] : this.arrays.line_faces.length;
    return {
      kind: t[5 * i],
      closed: t[5 * i + 1] === 1,
      begin: t[5 * i + 2],
      end: t[5 * i + 3],
      first: t[5 * i + 4],
      last: end,
    };
  }

  get lineCount() {
    return this.arrays.line_table ? this.arrays.line_table.length / 5 : 0;
  }

  /** Normals at the corners of the triangles, averaged over the faces around the vertex that make no crease with this one. */
  cornerNormals() {
    const { triangles, faceCount, vertexCount } = this;
    const points = this.corners.space;
    const faceNormals = new Float32Array(3 * faceCount);
    const units = new Float32Array(3 * faceCount);
    for (let f = 0; f < faceCount; ++f) {
      const p = 9 * f;
      const [ax, ay, az] = [points[p + 3] - points[p], points[p + 4] - points[p + 1], points[p + 5] - points[p + 2]];
      const [bx, by, bz] = [points[p + 6] - points[p], points[p + 7] - points[p + 1], points[p + 8] - points[p + 2]];
      const n = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
      const length = Math.hypot(...n) || 1;
      for (let i = 0; i < 3; ++i) {
        faceNormals[3 * f + i] = n[i];
        units[3 * f + i] = n[i] / length;
      }
    }
    const first = new Uint32Array(vertexCount + 1);
    for (const v of triangles) ++first[v + 1];
    for (let v = 0; v < vertexCount; ++v) first[v + 1] += first[v];
    const around = new Uint32Array(triangles.length);
    const next = first.slice();
    for (let i = 0; i < triangles.length; ++i) around[next[triangles[i]]++] = Math.floor(i / 3);
    const out = new Float32Array(points.length);
    for (let i = 0; i < triangles.length; ++i) {
      const f = 3 * Math.floor(i / 3);
      for (let k = first[triangles[i]]; k < first[triangles[i] + 1]; ++k) {
        const g = 3 * around[k];
        if (units[f] * units[g] + units[f + 1] * units[g + 1] + units[f + 2] * units[g + 2] < creaseCosine) continue;
        for (let c = 0; c < 3; ++c) out[3 * i + c] += faceNormals[g + c];
      }
    }
    return out;
  }

  /** The mean of the triangles' unit normals, each counting alike: where the side with most detail looks to. About zero for a closed
   *  surface that is meshed evenly. */
  meanNormal() {
    const sum = [0, 0, 0];
    const p = this.corners.space;
    for (let i = 0; i < p.length; i += 9) {
      const a = [p[i + 3] - p[i], p[i + 4] - p[i + 1], p[i + 5] - p[i + 2]];
      const b = [p[i + 6] - p[i], p[i + 7] - p[i + 1], p[i + 8] - p[i + 2]];
      const n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
      const length = Math.hypot(...n) || 1;
      for (let c = 0; c < 3; ++c) sum[c] += n[c] / length;
    }
    return sum.map((x) => x / this.faceCount);
  }

  /** A scalar field's values at the vertices, once computed. */
  values(name, field) {
    this.cache ??= {};
    return (this.cache[name] ??= Float32Array.from({ length: this.vertexCount }, (_, i) => field.of(this.arrays, i)));
  }
}
