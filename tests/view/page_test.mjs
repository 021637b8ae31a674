// The page as a person uses it: opened from a file in a real browser, layers switched, things clicked, turned.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { before, test } from 'node:test';
import { boxOf, differing, file, hues, makeKnown, must, near, openBrowser, screenshot } from './support.mjs';

let open;
before(async () => {
  makeKnown();
  // From the front, so that the square is a square.
  must('anisomesh-view', '-q', 'known.om', 'known-result.om', '-o', 'all.html', '--view', 'front');
  open = await openBrowser();
});

const show = (page, name, on = true) => page.locator(`[data-layer="${name}"]`).setChecked(on);
const settle = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const layerNames = (page) => page.locator('[data-layer]').evaluateAll((inputs) => inputs.map((i) => i.dataset.layer));

/** Switches everything off but these; the colours to none. */
async function only(page, ...names) {
  await page.evaluate((wanted) => {
    for (const input of document.querySelectorAll('[data-layer]')) {
      const on = wanted.includes(input.dataset.layer) || (input.dataset.layer.startsWith('no-') && !input.checked);
      if (input.checked !== on && (on || input.type === 'checkbox')) input.click();
    }
  }, names);
  await settle(page);
}

/** Where the point (u, v) of the square in a picture of the stage is on the page. */
async function place(page, box, u, v) {
  const stage = await page.locator('#stage').boundingBox();
  const [x, y] = box.at(u, v);
  return [stage.x + x, stage.y + y];
}

const picked = (page) =>
  page
    .locator('#picked section')
    .evaluateAll((all) =>
      Object.fromEntries(all.map((s) => [s.dataset.kind, { number: +s.dataset.number, text: s.innerText }])),
    );

test('opens from a file with no complaint and no request but for itself', async () => {
  const { page, complaints, requests } = await open('all.html');
  await settle(page);
  assert.deepEqual(requests, [`file://${file('all.html')}`]);
  assert.deepEqual(await page.evaluate(() => performance.getEntriesByType('resource').map((r) => r.name)), []);
  assert.deepEqual(complaints, []);
  assert.ok((await page.locator('h1').innerText()).includes('known.om'));
  await page.close();
});

test('has the layers that --help lists, no more and no fewer', async () => {
  const { page } = await open('all.html');
  const inPage = (await layerNames(page)).filter((name) => !name.startsWith('no-')).sort();
  const help = must('anisomesh-view', '--help').replace(/\s+/g, ' ');
  const listed = /may be repeated: ([a-z, -]+)/
    .exec(help)[1]
    .split(', ')
    .map((name) => name.trim().split(' ')[0])
    // what lies in a plane, as this surface does, has no charts
    .filter((name) => name && name !== 'seams')
    .sort();
  assert.deepEqual(inPage, listed);
  await page.close();
});

test('every layer changes the picture, and switching it off brings the old one back', async () => {
  const { page, complaints } = await open('all.html', { width: 1000, height: 480 });
  const bases = new Map();
  for (const name of (await layerNames(page)).filter((n) => !n.startsWith('no-'))) {
    const base =
      name === 'surface'
        ? ['result']
        : ['plane', 'result', 'overlay'].includes(name)
          ? ['surface']
          : ['surface', 'plane', 'result'];
    await only(page, ...base);
    // the picture before the first layer on this base; after each layer it must be the same again
    const now = await screenshot(page);
    const without = bases.get(String(base)) ?? now;
    bases.set(String(base), without);
    assert.equal(differing(without, now), 0, `the layer before ${name} leaves something behind`);
    await show(page, name);
    await settle(page);
    const within = await screenshot(page);
    // not counting titles and legends: those change too, but prove nothing
    const changed = differing(without, within, { y: 26, height: within.height - 26 - 93 });
    assert.ok(changed > 25, `${name} changes ${changed} pixels`);
  }
  await only(page, 'surface', 'plane', 'result');
  assert.equal(differing(bases.get('surface,plane,result'), await screenshot(page)), 0);
  assert.deepEqual(complaints, []);
  await page.close();
});

