// SPDX-License-Identifier: MIT
// The two markers of time in a pane's toolbar: set at the cursor, or where the scene is; and the time between them.
import { h } from "../dom";
import type { Store } from "../store/store";

export function markersBar(store: Store): HTMLElement {
  const { cursor } = store,
    said = h("output", { className: "number markers-text" }),
    away = h("button", { title: "No markers", "aria-label": "No markers", onclick: () => cursor.forgetMarkers() }, "×");
  const button = (which: "a" | "b", name: string) =>
    h(
      "button",
      {
        title: `Marker ${name} at the time that is shown; in the picture: ${which === "a" ? "click" : "Shift and click"}`,
        "aria-label": `Marker ${name} at the time that is shown`,
        onclick: () => cursor.mark(which, cursor.time ?? store.frame?.time ?? 0),
      },
      name,
    );
  const show = () => {
    said.textContent = cursor.text;
    away.hidden = !cursor.text;
  };
  store.on("cursor", show);
  show();
  return h("span", { className: "markers" }, button("a", "A"), button("b", "B"), said, away);
}
