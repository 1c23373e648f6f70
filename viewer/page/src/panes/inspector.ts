// SPDX-License-Identifier: MIT
// Beside the scene: a robot with its sensors, lights and selector, a thing with the keys of its piece of the world
// file, several pieces, or the world itself.
import { byId, h } from "../dom";
import type { Thing } from "../link/protocol";
import type { Client } from "../store/client";
import type { Pieces } from "../store/pieces";
import type { Store } from "../store/store";
import { Fields, headOf, hex } from "./fields";
import { RobotSheet } from "./robot_sheet";

const kSwatches: [string, number[]][] = [
  ["black", [0, 0, 0]],
  ["white", [1, 1, 1]],
  ["grey", [0.5, 0.5, 0.5]],
  ["red", [0.85, 0.1, 0.1]],
  ["green", [0.1, 0.6, 0.25]],
  ["blue", [0.1, 0.3, 0.8]],
  ["yellow", [0.95, 0.8, 0.1]],
];

export class Inspector {
  private shown = "";
  private fields: Fields;
  private sheet: RobotSheet;

  constructor(
    private store: Store,
    client: Client,
    private pieces: Pieces,
  ) {
    this.fields = new Fields(store, client);
    this.sheet = new RobotSheet(store, client, pieces, this.fields, () => {
      this.shown = "";
      this.show();
    });
    store.wanted.push(() => this.sheet.names());
    store.on("selection", () => this.show());
    store.on("pulse", () => this.update());
    store.on("look", () => this.sheet.showLook());
    store.on("theme", () => this.update());
  }
  toggleView() {
    this.sheet.toggleView();
  }
  private show() {
    const { store } = this;
    const editing = document.activeElement?.closest("#inspector input,#inspector select");
    const now = store.selection.join();
    if (editing && this.shown === now) return;
    // another text of the same piece: what had the focus has it again
    const focus = this.shown === now ? focusWithin(byId("inspector")) : undefined;
    this.shown = now;
    const robot = store.selectedRobot(),
      thing = store.selectedThing();
    const several = store.selection.length > 1;
    byId("inspector").replaceChildren(
      ...(several ? this.several() : robot ? this.sheet.show(robot) : thing ? this.thing(thing) : this.world()),
    );
    this.sheet.showLook();
    this.update();
    focus?.();
  }
  private update() {
    const robot = this.store.selectedRobot();
    if (robot && this.store.selection.length === 1) this.sheet.update(robot);
  }

  private world(): HTMLElement[] {
    const { world, schema } = this.store;
    const once = Object.keys(schema).filter((path) => path && !schema[path].many && !path.includes("."));
    const first = ["arena", "world", "proximity", "floor", "sky"];
    once.sort((a, b) => (first.indexOf(a) + 1 || 99) - (first.indexOf(b) + 1 || 99));
    return [
      h("h2", {}, world.title || "World"),
      h("p", { className: "dim" }, world.file),
      h("p", {}, "Click a robot or a thing to see and change it. Add things from the palette on the left."),
      h("h3", {}, "Sections of the world file"),
      h(
        "p",
        { className: "dim" },
        "Those that are not in the file count with their defaults; what is typed in one adds it.",
      ),
      ...once.flatMap((path) => this.fields.of(path)),
    ];
  }
  private paint() {
    if (!this.pieces.all().some((p) => this.pieces.canPaint(p))) return [];
    return [
      h("h3", {}, "Paint"),
      h(
        "div",
        { className: "swatches" },
        ...kSwatches.map(([name, colour]) =>
          h("button", {
            style: `background:${hex(colour)}`,
            title: name,
            "aria-label": `paint ${name}`,
            onclick: () => this.pieces.paint(colour),
          }),
        ),
      ),
    ];
  }
  private buttons() {
    const { pieces } = this,
      all = pieces.all();
    // several lie elsewhere when they are turned about their middle
    const turns = all.length > 1 || all.some((p) => pieces.canTurn(p));
    return h(
      "div",
      { className: "buttons" },
      h("button", { onclick: () => pieces.copy(), title: "Copy (Ctrl D)" }, "Copy"),
      ...(turns
        ? [h("button", { onclick: () => pieces.turn(15), title: "Turn by 15 degrees (Q, back: E)" }, "Turn")]
        : []),
      h("button", { onclick: () => pieces.remove(), title: "Delete (Del)" }, "Delete"),
    );
  }
  private several(): HTMLElement[] {
    const { store } = this;
    return [
      h("h2", {}, `${store.selection.length} pieces`),
      h(
        "p",
        { className: "dim" },
        "They are moved, turned, painted, copied and deleted together; one Undo takes it back.",
      ),
      this.buttons(),
      ...this.paint(),
    ];
  }
  private thing(thing: Thing): HTMLElement[] {
    const element = this.store.world.elements.find((e) => e.id === thing.id);
    const wrong = this.store.world.problems.find((p) => p.id === thing.id);
    return [
      ...headOf(thing.colour, thing.name || thing.kind, `${thing.kind}, line ${element?.line}`, wrong),
      this.buttons(),
      ...this.paint(),
      ...this.fields.of(element?.path ?? thing.kind, thing.id),
    ];
  }
}

/** What gives the focus back to the same place, when all within is made anew. */
function focusWithin(box: HTMLElement): (() => void) | undefined {
  const at = document.activeElement as HTMLElement | null;
  if (!at || !box.contains(at)) return undefined;
  const key = at.dataset.key,
    same = [...box.querySelectorAll<HTMLElement>("button,input,select,canvas,summary")].indexOf(at);
  return () => {
    const all = [...box.querySelectorAll<HTMLElement>("button,input,select,canvas,summary")];
    (key ? box.querySelector<HTMLElement>(`[data-key="${key}"]`) : all[same])?.focus();
  };
}
