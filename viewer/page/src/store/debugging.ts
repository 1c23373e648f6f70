// SPDX-License-Identifier: MIT
// One robot's program, debugged: breakpoints by file, where it stands, calls, variables, expressions that are watched.
// The server speaks the Debug Adapter Protocol, as it does with editors (docs/looking.md).
import type { Answer } from "../link/connection";
import { keyOf } from "./buffer";
import type { Client } from "./client";
import type { SourceLine, Store } from "./store";

export interface Breakpoint {
  line: number;
  condition: string;
  /** What the debugger says of it; undefined: nothing yet. */
  verified?: boolean;
  message?: string;
}
export interface Call {
  id: number;
  name: string;
  at?: SourceLine;
  /** Where it is, for people. */
  place: string;
}
export interface Variable {
  name: string;
  value: string;
  reference: number; // of the scope that it is in
  changed: boolean;
}
export interface Scope {
  name: string;
  reference: number;
  /** Asked for only when somebody looks. */
  expensive: boolean;
  variables?: Variable[];
}
export interface Watch {
  expression: string;
  value: string;
  wrong: boolean;
  /** The run stops when it changes. */
  stops: boolean;
  dataId?: string;
}
export type Step = "continue" | "pause" | "next" | "stepIn" | "stepOut" | "stepBack" | "reverseContinue";

const kBreakpoints = "breakpoints",
  kWatches = "watches"; // in localStorage
const kMostOutput = 400; // lines

export class Debugging {
  /** True where the program stands and can be looked at. */
  stands = false;
  /** Why it stands, for people. */
  reason = "";
  calls: Call[] = [];
  /** Of the calls: the one that is looked at. */
  call = 0;
  scopes: Scope[] = [];
  watches: Watch[] = [];
  output: string[] = [];
  /** Scopes that somebody looks at though they are expensive. */
  readonly open = new Set<string>();
  private all = new Map<string, Breakpoint[]>(); // by key of the file
  private robot = "";
  private asked = 0; // looks that have begun: only the last one counts

  constructor(
    private store: Store,
    private client: Client,
  ) {
    this.recall();
    client.link.on("dap", (e) => this.take(e.name, e.body ?? {}));
    store.on("state", ({ debugging }) => this.follow(debugging ?? ""));
  }
  get debugged() {
    return this.robot;
  }

  // --- breakpoints

  private recall() {
    try {
      const kept: Record<string, [number, string][]> = JSON.parse(localStorage.getItem(kBreakpoints) ?? "{}");
      for (const [key, list] of Object.entries(kept))
        this.all.set(
          key,
          list.map(([line, condition]) => ({ line, condition })),
        );
      const watches: string[] = JSON.parse(localStorage.getItem(kWatches) ?? "[]");
      this.watches = watches.map((expression) => ({ expression, value: "", wrong: false, stops: false }));
    } catch {
      /* somebody else's */
    }
  }
  private keep() {
    const kept = [...this.all].filter(([, list]) => list.length);
    localStorage.setItem(
      kBreakpoints,
      JSON.stringify(Object.fromEntries(kept.map(([key, list]) => [key, list.map((b) => [b.line, b.condition])]))),
    );
    localStorage.setItem(kWatches, JSON.stringify(this.watches.map((w) => w.expression)));
  }
  of(key: string): readonly Breakpoint[] {
    return this.all.get(key) ?? [];
  }
  files(): [string, readonly Breakpoint[]][] {
    return [...this.all].filter(([, list]) => list.length);
  }
  private put(key: string, list: Breakpoint[]) {
    this.all.set(
      key,
      list.sort((a, b) => a.line - b.line),
    );
    this.keep();
    this.store.tell("breakpoints", key);
    void this.send(key);
  }
  toggle(key: string, line: number) {
    const list = this.of(key);
    const without = list.filter((b) => b.line !== line);
    this.put(key, without.length < list.length ? without : [...list, { line, condition: "" }]);
  }
  /** Stops only if that holds; empty: always. */
  condition(key: string, line: number, condition: string) {
    this.put(key, [...this.of(key).filter((b) => b.line !== line), { line, condition }]);
  }
  /** Lines have moved, since somebody types above them. */
  moved(key: string, lines: number[]) {
    const list = this.of(key);
    if (lines.length !== list.length || list.every((b, i) => b.line === lines[i])) return;
    const seen = new Set<number>();
    this.all.set(
      key,
      list.map((b, i) => ({ ...b, line: lines[i] })).filter((b) => !seen.has(b.line) && seen.add(b.line)),
    );
    this.keep();
    this.store.tell("breakpoints", key);
  }
  private async send(key: string) {
    const path = this.pathOf(key);
    if (!this.robot || !path) return;
    const sent = this.of(key);
    const answer = await this.dap("setBreakpoints", {
      source: { path },
      breakpoints: sent.map((b) => (b.condition ? { line: b.line, condition: b.condition } : { line: b.line })),
    }).catch((e: Error) => this.say(e.message));
    const told: any[] = (answer as Answer | undefined)?.breakpoints ?? [];
    sent.forEach((b, i) => {
      b.verified = told[i]?.verified;
      b.message = told[i]?.message;
    });
    this.store.tell("breakpoints", key);
  }
  private pathOf(key: string) {
    const [name, file] = key.split("\n"),
      program = this.store.programs.find((p) => p.name === name);
    return program && program.robots.includes(this.robot) ? `${program.folder}/${file}` : undefined;
  }
  /** A file of a controller, as the debugger names it. */
  private lineOf(path: string, line: number): SourceLine | undefined {
    if (!line) return undefined;
    const programs = this.store.programs.filter((p) => p.robots.includes(this.robot));
    for (const program of programs)
      for (const file of program.files)
        if (path === `${program.folder}/${file}` || path.endsWith(`/${program.name}/${file}`))
          return { program: program.name, file, line };
    return undefined;
  }

