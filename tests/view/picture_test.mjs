// Pictures and drawings from the command line, and what is said where there can be none.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { chmodSync, existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { before, test } from 'node:test';
import { boxOf, file, hues, makeKnown, must, near, readPng, run, work } from './support.mjs';

const footer = 27; // of a picture whose legend is one row

before(() => {
  makeKnown();
  must('anisomesh-shapes', '-q', 'dome', '--vertices', '300', '-o', 'dome.om');
});

/** The exit code, and one line on stderr that says this; nothing is written. */
function refused(code, says, args, environment) {
  const { status, stderr } = run('anisomesh-view', args, environment);
  assert.equal(status, code, stderr);
  assert.equal(stderr.trim().split('\n').length, 1, stderr);
  for (const text of [says].flat()) assert.ok(stderr.includes(text), `'${text}' in: ${stderr}`);
}

test('a picture has the size asked for and shows the layers asked for', () => {
  must(
    'anisomesh-view',
    '-q',
    'known.om',
    '--png',
    'lines.png',
    '--layer',
    'border',
    '--layer',
    'max-lines',
    '--size',
    '640x480',
    '--view',
    'front',
  );
  const picture = readPng('lines.png');
  assert.deepEqual([picture.width, picture.height], [640, 480]);
  const box = boxOf(picture, { footer });
  for (let v = 0.03; v < 1; v += 0.07) {
    assert.ok(near(picture, ...box.at(0.55, v), 'red', 1), `red at ${v}`);
    assert.ok(!near(picture, ...box.at(0.52, v), 'red', 1), `not red beside it at ${v}`);
  }
  assert.ok(!near(picture, ...box.at(0.3, 0.35), 'blue', 4), 'no min line was asked for');
  assert.ok(hues.grey(picture.at(...box.at(0.31, 0.44))), 'the surface is plain');
});

test('a picture is seen from where it is asked for', () => {
  must(
    'anisomesh-view',
    '-q',
    'known.om',
    '--png',
    'back.png',
    '--layer',
    'border',
    '--layer',
    'max-lines',
    '--view',
    'back',
  );
  const picture = readPng('back.png');
  const box = boxOf(picture, { footer });
  assert.ok(near(picture, ...box.at(0.45, 0.8), 'red'), 'left and right change places');
  assert.ok(!near(picture, ...box.at(0.55, 0.8), 'red'));
  must(
    'anisomesh-view',
    '-q',
    'known.om',
    '--png',
    'turned.png',
    '--layer',
    'border',
    '--layer',
    'max-lines',
    '--view',
    '0,0,1',
    '--up',
    '1,0,0',
  );
  const turned = readPng('turned.png');
  assert.ok(
    near(turned, ...boxOf(turned, { footer }).at(0.8, 0.55), 'red'),
    '--up 1,0,0 turns the square by a quarter',
  );
});

test('--zoom and --at look closer', () => {
  must(
    'anisomesh-view',
    '-q',
    'known.om',
    '--png',
    'close.png',
    '--layer',
    'max-lines',
    '--layer',
    'min-lines',
    '--layer',
    'features',
    '--view',
    'front',
    '--zoom',
    '4',
    '--at',
    '0.55,0.35,0',
    '--size',
    '400x400',
  );
  const picture = readPng('close.png');
  const [x, y] = [200, 24 + (400 - 24 - 25) / 2]; // between title and legend
  assert.ok(near(picture, x, y - 100, 'red') && near(picture, x, y + 100, 'red'), 'the max line is in the middle');
  assert.ok(near(picture, x - 150, y, 'blue') && near(picture, x + 150, y, 'blue'), 'the min line is in the middle');
  for (let i = 0; i < 400; i += 3) assert.ok(!near(picture, i, y - 60, 'green', 1), 'the feature is out of sight');
});

test('panes stand side by side in a picture', () => {
  must(
    'anisomesh-view',
    '-q',
    'known.om',
    'known-result.om',
    '--png',
    'both.png',
    '--layer',
    'max-lines',
    '--layer',
    'degree',
    '--layer',
    'polygons',
    '--size',
    '1000x500',
    '--view',
    'front',
  );
  const picture = readPng('both.png');
  const [left, right] = [boxOf(picture, { x: 0, width: 498, footer }), boxOf(picture, { x: 502, width: 498, footer })];
  assert.ok(near(picture, ...left.at(0.55, 0.5), 'red'));
  assert.ok(near(picture, ...right.at(0.75, 0.5), 'black'), 'the edge between the triangles');
  const [quad, triangle] = [picture.at(...right.at(0.25, 0.5)), picture.at(...right.at(0.9, 0.3))];
  assert.ok(quad[2] > quad[0] && triangle[0] > triangle[2], 'a quad is blue, a triangle yellow');
});