test('a window of another size shows what it showed, and as large as it can', async () => {
  const { page } = await open('all.html');
  for (const layers of [['surface', 'border'], ['plane', 'border']]) {
    await page.setViewportSize({ width: 1200, height: 700 });
    await only(page, ...layers);
    await page.locator('button', { hasText: 'Look at everything' }).click();
    await settle(page);
    const first = boxOf(await screenshot(page));
    const shape = (first.right - first.left) / (first.bottom - first.top);
    for (const [width, height] of [
      [1000, 1300],
      [950, 500],
      [1600, 500],
    ]) {
      await page.setViewportSize({ width, height });
      await settle(page);
      const stage = await page.locator('#stage').boundingBox();
      const box = boxOf(await screenshot(page));
      const [across, down] = [box.right - box.left, box.bottom - box.top];
      const what = `${layers[0]} at ${width} x ${height}: ${across} x ${down} of ${stage.width} x ${stage.height}`;
      assert.ok(Math.abs(across - shape * down) <= 4, `its shape is kept, ${what}`);
      assert.ok(box.left > 0 && box.right < stage.width - 1, `all of it is seen, ${what}`);
      const most = Math.min(stage.width, shape * (stage.height - 24 - 92));
      assert.ok(across > 0.9 * most && across <= most, `it is as large as it can be, ${what}`);
    }
    await page.setViewportSize({ width: 1200, height: 700 });
    await settle(page);
    const last = boxOf(await screenshot(page));
    for (const side of ['left', 'right', 'top', 'bottom']) assert.ok(Math.abs(first[side] - last[side]) <= 1);
  }
  await page.close();
});

test('lines, features, border and umbilics are where they should be, in space', async () => {
  const { page } = await open('all.html');
  await only(page, 'surface', 'border');
  const box = boxOf(await screenshot(page));
  assert.ok(Math.abs(box.right - box.left - (box.bottom - box.top)) <= 3, 'the square is a square');
  const expected = [
    [
      'max-lines',
      'red',
      [0.55, 0.1],
      [0.55, 0.77],
      [
        [0.5, 0.1],
        [0.6, 0.77],
      ],
    ],
    [
      'min-lines',
      'blue',
      [0.07, 0.35],
      [0.93, 0.35],
      [
        [0.07, 0.4],
        [0.93, 0.3],
      ],
    ],
    [
      'features',
      'green',
      [0.2, 0.05],
      [0.2, 0.95],
      [
        [0.15, 0.05],
        [0.25, 0.95],
      ],
    ],
    ['umbilics', 'orange', [0.75, 0.87], [0.75, 0.87], [[0.25, 0.87]]],
    ['umbilics', 'purple', [0.25, 0.87], [0.25, 0.87], [[0.75, 0.87]]],
    ['samples', 'black', [0.85, 0.16], [0.85, 0.16], [[0.75, 0.16]]],
  ];
  for (const [layer, hue, first, second, elsewhere] of expected) {
    await only(page, 'surface', 'border', layer);
    const picture = await screenshot(page);
    for (const p of [first, second]) assert.ok(near(picture, ...box.at(...p), hue), `${layer} is ${hue} at ${p}`);
    for (const p of elsewhere) assert.ok(!near(picture, ...box.at(...p), hue), `${layer} is not ${hue} at ${p}`);
  }
  await page.close();
});

test('and in the plane, which is twice as wide', async () => {
  const { page } = await open('all.html');
  await only(page, 'plane', 'border');
  const box = boxOf(await screenshot(page));
  assert.ok(Math.abs((box.right - box.left) / (box.bottom - box.top) - 2) < 0.03);
  await only(page, 'plane', 'border', 'max-lines', 'min-lines', 'features');
  const picture = await screenshot(page);
  assert.ok(near(picture, ...box.at(0.55, 0.9), 'red'));
  assert.ok(near(picture, ...box.at(0.9, 0.35), 'blue'));
  assert.ok(near(picture, ...box.at(0.2, 0.5), 'green'));
  assert.ok(!near(picture, ...box.at(0.45, 0.9), 'red'));
  await only(page, 'plane', 'border', 'plane-polygons', 'edge-kinds');
  const polygons = await screenshot(page);
  assert.ok(near(polygons, ...box.at(0.5, 0.9), 'red'), 'the edge in the middle is a max edge');
  assert.ok(near(polygons, ...box.at(0.75, 0.5), 'orange'), 'the diagonal is conforming');
  await page.close();
});

