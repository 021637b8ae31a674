// bundle.mjs PACKAGES OUTPUT.cc: bundles src/ with the packages in PACKAGES/node_modules into one HTML page, and the page into a C++
// source. Nothing in the page is fetched: script and style stand in it.
import { readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const [packages, output] = process.argv.slice(2).map((p) => path.resolve(p));
const here = path.dirname(fileURLToPath(import.meta.url));
const { build } = createRequire(path.join(packages, 'package.json'))('esbuild');

const result = await build({
  entryPoints: [path.join(here, 'src/main.js')],
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: ['chrome100', 'firefox100', 'safari15'],
  charset: 'ascii',
  legalComments: 'inline',
  nodePaths: [path.join(packages, 'node_modules')],
});
const script = result.outputFiles[0].text.replaceAll('</script', '<\\/script');
const style = await readFile(path.join(here, 'src/style.css'), 'utf8');
const frame = await readFile(path.join(here, 'src/page.html'), 'utf8');
const page = frame.replace('/*style*/', () => style).replace('/*script*/', () => script);

// Compilers limit the length of a literal, so the page goes in pieces.
const delimiter = 'anisomesh';
if (page.includes(`)${delimiter}"`)) throw new Error(`the page holds )${delimiter}"`);
const pieces = page.match(/[^]{1,16000}/g).map((piece) => `  page += R"${delimiter}(${piece})${delimiter}";`);
await writeFile(
  output,
  `// Made by view/bundle.mjs.
#include <string>

namespace view {

const std::string& page_template();
static std::string make_page_template() {
  std::string page;
${pieces.join('\n')}
  return page;
}
const std::string& page_template() {
  static const std::string page = make_page_template();
  return page;
}

}  // namespace view
`,
);
