// SPDX-License-Identifier: MIT
// What robots say on their serial lines, and a line to type to them.
import { h } from "../dom";
import { notice } from "../frame/notices";
import type { Client } from "../store/client";
import type { Store } from "../store/store";
import { bytesOf, kLineEnds, Utf8Pieces } from "./bytes";
import type { Characters } from "./bytes";

const kMostLines = 2000;
const kMostLetters = 4000; // of a line: what has no line ends is broken there
const kMostTyped = 50;
const kNear = 40; // px from the end: new lines are followed
const kWaitForRest = 0.05; // simulated s, for the other bytes of a character

interface Open {
  line?: HTMLElement;
  text?: Text;
  pieces: Utf8Pieces;
  cameAt: number;
}

export class Console {
  readonly pane: HTMLElement;
  private lines = h("div", {
    id: "console-lines",
    tabIndex: 0,
    role: "log",
    "aria-label": "What robots and supervisors say",
  });
  private robot = h("select", { title: "Whose serial line", "aria-label": "Whose serial line" });
  private port = h(
    "select",
    { title: "UART 1 (Bluetooth) or 2", "aria-label": "Serial port" },
    h("option", { value: "1" }, "UART 1"),
    h("option", { value: "2" }, "UART 2"),
  );
  private end = h(
    "select",
    {
      id: "line-end",
      title: "What Enter adds to what is typed",
      "aria-label": "Line end",
      onchange: () => this.remember(),
    },
    ...Object.keys(kLineEnds).map((name) => h("option", { value: name }, name === "none" ? "no line end" : name)),
  );
  private characters = h(
    "select",
    {
      id: "characters",
      title: "How characters beyond ASCII become bytes: é is the two bytes C3 A9 in UTF-8, the one byte E9 in Latin-1",
      "aria-label": "Characters beyond ASCII",
      onchange: () => this.remember(),
    },
    h("option", { value: "utf-8" }, "UTF-8"),
    h("option", { value: "latin-1" }, "Latin-1"),
  );
  private input = h("input", {
    id: "console-input",
    placeholder: "Type to the robot; Enter sends. Bytes: \\xF5",
    "aria-label": "Text for the robot",
    title:
      "Enter sends. \\xNN is a byte, \\n \\r \\t \\0 are what they are in C, \\\\ is a backslash. Up and Down: what was sent before",
    onkeydown: (e: KeyboardEvent) => this.key(e),
  });
  private open = new Map<string, Open>();
  private sent: string[] = [];
  private sentAt = 0;

  constructor(
    private store: Store,
    private client: Client,
  ) {
    this.end.value = localStorage.getItem("line-end") ?? "CR";
    this.characters.value = localStorage.getItem("characters") ?? "utf-8";
    this.pane = h(
      "div",
      { className: "pane column" },
      this.lines,
      h(
        "div",
        { className: "toolbar" },
        this.robot,
        this.port,
        this.input,
        this.end,
        this.characters,
        h("button", { onclick: () => this.clear() }, "Clear"),
      ),
    );
    this.hint();
    store.on("world", () => this.robots(store.world.robots.map((r) => r.name)));
    store.on("selection", ({ changed }) => {
      const robot = store.selectedRobot();
      if (robot && changed) this.robot.value = robot.name;
    });
    store.on("serial", (e) => this.hear(e.robot + (e.port === 2 ? " uart2" : ""), e.text, e.time_s));
    store.on("pulse", () => this.waited(store.frame?.time ?? 0));
    store.on("says", (text) => this.say("supervisor", text + "\n", "dim"));
    store.on("trap", (e) => this.say(e.robot, `${e.kind}: ${e.text}, at ${e.place}\n`, "bad"));
    store.on("jump", (at) => this.shownUntil(store.live ? Infinity : store.past.frames[at].time));
  }
  private remember() {
    localStorage.setItem("line-end", this.end.value);
    localStorage.setItem("characters", this.characters.value);
  }
  private hint() {
    this.lines.append(
      h("p", { className: "dim hint" }, "Nothing has been said. What robots send on their serial lines stands here."),
    );
  }
  clear() {
    this.lines.replaceChildren();
    this.open.clear();
    this.hint();
  }
  private robots(names: string[]) {
    const was = this.robot.value;
    this.robot.replaceChildren(...names.map((n) => h("option", { value: n }, n)));
    if (names.includes(was)) this.robot.value = was;
  }

