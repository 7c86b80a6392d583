// Prints the licences of the packages that a bundle contains: they ask that their texts go with every copy.
// Usage: node licences.mjs METAFILE   (of esbuild)
import { readdirSync, readFileSync } from "node:fs";

const { inputs } = JSON.parse(readFileSync(process.argv[2], "utf8"));
const folders = Object.keys(inputs).map((file) => file.match(/^(?:.*\/)?node_modules\/(?:@[^/]+\/)?[^/]+/)?.[0]);

for (const folder of [...new Set(folders.filter(Boolean))].sort()) {
  const { name, version, license } = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
  const [text] = readdirSync(folder).filter((file) => /^licen[cs]e/i.test(file));
  if (text === undefined) {
    throw new Error(`${name} ${version} has no text of its licence (${license})`);
  }
  console.log(`${name} ${version}\n\n${readFileSync(`${folder}/${text}`, "utf8").trim()}\n`);
}
