// Titles and legends, drawn into the labels canvas, so that a picture has them as the page does.
import { colours, degreeColours, mapColour } from './colour.js';
import { formatTick, resultFields, surfaceFields } from './fields.js';
import { layerOf, layers } from './layers.js';

const font = '12px "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif';
const rowHeight = 19;
const barHeight = 46;
export const titleHeight = 24;

/** What a pane shows, in words, with a swatch each: [text, colour, shape]. */
function swatches(stage, pane) {
  const out = [];
  const { surface, result } = stage;
  const count = (n, what) => `${what} (${n})`;
  const ofPane = (layer) =>
    pane === 'overlay' || (pane === 'result' ? layer.group === 'On the result' : layer.group === 'On the input');
  const kindsInPlane = pane === 'plane' && stage.isOn('plane-polygons') && stage.isOn('edge-kinds');
  for (const layer of layers) {
    if (!layer.swatch || !stage.isOn(layer.name)) continue;
    if (!ofPane(layer) && !(layer.name === 'edge-kinds' && kindsInPlane)) continue;
    layer.swatch.forEach(([what, colour, shape], i) => {
      let text = what;
      if (layer.name === 'umbilics')
        text = count(surface.arrays.umbilic_wedge.filter((w) => (w ? 0 : 1) === i).length, what);
      if (layer.name === 'samples') text = count(surface.arrays.sample_faces.length, what);
      if (layer.name === 'min-lines' || layer.name === 'max-lines') {
        const kind = layer.name === 'min-lines' ? 0 : 1;
        text = count(
          Array.from({ length: surface.lineCount }, (_, k) => k).filter((k) => surface.line(k).kind === kind).length,
          what,
        );
      }
      if (layer.name === 'border') text = count(surface.arrays.border.length / 3, 'border edges');
      if (layer.name === 'features') text = count(surface.arrays.features.length / 3, 'feature edges');
      if (layer.name === 'edge-kinds')
        text = count(result.arrays.edge_kind.filter((k) => k === i).length, `${what} edges`);
      if (layer.name === 'origins') text = count(result.arrays.origin.filter((o) => o === i).length, what);
      if (!text.endsWith('(0)')) out.push([text, colour, shape]);
    });
  }
  if (pane === 'result' && stage.isOn('degree')) {
    const degrees = stage.result.values('degree');
    for (const [degree, colour] of Object.entries(degreeColours)) {
      const n = degrees.filter((d) => d === +degree || (degree === '7' && d > 7)).length;
      if (n) out.push([`${degree}${degree === '7' ? ' or more' : ''} corners (${n})`, colour, 'square']);
    }
  }
  return out;
}

function fieldIn(stage, pane) {
  const name = stage.fieldOf(pane === 'result' ? 'result' : 'surface');
  if (!name) return null;
  const field = (pane === 'result' ? resultFields : surfaceFields)[name];
  return field.categories ? null : { name, field, range: stage.ranges[name] };
}

/** Places swatches in rows; each gets x and row. */
function layOut(context, items, width) {
  let x = 10;
  let row = 0;
  const placed = items.map(([text, colour, shape]) => {
    const needed = 24 + context.measureText(text).width + 12;
    if (x > 10 && x + needed > width) {
      x = 10;
      ++row;
    }
    const at = { text, colour, shape, x, row };
    x += needed;
    return at;
  });
  return { placed, rows: items.length ? row + 1 : 0 };
}

/** The height that the legend of a pane needs. */
export function legendHeight(context, stage, pane, width) {
  context.font = font;
  return (fieldIn(stage, pane) ? barHeight : 0) + rowHeight * layOut(context, swatches(stage, pane), width).rows + 6;
}

