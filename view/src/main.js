// The page of anisomesh-view: reads what the app put in, fills the panels, draws. As a picture (header.picture) it draws once, synchronously,
// and leaves the PNG in the document.
import { readDocument } from './data.js';
import { firstLayers } from './legend.js';
import { fillControls, fillFacts } from './panel.js';
import { Result } from './result.js';
import { Stage } from './scene.js';
import { Surface } from './surface.js';
import { Viewer } from './viewer.js';

const paneNames = ['surface', 'plane', 'result', 'overlay'];

function say(id, text) {
  const pre = document.createElement('pre');
  pre.id = id;
  pre.textContent = text;
  document.body.replaceChildren(pre);
}

/** The layers asked for, with the panes that they are drawn in where none is asked for. */
function chooseLayers(header, stage) {
  if (!header.layers.length) return firstLayers(stage);
  const out = [...header.layers];
  if (!out.some((name) => paneNames.includes(name))) {
    const groups = out.map((name) => stage.groupOf(name));
    if (groups.some((group) => group?.endsWith('input'))) out.push('surface');
    if (out.some((name) => name === 'plane-polygons')) out.push('plane');
    if (out.some((name) => stage.groupOf(name)?.endsWith('result') && name !== 'plane-polygons')) out.push('result');
  }
  return out;
}

function picture(viewer, [width, height]) {
  viewer.resize(width, height, 1);
  viewer.fit();
  viewer.draw();
  const both = document.createElement('canvas');
  [both.width, both.height] = [width, height];
  const context = both.getContext('2d');
  context.drawImage(viewer.drawing, 0, 0);
  context.drawImage(viewer.labels, 0, 0);
  say('picture', both.toDataURL('image/png'));
}

function page(header, stage, viewer) {
  const main = document.getElementById('stage');
  const controls = document.getElementById('controls');
  const size = () => [main.clientWidth, main.clientHeight, Math.min(window.devicePixelRatio || 1, 2)];
  const chosen = (surface, result) => {
    stage.choose(surface, result);
    fillControls(controls, stage, viewer, chosen);
    viewer.fit();
    viewer.soon();
  };
  fillControls(controls, stage, viewer, chosen);
  viewer.onPick = fillFacts(document.getElementById('facts'), header.tables);
  viewer.resize(...size());
  viewer.fit();
  viewer.listen();
  viewer.draw();
  new ResizeObserver(() => {
    viewer.resizeKeepingView(...size());
    viewer.soon();
  }).observe(main);
}

try {
  const header = readDocument();
  const surfaces = header.models.filter((m) => m.role === 'surface').map((m) => new Surface(m));
  const results = header.models.filter((m) => m.role === 'result').map((m) => new Result(m, header.scale));
  const stage = new Stage(surfaces, results);
  for (const name of chooseLayers(header, stage)) stage.set(name, true);
  const viewer = new Viewer(header, stage, document.getElementById('drawing'), document.getElementById('labels'));
  window.anisomesh = viewer; // for a look from the browser's console
  if (header.picture) picture(viewer, header.picture);
  else page(header, stage, viewer);
} catch (error) {
  say('failure', `${error.message ?? error}`);
  throw error;
}
