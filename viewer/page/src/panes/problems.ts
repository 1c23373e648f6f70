// SPDX-License-Identifier: MIT
// What is wrong, with a click to the line.
import { byId, h } from "../dom";
import { wrongsOf } from "../store/problems";
import type { Wrong } from "../store/problems";
import type { Store } from "../store/store";

const kMostRows = 500;
const kNames: Record<Wrong["of"], string> = {
  run: "run",
  world: "world file",
  compiler: "compiler",
  trap: "trap",
  diagnosis: "diagnosis",
  recording: "recording",
  file: "file",
};

export class ProblemsPane {
  readonly pane = h("div", { className: "pane pad" });
  private shown = "";

  constructor(private store: Store) {
    for (const topic of ["problems", "programs", "state", "world"] as const) store.on(topic, () => this.show());
  }
  private show() {
    const list = wrongsOf(this.store),
      said = JSON.stringify(list);
    // the state comes often
    if (said === this.shown) return;
    this.shown = said;
    this.pane.replaceChildren(
      ...(list.length
        ? [h("ul", { className: "list" }, ...list.slice(0, kMostRows).map((w) => h("li", {}, this.row(w))))]
        : [h("p", { className: "dim" }, "Nothing is wrong.")]),
    );
    if (list.length > kMostRows) this.pane.append(h("p", { className: "dim" }, `and ${list.length - kMostRows} more`));
    const tab = byId("tab-problems");
    tab.dataset.count = list.length ? String(list.length) : "";
    tab.setAttribute("aria-label", list.length ? `Problems, ${list.length}` : "Problems, none");
  }
  private row(w: Wrong) {
    const text = w.line ? `line ${w.line}: ${w.text}` : w.text;
    const kind = h("small", { className: "kind" }, kNames[w.of]);
    const says = h("span", {}, text);
    if (!w.source && !w.line && !w.piece) return h("div", { className: `row ${w.weight}` }, kind, says);
    return h(
      "button",
      { className: `row ${w.weight}`, title: "Go to the line", onclick: () => this.go(w) },
      kind,
      says,
    );
  }
  private go(w: Wrong) {
    const { store } = this;
    if (w.piece) store.select(w.piece);
    if (w.source) store.tell("sourceLine", w.source);
    else if (w.line) store.tell("worldLine", w.line);
  }
}
