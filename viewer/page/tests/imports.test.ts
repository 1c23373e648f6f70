// SPDX-License-Identifier: MIT
// Who may import whom: no circle of files; panes know the store and the link, never each other or the page's frame.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";

const src = path.resolve("src");
const files = fs.readdirSync(src, { recursive: true, encoding: "utf8" }).filter((f) => f.endsWith(".ts"));
const imports = new Map(
  files.map((file) => {
    const text = fs.readFileSync(path.join(src, file), "utf8");
    const names = [...text.matchAll(/from "(\.[^"]+)"/g)].map((m) => m[1]);
    return [file, names.map((n) => path.join(path.dirname(file), n) + ".ts")];
  }),
);
const folder = (file: string) => (file.includes("/") ? file.split("/")[0] : "");
// notices say what is wrong, wherever it is found out
const kFree = ["dom.ts", "frame/notices.ts", "frame/layout.ts"];
const kMay: Record<string, string[]> = {
  link: ["link"],
  store: ["store", "link"],
  scene: ["scene", "store", "link", "panes/senses.ts"],
  panes: ["panes", "store", "link"],
  frame: ["frame", "store", "link", "panes", "scene"],
};

test("no circle of files", () => {
  const done = new Set<string>();
  const visit = (file: string, way: string[]) => {
    assert.ok(!way.includes(file), `a circle: ${[...way.slice(way.indexOf(file)), file].join(" -> ")}`);
    if (done.has(file)) return;
    for (const other of imports.get(file) ?? []) visit(other, [...way, file]);
    done.add(file);
  };
  for (const file of files) visit(file, []);
});

test("imports go from the frame to panes and scene, from these to the store, from there to the link", () => {
  for (const [file, others] of imports)
    for (const other of others) {
      const may = kMay[folder(file)];
      const right = !may || kFree.includes(other) || may.includes(folder(other)) || may.includes(other);
      assert.ok(right, `${file} may not import ${other}`);
    }
});
