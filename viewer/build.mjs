// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Builds the page: node build.mjs PACKAGES OUT
//   PACKAGES  the folder whose node_modules was made by `npm ci` out of the lock file
//   OUT       gets index.html, main.js, view3d.js, main.css, icon.svg, THIRD-PARTY.txt, and export.html: the same page as one file, which
//             reads the frames that `tofray view --export` puts in the place of its line <!--tofray-data-->, and asks nobody for anything
// The same sources and packages give the same bytes, wherever they are. A file that would not change is left alone.

import { createHash } from "node:crypto";
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

const icon = readFileSync(join(source, "icon.svg"), "utf8");

/** @param in_file  all of it in one file, with no server behind it */
const bundle = (entryPoints, plugins, in_file) => build({
  absWorkingDir: source,
  entryPoints,
  outdir: out,
  define: {
    TOFRAY_IN_FILE: String(in_file),
    TOFRAY_ICON: JSON.stringify(in_file ? `data:image/svg+xml;base64,${Buffer.from(icon).toString("base64")}` : "icon.svg"),
  },
  write: false,
  bundle: true,
  format: "esm",
  target: ["es2022", "chrome105", "firefox110", "safari16"],
  jsx: "automatic",
  jsxImportSource: "preact",
  tsconfigRaw: {},
  plugins,
  minify: true,
  legalComments: "none",   // all of them are in THIRD-PARTY.txt
  charset: "utf8",
  metafile: true,
  logLevel: "warning",
});
const result = await bundle(["main.tsx", "view3d.ts", "main.css"], [apart, from_packages], false);
const one_file = await bundle(["main.tsx", "main.css"], [from_packages], true);

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
  "icon.svg": icon,
  "THIRD-PARTY.txt": third_party,
};

/** The page as one file: what runs in it is told by its hash, and nothing may be fetched. */
function page_as_one_file() {
  const own = spdx.replace("THIRD-PARTY.txt", "the block tofray-licences");
  const [script, style] = [".js", ".css"].map((end) => `\n/* ${own} */\n${one_file.outputFiles.find(({ path }) => path.endsWith(end)).text}`);
  for (const [what, text] of Object.entries({ script, style, third_party }))
    if (/<\/(script|style)|<!--/i.test(text)) throw new Error(`the ${what} has words that would end its element in a page`);
  const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
  const policy = `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; img-src data: blob:; base-uri 'none'; form-action 'none'`;
  return `<!DOCTYPE html>
<!-- ${own} -->
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="referrer" content="no-referrer">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="dark light">
<title>tofray view</title>
<link rel="icon" href="data:image/svg+xml;base64,${Buffer.from(icon).toString("base64")}" type="image/svg+xml">
<style>${style}</style>
</head>
<body>
<div id="page"></div>
<noscript>This page needs JavaScript.</noscript>
<script type="text/plain" id="tofray-licences">
${third_party}</script>
<!--tofray-data-->
<script type="module">${script}</script>
</body>
</html>
`;
}

for (const { path, text } of result.outputFiles) files[relative(out, path)] = `/* ${spdx} */\n${text}`;

files["export.html"] = page_as_one_file();

mkdirSync(out, { recursive: true });
for (const [name, text] of Object.entries(files)) {
  const path = join(out, name);
  if (!existsSync(path) || readFileSync(path, "utf8") !== text) writeFileSync(path, text);
}