test('colour maps run from one end to the other', async () => {
  const { page } = await open('all.html');
  await only(page, 'surface', 'border');
  const box = boxOf(await screenshot(page));
  const colour = async (layer, u) => {
    await only(page, 'surface', 'border', layer);
    return (await screenshot(page)).at(...box.at(u, 0.52));
  };
  // k_min is -x: nothing on the left, the most negative, blue, on the right
  const [left, right] = [await colour('k-min', 0.02), await colour('k-min', 0.97)];
  assert.ok(hues.grey(left), `k_min is neutral at 0: ${left}`);
  assert.ok(right[2] > right[0] + 80, `k_min is blue where it is negative: ${right}`);
  const most = await colour('k-max', 0.97);
  assert.ok(most[0] > most[2] + 80, `k_max is red where it is positive: ${most}`);
  // anisotropy (2 + x - x) / (2 + x + x) is 1 at x = 0, yellow, and 1/2 at x = 1, green
  const [full, half] = [await colour('anisotropy', 0.01), await colour('anisotropy', 0.97)];
  assert.ok(full[0] > 150 && full[1] > 150 && full[2] < 90, `${full}`);
  assert.ok(half[1] > half[0] + 30 && half[2] > 70, `${half}`);
  // the quad's lifted corner is an error, the triangles have none
  await only(page, 'result');
  const frame = boxOf(await screenshot(page));
  await only(page, 'result', 'error');
  const errors = await screenshot(page);
  const [quad, triangle] = [errors.at(...frame.at(0.25, 0.6)), errors.at(...frame.at(0.8, 0.3))];
  assert.ok(quad[0] + quad[1] > triangle[0] + triangle[1] + 100, `${quad} against ${triangle}`);
  await page.close();
});

test('a click says what is there', async () => {
  const { page } = await open('all.html');
  for (const pane of ['surface', 'plane']) {
    await only(page, pane, 'border', 'min-lines', 'max-lines', 'features', 'umbilics');
    const box = boxOf(await screenshot(page));
    const click = async (u, v) => {
      await page.mouse.click(...(await place(page, box, u, v)));
      await settle(page);
      return picked(page);
    };
    // cell (4, 7): below and above its diagonal
    assert.equal((await click(0.47, 0.73)).face.number, 2 * (10 * 7 + 4));
    assert.equal((await click(0.43, 0.77)).face.number, 2 * (10 * 7 + 4) + 1);
    const vertex = (await click(0.7, 0.6)).vertex;
    assert.equal(vertex.number, 6 * 11 + 7);
    assert.match(vertex.text, /k-min\s+-0\.7\b/);
    assert.match(vertex.text, /position\s+\(0\.7, 0\.6, 0\)/);
    const line = (await click(0.55, 0.23)).line;
    assert.equal(line.number, 1);
    assert.match(line.text, /Max line 1\s+points\s+41\s+length\s+1\b/);
    assert.equal((await click(0.33, 0.35)).line.number, 0);
    assert.match((await click(0.2, 0.46)).edge.text, /Feature edge/);
    assert.match((await click(0.75, 0.87)).umbilic.text, /wedge/);
    assert.equal((await click(0.43, 0.77)).line, undefined);
  }
  await only(page, 'result');
  const box = boxOf(await screenshot(page));
  await page.mouse.click(...(await place(page, box, 0.25, 0.5)));
  const quad = (await picked(page)).polygon;
  assert.equal(quad.number, 0);
  assert.match(quad.text, /corners\s+4/);
  // its lifted corner: the normals (0, 0, 1) and (0.1, -0.05, 0.5) along one diagonal, (0.1, 0, 0.5) and (0, -0.05, 0.5) along the other
  assert.match(quad.text, /bend\s+12\.6044 degrees/);
  await page.mouse.click(...(await place(page, box, 0.9, 0.3)));
  assert.equal((await picked(page)).polygon.number, 1);
  await page.mouse.click(...(await place(page, box, 0.5, 0.5)));
  assert.match((await picked(page))['result-edge'].text, /kind\s+max/);
  await page.mouse.click(...(await place(page, box, -0.02, 1.02)));
  assert.deepEqual(await picked(page), {});
  // Laid over each other both are there, the result first.
  await only(page, 'overlay', 'border', 'polygons');
  const over = boxOf(await screenshot(page));
  await page.mouse.click(...(await place(page, over, 0.47, 0.73)));
  const both = await picked(page);
  assert.equal(both.face.number, 2 * (10 * 7 + 4));
  assert.equal(both.polygon.number, 0);
  assert.deepEqual(Object.keys(both).sort(), ['face', 'polygon']);
  await page.close();
});

