// SPDX-License-Identifier: MIT
// What is wrong.
import { byId, h } from "../dom";
import { textOfDiagnosis } from "../store/client";
import type { Store, Trap } from "../store/store";

const textOfTrap = (e: Trap) => `${e.robot}: ${e.kind}: ${e.text}, at ${e.place}, ${e.time_s.toFixed(3)} s`;

export class ProblemsPane {
  readonly pane = h("div", { className: "pane pad" });
  constructor(private store: Store) {
    store.on("problems", () => this.show());
  }
  show() {
    const { store } = this,
      diagnoses = [...store.traps.map(textOfTrap), ...store.diagnoses.map(textOfDiagnosis)];
    const problems = this.store.world.problems;
    const rows = problems.map((p) =>
      h(
        "button",
        {
          className: "row bad",
          onclick: () => {
            if (p.id) this.store.select(p.id);
            this.store.tell("worldLine", p.line);
          },
        },
        p.line ? `line ${p.line}: ${p.text}` : p.text,
      ),
    );
    const told = diagnoses.map((d) => h("div", { className: "row" }, d));
    this.pane.replaceChildren(
      ...(rows.length + told.length ? [...rows, ...told] : [h("p", { className: "dim" }, "Nothing is wrong.")]),
    );
    byId("tab-problems").dataset.count =
      problems.length + diagnoses.length ? String(problems.length + diagnoses.length) : "";
  }
}