  // --- running

  private async dap(command: string, more: Record<string, unknown> = {}): Promise<Answer> {
    return (await this.client.ask("dap", { message: { command, arguments: more } })).body ?? {};
  }
  async start(robot: string) {
    if (await this.client.do("debug", { robot })) this.follow(robot);
  }
  async end() {
    if (await this.client.do("debug", { robot: "" })) this.follow("");
  }
  /** Another robot is debugged, or none, whoever has asked for it. */
  private follow(robot: string) {
    if (robot === this.robot) return;
    this.robot = robot;
    this.stands = false;
    this.calls = [];
    this.scopes = [];
    this.reason = "";
    for (const list of this.all.values()) for (const b of list) b.verified = b.message = undefined;
    this.tell();
    if (!robot) return;
    for (const key of this.all.keys()) void this.send(key);
    void this.look("where the run stood");
  }
  async step(command: Step) {
    if (!this.robot) return;
    try {
      if (command !== "pause") this.runs();
      await this.dap(command, { threadId: 1 });
    } catch (e) {
      this.say((e as Error).message);
      void this.look(this.reason);
    }
  }
  private runs() {
    this.stands = false;
    this.tell();
  }
  private take(name: string, body: any) {
    if (name === "stopped") {
      const id: number | undefined = body.hitBreakpointIds?.[0];
      void this.look(body.text || (id ? `${body.reason} ${id}` : body.reason));
    } else if (name === "continued") this.runs();
    else if (name === "output") this.say(body.output ?? "");
    else if (name === "terminated") {
      this.say("The run has ended.");
      this.runs();
    }
  }

  // --- looking

