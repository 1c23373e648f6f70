// SPDX-License-Identifier: MIT
// The text editor of programs and of the world file.
import { EditorView, basicSetup } from "codemirror";
import { indentWithTab } from "@codemirror/commands";
import { oneDark } from "@codemirror/theme-one-dark";
import { EditorState, Compartment, StateEffect, StateField } from "@codemirror/state";
import { Decoration, keymap } from "@codemirror/view";
import type { DecorationSet } from "@codemirror/view";

export function editor(parent: HTMLElement, onSave: () => void, theme: Compartment, dark: boolean, extra: any[] = []) {
  return new EditorView({
    parent,
    state: EditorState.create({
      doc: "",
      extensions: [
        basicSetup,
        keymap.of([indentWithTab, { key: "Mod-s", run: () => (onSave(), true), preventDefault: true }]),
        theme.of(dark ? oneDark : []),
        EditorView.theme({ "&": { height: "100%" }, ".cm-scroller": { fontFamily: "var(--mono)", fontSize: "13px" } }),
        ...extra,
      ],
    }),
  });
}
export const put = (view: EditorView, text: string) =>
  view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });

/** A line with a mark, 0: none. */
export const markLine = StateEffect.define<number>();
export const markedLine = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(marks, change) {
    for (const e of change.effects)
      if (e.is(markLine))
        return e.value
          ? Decoration.set(Decoration.line({ class: "stands" }).range(change.state.doc.line(e.value).from))
          : Decoration.none;
    return marks.map(change.changes);
  },
  provide: (field) => EditorView.decorations.from(field),
});
