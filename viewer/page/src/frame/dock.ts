// SPDX-License-Identifier: MIT
// Below the scene: panes behind tabs.
import { byId, h } from "../dom";
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
        { className: "tabs", role: "tablist" },
        ...tabs.map(({ id, text }) =>
          h("button", { id: `tab-${id}`, role: "tab", onclick: () => this.show(id) }, text),
        ),
        h("span", { className: "space" }),
        h("button", { title: "Larger or smaller", onclick: () => document.body.classList.toggle("tall") }, "⇕"),
      ),
      ...tabs.map(({ id, pane }) => ((pane.id = `pane-${id}`), pane)),
    );
    store.on("show", (id) => this.show(id));
  }
  show(id: string) {
    for (const tab of this.tabs) {
      byId(`tab-${tab.id}`).classList.toggle("on", tab.id === id);
      tab.pane.hidden = tab.id !== id;
    }
    this.store.dock = id;
    this.store.tell("shown", id);
  }
}
