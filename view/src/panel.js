// The panels at the sides: layers to switch, what was clicked, and the tables.
import { layers } from './layers.js';

function element(tag, attributes = {}, ...children) {
  const out = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) out.setAttribute(name, value);
  out.append(...children);
  return out;
}

/** Checkboxes, and radio buttons for colours, of the layers that there is something to draw for. */
export function fillControls(root, stage, viewer, chosen) {
  root.replaceChildren(element('h1', {}, document.title));
  const choice = (label, models, current, set) => {
    if (models.length < 2) return;
    const select = element(
      'select',
      {},
      ...models.map((m, i) => element('option', { value: i, ...(m === current ? { selected: '' } : {}) }, m.name)),
    );
    select.addEventListener('change', () => set(models[select.value]));
    root.append(element('label', { class: 'choice' }, `${label} `, select));
  };
  choice('Input', stage.surfaces, stage.surface, (s) => chosen(s, stage.result));
  choice('Result', stage.results, stage.result, (r) => chosen(stage.surface, r));
  for (const group of [...new Set(layers.map((l) => l.group))]) {
    const members = layers.filter((l) => l.group === group && stage.available(l));
    if (!members.length) continue;
    const box = element('fieldset', {}, element('legend', {}, group));
    const radios = members.some((l) => l.field);
    const add = (name, label, on) => {
      const input = element('input', {
        type: radios ? 'radio' : 'checkbox',
        'data-layer': name,
        ...(radios ? { name: group } : {}),
      });
      input.checked = on;
      input.addEventListener('change', () => {
        if (radios) for (const l of members) stage.set(l.name, l.name === name);
        else stage.set(name, input.checked);
        if (group === 'Panes') viewer.fitPanes();
        viewer.soon();
      });
      box.append(element('label', {}, input, ` ${label}`));
    };
    if (radios) add(`no-${members[0].of}-colour`, 'none', !members.some((l) => stage.isOn(l.name)));
    for (const l of members) add(l.name, l.label, stage.isOn(l.name));
    root.append(box);
  }
  const reset = element('button', { type: 'button', id: 'reset' }, 'Look at everything');
  reset.addEventListener('click', () => {
    viewer.fit();
    viewer.soon();
  });
  root.append(
    reset,
    element('p', { class: 'hint' }, 'Drag to turn, with Shift to move, wheel to zoom; click to ask what is there.'),
  );
}

const isTable = (value) => value !== null && typeof value === 'object' && !Array.isArray(value);
function cell(value) {
  if (Array.isArray(value))
    return value
      .map((v) =>
        isTable(v)
          ? Object.entries(v)
              .map(([k, x]) => `${k} ${cell(x)}`)
              .join(' ')
          : cell(v),
      )
      .join('; ');
  return typeof value === 'number' && !Number.isInteger(value) ? String(+value.toPrecision(6)) : String(value ?? '');
}

function table(rows) {
  const body = element('tbody');
  for (const [what, value] of Object.entries(rows)) {
    if (isTable(value)) {
      body.append(element('tr', {}, element('th', { colspan: 2, class: 'group' }, what)));
      for (const [inner, x] of Object.entries(value))
        body.append(
          element(
            'tr',
            {},
            element('th', { class: 'inner' }, inner),
            element('td', {}, isTable(x) ? JSON.stringify(x) : cell(x)),
          ),
        );
    } else if (value === '') body.append(element('tr', {}, element('th', { colspan: 2, class: 'group' }, what)));
    else
      body.append(
        element(
          'tr',
          {},
          element('th', { class: what.startsWith('  ') ? 'inner' : '' }, what.trim()),
          element('td', {}, cell(value)),
        ),
      );
  }
  return element('table', {}, body);
}

export function fillFacts(root, tables) {
  const picked = element('section', { id: 'picked' }, element('p', { class: 'hint' }, 'Nothing is selected.'));
  root.replaceChildren(element('h2', {}, 'Selected'), picked);
  tables.forEach(({ title, rows }, i) =>
    root.append(
      element(
        'details',
        { ...(i === 0 ? { open: '' } : {}), 'data-table': title },
        element('summary', {}, title),
        table(rows),
      ),
    ),
  );
  return (pane, things) => {
    picked.replaceChildren(
      ...(things.length ? [] : [element('p', { class: 'hint' }, 'There is nothing here.')]),
      ...things.map(({ kind, title, number, rows }) =>
        element(
          'section',
          { 'data-kind': kind, 'data-number': number },
          element('h3', {}, `${title} ${number}`),
          table(Object.fromEntries(rows)),
        ),
      ),
    );
  };
}