test('a corner that three edges pass straight through is no fold', async () => {
  // three corners on a curved crease: the triangle between them stands upright, but nothing is cut along its long side
  writeFileSync(file('straight.obj'), 'v 0 0 0\nv 1 0 0.02\nv 2 0 0\nv 1 1 0\nf 1 2 3 4\n');
  must('anisomesh-view', '-q', 'straight.obj', '-o', 'straight.html', '--view', 'front');
  const { page } = await open('straight.html');
  const bend = await page.evaluate(() => window.anisomesh.stage.result.bend(0));
  const expected = (Math.acos((1 + 0.02 ** 2 - 0.02 ** 2) / (1 + 2 * 0.02 ** 2)) * 180) / Math.PI;
  assert.ok(Math.abs(bend - expected) < 1e-3, `${bend} against ${expected}`);
  await page.close();
});

test('of several inputs the last is shown first, and each can be chosen', async () => {
  must('anisomesh-shapes', '-q', 'dome', '--vertices', '300', '-o', 'dome.om');
  must('anisomesh-estimate', '-q', 'dome.om', '-o', 'dome-1.om');
  must('anisomesh-flatten', '-q', 'dome-1.om', '-o', 'dome-2.om');
  must('anisomesh-view', '-q', 'dome-1.om', 'dome-2.om', '-o', 'stages.html', '--layer', 'plane', '--layer', 'stretch');
  const { page, complaints } = await open('stages.html');
  assert.equal(await page.evaluate(() => window.anisomesh.stage.surface.name), 'dome-2.om');
  assert.ok((await layerNames(page)).includes('umbilics'));
  // flattening shrinks the middle least: the scale is symmetric about 1, but only what there is of it is named
  const { low, high, from, to } = await page.evaluate(() => window.anisomesh.stage.ranges.stretch);
  assert.equal(low, -high);
  assert.ok(Math.max(-from, to) === high && Math.min(-from, to) < high, `${from} to ${to} of ${low} to ${high}`);
  await page.locator('select').selectOption('0');
  assert.equal(await page.evaluate(() => window.anisomesh.stage.surface.name), 'dome-1.om');
  assert.ok(!(await layerNames(page)).includes('umbilics'));
  assert.deepEqual(complaints, []);
  await page.close();
});

test('panes turn together', async () => {
  must('anisomesh-shapes', '-q', 'saddle', '--vertices', '300', '-o', 'saddle.off');
  must('anisomesh-view', '-q', 'saddle.off', 'saddle.off', '-o', 'twice.html', '--view', '1,2,3');
  const { page } = await open('twice.html', { width: 1401, height: 700 });
  await only(page, 'surface', 'triangles', 'result', 'polygons');
  // the same mesh as input and as result: the shaded faces cover the same pixels
  const silhouettes = async () => {
    await only(page, 'surface', 'result');
    const picture = await screenshot(page);
    const half = Math.floor(picture.width / 2);
    const area = (x) => {
      const out = [];
      for (let j = 26; j < picture.height - 40; ++j)
        for (let i = 0; i < half - 2; ++i) out.push(hues.white(picture.at(x + i, j)) ? 0 : 1);
      return out;
    };
    return [area(0), area(half)];
  };
  const off = (a, b) => a.reduce((sum, v, i) => sum + (v !== b[i] ? 1 : 0), 0);
  const [left, right] = await silhouettes();
  const size = left.reduce((a, b) => a + b);
  assert.ok(size > 10000);
  assert.ok(off(left, right) < 0.01 * size, `before: ${off(left, right)} of ${size}`);
  const stage = await page.locator('#stage').boundingBox();
  const drag = async (x, dx, dy) => {
    await page.mouse.move(stage.x + x, stage.y + 300);
    await page.mouse.down();
    await page.mouse.move(stage.x + x + dx, stage.y + 300 + dy, { steps: 5 });
    await page.mouse.up();
    await settle(page);
  };
  await drag(stage.width / 4, 120, 60);
  const [turnedLeft, turnedRight] = await silhouettes();
  assert.ok(off(left, turnedLeft) > 0.1 * size, 'the pane that was dragged turned');
  assert.ok(off(turnedLeft, turnedRight) < 0.01 * size, 'the other one with it');
  await drag((3 * stage.width) / 4, -60, 80);
  const [againLeft, againRight] = await silhouettes();
  assert.ok(off(turnedLeft, againLeft) > 0.05 * size, 'and the other way round');
  assert.ok(off(againLeft, againRight) < 0.01 * size);
  await page.close();
});

