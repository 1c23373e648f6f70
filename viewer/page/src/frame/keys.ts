// SPDX-License-Identifier: MIT
// What keys do.
import type { Inspector } from "../panes/inspector";
import type { Touch } from "../scene/touch";
import type { Client } from "../store/client";
import type { Pieces } from "../store/pieces";
import type { Store } from "../store/store";
import type { Bar, Views } from "./bar";
import type { ViewButtons } from "./views";
import { makeKeyList, toggleKeys } from "./key_list";
import { dismiss } from "./notices";
import type { WorldFile } from "./save";

export interface Hands {
  store: Store;
  client: Client;
  pieces: Pieces;
  bar: Bar;
  file: WorldFile;
  views: Views;
  touch: Touch;
  inspector: Inspector;
  viewButtons: ViewButtons;
}

export function listenToKeys(hands: Hands) {
  makeKeyList();
  addEventListener("keydown", (e) => act(e, hands));
  // a button that the mouse has pressed gives the keys back to the scene; one that the keyboard has reached keeps them
  addEventListener("click", (e) => {
    const button = (e.target as HTMLElement).closest?.("button");
    if (button && e.detail > 0 && document.activeElement === button) button.blur();
  });
}

/**
 * Keys that change the scene are for it alone: a field, a slider has its own. The list of pieces selects what they
 * change, and keeps only those that it takes for itself.
 */
const isForScene = (target: HTMLElement) =>
  target === document.body || target === document.documentElement || !!target.closest?.("#stage canvas,#pieces");

function act(e: KeyboardEvent, { store, client, pieces, bar, file, views, touch, inspector, viewButtons }: Hands) {
  if (e.defaultPrevented) return;
  const target = e.target as HTMLElement;
  const ctrl = e.ctrlKey || e.metaKey,
    key = e.key.length === 1 ? e.key.toLowerCase() : e.key;
  const act = (f: () => unknown) => {
    e.preventDefault();
    f();
  };
  const typing = target.closest?.("input:not([type=range]):not([type=checkbox]),textarea,select,.cm-editor");
  if (ctrl && key === "s" && !target.closest?.(".cm-editor")) return act(() => void file.save());
  if (typing) {
    if (key === "Escape") target.blur();
    return;
  }
  if (ctrl) {
    const keys: Record<string, () => unknown> = {
      z: () => client.do(e.shiftKey ? "redo" : "undo"),
      y: () => client.do("redo"),
      d: () => pieces.copy(),
      a: () => store.selectAll([...store.world.robots, ...store.world.things].map((p) => p.id)),
      r: () => bar.restart(),
    };
    if (keys[key]) act(keys[key]);
    return;
  }
  if (key === "Escape") {
    dismiss();
    toggleKeys(false);
  }
  if (key === "?" && target.id === "keys") return act(() => toggleKeys(false));
  if (!isForScene(target)) {
    if (key === "Escape") target.blur();
    return;
  }
  const move = (x: number, y: number) => pieces.nudge(x, y, e.shiftKey ? 0.001 : 0.01);
  const tools: Record<string, string> = {
    v: "select",
    w: "wall",
    b: "box",
    c: "cylinder",
    o: "ball",
    l: "lamp",
    r: "robot",
  };
  const keys: Record<string, () => unknown> = {
    " ": () => bar.togglePlay(),
    n: () => bar.step(e.shiftKey ? "tick" : "control"),
    i: () => bar.stepInterrupt(),
    ",": () => bar.faster(-1),
    ".": () => bar.faster(1),
    "1": () => views.fit(true),
    "2": () => views.fit(false),
    f: () => views.fit(true),
    y: () => client.toggleRays(),
    p: () => bar.toggleTrails(),
    q: () => pieces.turn(e.shiftKey ? 1 : 15),
    e: () => pieces.turn(e.shiftKey ? -1 : -15),
    Delete: () => pieces.remove(),
    Backspace: () => pieces.remove(),
    k: () => inspector.toggleView(),
    Escape: () => {
      touch.choose("select");
      store.select(0);
    },
    ArrowLeft: () => move(-1, 0),
    ArrowRight: () => move(1, 0),
    ArrowUp: () => move(0, 1),
    ArrowDown: () => move(0, -1),
    "?": () => toggleKeys(),
  };
  const view = viewButtons.act(key);
  if (view) act(view);
  else if (tools[key]) act(() => touch.choose(tools[key]));
  else if (keys[key]) act(keys[key]);
}
