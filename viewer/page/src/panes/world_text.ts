// SPDX-License-Identifier: MIT
// The world file's text.
import { Compartment } from "@codemirror/state";
import { EditorView } from "codemirror";
import { oneDark } from "@codemirror/theme-one-dark";
import { h } from "../dom";
import type { Client } from "../store/client";
import type { Store } from "../store/store";
import { editor, put } from "./editor";

export class WorldTextPane {
  readonly pane: HTMLElement;
  private view: EditorView;
  private theme = new Compartment();
  constructor(
    private store: Store,
    private client: Client,
  ) {
    const area = h("div", { className: "editor", id: "world-text" });
    this.pane = h(
      "div",
      { className: "pane column" },
      h(
        "div",
        { className: "toolbar" },
        h("button", { onclick: () => this.apply(), title: "The world becomes what is written here (Ctrl S)" }, "Apply"),
        h("span", { className: "dim" }, "the world file as it will be saved"),
      ),
      area,
    );
    this.view = editor(area, () => this.apply(), this.theme, store.dark);
    store.on("theme", (dark) => this.setDark(dark));
    store.on("world", () => this.show(store.world.text));
    store.on("worldLine", (line) => {
      if (!line) return;
      store.tell("show", "text");
      this.goTo(line);
    });
  }
  setDark(dark: boolean) {
    this.view.dispatch({ effects: this.theme.reconfigure(dark ? oneDark : []) });
  }
  show(text: string) {
    if (this.view.state.doc.toString() !== text && !this.view.hasFocus) put(this.view, text);
  }
  goTo(line: number) {
    const at = this.view.state.doc.line(Math.min(line, this.view.state.doc.lines));
    this.view.dispatch({ selection: { anchor: at.from, head: at.to }, scrollIntoView: true });
  }
  private apply() {
    this.client.do("edit", { op: "text", text: this.view.state.doc.toString() });
  }
}
