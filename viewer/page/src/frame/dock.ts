// SPDX-License-Identifier: MIT
// Below the scene: panes behind tabs.
import { byId, h } from "../dom";
import { foldButton, unfold } from "./layout";
import type { Store } from "../store/store";

export interface Tab {
  id: string;
  text: string;
  pane: HTMLElement;
}

export class Dock {
  constructor(
    private store: Store,
    private tabs: Tab[],
  ) {
    byId("dock").replaceChildren(
      h(
        "div",
        { className: "tabs", role: "tablist", "aria-label": "Panes", onkeydown: (e: KeyboardEvent) => this.key(e) },
        ...tabs.map(({ id, text }) =>
          h(
            "button",
            { id: `tab-${id}`, role: "tab", "aria-controls": `pane-${id}`, onclick: () => this.show(id) },
            text,
          ),
        ),
        h("span", { className: "space", role: "none" }),
        foldButton("dock"),
      ),
      ...tabs.map(({ id, pane }) => {
        pane.id = `pane-${id}`;
        pane.setAttribute("role", "tabpanel");
        pane.setAttribute("aria-labelledby", `tab-${id}`);
        return pane;
      }),
    );
    store.on("show", (id) => this.show(id));
  }
  /** Left and right go from tab to tab. */
  private key(e: KeyboardEvent) {
    const at = this.tabs.findIndex((tab) => `tab-${tab.id}` === document.activeElement?.id);
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: this.tabs.length - 1 }[e.key];
    if (at < 0 || to === undefined) return;
    e.preventDefault();
    const tab = this.tabs[(to + this.tabs.length) % this.tabs.length];
    this.show(tab.id);
    byId(`tab-${tab.id}`).focus();
  }
  show(id: string) {
    for (const tab of this.tabs) {
      const button = byId(`tab-${tab.id}`),
        on = tab.id === id;
      button.classList.toggle("on", on);
      button.setAttribute("aria-selected", String(on));
      button.tabIndex = on ? 0 : -1;
      tab.pane.hidden = !on;
    }
    unfold("dock");
    this.store.dock = id;
    this.store.tell("shown", id);
  }
}
