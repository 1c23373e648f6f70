// SPDX-License-Identifier: MIT
// The world's problems, in the scene.
import { byId, h } from "../dom";
import type { Store } from "../store/store";

const kMostBadges = 8;

export function showBadges(store: Store) {
  store.on("world", () =>
    byId("badges").replaceChildren(
      ...store.world.problems.slice(0, kMostBadges).map((p) =>
        h(
          "button",
          {
            className: "bad",
            onclick: () => {
              if (p.id) store.select(p.id);
              store.tell("worldLine", p.line);
            },
          },
          `⚠ ${p.text}`,
        ),
      ),
    ),
  );
}
