// What lies under the pointer: the face that a ray meets first, and near that point a vertex, line, edge, umbilic or sample.

/** The first triangle of `points` (nine numbers each) that the ray from o along d meets: index, barycentric coordinates, point. */
export function firstTriangle(points, o, d) {
  let best = null;
  let nearest = Infinity;
  for (let t = 0; t < points.length; t += 9) {
    const ex = points[t + 3] - points[t],
      ey = points[t + 4] - points[t + 1],
      ez = points[t + 5] - points[t + 2];
    const fx = points[t + 6] - points[t],
      fy = points[t + 7] - points[t + 1],
      fz = points[t + 8] - points[t + 2];
    const px = d[1] * fz - d[2] * fy,
      py = d[2] * fx - d[0] * fz,
      pz = d[0] * fy - d[1] * fx;
    const det = ex * px + ey * py + ez * pz;
    if (det === 0) continue;
    const sx = o[0] - points[t],
      sy = o[1] - points[t + 1],
      sz = o[2] - points[t + 2];
    const b = (sx * px + sy * py + sz * pz) / det;
    if (b < 0 || b > 1) continue;
    const qx = sy * ez - sz * ey,
      qy = sz * ex - sx * ez,
      qz = sx * ey - sy * ex;
    const c = (d[0] * qx + d[1] * qy + d[2] * qz) / det;
    if (c < 0 || b + c > 1) continue;
    const distance = (fx * qx + fy * qy + fz * qz) / det;
    if (distance > 0 && distance < nearest) {
      nearest = distance;
      best = { triangle: t / 9, barycentric: [1 - b - c, b, c] };
    }
  }
  if (best) best.point = o.map((x, i) => x + nearest * d[i]);
  return best;
}

/** The segment nearest to a point and nearer than `radius`: its index, or -1. */
export function nearestSegment(segments, point, radius) {
  let best = -1;
  let least = radius * radius;
  for (let i = 0; i < segments.length; i += 6) {
    let ee = 0;
    let se = 0;
    for (let c = 0; c < 3; ++c) {
      const e = segments[i + 3 + c] - segments[i + c];
      ee += e * e;
      se += (point[c] - segments[i + c]) * e;
    }
    const t = ee > 0 ? Math.min(Math.max(se / ee, 0), 1) : 0;
    let distance = 0;
    for (let c = 0; c < 3; ++c)
      distance += (segments[i + c] + t * (segments[i + 3 + c] - segments[i + c]) - point[c]) ** 2;
    if (distance < least) {
      least = distance;
      best = i / 6;
    }
  }
  return best;
}

/** The point of `points` nearest to a point and nearer than `radius`: its index, or -1. */
export function nearestPoint(points, point, radius) {
  let best = -1;
  let least = radius * radius;
  for (let i = 0; i < points.length; i += 3) {
    const distance = (points[i] - point[0]) ** 2 + (points[i + 1] - point[1]) ** 2 + (points[i + 2] - point[2]) ** 2;
    if (distance < least) {
      least = distance;
      best = i / 3;
    }
  }
  return best;
}
