// SPDX-License-Identifier: MIT
// The cursor in the console: the last line until then is marked, and the pointer on a line says its time.
import type { Store } from "../store/store";

export function showCursorIn(lines: HTMLElement, store: Store) {
  let marked: Element | null = null;
  const timeOf = (line: Element) => Number((line as HTMLElement).dataset.time ?? NaN);
  store.on("cursor", () => {
    const { time } = store.cursor;
    let now: Element | null = null;
    if (time !== undefined && lines.offsetParent)
      // lines come in time, so the last ones are looked at first
      for (let line = lines.lastElementChild; line; line = line.previousElementSibling)
        if (timeOf(line) <= time) {
          now = line;
          break;
        }
    if (now === marked) return;
    marked?.classList.remove("cursor");
    now?.classList.add("cursor");
    marked = now;
    if (now && !lines.matches(":hover")) now.scrollIntoView({ block: "nearest" });
  });
  lines.addEventListener("pointerover", (e) => {
    const line = (e.target as HTMLElement).closest<HTMLElement>("[data-time]");
    store.cursor.pointAt(line ? timeOf(line) : undefined);
  });
  lines.addEventListener("pointerleave", () => store.cursor.pointAt(undefined));
}
