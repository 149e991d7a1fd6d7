// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Builds the page: node build.mjs PACKAGES OUT
//   PACKAGES  the folder whose node_modules was made by `npm ci` out of the lock file
//   OUT       gets index.html, main.js, view3d.js, main.css, icon.svg, THIRD-PARTY.txt
// The same sources and packages give the same bytes, wherever they are. A file that would not change is left alone.

import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, relative, resolve, sep } from "node:path";
import { fileURLToPath } from "node:url";

const source = join(dirname(fileURLToPath(import.meta.url)), "src");
const packages = resolve(process.argv[2] ?? ".");
const out = resolve(process.argv[3] ?? "page");
const { build } = createRequire(join(packages, "package.json"))("esbuild");

// Packages come from that folder alone, also where an editor has some beside the sources.
const from_packages = {
  name: "from-packages",
  setup(builder) {
    builder.onResolve({ filter: /^[^./]/ }, ({ path, kind, importer, pluginData }) =>
      kind === "entry-point" || pluginData === "asked" || !importer.startsWith(source + sep)
        ? undefined
        : builder.resolve(path, { kind, resolveDir: packages, pluginData: "asked" }));
  },
};

// What draws by the GPU is a file of its own, which a page fetches when somebody looks at it. (Shares no state with the page: no splitting.)
const apart = {
  name: "apart",
  setup(builder) {
    builder.onResolve({ filter: /^\.\/view3d$/ }, ({ kind, importer }) => {
      if (kind !== "dynamic-import") throw new Error(`${importer}: view3d has to be imported when it is needed`);
      return { path: "./view3d.js", external: true };
    });
  },
};

const result = await build({
  absWorkingDir: source,
  entryPoints: ["main.tsx", "view3d.ts", "main.css"],
  outdir: out,
  write: false,
  bundle: true,
  format: "esm",
  target: ["es2022", "chrome105", "firefox110", "safari16"],
  jsx: "automatic",
  jsxImportSource: "preact",
  tsconfigRaw: {},
  plugins: [apart, from_packages],
  minify: true,
  legalComments: "none",   // all of them are in THIRD-PARTY.txt
  charset: "utf8",
  metafile: true,
  logLevel: "warning",
});

/** The packages that something in the bundle comes from, by the folders of its inputs. */
function bundled_packages() {
  const names = new Set();
  for (const output of Object.values(result.metafile.outputs)) {
    for (const [input, { bytesInOutput }] of Object.entries(output.inputs)) {
      const path = relative(join(packages, "node_modules"), resolve(source, input)).split(sep);
      if (bytesInOutput === 0 || path[0] === "..") continue;
      names.add(path[0].startsWith("@") ? `${path[0]}/${path[1]}` : path[0]);
    }
  }
  return [...names].sort();
}

/** A package's name, version and licence, word for word as it came. */
function notice(name) {
  const folder = join(packages, "node_modules", name);
  const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const file = readdirSync(folder).sort().find((one) => /^(licen[cs]e|copying)(\.(md|txt))?$/i.test(one));
  if (file === undefined) throw new Error(`${name} ${version} comes without the text of its licence`);
  return `${name} ${version} (${license})\n\n${readFileSync(join(folder, file), "utf8").trim()}\n`;
}

const third_party = [
  "The page of `tofray view` contains these packages, each with its licence.\n",
  ...bundled_packages().map(notice),
].join(`\n${"-".repeat(80)}\n\n`);

const spdx = "SPDX-FileCopyrightText: 2026 The tofray authors. SPDX-License-Identifier: Apache-2.0. Others: THIRD-PARTY.txt";
const files = {
  "index.html": readFileSync(join(source, "index.html"), "utf8"),
  "icon.svg": readFileSync(join(source, "icon.svg"), "utf8"),
  "THIRD-PARTY.txt": third_party,
};
for (const { path, text } of result.outputFiles) files[relative(out, path)] = `/* ${spdx} */\n${text}`;

mkdirSync(out, { recursive: true });
for (const [name, text] of Object.entries(files)) {
  const path = join(out, name);
  if (!existsSync(path) || readFileSync(path, "utf8") !== text) writeFileSync(path, text);
}
