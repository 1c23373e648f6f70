// SPDX-License-Identifier: MIT
// Beside the program, while a robot is debugged: steps, calls, variables, what is watched, registers, and the monitor's commands.
import { h, icon } from "../dom";
import { askText } from "../frame/notices";
import type { Debugging, Scope, Step, Variable, Watch } from "../store/debugging";
import type { Store } from "../store/store";

const kSteps: [Step, string, string, string][] = [
  ["continue", "play", "Go on", "F5"],
  ["pause", "pause", "Pause", "F6"],
  ["next", "over", "Step over: to the next line", "F10"],
  ["stepIn", "in", "Step in: into a function", "F11"],
  ["stepOut", "out", "Step out: to the function's end", "Shift F11"],
  ["stepBack", "back", "Step back: to the line before", "Alt F10"],
  ["reverseContinue", "reverse", "Back to the breakpoint before", "Alt F5"],
];
const kKeys: Record<string, Step> = {
  F5: "continue",
  F6: "pause",
  F10: "next",
  F11: "stepIn",
  "Shift F11": "stepOut",
  "Alt F10": "stepBack",
  "Alt F5": "reverseContinue",
};

export class DebuggerPane {
  /** Beside the program. */
  readonly pane: HTMLElement;
  /** For the program's toolbar. */
  readonly begin = h("button", {
    id: "debug-begin",
    title:
      "Its program stops where the run stands, and the world with it. A click in the margin sets a breakpoint (F9), a right click one with a condition",
    onclick: () => void this.toggle(),
  });
  private says = h("output", { id: "debug-state", className: "dim" });
  private steps = kSteps.map(([step, sign, title, key]) =>
    h(
      "button",
      {
        id: `debug-${step}`,
        title: `${title} (${key})`,
        "aria-label": title,
        onclick: () => void this.debug.step(step),
      },
      icon(sign),
    ),
  );
  private why = h(
    "button",
    {
      id: "debug-why",
      title: "What it waits for, and who could set it",
      onclick: () => void this.debug.monitor("why"),
    },
    "Why?",
  );
  private calls = h("ol", { id: "debug-calls", className: "list", "aria-label": "Calls" });
  private variables = h("div", { id: "debug-variables" });
  private watches = h("ul", { id: "debug-watches", className: "list", "aria-label": "Watched expressions" });
  private points = h("ul", { id: "debug-breakpoints", className: "list", "aria-label": "Breakpoints" });
  private output = h("pre", { id: "debug-output", role: "log", tabIndex: 0, "aria-label": "What the debugger says" });
  constructor(
    private store: Store,
    private debug: Debugging,
  ) {
    const watch = h("input", {
      id: "debug-watch",
      placeholder: "Watch: ticks, motors[1].speed, T1CON",
      "aria-label": "Expression to watch",
      onkeydown: (e: KeyboardEvent) => {
        if (e.key !== "Enter") return;
        void debug.watch(watch.value.trim());
        watch.value = "";
      },
    });
    const ask = h("input", {
      id: "debug-ask",
      placeholder: "why, dis, x 0x800 16, info interrupts, help",
      "aria-label": "Command for the debugger",
      title: "A command of the monitor; help lists all",
      onkeydown: (e: KeyboardEvent) => {
        if (e.key !== "Enter" || !ask.value.trim()) return;
        void debug.monitor(ask.value.trim());
        ask.value = "";
      },
    });
    const part = (title: string, open: boolean, ...children: HTMLElement[]) =>
      h("details", { className: "part-of", open }, h("summary", {}, title), ...children);
    this.pane = h(
      "aside",
      { id: "debugger", "aria-label": "Debugger", hidden: true },
      h("div", { className: "toolbar wrap debug" }, ...this.steps, this.why, this.says),
      h(
        "div",
        { className: "parts" },
        part("Watched", true, watch, this.watches),
        this.variables,
        part("Calls", true, this.calls),
        part("Breakpoints", true, this.points),
        part("What the debugger says", true, this.output, ask),
      ),
    );
    store.on("debug", () => this.show());
    store.on("breakpoints", () => this.showPoints());
    store.on("selection", () => this.showState());
    store.on("state", () => this.showState());
    addEventListener("keydown", (e) => this.key(e));
    this.show();
  }
  private target() {
    return this.store.selectedRobot() ?? this.store.world.robots[0];
  }
  private async toggle() {
    if (this.debug.debugged) return this.debug.end();
    const robot = this.target();
    if (robot) await this.debug.start(robot.name);
  }
  private key(e: KeyboardEvent) {
    if (!this.debug.debugged || e.ctrlKey || e.metaKey) return;
    const step = kKeys[`${e.altKey ? "Alt " : ""}${e.shiftKey ? "Shift " : ""}${e.key}`];
    if (!step) return;
    e.preventDefault();
    if (step === "pause" ? !this.debug.stands : this.debug.stands) void this.debug.step(step);
  }

