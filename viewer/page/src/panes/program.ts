// SPDX-License-Identifier: MIT
// Sources of the controllers.
import { EditorView } from "codemirror";
import { cpp } from "@codemirror/lang-cpp";
import { setDiagnostics, lintGutter } from "@codemirror/lint";
import { oneDark } from "@codemirror/theme-one-dark";
import { Compartment } from "@codemirror/state";
import { h } from "../dom";
import { notice } from "../frame/notices";
import type { Look } from "../link/protocol";
import type { Client } from "../store/client";
import type { SourceLine, Store } from "../store/store";
import { editor, markedLine, markLine, put } from "./editor";

export class ProgramPane {
  readonly pane: HTMLElement;
  private view: EditorView;
  private file = h("select", {
    id: "source-file",
    title: "Sources of the controllers",
    onchange: () => this.open(),
  }) as HTMLSelectElement;
  private messages = h("div", { id: "build-messages" });
  private theme = new Compartment();
  private saved = "";
  private marked = 0;
  constructor(
    private store: Store,
    private client: Client,
  ) {
    const area = h("div", { className: "editor", id: "source" });
    this.pane = h(
      "div",
      { className: "pane column" },
      h(
        "div",
        { className: "toolbar" },
        this.file,
        h(
          "button",
          {
            id: "source-save",
            onclick: () => this.save(),
            title: "Save, build and start where the robots stand (Ctrl S)",
          },
          "Save and run",
        ),
        this.messages,
      ),
      area,
    );
    this.view = editor(area, () => this.save(), this.theme, store.dark, [cpp(), lintGutter(), markedLine]);
    store.on("theme", (dark) => this.setDark(dark));
    store.on("programs", () => this.programs());
    store.on("look", (look) => this.stands(look));
    store.on("selection", ({ changed }) => {
      const robot = store.selectedRobot();
      if (robot && changed) this.choose(store.programOf(robot));
    });
    store.on("building", () => this.building());
    store.on("built", (e) => void this.built(e));
    store.on("sourceLine", (at) => void this.goTo(at));
  }
  setDark(dark: boolean) {
    this.view.dispatch({ effects: this.theme.reconfigure(dark ? oneDark : []) });
  }
  programs() {
    const was = this.file.value;
    this.file.replaceChildren(
      ...this.store.programs.flatMap((p) =>
        p.files.map((f) => h("option", { value: `${p.name}\n${f}` }, `${p.name} / ${f}`)),
      ),
    );
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
  private get place() {
    const [program, file] = this.file.value.split("\n");
    return { program, file };
  }
  text() {
    return this.view.state.doc.toString();
  }
  setText(text: string) {
    put(this.view, text);
  }
  get markedLine() {
    return this.marked;
  }
  async open() {
    if (!this.file.value) return;
    try {
      const text = (await this.client.ask("source", this.place)).text;
      this.saved = text;
      this.marked = 0;
      put(this.view, text);
      this.stands(this.store.look);
    } catch (e) {
      notice((e as Error).message, true);
    }
  }
  async save() {
    this.saved = this.text();
    await this.client.do("write_source", { ...this.place, text: this.saved });
  }
  /** Marks the line where the robot's program stands, if it is of this file. */
  stands(look?: Look) {
    const at = this.store.sourceOf(look),
      here =
        at && this.file.value === `${at.program}\n${at.file}` && at.line <= this.view.state.doc.lines ? at.line : 0;
    if (here !== this.marked) this.view.dispatch({ effects: markLine.of(here) });
    this.marked = here;
  }
  async goTo(at: SourceLine) {
    const value = `${at.program}\n${at.file}`;
    if (this.file.value !== value) {
      this.file.value = value;
      await this.open();
    }
    this.store.tell("show", "program");
    this.stands(this.store.look);
    const line = this.view.state.doc.line(Math.min(at.line, this.view.state.doc.lines));
    this.view.dispatch({ effects: EditorView.scrollIntoView(line.from, { y: "center" }) });
  }
  building() {
    this.messages.replaceChildren(h("span", { className: "dim" }, "building…"));
  }
  async built(event: { ok: boolean; problems: string[]; warnings: string[]; took_s: number }) {
    // a change from outside shows, unless something here would be lost
    if (this.text() === this.saved) await this.open();
    const all = [
      ...event.problems.map((t) => ({ t, severity: "error" as const })),
      ...event.warnings.map((t) => ({ t, severity: "warning" as const })),
    ];
    const doc = this.view.state.doc;
    const marks = all.flatMap(({ t, severity }) => {
      const m = t.match(/([^\s:]+):(\d+)(?::(\d+))?:\s*(.*)/);
      if (!m || !m[1].endsWith(this.place.file) || Number(m[2]) > doc.lines) return [];
      const line = doc.line(Number(m[2]));
      return [{ from: Math.min(line.to, line.from + Number(m[3] ?? 1) - 1), to: line.to, severity, message: m[4] }];
    });
    this.view.dispatch(setDiagnostics(this.view.state, marks));
    this.messages.replaceChildren(
      event.ok
        ? h("span", { className: "good" }, `runs, built in ${(1000 * event.took_s).toFixed(0)} ms`)
        : h("span", { className: "bad" }, event.problems[0] ?? "not built"),
    );
    this.messages.dataset.ok = String(event.ok);
  }
}
