// How things are drawn: shaded faces, lines some pixels wide, dots. Lines and dots are moved towards the eye by `bias` (in units of the
// scene, whose diagonal is 1), so that what lies on the surface is not half hidden by it.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  GLSL3,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  Mesh,
  RawShaderMaterial,
  Points,
  Vector2,
} from 'three';

/** Of all cameras: the eye is depth/2 from the middle of the scene. */
export const depth = 8;

const head = 'precision highp float; uniform mat4 modelViewMatrix, projectionMatrix; uniform float bias;';
const shift = `gl_Position.z -= bias * 2.0 / float(${depth}) * gl_Position.w;`;

/** Triangles with a colour and a normal at each corner. */
export function facesOf(points, normals, lit) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(points, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  geometry.setAttribute('colour', new BufferAttribute(new Uint8Array(points.length), 3, true));
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    side: DoubleSide,
    uniforms: { lit: { value: lit ? 1 : 0 } },
    vertexShader: `precision highp float; uniform mat4 modelViewMatrix, projectionMatrix; uniform mat3 normalMatrix;
      in vec3 position, normal, colour; out vec3 n, c;
      void main() { n = normalMatrix * normal; c = colour; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: `precision highp float; uniform float lit; in vec3 n, c; out vec4 result;
      void main() {
        vec3 m = normalize(n) * (gl_FrontFacing ? 1.0 : -1.0);
        float light = 0.5 + 0.5 * max(dot(m, normalize(vec3(-0.35, 0.45, 1.0))), 0.0);
        vec3 seen = gl_FrontFacing ? c : mix(c, vec3(0.35, 0.3, 0.28), 0.55);
        result = vec4(seen * mix(1.0, light, lit), 1.0);
      }`,
  });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}

/** Segments of six numbers each, `width` pixels wide; `colour` for all, or a colour (0 to 255) for each. Four vertices a segment, not
 *  instances: software renderers draw each instance by itself, which takes ten times as long. */
export function segmentsOf(segments, { colour, colours, width = 1.6, bias = 0.004 }) {
  const count = segments.length / 6;
  const ends = new Float32Array(24 * count);
  const corners = new Int8Array(8 * count);
  const index = new Uint32Array(6 * count);
  for (let i = 0; i < count; ++i) {
    for (let k = 0; k < 4; ++k) ends.set(segments.subarray(6 * i, 6 * i + 6), 24 * i + 6 * k);
    corners.set([-1, -1, 1, -1, 1, 1, -1, 1], 8 * i);
    index.set(
      [0, 1, 2, 0, 2, 3].map((k) => 4 * i + k),
      6 * i,
    );
  }
  const geometry = new BufferGeometry();
  const buffer = new InterleavedBuffer(ends, 6);
  geometry.setAttribute('position', new InterleavedBufferAttribute(buffer, 3, 0));
  geometry.setAttribute('end', new InterleavedBufferAttribute(buffer, 3, 3));
  geometry.setAttribute('corner', new BufferAttribute(corners, 2));
  geometry.setIndex(new BufferAttribute(index, 1));
  if (colours) {
    const each = new Uint8Array(12 * count);
    for (let i = 0; i < 12 * count; ++i) each[i] = colours[3 * Math.floor(i / 12) + (i % 3)];
    geometry.setAttribute('colour', new BufferAttribute(each, 3, true));
  }
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    side: DoubleSide,
    uniforms: {
      viewport: { value: new Vector2(1, 1) },
      width: { value: width },
      bias: { value: bias },
      tint: { value: (colour ?? [0, 0, 0]).map((x) => x / 255) },
    },
    vertexShader: `${head} uniform vec2 viewport; uniform float width; in vec3 position, end; in vec2 corner;
      ${colours ? 'in vec3 colour;' : 'uniform vec3 tint;'} out vec3 c;
      void main() {
        vec4 a = projectionMatrix * modelViewMatrix * vec4(position, 1.0), b = projectionMatrix * modelViewMatrix * vec4(end, 1.0);
        vec2 along = (b.xy - a.xy) * viewport;
        along = length(along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
        vec2 across = vec2(-along.y, along.x);
        gl_Position = corner.x < 0.0 ? a : b;
        gl_Position.xy += (across * corner.y + along * corner.x * 0.5) * width / viewport;
        ${shift}
        c = ${colours ? 'colour' : 'tint'};
      }`,
    fragmentShader: 'precision highp float; in vec3 c; out vec4 result; void main() { result = vec4(c, 1.0); }',
  });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}

/** Dots of `size` pixels with a dark rim; shape 1 is a triangle, 0 a disc. */
export function dotsOf(points, { colours, shapes, size = 9, bias = 0.01 }) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(points, 3));
  geometry.setAttribute('colour', new BufferAttribute(colours, 3, true));
  geometry.setAttribute('shape', new BufferAttribute(shapes ?? new Float32Array(points.length / 3), 1));
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    uniforms: { size: { value: size }, ratio: { value: 1 }, bias: { value: bias } },
    vertexShader: `${head} uniform float size, ratio; in vec3 position, colour; in float shape; out vec3 c; flat out float s;
      void main() {
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        ${shift}
        gl_PointSize = size * ratio * (shape > 0.5 ? 1.3 : 1.0);
        c = colour; s = shape;
      }`,
    fragmentShader: `precision highp float; in vec3 c; flat in float s; out vec4 result;
      void main() {
        vec2 p = gl_PointCoord * 2.0 - 1.0;
        float r = s > 0.5 ? max(abs(p.x) * 1.7 - p.y * 0.9 + 0.1, p.y + 0.2) : length(p);
        if (r > 1.0) discard;
        result = vec4(r > 0.72 ? vec3(0.0) : c, 1.0);
      }`,
  });
  const dots = new Points(geometry, material);
  dots.frustumCulled = false;
  return dots;
}
