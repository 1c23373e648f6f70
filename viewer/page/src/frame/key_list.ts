// SPDX-License-Identifier: MIT
// The list of keys, over the scene.
import { byId, h } from "../dom";

const kKeys: [string, string][] = [
  ["Space", "play, pause"],
  ["N, Shift N", "one control step, one tick"],
  ["I", "to the next interrupt"],
  [", .", "slower, faster"],
  ["Ctrl R", "restart"],
  ["1 2 F", "from above, aslant, fit"],
  ["3 4 M", "view follows the robot, goes behind it; ruler"],
  ["Y P K", "rays, paths, what the camera sees"],
  ["V W B C O L R", "select; wall, box, cylinder, ball, lamp, robot"],
  ["Q E", "turn by 15°, with Shift 1°"],
  ["Arrows", "move by 1 cm, with Shift 1 mm"],
  ["Shift or Ctrl click", "selects several; dragged on the floor: all in a frame"],
  ["Ctrl A", "selects all"],
  ["Ctrl D, Del", "copy, delete"],
  ["Ctrl C X V", "to and from the clipboard"],
  ["Ctrl Z Y S", "undo, redo, save"],
  ["Shift while dragging", "without the grid of 1 cm"],
  ["Left, right drag, wheel", "move the view, turn it, zoom"],
  ["Esc", "nothing selected"],
];

let before: HTMLElement | null = null; // who gets the focus back

export function makeKeyList() {
  byId("stage").append(
    h(
      "div",
      { id: "keys", hidden: true, role: "dialog", "aria-label": "Keys", tabIndex: -1 },
      h("h3", {}, "Keys"),
      ...kKeys.map(([k, text]) => h("div", {}, h("kbd", {}, k), text)),
    ),
  );
}

/** Opens or closes the list of keys, which has the focus while it is open: arrows scroll it. */
export function toggleKeys(open = byId("keys").hidden) {
  const keys = byId("keys");
  if (keys.hidden !== open) return;
  if (open) before = document.activeElement as HTMLElement | null;
  keys.hidden = !open;
  if (open) keys.focus();
  else if (before?.isConnected) before.focus();
}
