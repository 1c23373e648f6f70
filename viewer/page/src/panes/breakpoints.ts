// SPDX-License-Identifier: MIT
// Breakpoints in the editor's margin: a click sets one or takes it away, a right click asks for its condition. They move
// with their lines.
import { RangeSet, StateEffect, StateField } from "@codemirror/state";
import type { Extension } from "@codemirror/state";
import { EditorView, gutter, GutterMarker, keymap } from "@codemirror/view";
import type { Breakpoint } from "../store/debugging";

class Mark extends GutterMarker {
  constructor(readonly of: Breakpoint) {
    super();
  }
  eq(other: Mark) {
    return JSON.stringify(this.of) === JSON.stringify(other.of);
  }
  toDOM() {
    const dot = document.createElement("span"),
      { line, condition, verified, message } = this.of;
    if (!line) return dot; // only room for one
    dot.className = `breakpoint${condition ? " conditional" : ""}${verified === false ? " unmet" : ""}`;
    dot.textContent = condition ? "◆" : "●";
    dot.title = [condition && `if ${condition}`, message].filter(Boolean).join("; ") || "Breakpoint";
    return dot;
  }
}
const put = StateEffect.define<readonly Breakpoint[]>();
const marks = StateField.define<RangeSet<Mark>>({
  create: () => RangeSet.empty,
  update(set, change) {
    set = set.map(change.changes);
    for (const e of change.effects)
      if (e.is(put)) {
        const { doc } = change.state;
        set = RangeSet.of(
          e.value.filter((b) => b.line <= doc.lines).map((b) => new Mark(b).range(doc.line(b.line).from)),
          true,
        );
      }
    return set;
  },
});

export interface BreakpointHands {
  toggle(line: number): void;
  askCondition(line: number): void;
  moved(lines: number[]): void;
}
export function breakpoints(hands: BreakpointHands): Extension {
  const lineAt = (view: EditorView, from: number) => view.state.doc.lineAt(from).number;
  const here = (view: EditorView) => lineAt(view, view.state.selection.main.head);
  return [
    marks,
    gutter({
      class: "cm-breakpoints",
      renderEmptyElements: true,
      markers: (view) => view.state.field(marks),
      initialSpacer: () => new Mark({ line: 0, condition: "" }),
      domEventHandlers: {
        mousedown: (view, block, e) => {
          if ((e as MouseEvent).button === 0) hands.toggle(lineAt(view, block.from));
          return true;
        },
        contextmenu: (view, block, e) => {
          e.preventDefault();
          hands.askCondition(lineAt(view, block.from));
          return true;
        },
      },
    }),
    keymap.of([
      { key: "F9", run: (view) => (hands.toggle(here(view)), true) },
      { key: "Shift-F9", run: (view) => (hands.askCondition(here(view)), true) },
    ]),
    EditorView.updateListener.of((u) => {
      if (!u.docChanged) return;
      const lines: number[] = [];
      u.state.field(marks).between(0, u.state.doc.length, (from) => void lines.push(lineAt(u.view, from)));
      hands.moved(lines);
    }),
  ];
}
export const showBreakpoints = (view: EditorView, list: readonly Breakpoint[]) =>
  view.dispatch({ effects: put.of(list) });
