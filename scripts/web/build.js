// Bundles main.js with the libraries that it uses into bundle.js, the licences of these included.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const result = await build({
  entryPoints: ["main.js"],
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2021",
  charset: "utf8",
  legalComments: "none", // all licences stand in full below
  metafile: true,
  write: false,
});

const packages = new Set(
  Object.keys(result.metafile.inputs).map((path) => /^node_modules\/((@[^/]+\/)?[^/]+)/.exec(path)?.[1]),
);
packages.delete(undefined);
const byText = new Map();
for (const name of [...packages].sort()) {
  const file = ["LICENSE", "LICENSE.md", "LICENSE.txt"].map((f) => `node_modules/${name}/${f}`).find(existsSync);
  const text = file
    ? readFileSync(file, "utf8").trim()
    : `Licence: ${JSON.parse(readFileSync(`node_modules/${name}/package.json`)).license}`;
  byText.set(text, [...(byText.get(text) ?? []), name]);
}
const licences = [...byText]
  .map(([text, names]) => `${names.join(", ")}:\n${text}`)
  .join("\n\n")
  .replaceAll("*/", "* /");
writeFileSync(
  "bundle.js",
  `/*\nThis script contains these packages.\n\n${licences}\n*/\n${result.outputFiles[0].text}`,
);
