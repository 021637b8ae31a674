// What is drawn: for each domain (the input in space, the input in the plane, the result) a scene whose layers are made when first shown.
import { Color, Scene } from 'three';
import { colours, degreeColours, mapColour, rgb, robustRange } from './colour.js';
import { resultFields, surfaceFields } from './fields.js';
import { layerOf, layers } from './layers.js';
import { facesOf, segmentsOf } from './materials.js';

const overlayBias = 0.012; // more than a result lies beside its input

/** Colours of `count` elements from a field's values, as bytes; NaN is grey. */
function coloursOf(field, values, range, count) {
  const out = new Uint8Array(3 * count);
  const missing = rgb(colours.missing);
  for (let i = 0; i < count; ++i) {
    const v = values[i];
    if (!Number.isFinite(v)) out.set(missing, 3 * i);
    else if (field.categories) out.set(rgb(degreeColours[Math.min(Math.max(v, 3), 7)]), 3 * i);
    else mapColour(field.map, (v - range.low) / (range.high - range.low), out, 3 * i);
  }
  return out;
}

export class Stage {
  constructor(surfaces, results) {
    this.surfaces = surfaces;
    this.results = results;
    this.on = new Set();
    // The last input has most on it: stages are named in order.
    this.choose(surfaces[surfaces.length - 1] ?? null, results[0] ?? null);
  }

  /** Which of the meshes are looked at. */
  choose(surface, result) {
    this.surface = surface;
    this.result = result;
    this.scenes = Object.fromEntries(['space', 'plane', 'result', 'over'].map((name) => [name, new Scene()]));
    for (const scene of Object.values(this.scenes)) scene.background = null;
    this.scenes.space.background =
      this.scenes.plane.background =
      this.scenes.result.background =
        new Color(colours.background);
    this.made = new Map();
    this.marked = [];
    this.ranges = {};
    if (surface) {
      this.inSpace = facesOf(surface.corners.space, surface.cornerNormals(), true);
      this.scenes.space.add(this.inSpace);
      if (surface.planePoints) {
        const upright = Float32Array.from({ length: surface.corners.plane.length }, (_, i) => (i % 3 === 2 ? 1 : 0));
        this.inPlane = facesOf(surface.corners.plane, upright, false);
        this.scenes.plane.add(this.inPlane);
      }
    }
    if (result) {
      this.ofResult = facesOf(result.cornerPoints, result.cornerNormals, true);
      this.scenes.result.add(this.ofResult);
      this.planeOfResult = result.planePoints(surface);
    }
    this.colourSurface();
    this.colourResult();
    for (const layer of layers) this.#show(layer);
  }

  available(layer) {
    if (layer.of === 'both') return Boolean(this.surface && this.result && layer.available(this.result, this.surface));
    const model = layer.of === 'surface' ? this.surface : this.result;
    return Boolean(model && layer.available(model, this.surface));
  }

  /** Switches a layer; of the colours of one mesh only one is on. */
  set(name, on) {
    const layer = layerOf[name];
    if (!layer || (on && !this.available(layer))) return;
    if (on) this.on.add(name);
    else this.on.delete(name);
    if (layer.field) {
      if (on)
        for (const other of layers)
          if (other.field && other.group === layer.group && other !== layer) this.on.delete(other.name);
      if (layer.of === 'surface') this.colourSurface();
      else this.colourResult();
    } else this.#show(layer);
    if (name === 'edge-kinds') {
      this.#show(layerOf['plane-polygons']);
      this.#show(layerOf.polygons);
    }
  }

  isOn(name) {
    return this.on.has(name) && this.available(layerOf[name]);
  }

  groupOf(name) {
    return layerOf[name]?.group;
  }

  fieldOf(of) {
    return layers.find((layer) => layer.field && layer.of === of && this.isOn(layer.name))?.name;
  }

  colourSurface() {
    if (!this.surface) return;
    const name = this.fieldOf('surface');
    const { vertexCount, triangles } = this.surface;
    let at;
    if (name) {
      const values = this.surface.values(name, surfaceFields[name]);
      const range = surfaceFields[name].range ?? robustRange(values, surfaceFields[name]);
      this.ranges[name] = range;
      at = coloursOf(surfaceFields[name], values, range, vertexCount);
    }
    const plain = rgb(colours.plain);
    for (const mesh of [this.inSpace, this.inPlane]) {
      if (!mesh) continue;
      const attribute = mesh.geometry.getAttribute('colour');
      for (let i = 0; i < triangles.length; ++i)
        for (let c = 0; c < 3; ++c) attribute.array[3 * i + c] = at ? at[3 * triangles[i] + c] : plain[c];
      attribute.needsUpdate = true;
    }
  }

  colourResult() {
    if (!this.result) return;
    const name = this.fieldOf('result');
    const { triangleFaces, faceCount } = this.result;
    let at;
    if (name) {
      const values = this.result.values(name);
      const range = resultFields[name].categories ? null : robustRange(values, resultFields[name]);
      this.ranges[name] = range;
      at = coloursOf(resultFields[name], values, range, faceCount);
    }
    const plain = rgb(colours.plain);
    const attribute = this.ofResult.geometry.getAttribute('colour');
    for (let t = 0; t < triangleFaces.length; ++t)
      for (let i = 0; i < 9; ++i) attribute.array[9 * t + i] = at ? at[3 * triangleFaces[t] + (i % 3)] : plain[i % 3];
    attribute.needsUpdate = true;
  }

  /** The layer's objects, made if they are to be seen and are not there yet. */
  #show(layer) {
    const wanted = this.isOn(layer.name);
    if (!this.made.has(layer.name)) {
      if (!wanted) return;
      this.made.set(layer.name, this.#make(layer));
    }
    for (const object of this.made.get(layer.name)) object.visible = wanted;
    // Edges by kind stand in for plain edges.
    const kinds = this.isOn('edge-kinds');
    const objects = this.made.get(layer.name);
    if (layer.name === 'polygons') for (const object of objects) object.visible = wanted && !kinds;
    if (layer.name === 'plane-polygons' && objects.length === 2)
      objects.forEach((object, i) => (object.visible = wanted && kinds === (i === 1)));
  }

  #make(layer) {
    const objects = [];
    const put = (scene, object) => {
      this.scenes[scene].add(object);
      objects.push(object);
    };
    if (layer.name === 'plane-polygons') {
      if (!this.planeOfResult) return objects;
      put('plane', layerOf.polygons.draw(this.result, this.planeOfResult, 0.01));
      if (this.result.arrays.edge_kind)
        put('plane', layerOf['edge-kinds'].draw(this.result, this.planeOfResult, 0.012));
    } else if (layer.draw && layer.of === 'surface') {
      put('space', layer.draw(this.surface, 'space'));
      if (this.surface.planePoints) put('plane', layer.draw(this.surface, 'plane'));
    } else if (layer.draw) {
      put('result', layer.draw(this.result, this.result.points, 0.003));
      put('over', layer.draw(this.result, this.result.points, overlayBias));
    }
    return objects;
  }

  /** Marks what was picked: pairs of a scene and segments in it, replacing the last marks. */
  mark(segmentsIn) {
    for (const object of this.marked) object.removeFromParent();
    this.marked = segmentsIn
      .filter(([, segments]) => segments.length > 0)
      .map(([scene, segments]) => {
        const object = segmentsOf(Float32Array.from(segments), { colour: rgb(colours.selected), width: 3.5, bias: 0.02 });
        this.scenes[scene].add(object);
        return object;
      });
  }
}