test('a picture that asks for errors measures them', () => {
  must(
    'anisomesh-view',
    '-q',
    'known.om',
    'known-result.om',
    '--png',
    'error.png',
    '--layer',
    'error',
    '--view',
    'front',
    '--size',
    '400x400',
  );
  const picture = readPng('error.png');
  const box = boxOf(picture, { footer: 54 });
  const [quad, triangle] = [picture.at(...box.at(0.25, 0.6)), picture.at(...box.at(0.9, 0.3))];
  assert.ok(quad[0] + quad[1] > triangle[0] + triangle[1] + 100);
});

test('a drawing has lines, umbilics and polygons where they are', () => {
  must('anisomesh-view', '-q', 'known.om', 'known-result.om', '--svg', 'plane.svg');
  const svg = readFileSync(file('plane.svg'), 'utf8');
  const group = (name) => new RegExp(`<g id="${name}"[^>]*>([^]*?)</g>`).exec(svg)[1];
  const paths = (name) =>
    [...group(name).matchAll(/ d="([^"]*)"/g)].map((m) =>
      [...m[1].matchAll(/[ML](\S+) ([-\d.]+)/g)].map((p) => [+p[1], +p[2]]),
    );
  // the border says where the square is
  const all = paths('border').flat();
  const [x, y] = [0, 1].map((c) => [Math.min(...all.map((p) => p[c])), Math.max(...all.map((p) => p[c]))]);
  assert.ok(Math.abs((x[1] - x[0]) / (y[1] - y[0]) - 2) < 0.01);
  const u = (p) => (p[0] - x[0]) / (x[1] - x[0]);
  const v = (p) => (y[1] - p[1]) / (y[1] - y[0]);
  const [max] = paths('max-lines');
  assert.equal(max.length, 41);
  for (const p of max) assert.ok(Math.abs(u(p) - 0.55) < 1e-3);
  for (const p of paths('min-lines')[0]) assert.ok(Math.abs(v(p) - 0.35) < 1e-3);
  assert.match(/<g id="max-lines" ([^>]*)>/.exec(svg)[1], /#d62728/);
  const [, cx, cy] = /<circle[^>]* cx="([\d.]+)" cy="([\d.]+)"/.exec(group('umbilics'));
  assert.ok(Math.abs(u([+cx]) - 0.75) < 1e-3 && Math.abs(v([0, +cy]) - 0.87) < 1e-3);
  assert.equal([...group('umbilics').matchAll(/<polygon/g)].length, 1);
  assert.equal(paths('polygon-edges').length, 8);
  assert.equal(paths('features').length, 10);
  // --layer chooses here too
  must('anisomesh-view', '-q', 'known.om', 'known-result.om', '--svg', 'kinds.svg', '--layer', 'edge-kinds');
  const kinds = readFileSync(file('kinds.svg'), 'utf8');
  assert.ok(!kinds.includes('max-lines') && kinds.includes('#e08a00'));
});

test('a layer without its property is refused with the stage to run', () => {
  refused(
    3,
    ['dome.om', "'k-min'", 'anisomesh:k_min', 'run anisomesh-estimate'],
    ['dome.om', '-o', 'out.html', '--layer', 'k-min'],
  );
  refused(3, ['run anisomesh-flatten'], ['dome.om', '-o', 'out.html', '--layer', 'umbilics']);
  refused(3, ['run anisomesh-flatten'], ['dome.om', '-o', 'out.html', '--layer', 'plane']);
  refused(3, ['run anisomesh-trace'], ['dome.om', '--png', 'out.png', '--layer', 'min-lines']);
  refused(3, ['run anisomesh-flatten', 'anisomesh:uv'], ['dome.om', '--svg', 'out.svg']);
  refused(3, ['run anisomesh-mesh'], ['known.om', 'dome.om', '-o', 'out.html', '--layer', 'edge-kinds']);
  refused(3, ['none was given'], ['known.om', '-o', 'out.html', '--layer', 'degree']);
  refused(3, ['none was given'], ['known-result.om', '-o', 'out.html', '--layer', 'k-min']);
  assert.ok(!existsSync(file('out.html')) && !existsSync(file('out.png')) && !existsSync(file('out.svg')));
});

