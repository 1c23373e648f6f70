// SPDX-License-Identifier: MIT
// The text editor of programs and of the world file: one view, and a state with its own undo for each file.
import { EditorView, basicSetup } from "codemirror";
import { indentWithTab, isolateHistory } from "@codemirror/commands";
import { diff, goToNextChunk, unifiedMergeView } from "@codemirror/merge";
import { HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";
import { oneDark } from "@codemirror/theme-one-dark";
import { Annotation, EditorState, Compartment, StateEffect, StateField } from "@codemirror/state";
import type { Extension } from "@codemirror/state";
import { Decoration, keymap } from "@codemirror/view";
import type { DecorationSet } from "@codemirror/view";
import { h } from "../dom";

const kLook = EditorView.theme({
  "&": { height: "100%" },
  ".cm-scroller": { fontFamily: "var(--mono)", fontSize: "13px" },
});
// what the usual colours have below a contrast of 4.5
const kOnDark = syntaxHighlighting(HighlightStyle.define([{ tag: [tags.comment, tags.meta], color: "#98a3b3" }]));
const kOnLight = syntaxHighlighting(
  HighlightStyle.define([
    { tag: [tags.regexp, tags.escape, tags.special(tags.string)], color: "#b34700" },
    { tag: tags.invalid, color: "#b3001b" },
    { tag: tags.comment, color: "#7a4a00" },
  ]),
);
/** A change that comes from the file, not from a hand. */
const fromFile = Annotation.define<boolean>();

/** A line with a mark, 0: none. */
const markLine = StateEffect.define<number>();
const markedLine = StateField.define<DecorationSet>({
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

export interface EditorOptions {
  id: string;
  label: string;
  dark: boolean;
  save: () => void;
  typed: (text: string) => void;
  extensions?: Extension[];
}

export class TextEditor {
  readonly element: HTMLElement;
  readonly view: EditorView;
  private theme = new Compartment();
  private writable = new Compartment();
  private comparing = new Compartment();
  private states = new Map<string, EditorState>();
  private key = "";
  private marked = 0;
  private compared = false;

  constructor(private options: EditorOptions) {
    this.element = h("div", { className: "editor", id: options.id });
    this.view = new EditorView({ parent: this.element, state: this.fresh("", false) });
  }
  private fresh(text: string, writable: boolean) {
    const { options } = this;
    return EditorState.create({
      doc: text,
      extensions: [
        options.extensions ?? [],
        basicSetup,
        keymap.of([indentWithTab, { key: "Mod-s", run: () => (options.save(), true), preventDefault: true }]),
        this.theme.of(this.themeOf(options.dark)),
        this.writable.of(EditorState.readOnly.of(!writable)),
        this.comparing.of([]),
        kLook,
        markedLine,
        EditorView.contentAttributes.of({ "aria-label": options.label }),
        EditorView.updateListener.of((u) => {
          if (u.docChanged && !u.transactions.some((t) => t.annotation(fromFile)))
            options.typed(u.state.doc.toString());
        }),
      ],
    });
  }
  private themeOf = (dark: boolean) => (dark ? [kOnDark, oneDark] : kOnLight);

  get text() {
    return this.view.state.doc.toString();
  }
  get lines() {
    return this.view.state.doc.lines;
  }
  get markedLine() {
    return this.marked;
  }
  /** What a banner offers for that; `done`: it is shown, or no more. */
  comparison(id: string, other: string, done: () => void): Choice {
    const act = () => {
      this.compare(this.comparesNow ? undefined : other);
      done();
    };
    const text = this.comparesNow ? "No comparison" : "Compare";
    return { id, text, title: "Differing lines below each other", act };
  }
  get comparesNow() {
    return this.compared;
  }
  /** Shows that file. Undefined text: it has not come, and nothing can be typed. */
  show(key: string, text: string | undefined) {
    if (key !== this.key) {
      this.compare(undefined);
      if (this.key) this.states.set(this.key, this.view.state);
      this.key = key;
      this.marked = 0;
      this.view.setState(this.states.get(key) ?? this.fresh(text ?? "", false));
      this.view.dispatch({
        effects: [this.theme.reconfigure(this.themeOf(this.options.dark)), markLine.of(0)],
      });
    }
    this.view.dispatch({ effects: this.writable.reconfigure(EditorState.readOnly.of(text === undefined)) });
    if (text !== undefined) this.put(text);
  }
  /** Another text: only what differs is changed, so that the cursor stays; Ctrl Z brings the old one back. */
  put(text: string, byHand = false) {
    const now = this.text;
    if (text === now) return;
    const changes = diff(now, text, { scanLimit: 500, timeout: 50 }).map((c) => ({
      from: c.fromA,
      to: c.toA,
      insert: text.slice(c.fromB, c.toB),
    }));
    const notes = byHand ? [] : [fromFile.of(true), isolateHistory.of("full")];
    this.view.dispatch({ changes, annotations: notes });
  }
  /** What is there instead, beside what is typed: differing lines stand below each other. Undefined: no more. */
  compare(original: string | undefined) {
    this.compared = original !== undefined;
    this.view.dispatch({
      effects: this.comparing.reconfigure(
        original === undefined
          ? []
          : unifiedMergeView({
              original,
              mergeControls: (type, action) =>
                h(
                  "button",
                  { className: "tiny", onmousedown: action },
                  type === "accept" ? "Keep mine" : "Take theirs",
                ),
            }),
      ),
    });
    if (original === undefined) return;
    this.view.dispatch({ selection: { anchor: 0 } });
    goToNextChunk(this.view);
  }
  /** Marks a line, 0: none. */
  mark(line: number) {
    const here = line <= this.lines ? line : 0;
    if (here !== this.marked) this.view.dispatch({ effects: markLine.of(here) });
    this.marked = here;
  }
  goTo(line: number, column = 1, select = false) {
    const at = this.view.state.doc.line(Math.max(1, Math.min(line, this.lines))),
      head = Math.min(at.to, at.from + Math.max(0, column - 1));
    this.view.dispatch({
      selection: select ? { anchor: at.from, head: at.to } : { anchor: head },
      effects: EditorView.scrollIntoView(at.from, { y: "center" }),
    });
  }
  setDark(dark: boolean) {
    this.options.dark = dark;
    this.view.dispatch({ effects: this.theme.reconfigure(this.themeOf(dark)) });
  }
  get hasFocus() {
    return this.view.hasFocus;
  }
}

/** Says that a file is another one than was read, and what can be done. */
export interface Choice {
  id: string;
  text: string;
  title: string;
  act: () => void;
}
export function banner(text: string, choices: Choice[]): HTMLElement {
  return h(
    "div",
    { className: "banner", role: "status" },
    h("span", {}, text),
    ...choices.map((c) => h("button", { id: c.id, title: c.title, onclick: c.act }, c.text)),
  );
}
