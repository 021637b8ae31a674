// The two ways of looking: one camera for everything in space, so that panes turn together, and one for the plane.
import { Matrix4, OrthographicCamera, Quaternion, Vector3 } from 'three';
import { depth } from './materials.js';

const fitting = (low, high, aspect) => 0.525 * Math.max(high[1] - low[1], (high[0] - low[0]) / aspect, 1e-6);

export class View {
  constructor(turns) {
    this.turns = turns; // false in the plane, which only moves and grows
    this.orientation = new Quaternion();
    this.middle = new Vector3();
    this.halfHeight = 0.5;
    this.camera = new OrthographicCamera(-1, 1, 1, -1, 0, depth);
  }

  /** Looks from `eye` with `up` upwards, at points so that all are seen in a pane of this width over height. */
  fit(points, aspect, eye, up) {
    if (eye) {
      const matrix = new Matrix4().lookAt(eye, new Vector3(), up);
      this.orientation.setFromRotationMatrix(matrix);
    }
    const { low, high, axes } = this.extent(points);
    this.middle.set(0, 0, 0);
    axes.forEach((axis, c) => this.middle.addScaledVector(axis, (low[c] + high[c]) / 2));
    this.halfHeight = fitting(low, high, aspect);
  }

  /** After a pane has another width over height: as large in what fits as before. */
  refit(points, before, after) {
    const { low, high } = this.extent(points);
    this.halfHeight *= fitting(low, high, after) / fitting(low, high, before);
  }

  /** The box of points along the axes of the view. */
  extent(points) {
    const axes = [0, 1, 2].map((c) => new Vector3().setComponent(c, 1).applyQuaternion(this.orientation));
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < points.length; i += 3)
      for (let c = 0; c < 3; ++c) {
        const x = points[i] * axes[c].x + points[i + 1] * axes[c].y + points[i + 2] * axes[c].z;
        if (x < low[c]) low[c] = x;
        if (x > high[c]) high[c] = x;
      }
    return { low, high, axes };
  }

  /** The camera for a pane of this width over height. */
  at(aspect) {
    const { camera } = this;
    camera.left = -this.halfHeight * aspect;
    camera.right = this.halfHeight * aspect;
    camera.top = this.halfHeight;
    camera.bottom = -this.halfHeight;
    camera.quaternion.copy(this.orientation);
    camera.position.copy(new Vector3(0, 0, depth / 2).applyQuaternion(this.orientation).add(this.middle));
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return camera;
  }

  /** Turns as a ball would that a pointer drags by dx, dy pixels. */
  turn(dx, dy, height) {
    const angle = (2.2 * Math.PI * Math.hypot(dx, dy)) / (2 * height);
    const axis = new Vector3(-dy, -dx, 0).normalize().applyQuaternion(this.orientation);
    this.orientation.premultiply(new Quaternion().setFromAxisAngle(axis, angle)).normalize();
  }

  move(dx, dy, height) {
    const unit = (2 * this.halfHeight) / height;
    this.middle.add(new Vector3(-dx * unit, dy * unit, 0).applyQuaternion(this.orientation));
  }

  /** Grows by `factor` about the point of the pane at x, y in [-1, 1]. */
  grow(factor, x, y, aspect) {
    const before = this.halfHeight;
    this.halfHeight = Math.min(Math.max(before / factor, 1e-4), 4);
    const by = before - this.halfHeight;
    this.middle.add(new Vector3(x * by * aspect, y * by, 0).applyQuaternion(this.orientation));
  }
}

/** The side that shows most, a little from above and from the side: that which most triangles look to, or a corner where they look
 *  everywhere. The y axis is up where it can be, else z. */
export function chooseEye(meanNormal) {
  const n = new Vector3(...meanNormal);
  const eye = n.length() < 0.1 ? new Vector3(0, 0, 1) : n.normalize();
  const up = Math.abs(eye.y) < 0.7 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);
  const right = new Vector3().crossVectors(up, eye).normalize();
  eye.applyAxisAngle(right, -0.25).applyAxisAngle(up, 0.4);
  return { eye, up };
}

export function upFor(eye) {
  const e = eye.clone().normalize();
  if (Math.abs(e.y) < 0.9) return new Vector3(0, 1, 0);
  return new Vector3(0, 0, e.y > 0 ? -1 : 1);
}
