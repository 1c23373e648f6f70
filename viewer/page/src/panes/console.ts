// SPDX-License-Identifier: MIT
// What robots say on their serial lines, and a line to type to them.
import { h } from "../dom";
import type { Client } from "../store/client";
import type { Store } from "../store/store";

const kConsoleLines = 2000;

export class Console {
  readonly pane: HTMLElement;
  private lines = h("pre", { id: "console-lines", tabIndex: 0 });
  private robot = h("select", { title: "Whose serial line" }) as HTMLSelectElement;
  private port = h(
    "select",
    { title: "UART 1 (Bluetooth) or 2" },
    h("option", { value: "1" }, "UART 1"),
    h("option", { value: "2" }, "UART 2"),
  ) as HTMLSelectElement;
  private open = new Map<string, HTMLElement>();
  constructor(
    private store: Store,
    private client: Client,
  ) {
    const input = h("input", {
      id: "console-input",
      placeholder: "Type to the robot; Enter sends",
      title: "Sent with a carriage return, as terminals do",
      onkeydown: (e: KeyboardEvent) => {
        if (e.key !== "Enter") return;
        this.client.do("type", { robot: this.robot.value, port: Number(this.port.value), bytes: input.value + "\r" });
        input.value = "";
      },
    }) as HTMLInputElement;
    this.pane = h(
      "div",
      { className: "pane column" },
      this.lines,
      h(
        "div",
        { className: "toolbar" },
        this.robot,
        this.port,
        input,
        h("button", { onclick: () => this.clear() }, "Clear"),
      ),
    );
    store.on("world", () => this.robots(store.world.robots.map((r) => r.name)));
    store.on("selection", ({ changed }) => {
      const robot = store.selectedRobot();
      if (robot && changed) this.choose(robot.name);
    });
    store.on("serial", (e) => this.say(e.robot + (e.port === 2 ? " uart2" : ""), e.text, "", e.time_s));
    store.on("says", (text) => this.say("supervisor", text + "\n", "dim"));
    store.on("trap", (e) => this.say(e.robot, `${e.kind}: ${e.text}, at ${e.place}\n`, "bad"));
    store.on("jump", (at) => this.shownUntil(store.live ? Infinity : store.past.frames[at].time));
  }
  clear() {
    this.lines.replaceChildren();
    this.open.clear();
  }
  robots(names: string[]) {
    const was = this.robot.value;
    this.robot.replaceChildren(...names.map((n) => h("option", { value: n }, n)));
    if (names.includes(was)) this.robot.value = was;
  }
  choose(name: string) {
    this.robot.value = name;
  }
  /** What came later than what the scene shows is dim. */
  shownUntil(time: number) {
    for (const line of this.lines.children)
      line.classList.toggle("later", Number((line as HTMLElement).dataset.time ?? 0) > time);
  }
  say(who: string, text: string, kind = "", time?: number) {
    const stays = this.lines.scrollHeight - this.lines.scrollTop - this.lines.clientHeight > 40;
    const parts = text.split(/\r\n|\r|\n/);
    parts.forEach((part, i) => {
      let line = this.open.get(who);
      if (!line && (part !== "" || i < parts.length - 1)) {
        if (part === "" && i < parts.length - 1) return;
        line = h(
          "div",
          { className: kind },
          time !== undefined && h("small", {}, `${time.toFixed(3)} `),
          h("b", {}, who + " "),
          h("span", {}),
        );
        if (time !== undefined) line.dataset.time = String(time);
        this.lines.append(line);
        this.open.set(who, line);
      }
      if (line) line.lastElementChild!.textContent += part;
      if (i < parts.length - 1) this.open.delete(who);
    });
    while (this.lines.childElementCount > kConsoleLines) this.lines.firstElementChild!.remove();
    if (!stays) this.lines.scrollTop = this.lines.scrollHeight;
  }
}