  // --- to the robot

  private key(e: KeyboardEvent) {
    if (e.key === "Enter" && !e.isComposing) this.send();
    else if ((e.key === "ArrowUp" || e.key === "ArrowDown") && this.sent.length) {
      e.preventDefault();
      this.sentAt = Math.min(this.sent.length, Math.max(0, this.sentAt + (e.key === "ArrowUp" ? -1 : 1)));
      this.input.value = this.sent[this.sentAt] ?? "";
    }
  }
  private async send() {
    const typed = this.input.value;
    let bytes: string;
    try {
      bytes = bytesOf(typed, this.characters.value as Characters) + kLineEnds[this.end.value];
    } catch (e) {
      return notice((e as Error).message, true);
    }
    if (!bytes) return;
    const done = await this.client.do("type", { robot: this.robot.value, port: Number(this.port.value), bytes });
    // what was not sent stays to be mended
    if (!done || this.input.value !== typed) return;
    this.input.value = "";
    if (this.sent[this.sent.length - 1] !== typed) this.sent.push(typed);
    if (this.sent.length > kMostTyped) this.sent.shift();
    this.sentAt = this.sent.length;
  }

  // --- from it

  private of(who: string): Open {
    let open = this.open.get(who);
    if (!open) this.open.set(who, (open = { pieces: new Utf8Pieces(), cameAt: 0 }));
    return open;
  }
  /** Bytes of a serial line. */
  hear(who: string, bytes: string, time: number) {
    const open = this.of(who);
    if (open.pieces.waits && time > open.cameAt + kWaitForRest) this.say(who, open.pieces.flush(), "", open.cameAt);
    open.cameAt = time;
    const text = open.pieces.take(bytes);
    if (text) this.say(who, text, "", time);
  }
  /** The rest of a character has not come. */
  private waited(time: number) {
    for (const [who, open] of this.open)
      if (open.pieces.waits && time > open.cameAt + kWaitForRest) this.say(who, open.pieces.flush(), "", open.cameAt);
  }
  say(who: string, text: string, kind = "", time?: number) {
    const { lines } = this;
    const stays = lines.scrollHeight - lines.scrollTop - lines.clientHeight > kNear;
    const parts = text.split(/\r\n|\r|\n/),
      open = this.of(who);
    lines.querySelector(".hint")?.remove();
    parts.forEach((part, i) => {
      const ends = i < parts.length - 1;
      if (!open.line && part !== "") this.begin(who, open, kind, time);
      open.text?.appendData(part);
      if (ends || (open.text?.length ?? 0) > kMostLetters) open.line = open.text = undefined;
    });
    while (lines.childElementCount > kMostLines) lines.firstElementChild!.remove();
    if (!stays) lines.scrollTop = lines.scrollHeight;
  }
  private begin(who: string, open: Open, kind: string, time?: number) {
    open.text = document.createTextNode("");
    open.line = h(
      "div",
      { className: kind },
      time !== undefined && h("small", {}, `${time.toFixed(3)} `),
      h("b", {}, who + " "),
      h("span", {}, open.text),
    );
    if (time !== undefined) open.line.dataset.time = String(time);
    this.lines.append(open.line);
  }
  /** What came later than what the scene shows is dim. */
  private shownUntil(time: number) {
    for (const line of this.lines.querySelectorAll<HTMLElement>("[data-time]"))
      line.classList.toggle("later", Number(line.dataset.time) > time);
  }
}