test('a surface that was not flattened has no plane, and that is said', () => {
  must('anisomesh-shapes', '-q', 'torus', '--vertices', '600', '-o', 'torus.off');
  must('anisomesh-estimate', '-q', 'torus.off', '-o', 'torus-1.om');
  must('anisomesh-flatten', '-q', 'torus-1.om', '-o', 'torus-2.om');
  refused(3, ['torus-2.om', 'without a plane'], ['torus-2.om', '-o', 'out.html', '--layer', 'plane']);
  refused(3, ['torus-2.om', 'without a plane'], ['torus-2.om', '--svg', 'out.svg']);
  must('anisomesh-view', '-q', 'torus-2.om', '-o', 'torus.html', '--layer', 'smoothed-crosses');
});

test('what is no mesh, or nowhere to write, is refused', () => {
  writeFileSync(file('text.om'), 'this is no mesh');
  writeFileSync(file('text.off'), 'this is no mesh');
  refused(3, 'text.om', ['text.om', '-o', 'out.html']);
  refused(3, 'text.off', ['text.off', '-o', 'out.html']);
  refused(3, 'missing.om', ['missing.om', '-o', 'out.html']);
  refused(3, 'no/out.html', ['known.om', '-o', 'no/out.html']);
  refused(3, 'no/out.png', ['known.om', '--png', 'no/out.png']);
  mkdirSync(file('folder.html'));
  refused(3, 'directory', ['known.om', '-o', 'folder.html']);
  refused(3, ['text.off', '--json'], ['known.om', '-o', 'out.html', '--table', 'text.off']);
  refused(2, ["no layer 'k-mni'", 'k-min'], ['known.om', '-o', 'out.html', '--layer', 'k-mni']);
  refused(2, '--size', ['known.om', '--png', 'out.png', '--size', '10x']);
  refused(2, '--size', ['known.om', '--png', 'out.png', '--size', '20000x100']);
  refused(2, '--view', ['known.om', '--png', 'out.png', '--view', 'sideways']);
  refused(2, '--view', ['known.om', '--png', 'out.png', '--view', '0,0,0']);
  refused(2, '--at', ['known.om', '--png', 'out.png', '--at', '1,2']);
  refused(2, '--zoom', ['known.om', '--png', 'out.png', '--zoom', '0']);
  refused(2, 'nothing to write', ['known.om']);
  assert.ok(!existsSync(file('out.html')) && !existsSync(file('out.png')));
});

test('without Chromium a picture is refused with the package to install; pages and drawings go on', () => {
  const none = { PATH: file('nothing'), ANISOMESH_CHROMIUM: '' };
  refused(4, ["install the package 'chromium'"], ['known.om', '--png', 'out.png'], none);
  refused(4, ['ANISOMESH_CHROMIUM names no program: /no/chromium'], ['known.om', '--png', 'out.png'], {
    ANISOMESH_CHROMIUM: '/no/chromium',
  });
  const { status, stderr } = run('anisomesh-view', ['-q', 'known.om', '-o', 'fine.html', '--svg', 'fine.svg'], none);
  assert.equal(status, 0, stderr);
  assert.ok(existsSync(file('fine.html')) && existsSync(file('fine.svg')));
});

test('a Chromium that draws nothing is said to have drawn nothing', () => {
  writeFileSync(file('broken'), '#!/bin/sh\necho "no screen, no card" >&2\nexit 1\n');
  chmodSync(file('broken'), 0o755);
  refused(4, ['drew no picture', 'no screen, no card'], ['known.om', '--png', 'out.png'], {
    ANISOMESH_CHROMIUM: file('broken'),
  });
  assert.ok(!existsSync(file('out.png')));
});

test('a build without the page says what to install, and draws drawings', () => {
  for (const output of [
    ['-o', 'none.html'],
    ['--png', 'none.png'],
  ]) {
    const { status, stderr } = spawnSync(process.env.ANISOMESH_WITHOUT_PAGE, ['known.om', ...output], {
      cwd: work,
      encoding: 'utf8',
    });
    assert.equal(status, 4, stderr);
    assert.match(stderr, /no viewer page; install npm and configure with -D ANISOMESH_VIEW=ON/);
  }
  const { status, stderr } = spawnSync(process.env.ANISOMESH_WITHOUT_PAGE, ['-q', 'known.om', '--svg', 'without.svg'], {
    cwd: work,
    encoding: 'utf8',
  });
  assert.equal(status, 0, stderr);
  assert.ok(readFileSync(file('without.svg'), 'utf8').includes('max-lines'));
});