function drawSwatch(context, { text, colour, shape, x }, y) {
  context.fillStyle = colour;
  context.strokeStyle = '#000000';
  context.lineWidth = 1.2;
  context.beginPath();
  if (shape === 'disc') context.arc(x + 9, y, 4.5, 0, 2 * Math.PI);
  else if (shape === 'triangle') {
    context.moveTo(x + 9, y - 6);
    context.lineTo(x + 15, y + 5);
    context.lineTo(x + 3, y + 5);
    context.closePath();
  } else if (shape === 'square') context.rect(x + 3, y - 6, 12, 12);
  else context.rect(x, y - 1.5, 18, 3);
  context.fill();
  if (shape) context.stroke();
  context.fillStyle = '#1c2126';
  context.fillText(text, x + 24, y + 4);
}

/** The bar of a colour map, as far as there are values; between its ends 0 is named, or the middle where 0 is too near to them. */
function drawBar(context, { field, range }, left, width, y) {
  const [x, w] = [left + 10, Math.min(width - 20, 300)];
  const { low, high, from, to } = range;
  const out = [0, 0, 0];
  for (let i = 0; i < w; ++i) {
    mapColour(field.map, (from + (i / (w - 1)) * (to - from) - low) / (high - low), out, 0);
    context.fillStyle = `rgb(${out})`;
    context.fillRect(x + i, y + 17, 1.5, 10);
  }
  context.fillStyle = '#1c2126';
  context.fillText(field.label, x, y + 12, width - 20);
  const texts = [from, to].map((end) => formatTick(field, end));
  const [first, last] = texts.map((text) => context.measureText(text).width);
  const zero = -from / (to - from);
  const text = formatTick(field, 0);
  const half = context.measureText(text).width / 2 + 8;
  const isZeroFree = field.diverging && zero * w > first + half && zero * w < w - last - half;
  const middle = isZeroFree ? text : formatTick(field, (from + to) / 2);
  context.fillText(texts[0], x, y + 40);
  context.fillText(middle, x + (isZeroFree ? zero : 0.5) * w - context.measureText(middle).width / 2, y + 40);
  context.fillText(texts[1], x + w - last, y + 40);
}

const titles = { surface: 'input', plane: 'input in the plane', result: 'result', overlay: 'result over input' };

/** Draws a pane's title above and its legend below; `box` is the whole pane, in pixels. */
export function drawLabels(context, stage, pane, box, height) {
  context.save();
  context.beginPath();
  context.rect(box.x, box.y, box.width, box.height);
  context.clip();
  context.fillStyle = colours.background;
  context.fillRect(box.x, box.y, box.width, titleHeight);
  context.fillRect(box.x, box.y + box.height - height, box.width, height);
  context.font = `bold ${font}`;
  context.fillStyle = '#1c2126';
  const { surface, result } = stage;
  const size =
    pane === 'result' || pane === 'overlay' ? `${result.faceCount} polygons` : `${surface.faceCount} triangles`;
  const name =
    pane === 'overlay' ? `${result.name} over ${surface.name}` : pane === 'result' ? result.name : surface.name;
  context.fillText(`${titles[pane]}`, box.x + 10, box.y + 16);
  const after = box.x + 18 + context.measureText(titles[pane]).width;
  context.font = font;
  context.fillStyle = '#5b636c';
  context.fillText(`${name}, ${size}`, after, box.y + 16, box.x + box.width - after - 4);
  let y = box.y + box.height - height;
  const shown = fieldIn(stage, pane);
  if (shown) {
    drawBar(context, shown, box.x, box.width, y);
    y += barHeight;
  }
  for (const item of layOut(context, swatches(stage, pane), box.width).placed)
    drawSwatch(context, { ...item, x: box.x + item.x }, y + rowHeight * item.row + 10);
  context.restore();
}

/** The layers a page begins with: what the latest stage left. */
export function firstLayers(stage) {
  const can = (name) => stage.available(layerOf[name]);
  const first = (...names) => names.find(can);
  const out = ['surface', 'plane', 'result'].filter(can);
  out.push(...['border', 'features', 'umbilics', 'min-lines', 'max-lines', 'polygons', 'degree'].filter(can));
  if (!can('min-lines')) out.push(...[first('smoothed-crosses', 'crosses'), first('mean')].filter(Boolean));
  return out;
}