  private show() {
    this.showState();
    this.showCalls();
    this.showScopes();
    this.showWatches();
    this.showPoints();
    const text = this.debug.output.join("\n");
    if (this.output.textContent !== text) {
      this.output.textContent = text;
      this.output.scrollTop = this.output.scrollHeight;
      this.output.scrollIntoView?.({ block: "nearest" });
    }
  }
  private showState() {
    const { debugged, stands, reason } = this.debug,
      robot = this.target();
    this.begin.textContent = debugged ? `End debugging ${debugged}` : robot ? `Debug ${robot.name}` : "Debug";
    this.begin.classList.toggle("on", !!debugged);
    this.begin.disabled = !debugged && !robot;
    kSteps.forEach(([step], i) => (this.steps[i].disabled = !debugged || (step === "pause" ? stands : !stands)));
    this.why.disabled = !stands;
    this.says.textContent = !debugged ? "" : stands ? `stands: ${reason}` : "runs";
    this.pane.hidden = !debugged;
  }
  private showCalls() {
    const { calls, call, stands } = this.debug;
    this.calls.replaceChildren(
      ...(stands ? calls : []).map((c, i) =>
        h(
          "li",
          {},
          h(
            "button",
            {
              className: i === call ? "row on" : "row",
              "aria-current": i === call ? "true" : "false",
              title: "Go there",
              onclick: () => this.debug.goTo(i),
            },
            c.name,
            h("small", {}, c.place),
          ),
        ),
      ),
    );
  }
  private showScopes() {
    const { scopes, stands } = this.debug;
    if (!stands) return this.variables.classList.add("later");
    this.variables.classList.remove("later");
    this.variables.replaceChildren(
      ...scopes.map((scope) => {
        const box = h(
          "details",
          { open: !scope.expensive && (scope.name === "Variables" || this.debug.open.has(scope.name)) },
          h("summary", {}, scope.name),
          ...(scope.variables ?? []).map((v) => this.variable(v)),
        );
        if (this.debug.open.has(scope.name)) box.open = true;
        box.addEventListener("toggle", () => this.unfold(scope, box.open));
        return box;
      }),
    );
  }
  private unfold(scope: Scope, open: boolean) {
    if (open !== this.debug.open.has(scope.name) || (open && !scope.variables)) void this.debug.unfold(scope, open);
  }
  private variable(v: Variable) {
    return h(
      "div",
      { className: v.changed ? "variable changed" : "variable" },
      h("span", {}, v.name),
      h(
        "button",
        {
          className: "value",
          title: "Change it",
          "aria-label": `${v.name} = ${v.value}, change`,
          onclick: () => void this.change(v),
        },
        v.value,
      ),
    );
  }
  private async change(v: Variable) {
    const plain = v.value.replace(/ \(.*$/, "");
    const to = await askText(`${v.name} =`, plain);
    if (to !== undefined && to !== plain) await this.debug.set(v, to);
  }
  private showWatches() {
    this.watches.replaceChildren(...this.debug.watches.map((w) => h("li", {}, this.watch(w))));
  }
  private watch(w: Watch) {
    return h(
      "div",
      { className: "variable" },
      h("span", {}, w.expression),
      h("span", { className: w.wrong ? "value bad" : "value" }, w.value || "–"),
      h(
        "button",
        {
          className: w.stops ? "tiny on" : "tiny",
          title: "Stop when it changes",
          "aria-label": `Stop when ${w.expression} changes`,
          "aria-pressed": String(w.stops),
          onclick: () => void this.debug.stopAt(w, !w.stops),
        },
        "●",
      ),
      h(
        "button",
        {
          className: "tiny",
          title: "No more",
          "aria-label": `${w.expression}: no more`,
          onclick: () => this.debug.unwatch(w),
        },
        "×",
      ),
    );
  }
  private showPoints() {
    this.points.replaceChildren(
      ...this.debug.files().flatMap(([key, list]) => {
        const [program, file] = key.split("\n");
        return list.map((b) =>
          h(
            "li",
            {},
            h(
              "div",
              { className: "variable" },
              h(
                "button",
                {
                  className: "row",
                  title: b.message ?? "Go there",
                  onclick: () => this.store.tell("sourceLine", { program, file, line: b.line }),
                },
                `${file}:${b.line}`,
                h("small", {}, b.condition ? `if ${b.condition}` : b.verified === false ? "not reachable" : ""),
              ),
              h(
                "button",
                {
                  className: "tiny",
                  title: "No more",
                  "aria-label": `Breakpoint ${file}:${b.line}: no more`,
                  onclick: () => this.debug.toggle(key, b.line),
                },
                "×",
              ),
            ),
          ),
        );
      }),
    );
  }
}
