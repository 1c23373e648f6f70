// SPDX-License-Identifier: MIT
// Runs the browser tests one after the other: a line each, then "N passed, N failed". An argument selects by name.
import { launch } from "./harness.mjs";
import { tests } from "./tests.mjs";
import { webots } from "./webots.mjs";

const filter = process.argv[2] ?? "";
const browser = await launch();
let passed = 0, failed = 0;
for (const [name, test] of Object.entries({ ...tests, ...webots })) {
  if (!name.includes(filter)) continue;
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
