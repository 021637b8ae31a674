// Panes beside each other on one canvas: where they are, drawing them, and the pointer.
import { ColorManagement, LinearSRGBColorSpace, Vector3, WebGLRenderer } from 'three';
import { chooseEye, upFor, View } from './camera.js';
import { Describer } from './describe.js';
import { drawLabels, legendHeight, titleHeight } from './legend.js';
import { firstTriangle } from './pick.js';

const paneNames = ['surface', 'plane', 'result', 'overlay'];
const pickRadius = 7; // pixels
const pageLegend = 92;

export class Viewer {
  constructor(header, stage, drawing, labels) {
    ColorManagement.enabled = false; // colours are what colour.js says
    this.header = header;
    this.stage = stage;
    this.drawing = drawing;
    this.labels = labels;
    this.describer = new Describer(header);
    this.renderer = new WebGLRenderer({
      canvas: drawing,
      antialias: true,
      preserveDrawingBuffer: Boolean(header.picture),
    });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.autoClear = false;
    this.renderer.sortObjects = false; // depth decides
    this.renderer.debug.checkShaderErrors = false; // asking would wait for the compiler
    this.space = new View(true);
    this.plane = new View(false);
    this.onPick = () => {};
  }

  /** \param ratio device pixels a pixel */
  resize(width, height, ratio) {
    this.width = width;
    this.height = height;
    this.ratio = ratio;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.labels.width = Math.round(width * ratio);
    this.labels.height = Math.round(height * ratio);
  }

  /** The panes that are on, with their boxes in pixels; `inner` is between title and legend. */
  panes() {
    const on = paneNames.filter((name) => this.stage.isOn(name));
    const context = this.labels.getContext('2d');
    const width = Math.floor(this.width / Math.max(on.length, 1));
    const needed = Math.max(0, ...on.map((name) => legendHeight(context, this.stage, name, width)));
    // On a page the legend's room is fixed, so that switching a layer moves nothing; a longer legend covers a little of the drawing.
    const legend = this.header.picture ? needed : pageLegend;
    return on.map((name, i) => {
      const box = {
        x: i * width,
        y: 0,
        width: i === on.length - 1 ? this.width - i * width : width - 1,
        height: this.height,
      };
      return {
        name,
        box,
        legend: Math.max(legend, needed),
        inner: { x: box.x, y: titleHeight, width: box.width, height: Math.max(this.height - titleHeight - legend, 1) },
      };
    });
  }

  /** Width over height of the narrowest pane; infinite where there is none. */
  aspect() {
    return Math.min(...this.panes().map((p) => p.inner.width / p.inner.height));
  }

  spacePoints() {
    return this.stage.surface?.points ?? this.stage.result.points;
  }

  /** After the page has another size: what was in a pane stays in it. */
  resizeKeepingView(width, height, ratio) {
    const before = this.aspect();
    this.resize(width, height, ratio);
    const after = this.aspect();
    if (before === after || !Number.isFinite(before)) return;
    this.space.refit(this.spacePoints(), before, after);
    if (this.stage.surface?.planePoints) this.plane.refit(this.stage.surface.planePoints, before, after);
  }

  /** Looks at everything from the direction asked for, or from where most is seen. */
  fit() {
    const aspect = this.aspect();
    if (!Number.isFinite(aspect)) return;
    const { stage, header } = this;
    const chosen = chooseEye(stage.surface?.meanNormal() ?? [0, 0, 0]);
    const eye = header.eye ? new Vector3(...header.eye) : chosen.eye;
    const up = header.up ? new Vector3(...header.up) : header.eye ? upFor(eye) : chosen.up;
    this.space.fit(this.spacePoints(), aspect, eye, up);
    this.space.halfHeight /= header.zoom;
    if (header.middle) this.space.middle.set(...header.middle.map((x, c) => (x - header.centre[c]) / header.scale));
    if (stage.surface?.planePoints) this.plane.fit(stage.surface.planePoints, aspect);
  }

  /** After a pane came or went: as large as before in its pane, or as much as fits where it is narrower now. */
  fitPanes() {
    const { orientation } = this.space;
    const kept = orientation.clone();
    this.fit();
    const aspect = this.aspect();
    if (!Number.isFinite(aspect)) return;
    orientation.copy(kept);
    this.space.fit(this.spacePoints(), aspect);
  }

  viewOf(pane) {
    return pane.name === 'plane' ? this.plane : this.space;
  }