  /** All that is shown, anew. */
  private async look(reason: string) {
    const turn = ++this.asked,
      before = new Map(this.scopes.flatMap((s) => (s.variables ?? []).map((v) => [`${s.name} ${v.name}`, v.value])));
    try {
      const stack = await this.dap("stackTrace", { threadId: 1 });
      if (turn !== this.asked) return;
      this.calls = stack.stackFrames.map((f: any) => {
        const at = f.source ? this.lineOf(f.source.path, f.line) : undefined;
        return {
          id: f.id,
          name: f.name,
          at,
          place: f.line ? `${f.source?.name ?? "?"}:${f.line}` : f.instructionPointerReference,
        };
      });
      this.call = 0;
      this.stands = true;
      this.reason = reason;
      const { scopes } = await this.dap("scopes", { frameId: this.calls[0]?.id ?? 0 });
      const fresh: Scope[] = scopes.map((s: any) => ({
        name: s.name,
        reference: s.variablesReference,
        expensive: s.expensive,
      }));
      await Promise.all(fresh.filter((s) => !s.expensive || this.open.has(s.name)).map((s) => this.fill(s, before)));
      await Promise.all(this.watches.map((w) => this.compute(w)));
      if (turn !== this.asked) return;
      this.scopes = fresh;
    } catch (e) {
      if (turn !== this.asked) return;
      // it runs: there is nothing to be seen
      this.stands = false;
    }
    this.tell();
    const at = this.calls[0]?.at;
    if (at && this.stands) this.store.tell("sourceLine", at);
  }
  private async fill(scope: Scope, before?: Map<string, string>) {
    const { variables } = await this.dap("variables", { variablesReference: scope.reference });
    scope.variables = variables.map((v: any) => {
      const was = before?.get(`${scope.name} ${v.name}`);
      return {
        name: v.name,
        value: v.value,
        reference: scope.reference,
        changed: was !== undefined && was !== v.value,
      };
    });
  }
  /** Somebody looks at an expensive scope, or no more. */
  async unfold(scope: Scope, open: boolean) {
    this.open[open ? "add" : "delete"](scope.name);
    if (!open || scope.variables || !this.stands) return;
    await this.fill(scope).catch((e: Error) => this.say(e.message));
    this.tell();
  }
  goTo(index: number) {
    this.call = index;
    this.tell();
    const at = this.calls[index]?.at;
    if (at) this.store.tell("sourceLine", at);
  }
  async set(variable: Variable, value: string) {
    try {
      const answer = await this.dap("setVariable", {
        variablesReference: variable.reference,
        name: variable.name,
        value,
      });
      variable.value = answer.value;
      variable.changed = true;
      await Promise.all(this.watches.map((w) => this.compute(w)));
    } catch (e) {
      this.say((e as Error).message);
    }
    this.tell();
  }

  // --- watching, asking

  async watch(expression: string) {
    if (!expression || this.watches.some((w) => w.expression === expression)) return;
    const watch: Watch = { expression, value: "", wrong: false, stops: false };
    this.watches.push(watch);
    this.keep();
    if (this.stands) await this.compute(watch);
    this.tell();
  }
  unwatch(watch: Watch) {
    this.watches = this.watches.filter((w) => w !== watch);
    this.keep();
    if (watch.stops) void this.sendStops();
    this.tell();
  }
  private async compute(watch: Watch) {
    try {
      watch.value = (await this.dap("evaluate", { expression: watch.expression, context: "watch", frameId: 0 })).result;
      watch.wrong = false;
    } catch (e) {
      watch.value = (e as Error).message;
      watch.wrong = true;
    }
  }
  /** The run stops, or no more, when that changes. */
  async stopAt(watch: Watch, stops: boolean) {
    if (stops) {
      const info = await this.dap("dataBreakpointInfo", { name: watch.expression }).catch((e: Error) => ({
        dataId: null,
        description: e.message,
      }));
      if (!info.dataId) return this.say(info.description);
      watch.dataId = info.dataId;
    }
    watch.stops = stops;
    await this.sendStops();
    this.tell();
  }
  private async sendStops() {
    const wanted = this.watches.filter((w) => w.stops);
    await this.dap("setDataBreakpoints", {
      breakpoints: wanted.map((w) => ({ dataId: w.dataId, accessType: "write" })),
    }).catch((e: Error) => this.say(e.message));
  }
  /** A command of the monitor: `why`, `x 0x800 16`, `dis` ... */
  async monitor(command: string) {
    this.say(`> ${command}`);
    try {
      this.say((await this.dap("evaluate", { expression: command, context: "repl" })).result);
    } catch (e) {
      this.say((e as Error).message);
    }
  }
  private say(text: string) {
    this.output.push(...text.replace(/\n$/, "").split("\n"));
    if (this.output.length > kMostOutput) this.output.splice(0, this.output.length - kMostOutput);
    this.tell();
  }
  /** Where the program stands, of the call that is looked at. */
  line(key: string): number {
    const at = this.stands ? this.calls[this.call]?.at : undefined;
    return at && keyOf(at.program, at.file) === key ? at.line : 0;
  }
  private tell() {
    this.store.tell("debug");
  }
}
