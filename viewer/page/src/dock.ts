// SPDX-License-Identifier: MIT
// Below the scene: console, plots, the program's source, problems, the world file's text.
import { EditorView, basicSetup } from "codemirror";
import { indentWithTab } from "@codemirror/commands";
import { cpp } from "@codemirror/lang-cpp";
import { setDiagnostics, lintGutter } from "@codemirror/lint";
import { oneDark } from "@codemirror/theme-one-dark";
import { EditorState, Compartment, StateEffect, StateField } from "@codemirror/state";
import { Decoration, keymap } from "@codemirror/view";
import type { DecorationSet } from "@codemirror/view";
import uPlot from "uplot";
import type { App } from "./main";
import type { Look } from "./protocol";
import { kPalette } from "./scene";
import { byId, css, h } from "./dom";

const kConsoleLines = 2000;
const kMostSamples = 6000;

export class Console {
  readonly pane: HTMLElement;
  private lines = h("pre", { id: "console-lines", tabIndex: 0 });
  private robot = h("select", { title: "Whose serial line" }) as HTMLSelectElement;
  private port = h("select", { title: "UART 1 (Bluetooth) or 2" }, h("option", { value: "1" }, "UART 1"), h("option", { value: "2" }, "UART 2")) as HTMLSelectElement;
  private open = new Map<string, HTMLElement>();
  constructor(private app: App) {
    const input = h("input", { id: "console-input", placeholder: "Type to the robot; Enter sends", title: "Sent with a carriage return, as terminals do",
      onkeydown: (e: KeyboardEvent) => {
        if (e.key !== "Enter") return;
        this.app.do("type", { robot: this.robot.value, port: Number(this.port.value), bytes: input.value + "\r" });
        input.value = "";
      } }) as HTMLInputElement;
    this.pane = h("div", { className: "pane column" }, this.lines, h("div", { className: "toolbar" }, this.robot, this.port, input, h("button", { onclick: () => this.clear() }, "Clear")));
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
  choose(name: string) { this.robot.value = name; }
  /** What came later than what the scene shows is dim. */
  shownUntil(time: number) {
    for (const line of this.lines.children) line.classList.toggle("later", Number((line as HTMLElement).dataset.time ?? 0) > time);
  }
  say(who: string, text: string, kind = "", time?: number) {
    const stays = this.lines.scrollHeight - this.lines.scrollTop - this.lines.clientHeight > 40;
    const parts = text.split(/\r\n|\r|\n/);
    parts.forEach((part, i) => {
      let line = this.open.get(who);
      if (!line && (part !== "" || i < parts.length - 1)) {
        if (part === "" && i < parts.length - 1) return;
        line = h("div", { className: kind }, time !== undefined && h("small", {}, `${time.toFixed(3)} `), h("b", {}, who + " "), h("span", {}));
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

/** Of a plot: the first blue is too dark on a dark page. */
const plotColour = (i: number, dark: boolean) => kPalette[dark && i === 0 ? 5 : dark && i === 5 ? 0 : i];

export class Plots {
  readonly pane: HTMLElement;
  names: string[] = [];
  private times: number[] = [];
  private series: (number | null)[][] = [];
  private chart?: uPlot;
  private area = h("div", { id: "plot" });
  private chips = h("div", { className: "toolbar wrap" });
  constructor(private app: App) {
    const list = h("datalist", { id: "names" });
    const input = h("input", { id: "plot-name", list: "names", placeholder: "puck.ir0, puck.var:counter, puck.pin:D3", title: "Anything that has a name; Enter plots it",
      onfocus: () => list.replaceChildren(...this.app.world.robots.slice(0, 20).flatMap((r) => this.app.nameList.map((n) => h("option", { value: `${r.name}.${n}` })))),
      onchange: () => { if (input.value.trim()) this.toggle(input.value.trim()); input.value = ""; } }) as HTMLInputElement;
    this.pane = h("div", { className: "pane column" }, h("div", { className: "toolbar" }, input, list, this.chips, h("button", { onclick: () => this.clear(), title: "Forget what was plotted" }, "Clear"), h("button", { onclick: () => this.saveCsv(), title: "What is plotted, as a table" }, "CSV")), this.area);
    new ResizeObserver(() => this.chart?.setSize(this.size())).observe(this.area);
  }
  private size() { return { width: Math.max(200, this.area.clientWidth), height: Math.max(80, this.area.clientHeight - 4) }; }
  async toggle(name: string) {
    const before = this.names;
    this.names = before.includes(name) ? before.filter((n) => n !== name) : [...before, name].slice(-kPalette.length);
    try {
      await this.app.subscribe();
    } catch (e) {
      this.names = before;
      this.app.notice((e as Error).message, true);
      this.app.subscribe();
      return;
    }
    this.build();
    this.refill();
    this.app.showDock("plots");
  }
  /** From the frames that are kept. */
  refill() {
    this.clear();
    this.app.eachKept(this.names, (time, values) => this.sample(time, values));
    this.draw();
  }
  clear() {
    this.times = [];
    this.series = this.names.map(() => []);
  }
  build() {
    this.chart?.destroy();
    this.chips.replaceChildren(...this.names.map((n, i) => h("button", { className: "chip", title: "No more", onclick: () => this.toggle(n) }, h("i", { style: `background:${plotColour(i, this.app.dark)}` }), n)));
    this.chart = undefined;
    if (this.names.length === 0) return this.area.replaceChildren(h("p", { className: "dim pad" }, "Nothing is plotted. Click a value of a robot, or type a name above."));
    this.area.replaceChildren();
    const axis = { stroke: css("--dim"), grid: { stroke: css("--line"), width: 1 }, ticks: { stroke: css("--line") } };
    this.chart = new uPlot({
      ...this.size(), scales: { x: { time: false } }, axes: [{ ...axis, size: 32, values: (_: uPlot, at: number[]) => at.map((t) => `${+t.toFixed(3)} s`) }, { ...axis, size: 64 }], legend: { show: false },
      series: [{ label: "s" }, ...this.names.map((label, i) => ({ label, stroke: plotColour(i, this.app.dark), width: 1.5, points: { show: false } }))],
    }, [[], ...this.names.map(() => [])] as any, this.area);
  }
  sample(time: number, values: (number | null)[]) {
    if (this.names.length === 0) return;
    if (this.times.length > 0 && time < this.times[this.times.length - 1]) this.clear();
    if (time === this.times[this.times.length - 1]) return;
    this.times.push(time);
    values.forEach((v, i) => this.series[i]?.push(v));
    if (this.times.length > kMostSamples) {
      this.times.splice(0, kMostSamples / 4);
      this.series.forEach((s) => s.splice(0, kMostSamples / 4));
    }
  }
  draw() {
    if (this.pane.isConnected && this.pane.offsetParent && this.chart && this.times.length > 0) this.chart.setData([this.times, ...this.series] as any);
  }
  get samples() { return this.times.length; }
  private saveCsv() {
    const rows = [["time_s", ...this.names].join(","), ...this.times.map((t, i) => [t, ...this.series.map((s) => s[i])].join(","))];
    h("a", { href: URL.createObjectURL(new Blob([rows.join("\n") + "\n"], { type: "text/csv" })), download: "plot.csv" }).click();
  }
}

function editor(parent: HTMLElement, onSave: () => void, theme: Compartment, dark: boolean, extra: any[] = []) {
  return new EditorView({
    parent,
    state: EditorState.create({ doc: "", extensions: [basicSetup, keymap.of([indentWithTab, { key: "Mod-s", run: () => (onSave(), true), preventDefault: true }]), theme.of(dark ? oneDark : []), EditorView.theme({ "&": { height: "100%" }, ".cm-scroller": { fontFamily: "var(--mono)", fontSize: "13px" } }), ...extra] }),
  });
}
const put = (view: EditorView, text: string) => view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });

/** A line with a mark, 0: none. */
const markLine = StateEffect.define<number>();
const markedLine = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(marks, change) {
    for (const e of change.effects) if (e.is(markLine)) return e.value ? Decoration.set(Decoration.line({ class: "stands" }).range(change.state.doc.line(e.value).from)) : Decoration.none;
    return marks.map(change.changes);
  },
  provide: (field) => EditorView.decorations.from(field),
});

export class ProgramPane {
  readonly pane: HTMLElement;
  private view: EditorView;
  private file = h("select", { id: "source-file", title: "Sources of the controllers", onchange: () => this.open() }) as HTMLSelectElement;
  private messages = h("div", { id: "build-messages" });
  private theme = new Compartment();
  private saved = "";
  private marked = 0;
  constructor(private app: App) {
    const area = h("div", { className: "editor", id: "source" });
    this.pane = h("div", { className: "pane column" }, h("div", { className: "toolbar" }, this.file, h("button", { id: "source-save", onclick: () => this.save(), title: "Save, build and start where the robots stand (Ctrl S)" }, "Save and run"), this.messages), area);
    this.view = editor(area, () => this.save(), this.theme, app.dark, [cpp(), lintGutter(), markedLine]);
  }
  setDark(dark: boolean) { this.view.dispatch({ effects: this.theme.reconfigure(dark ? oneDark : []) }); }
  programs() {
    const was = this.file.value;
    this.file.replaceChildren(...this.app.programs.flatMap((p) => p.files.map((f) => h("option", { value: `${p.name}\n${f}` }, `${p.name} / ${f}`))));
    if ([...this.file.options].some((o) => o.value === was)) this.file.value = was;
    else this.open();
  }
  choose(program: string) {
    const first = [...this.file.options].find((o) => o.value.startsWith(program + "\n"));
    if (first && !this.file.value.startsWith(program + "\n")) {
      this.file.value = first.value;
      this.open();
    }
  }
  private get place() { const [program, file] = this.file.value.split("\n"); return { program, file }; }
  text() { return this.view.state.doc.toString(); }
  setText(text: string) { put(this.view, text); }
  get markedLine() { return this.marked; }
  async open() {
    if (!this.file.value) return;
    try {
      const text = (await this.app.connection.ask("source", this.place)).text;
      this.saved = text;
      this.marked = 0;
      put(this.view, text);
      this.stands(this.app.look);
    } catch (e) {
      this.app.notice((e as Error).message, true);
    }
  }
  async save() {
    this.saved = this.text();
    await this.app.do("write_source", { ...this.place, text: this.saved });
  }
  /** Marks the line where the robot's program stands, if it is of this file. */
  stands(look?: Look) {
    const at = this.app.sourceOf(look), here = at && this.file.value === `${at.program}\n${at.file}` && at.line <= this.view.state.doc.lines ? at.line : 0;
    if (here !== this.marked) this.view.dispatch({ effects: markLine.of(here) });
    this.marked = here;
  }
  async goTo(look?: Look) {
    const at = this.app.sourceOf(look);
    if (!at) return;
    const value = `${at.program}\n${at.file}`;
    if (this.file.value !== value) {
      this.file.value = value;
      await this.open();
    }
    this.app.showDock("program");
    this.stands(look);
    const line = this.view.state.doc.line(Math.min(at.line, this.view.state.doc.lines));
    this.view.dispatch({ effects: EditorView.scrollIntoView(line.from, { y: "center" }) });
  }
  building() { this.messages.replaceChildren(h("span", { className: "dim" }, "building…")); }
  async built(event: { ok: boolean; problems: string[]; warnings: string[]; took_s: number }) {
    // a change from outside shows, unless something here would be lost
    if (this.text() === this.saved) await this.open();
    const all = [...event.problems.map((t) => ({ t, severity: "error" as const })), ...event.warnings.map((t) => ({ t, severity: "warning" as const }))];
    const doc = this.view.state.doc;
    const marks = all.flatMap(({ t, severity }) => {
      const m = t.match(/([^\s:]+):(\d+)(?::(\d+))?:\s*(.*)/);
      if (!m || !m[1].endsWith(this.place.file) || Number(m[2]) > doc.lines) return [];
      const line = doc.line(Number(m[2]));
      return [{ from: Math.min(line.to, line.from + Number(m[3] ?? 1) - 1), to: line.to, severity, message: m[4] }];
    });
    this.view.dispatch(setDiagnostics(this.view.state, marks));
    this.messages.replaceChildren(event.ok ? h("span", { className: "good" }, `runs, built in ${(1000 * event.took_s).toFixed(0)} ms`) : h("span", { className: "bad" }, event.problems[0] ?? "not built"));
    this.messages.dataset.ok = String(event.ok);
  }
}

export class WorldTextPane {
  readonly pane: HTMLElement;
  private view: EditorView;
  private theme = new Compartment();
  constructor(private app: App) {
    const area = h("div", { className: "editor", id: "world-text" });
    this.pane = h("div", { className: "pane column" }, h("div", { className: "toolbar" }, h("button", { onclick: () => this.apply(), title: "The world becomes what is written here (Ctrl S)" }, "Apply"), h("span", { className: "dim" }, "the world file as it will be saved")), area);
    this.view = editor(area, () => this.apply(), this.theme, app.dark);
  }
  setDark(dark: boolean) { this.view.dispatch({ effects: this.theme.reconfigure(dark ? oneDark : []) }); }
  show(text: string) { if (this.view.state.doc.toString() !== text && !this.view.hasFocus) put(this.view, text); }
  goTo(line: number) {
    const at = this.view.state.doc.line(Math.min(line, this.view.state.doc.lines));
    this.view.dispatch({ selection: { anchor: at.from, head: at.to }, scrollIntoView: true });
  }
  private apply() { this.app.do("edit", { op: "text", text: this.view.state.doc.toString() }); }
}

export class ProblemsPane {
  readonly pane = h("div", { className: "pane pad" });
  constructor(private app: App) {}
  show(diagnoses: string[]) {
    const problems = this.app.world.problems;
    const rows = problems.map((p) => h("button", { className: "row bad", onclick: () => { if (p.id) this.app.select(p.id); this.app.goToLine(p.line); } }, p.line ? `line ${p.line}: ${p.text}` : p.text));
    const told = diagnoses.map((d) => h("div", { className: "row" }, d));
    this.pane.replaceChildren(...(rows.length + told.length ? [...rows, ...told] : [h("p", { className: "dim" }, "Nothing is wrong.")]));
    byId("tab-problems").dataset.count = problems.length + diagnoses.length ? String(problems.length + diagnoses.length) : "";
  }
}