  draw() {
    const { renderer, stage } = this;
    const context = this.labels.getContext('2d');
    renderer.setScissorTest(false);
    renderer.setClearColor(0xffffff, 1);
    renderer.clear();
    renderer.setScissorTest(true);
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    const panes = this.panes();
    panes.forEach((pane, i) => {
      const { x, y, width, height } = pane.inner;
      renderer.setViewport(x, this.height - y - height, width, height);
      renderer.setScissor(x, this.height - y - height, width, height);
      const camera = this.viewOf(pane).at(width / height);
      for (const name of { surface: ['space'], plane: ['plane'], result: ['result'], overlay: ['space', 'over'] }[
        pane.name
      ]) {
        const scene = stage.scenes[name];
        scene.traverse((object) => {
          object.material?.uniforms?.viewport?.value.set(width, height);
          if (object.material?.uniforms?.ratio) object.material.uniforms.ratio.value = this.ratio;
        });
        renderer.render(scene, camera);
      }
      drawLabels(context, stage, pane.name, pane.box, pane.legend);
      if (i > 0) {
        context.fillStyle = '#c4cad1';
        context.fillRect(pane.box.x - 1, 0, 1, this.height);
      }
    });
    this.frames = (this.frames ?? 0) + 1;
  }

  /** Draws once, soon, however often it is asked. */
  soon() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.draw();
    });
  }

  paneAt(x, y) {
    return this.panes().find(
      ({ inner }) => x >= inner.x && x < inner.x + inner.width && y >= inner.y && y < inner.y + inner.height,
    );
  }

  /** What is under a point of the canvas. */
  pick(x, y) {
    const { stage } = this;
    const pane = this.paneAt(x, y);
    if (!pane) return;
    const { inner } = pane;
    const view = this.viewOf(pane);
    const camera = view.at(inner.width / inner.height);
    const on = new Vector3(((x - inner.x) / inner.width) * 2 - 1, 1 - ((y - inner.y) / inner.height) * 2, -1).unproject(
      camera,
    );
    const along = new Vector3(0, 0, -1).applyQuaternion(view.orientation);
    const radius = (pickRadius * 2 * view.halfHeight) / inner.height;
    // Where a result is laid over its input both are under the pointer: what is on top comes first.
    const scenes = { surface: ['space'], plane: ['plane'], result: ['result'], overlay: ['over', 'space'] }[pane.name];
    const picked = scenes.map((scene) => ({ scene, things: this.thingsAt(scene, on, along, radius) }));
    stage.mark(picked.map(({ scene, things }) => [scene, things.flatMap((thing) => [...(thing.marks ?? [])])]));
    const things = picked.flatMap(({ things }) => things);
    this.onPick(pane.name, things);
    this.soon();
  }

  /** What a ray meets of a scene. */
  thingsAt(scene, on, along, radius) {
    const { stage, describer } = this;
    const ofResult = scene === 'result' || scene === 'over';
    const points = ofResult ? stage.result?.cornerPoints : stage.surface?.corners[scene];
    const hit = points && firstTriangle(points, on.toArray(), along.toArray());
    if (!hit) return [];
    return ofResult ? describer.result(stage, hit, radius) : describer.surface(stage, scene, hit, radius);
  }

  /** Dragging turns (with Shift, or the right button, moves), the wheel grows, a click picks, a double click looks at everything. */
  listen() {
    const { drawing } = this;
    let from = null;
    const local = (event) => {
      const box = drawing.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    drawing.addEventListener('pointerdown', (event) => {
      const [x, y] = local(event);
      from = { x, y, moved: 0, pane: this.paneAt(x, y), move: event.shiftKey || event.button !== 0 };
      drawing.setPointerCapture(event.pointerId);
    });
    drawing.addEventListener('pointermove', (event) => {
      if (!from?.pane) return;
      const [x, y] = local(event);
      const [dx, dy] = [x - from.x, y - from.y];
      from.moved += Math.abs(dx) + Math.abs(dy);
      if (from.moved < 4) return;
      const view = this.viewOf(from.pane);
      if (from.move || !view.turns) view.move(dx, dy, from.pane.inner.height);
      else view.turn(dx, dy, from.pane.inner.height);
      [from.x, from.y] = [x, y];
      this.soon();
    });
    drawing.addEventListener('pointerup', (event) => {
      if (from && from.moved < 4 && event.button === 0) this.pick(...local(event));
      from = null;
    });
    drawing.addEventListener('pointercancel', () => (from = null));
    drawing.addEventListener('contextmenu', (event) => event.preventDefault());
    drawing.addEventListener(
      'wheel',
      (event) => {
        const [x, y] = local(event);
        const pane = this.paneAt(x, y);
        if (!pane) return;
        event.preventDefault();
        const { inner } = pane;
        this.viewOf(pane).grow(
          Math.exp(-event.deltaY / 500),
          ((x - inner.x) / inner.width) * 2 - 1,
          1 - ((y - inner.y) / inner.height) * 2,
          inner.width / inner.height,
        );
        this.soon();
      },
      { passive: false },
    );
    drawing.addEventListener('dblclick', () => {
      this.fit();
      this.soon();
    });
  }
}
