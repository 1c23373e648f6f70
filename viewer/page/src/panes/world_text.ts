// SPDX-License-Identifier: MIT
// The world file's text.
import { h } from "../dom";
import { beginAnew, notice } from "../frame/notices";
import { isDirty, kWorldKey } from "../store/buffer";
import type { Buffer } from "../store/buffer";
import type { Buffers, Saved } from "../store/buffers";
import type { Store } from "../store/store";
import { banner, TextEditor } from "./editor";

export class WorldTextPane {
  readonly pane: HTMLElement;
  readonly editor: TextEditor;
  private state = h("span", { className: "dim", id: "world-text-state" });
  private told = h("div", { id: "world-conflict" });
  private button = h(
    "button",
    { id: "apply", onclick: () => void this.apply(), title: "The world becomes what is written here (Ctrl S)" },
    "Apply",
  );

  constructor(
    private store: Store,
    private buffers: Buffers,
  ) {
    this.editor = new TextEditor({
      id: "world-text",
      label: "Text of the world file",
      dark: store.dark,
      save: () => void this.apply(),
      typed: (text) => this.buffers.edit(kWorldKey, text),
    });
    this.pane = h(
      "div",
      { className: "pane column" },
      h("div", { className: "toolbar" }, this.button, this.state),
      this.told,
      this.editor.element,
    );
    store.on("theme", (dark) => this.editor.setDark(dark));
    store.on("buffer", (b) => {
      if (b.key === kWorldKey) this.changed(b);
    });
    store.on("worldLine", (line) => {
      if (!line) return;
      store.tell("show", "text");
      this.editor.goTo(line, 1, true);
    });
  }
  private changed(b: Buffer) {
    this.editor.show(b.key, b.read === undefined ? undefined : b.text);
    const dirty = isDirty(b);
    this.button.classList.toggle("strong", dirty);
    this.state.textContent = dirty ? "• typed here, not applied yet" : "the world file as it will be saved";
    const tab = document.getElementById("tab-text");
    if (tab) tab.dataset.dirty = dirty ? "yes" : "";
    const c = b.conflict;
    if (!c) {
      this.editor.compare(undefined);
      return this.told.replaceChildren();
    }
    this.told.replaceChildren(
      banner("The world has changed in the same lines meanwhile. What is typed here stays until you choose.", [
        {
          id: "world-reload",
          text: "Take the world's",
          title: "What the world has now takes the place of what is typed here (Ctrl Z brings it back)",
          act: () => this.buffers.reload(kWorldKey),
        },
        {
          id: "world-overwrite",
          text: "Apply mine",
          title: "The world becomes what is written here, also in those lines",
          act: () => void this.apply(true),
        },
        this.editor.comparison("world-compare", c.text!, () => this.changed(b)),
      ]),
    );
  }
  /** Beside another text, from wherever. */
  compareWith(other: string, where: string) {
    this.editor.compare(other);
    this.told.replaceChildren(
      banner(`Beside the text ${where}: lines that differ stand below each other.`, [
        {
          id: "world-compared",
          text: "No comparison",
          title: "Only the world's text",
          act: () => {
            this.editor.compare(undefined);
            this.changed(this.buffers.world);
          },
        },
      ]),
    );
  }
  /** True when the world is what is written here. */
  async apply(overwrite = false, anew = false): Promise<boolean> {
    let result: Saved;
    try {
      result = await this.buffers.apply(overwrite, anew);
    } catch (e) {
      const { message, anew: wantsAnew } = e as Error & { anew?: boolean };
      if (!wantsAnew) notice(message, true);
      else if (await beginAnew(message)) return this.apply(overwrite, true);
      return false;
    }
    if (result === "conflict") {
      this.store.tell("show", "text");
      notice("The world has changed in the same lines meanwhile: nothing was applied. Choose above the text.", true);
    }
    return result === "saved";
  }
}
