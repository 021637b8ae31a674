// Principal directions as small crosses whose arms are as long as the curvatures (in the plane: stretched as it is), on vertices spread evenly over the surface.
/** At most about this many crosses: more are a carpet. */
const wanted = 2600;

/** One vertex a cell of a grid over space. */
function spread(surface) {
  const p = surface.points;
  const n = surface.vertexCount;
  if (n <= wanted) return { vertices: Array.from({ length: n }, (_, i) => i), cell: 1.1 / Math.sqrt(n) };
  let area = 0;
  const q = surface.corners.space;
  for (let i = 0; i < q.length; i += 9) {
    const [ax, ay, az] = [q[i + 3] - q[i], q[i + 4] - q[i + 1], q[i + 5] - q[i + 2]];
    const [bx, by, bz] = [q[i + 6] - q[i], q[i + 7] - q[i + 1], q[i + 8] - q[i + 2]];
    area += Math.hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx) / 2;
  }
  const cell = Math.sqrt((1.5 * area) / wanted); // a surface cuts about 1.5 cells for each cell's side squared of area
  const nearest = new Map();
  for (let v = 0; v < n; ++v) {
    let key = 0;
    let distance = 0;
    for (let c = 0; c < 3; ++c) {
      const x = p[3 * v + c] / cell;
      key = key * 4096 + Math.floor(x) + 2048;
      distance += (x - Math.floor(x) - 0.5) ** 2;
    }
    const old = nearest.get(key);
    if (!old || distance < old.distance) nearest.set(key, { v, distance });
  }
  return { vertices: [...nearest.values()].map((x) => x.v), cell: 1.25 * cell };
}

/** For each vertex one triangle around it, as the index of its first corner. */
function anyTriangle(surface) {
  const out = new Uint32Array(surface.vertexCount);
  surface.triangles.forEach((v, i) => (out[v] = i - (i % 3)));
  return out;
}

/** Carries a vector lying in the first triangle to the second, both given by three points: through barycentric coordinates. */
function carry(d, from, to) {
  const e = [0, 1, 2].map((c) => from[3 + c] - from[c]);
  const f = [0, 1, 2].map((c) => from[6 + c] - from[c]);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const [ee, ef, ff, de, df] = [dot(e, e), dot(e, f), dot(f, f), dot(d, e), dot(d, f)];
  const det = ee * ff - ef * ef;
  if (!(det > 0)) return [0, 0, 0];
  const s = (ff * de - ef * df) / det;
  const t = (ee * df - ef * de) / det;
  return [0, 1, 2].map((c) => s * (to[3 + c] - to[c]) + t * (to[6 + c] - to[c]));
}

/** The eigenvalues and eigenvectors of a tensor (uu, uv, vv). */
function eigen(uu, uv, vv) {
  const mean = (uu + vv) / 2;
  const radius = Math.hypot((uu - vv) / 2, uv);
  const angle = Math.atan2(uv, (uu - vv) / 2) / 2;
  const max = [Math.cos(angle), Math.sin(angle), 0];
  return { k: [mean - radius, mean + radius], d: [[-max[1], max[0], 0], max] };
}

/** \param source estimated: gamma_min and gamma_max; smoothed: what smooth_tensors() made of them, in the plane or on the surface
 *  \returns segments, and for each whether it is the max direction */
export function crossSegments(surface, domain, source) {
  const a = surface.arrays;
  const { vertices, cell } = spread(surface);
  const triangle = anyTriangle(surface);
  const inPlane = source === 'smoothed' && a.uv && a.tensor2d;
  const home = inPlane ? 'plane' : 'space'; // where the directions are given
  const crosses = vertices.map((v) => {
    if (inPlane) return { v, ...eigen(a.tensor2d[3 * v], a.tensor2d[3 * v + 1], a.tensor2d[3 * v + 2]) };
    if (source === 'smoothed')
      return {
        v,
        k: [...a.smoothed_k.subarray(2 * v, 2 * v + 2)],
        d: [a.smoothed_min, a.smoothed_max].map((g) => [...g.subarray(3 * v, 3 * v + 3)]),
      };
    return {
      v,
      k: [a.k_min[v], a.k_max[v]],
      d: [a.gamma_min, a.gamma_max].map((g) => [...g.subarray(3 * v, 3 * v + 3)]),
    };
  });
  // Full length at what all but a tenth stay below: a few creases would leave everything else dots.
  const sizes = Float32Array.from(crosses.flatMap((x) => x.k.map(Math.abs))).sort();
  const full = sizes[Math.floor(0.9 * (sizes.length - 1))] || 1;
  const segments = new Float32Array(12 * crosses.length);
  const kinds = [];
  crosses.forEach(({ v, k, d }, i) => {
    const at = surface.pointsIn(domain).subarray(3 * v, 3 * v + 3);
    for (let kind = 0; kind < 2; ++kind) {
      let arm = d[kind];
      if (home !== domain) {
        const t = 3 * triangle[v];
        arm = carry(arm, surface.corners[home].subarray(t, t + 9), surface.corners[domain].subarray(t, t + 9));
      }
      const length = Math.hypot(...arm) || 1;
      const stretch = domain === 'plane' && a.stretch ? Math.sqrt(a.stretch[v]) : 1;
      const half = 0.5 * cell * stretch * (0.08 + 0.92 * Math.min(Math.abs(k[kind]) / full, 1));
      for (let c = 0; c < 3; ++c) {
        segments[12 * i + 6 * kind + c] = at[c] - (half * arm[c]) / length;
        segments[12 * i + 6 * kind + 3 + c] = at[c] + (half * arm[c]) / length;
      }
      kinds.push(kind);
    }
  });
  return { segments, kinds };
}
