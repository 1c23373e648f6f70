// SPDX-License-Identifier: MIT
// The pieces of the world as a list: names, places, lines of the file. As the scene selects, so does the list.
import { byId, h } from "../dom";
import { foldButton } from "../frame/layout";
import type { Piece, Pieces } from "../store/pieces";
import type { Store } from "../store/store";
import { hex } from "./fields";

const kMostRows = 1500;

export class Tree {
  private list = h("ul", {
    id: "pieces",
    role: "listbox",
    tabIndex: 0,
    "aria-label": "Pieces of the world",
    "aria-multiselectable": "true",
    onkeydown: (e: KeyboardEvent) => this.key(e),
  });
  private count = h("small", {});
  private filter = h("input", {
    id: "piece-filter",
    placeholder: "Filter",
    "aria-label": "Filter by name, kind or program",
    title: "Only pieces whose name, kind or program holds this",
    oninput: () => this.show(),
  });
  private rows = new Map<number, HTMLElement>();
  private shown: Piece[] = [];
  private anchor = 0; // of a range

  constructor(
    private store: Store,
    private pieces: Pieces,
  ) {
    byId("tree").append(
      h("div", { className: "toolbar head" }, foldButton("tree"), h("b", {}, "World"), this.count, this.filter),
      this.list,
    );
    store.on("world", () => this.show());
    store.on("programs", () => this.show());
    store.on("selection", () => this.mark());
  }

  private show() {
    const { world } = this.store,
      wanted = this.filter.value.trim().toLowerCase();
    const all: Piece[] = [...world.robots, ...world.things];
    this.shown = all
      .filter(
        (p) =>
          !wanted ||
          `${p.name ?? ""} ${p.kind} ${p.kind === "robot" ? this.store.programOf(p as never) : ""}`
            .toLowerCase()
            .includes(wanted),
      )
      .slice(0, kMostRows);
    const lines = new Map(world.elements.map((e) => [e.id, e]));
    const wrong = new Map(world.problems.map((p) => [p.id, p.text]));
    // a drag makes many worlds a second: only what differs is made anew
    const before = this.rows;
    this.rows = new Map();
    const rows = this.shown.map((p) => {
      const wrongText = wrong.get(p.id),
        line = lines.get(p.id)?.line;
      const said = [p.colour.join(), this.nameOf(p), placeOf(p), line, wrongText].join("\n");
      const old = before.get(p.id);
      const row = old?.dataset.said === said ? old : this.row(p, line, wrongText);
      row.dataset.said = said;
      this.rows.set(p.id, row);
      return row;
    });
    const now = this.list.children;
    if (rows.length !== now.length || rows.some((row, i) => row !== now[i])) this.list.replaceChildren(...rows);
    if (!all.length)
      this.list.replaceChildren(
        h(
          "li",
          { className: "dim pad hint", role: "none" },
          "Nothing stands here yet: choose a tool on the left, then click in the scene.",
        ),
      );
    this.count.textContent =
      wanted || all.length > kMostRows ? `${this.shown.length} of ${all.length}` : String(all.length);
    this.mark();
  }
  private row(p: Piece, line?: number, wrong?: string) {
    return h(
      "li",
      {
        id: `piece-${p.id}`,
        role: "option",
        className: wrong ? "row bad" : "row",
        title: wrong ?? "Shift or Ctrl selects several; a double click goes to the line of the file",
        onclick: (e: MouseEvent) => this.click(p.id, e),
        ondblclick: () => line && this.store.tell("worldLine", line),
      },
      h("i", { style: `background:${hex(p.colour)}` }),
      h("span", { className: "what" }, this.nameOf(p)),
      h("small", { className: "number" }, placeOf(p)),
      h("small", { className: "number" }, line ? `:${line}` : ""),
    );
  }
  private nameOf(p: Piece) {
    if (p.kind === "robot") return `${p.name} · ${this.store.programOf(p as never) || "no program"}`;
    return p.name && p.name !== p.kind ? `${p.name} · ${p.kind}` : p.kind;
  }
  private mark() {
    const chosen = new Set(this.store.selection);
    for (const [id, row] of this.rows) {
      row.classList.toggle("on", chosen.has(id));
      row.setAttribute("aria-selected", String(chosen.has(id)));
    }
    const last = this.rows.get(this.store.selected);
    if (last) this.list.setAttribute("aria-activedescendant", last.id);
    else this.list.removeAttribute("aria-activedescendant");
    last?.scrollIntoView?.({ block: "nearest" });
  }
  private click(id: number, e: MouseEvent) {
    const { store } = this;
    if (e.shiftKey) return this.range(id);
    this.anchor = id;
    if (!e.ctrlKey && !e.metaKey) return store.select(id);
    const was = store.selection.includes(id);
    store.selectAll(was ? store.selection.filter((other) => other !== id) : [...store.selection, id]);
  }
  private range(id: number) {
    const ids = this.shown.map((p) => p.id),
      from = Math.max(0, ids.indexOf(this.anchor)),
      to = ids.indexOf(id);
    const part = ids.slice(Math.min(from, to), Math.max(from, to) + 1);
    this.store.selectAll([...part.filter((other) => other !== id), id]);
  }
  private key(e: KeyboardEvent) {
    const { store } = this,
      ids = this.shown.map((p) => p.id),
      at = ids.indexOf(store.selected);
    const to = { ArrowDown: at + 1, ArrowUp: at < 0 ? 0 : at - 1, Home: 0, End: ids.length - 1 }[e.key];
    const ctrl = e.ctrlKey || e.metaKey;
    if (to !== undefined && ids.length) {
      const id = ids[Math.min(ids.length - 1, Math.max(0, to))];
      if (e.shiftKey) this.range(id);
      else store.select((this.anchor = id));
    } else if (ctrl && e.key === "a") store.selectAll(ids);
    else if (e.key === "Enter") {
      const line = store.world.elements.find((el) => el.id === store.selected)?.line;
      if (line) store.tell("worldLine", line);
    } else if (e.key === "Delete") this.pieces.remove();
    else return;
    e.preventDefault();
  }
}

function placeOf(p: Piece): string {
  const at = "points" in p && p.points ? p.points[0] : p.position;
  const to = "points" in p && p.points && p.points.length > 1 ? p.points[p.points.length - 1] : undefined;
  const said = (v: number[]) => `${v[0].toFixed(2)} ${v[1].toFixed(2)}`;
  return to ? `${said(at)} → ${said(to)} m` : `${said(at)} m`;
}
