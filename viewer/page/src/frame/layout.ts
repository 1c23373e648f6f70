// SPDX-License-Identifier: MIT
// How wide and high the page's parts are: splitters to pull or to move with arrow keys, parts that fold, remembered.
import { byId, h } from "../dom";

interface Part {
  id: "side" | "dock" | "tree";
  /** What it is called on its splitter. */
  name: string;
  /** Its size by which it is remembered: across, or up. */
  across: boolean;
  least: number; // rem
  most: () => number; // rem
  usual: number; // rem
}
const kStep = 1; // rem, of an arrow key
const rem = () => parseFloat(getComputedStyle(document.documentElement).fontSize) || 16;
const kParts: Part[] = [
  { id: "side", name: "Inspector", across: true, least: 14, most: () => innerWidth / rem() / 2, usual: 24.5 },
  { id: "dock", name: "Panes below", across: false, least: 6, most: () => (innerHeight / rem()) * 0.75, usual: 15 },
  {
    id: "tree",
    name: "Pieces of the world",
    across: false,
    least: 4,
    most: () => (innerHeight / rem()) * 0.6,
    usual: 11,
  },
];
type Sizes = Partial<Record<Part["id"], { size?: number; folded?: boolean }>>;

let sizes: Sizes = {};
function remembered(): Sizes {
  try {
    return JSON.parse(localStorage.getItem("layout") ?? "{}") ?? {};
  } catch {
    return {};
  }
}
const folds: (() => void)[] = [];
function set(part: Part, change: { size?: number; folded?: boolean }) {
  sizes[part.id] = { ...sizes[part.id], ...change };
  localStorage.setItem("layout", JSON.stringify(sizes));
  apply(part);
  folds.forEach((tell) => tell());
}
function sizeOf(part: Part) {
  return Math.min(Math.max(sizes[part.id]?.size ?? part.usual, part.least), Math.max(part.least, part.most()));
}
function apply(part: Part) {
  const own = sizes[part.id]?.size;
  if (own === undefined) document.body.style.removeProperty(`--${part.id}-size`);
  else document.body.style.setProperty(`--${part.id}-size`, `${sizeOf(part).toFixed(2)}rem`);
  document.body.classList.toggle(`no-${part.id}`, sizes[part.id]?.folded ?? false);
  const bar = document.getElementById(`split-${part.id}`);
  bar?.setAttribute("aria-valuenow", sizeOf(part).toFixed(0));
}

/** A bar between two parts. */
function splitter(part: Part): HTMLElement {
  const bar = h("div", {
    id: `split-${part.id}`,
    className: part.across ? "splitter across" : "splitter",
    tabIndex: 0,
    role: "separator",
    "aria-label": `Size: ${part.name}`,
    "aria-orientation": part.across ? "vertical" : "horizontal",
    "aria-valuemin": String(part.least),
    "aria-valuemax": "100",
    title: "Pull, or move with the arrow keys; a double click folds it away",
    ondblclick: () => set(part, { folded: !sizes[part.id]?.folded }),
    onkeydown: (e: KeyboardEvent) => {
      const by = { ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }[e.key];
      // the tree is above its bar, others below or behind theirs
      const sign = part.id === "tree" ? -1 : 1;
      if (by) set(part, { size: sizeOf(part) + sign * by * kStep, folded: false });
      else if (e.key === "Enter") set(part, { folded: !sizes[part.id]?.folded });
      else return;
      e.preventDefault();
    },
  });
  let from: { at: number; size: number } | undefined;
  bar.addEventListener("pointerdown", (e) => {
    from = { at: part.across ? e.clientX : e.clientY, size: sizeOf(part) };
    bar.setPointerCapture(e.pointerId);
    e.preventDefault();
  });
  bar.addEventListener("pointermove", (e) => {
    if (!from) return;
    const by = (from.at - (part.across ? e.clientX : e.clientY)) / rem();
    if (by) set(part, { size: from.size + (part.id === "tree" ? -by : by), folded: false });
  });
  for (const end of ["pointerup", "pointercancel"]) bar.addEventListener(end, () => (from = undefined));
  return bar;
}

/** A button that folds a part away and brings it back. */
export function foldButton(id: Part["id"]): HTMLElement {
  const part = kParts.find((p) => p.id === id)!;
  const button = h("button", { className: "tiny fold", onclick: () => set(part, { folded: !sizes[id]?.folded }) });
  const tell = () => {
    const folded = sizes[id]?.folded ?? false,
      open = part.across ? "⟩" : id === "tree" ? "▾" : "▾",
      closed = part.across ? "⟨" : id === "tree" ? "▸" : "▴";
    button.textContent = folded ? closed : open;
    button.title = folded ? `Show: ${part.name}` : `Fold away: ${part.name}`;
    button.setAttribute("aria-label", button.title);
    button.setAttribute("aria-expanded", String(!folded));
  };
  folds.push(tell);
  tell();
  return button;
}
/** Makes sure that a part is in sight. */
export function unfold(id: Part["id"]) {
  if (sizes[id]?.folded)
    set(
      kParts.find((p) => p.id === id)!,
      { folded: false },
    );
}

export function beginLayout() {
  sizes = remembered();
  const [side, dock, tree] = kParts.map(splitter);
  byId("side").before(side);
  byId("dock").before(dock);
  byId("tree").after(tree);
  kParts.forEach(apply);
  folds.forEach((tell) => tell());
  addEventListener("resize", () => kParts.forEach(apply));
}