test('the table has the figures that anisomesh-compare has', async () => {
  must('anisomesh-remesh', '-q', 'saddle.off', '-o', 'quads.obj', '--json', 'quads.json', '--epsilon', '0.003');
  const said = must('anisomesh-compare', 'saddle.off', 'quads.obj');
  must('anisomesh-view', '-q', 'saddle.off', 'quads.obj', '-o', 'figures.html', '--table', 'quads.json');
  const { page } = await open('figures.html');
  const rows = await page
    .locator('details[data-table^="Figures"] tr')
    .evaluateAll((all) => all.map((r) => [...r.children].map((c) => c.textContent)));
  const values = rows.filter((r) => r.length === 2);
  assert.ok(values.length > 12);
  for (const [what, value] of values)
    assert.ok(said.includes(value) && said.includes(what), `${what}: ${value} is in\n${said}`);
  await page.locator('details[data-table="quads.json"] summary').click();
  const text = await page.locator('details[data-table="quads.json"]').innerText();
  assert.match(text, /--epsilon\s+0\.003/);
  assert.match(text, /--stop-fraction\s+0\.5/);
  await page.close();
});

test('a surface without anything on it is shown without anything on it', async () => {
  must('anisomesh-view', '-q', 'saddle.off', '-o', 'bare.html');
  const { page, complaints } = await open('bare.html');
  const names = await layerNames(page);
  assert.deepEqual(names.sort(), ['border', 'features', 'surface', 'triangles']);
  boxOf(await screenshot(page));
  assert.deepEqual(complaints, []);
  await page.close();
});

test('anisomesh-remesh --report shows input, lines, result, figures, stages and options', async () => {
  must('anisomesh-shapes', '-q', 'octa-flower', '--vertices', '1500', '-o', 'flower.om');
  const said = must('anisomesh-remesh', 'flower.om', '-o', 'flower.obj', '--report', 'flower.html', '--rho', '0.25');
  assert.ok(said.includes('flower.html'));
  const { page, complaints, requests } = await open('flower.html');
  assert.deepEqual(requests.length, 1);
  assert.deepEqual(complaints, []);
  const names = await layerNames(page);
  // the .obj carries nothing, the report all of it
  for (const name of ['min-lines', 'umbilics', 'plane', 'degree', 'error', 'edge-kinds', 'plane-polygons'])
    assert.ok(names.includes(name), name);
  assert.ok(await page.locator('[data-layer="max-lines"]').isChecked());
  await page.locator('details[data-table="Options"] summary').click();
  assert.match(await page.locator('details[data-table="Options"]').innerText(), /--rho\s+0\.25/);
  await page.locator('details[data-table="Stages"] summary').click();
  assert.match(await page.locator('details[data-table="Stages"]').innerText(), /wedges\s+\d/);
  const figures = await page.locator('details[data-table^="Figures"]').innerText();
  const quads = /quads\s+([\d.]+ %)/.exec(figures)[1];
  assert.ok(must('anisomesh-compare', 'flower.om', 'flower.obj').includes(quads));
  await page.close();
});

test('a closed surface, which has no plane, is shown without one', async () => {
  must('anisomesh-shapes', '-q', 'torus', '--vertices', '1500', '-o', 'torus.off');
  must('anisomesh-estimate', '-q', 'torus.off', '-o', 'torus-1.om');
  must('anisomesh-flatten', '-q', 'torus-1.om', '-o', 'torus-2.om');
  must('anisomesh-trace', '-q', 'torus-2.om', '-o', 'torus-3.om', '--epsilon', '0.004');
  must('anisomesh-view', '-q', 'torus-3.om', '-o', 'torus.html');
  const { page, complaints } = await open('torus.html');
  const names = await layerNames(page);
  for (const name of ['plane', 'stretch', 'plane-polygons']) assert.ok(!names.includes(name), name);
  await only(page, 'surface');
  const bare = await screenshot(page);
  for (const name of ['min-lines', 'max-lines', 'smoothed-crosses']) {
    await only(page, 'surface', name);
    assert.ok(differing(bare, await screenshot(page), { y: 26, height: bare.height - 26 - 93 }) > 500, name);
  }
  assert.deepEqual(complaints, []);
  await page.close();
});
