// SPDX-License-Identifier: MIT
// Runs the browser tests one after the other: a line each, then "N passed, N failed". An argument selects by name, of
// the file (`lab.`) or the test.
import fs from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { launch } from "./harness.mjs";

const here = path.dirname(fileURLToPath(import.meta.url));
const filter = process.argv[2] ?? "";
const all = [];
for (const file of fs.readdirSync(here).filter((f) => f.endsWith(".tests.mjs")).sort())
  for (const [name, test] of Object.entries((await import(`./${file}`)).tests))
    if (name.includes(filter) || file.startsWith(filter)) all.push([name, test]);
const browser = await launch();
let passed = 0, failed = 0;
for (const [name, test] of all) {
  const begin = Date.now();
  const live = [];
  try {
    await test(browser, live);
    ++passed;
    console.log(`pass ${name} (${((Date.now() - begin) / 1000).toFixed(1)} s)`);
  } catch (e) {
    ++failed;
    console.log(`FAIL ${name}\n${e.stack}`);
  }
  for (const context of browser.contexts()) await context.close();
  for (const view of live) await view.end().catch(() => {});
}
await browser.close();
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed || !passed ? 1 : 0);
