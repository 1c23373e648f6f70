// SPDX-License-Identifier: MIT
// Ctrl C, X and V of pieces, as their text in the world file: other pages and text editors can have it.
import type { Pieces } from "../store/pieces";
import { notice } from "./notices";

/** The scene, the list of pieces, or nothing has the focus; and no text is selected. */
const isForPieces = () => {
  const at = document.activeElement;
  const free = !at || at === document.body || !!at.closest("#stage canvas, #pieces");
  return free && !String(getSelection?.() ?? "");
};

export function listenToClipboard(pieces: Pieces) {
  const copy = async (removes: boolean) => {
    const text = await pieces.toClipboard();
    if (text === undefined) return;
    await navigator.clipboard?.writeText(text).catch(() => {
      notice("The browser keeps its clipboard: pieces can be put in with Ctrl V in this page only.", true);
    });
    notice(`${pieces.all().length} ${pieces.all().length === 1 ? "piece" : "pieces"} copied`);
    if (removes) pieces.remove();
  };
  for (const kind of ["copy", "cut"] as const)
    document.addEventListener(kind, (e) => {
      if (!isForPieces() || !pieces.all().length) return;
      e.preventDefault();
      void copy(kind === "cut");
    });
  document.addEventListener("paste", (e) => {
    if (!isForPieces()) return;
    const text = e.clipboardData?.getData("text/plain") ?? "";
    if (text.trim()) void pieces.paste(text);
  });
}
