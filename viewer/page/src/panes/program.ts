// SPDX-License-Identifier: MIT
// Sources of the controllers.
import { cpp } from "@codemirror/lang-cpp";
import { setDiagnostics, lintGutter } from "@codemirror/lint";
import { h } from "../dom";
import { askText, notice } from "../frame/notices";
import type { Look } from "../link/protocol";
import { isDirty, keyOf } from "../store/buffer";
import type { Buffer } from "../store/buffer";
import type { Buffers } from "../store/buffers";
import type { Debugging } from "../store/debugging";
import type { SourceLine, Store } from "../store/store";
import type { DebuggerPane } from "./debugger";
import { breakpoints, showBreakpoints } from "./breakpoints";
import { banner, TextEditor } from "./editor";

export class ProgramPane {
  readonly pane: HTMLElement;
  readonly editor: TextEditor;
  private file = h("select", {
    id: "source-file",
    "aria-label": "Source file",
    title: "Sources of the controllers; a dot: not saved",
    onchange: () => void this.open(),
  });
  private button = h(
    "button",
    {
      id: "source-save",
      onclick: () => void this.save(),
      title: "Save, build and start where the robots stand (Ctrl S)",
    },
    "Save and run",
  );
  private locked = h("span", { className: "bad", hidden: true }, "read-only");
  private messages = h("div", { id: "build-messages", role: "status" });
  private told = h("div", { id: "source-conflict" });
  private empty = h(
    "p",
    { className: "dim pad hint", hidden: true },
    "No robot has a program whose source is here. Write the name of a controller into a robot's firmware; `twinpuck new NAME` makes one.",
  );

  constructor(
    private store: Store,
    private buffers: Buffers,
    private debug: Debugging,
    private beside?: DebuggerPane,
  ) {
    this.editor = new TextEditor({
      id: "source",
      label: "Source of a controller",
      dark: store.dark,
      save: () => void this.save(),
      typed: (text) => this.buffers.edit(this.file.value, text),
      extensions: [
        breakpoints({
          toggle: (line) => this.debug.toggle(this.file.value, line),
          askCondition: (line) => void this.askCondition(line),
          moved: (lines) => this.debug.moved(this.file.value, lines),
        }),
        cpp(),
        lintGutter(),
      ],
    });
    this.pane = h(
      "div",
      { className: "pane column" },
      h("div", { className: "toolbar wide" }, this.file, this.button, this.beside?.begin, this.locked, this.messages),
      this.told,
      this.empty,
      h("div", { className: "beside" }, this.editor.element, this.beside?.pane),
    );
    store.on("theme", (dark) => this.editor.setDark(dark));
    store.on("programs", () => this.list());
    store.on("look", (look) => this.stands(look));
    store.on("selection", ({ changed }) => {
      const robot = store.selectedRobot();
      if (robot && changed) this.choose(store.programOf(robot));
    });
    store.on("building", () => this.messages.replaceChildren(h("span", { className: "dim" }, "building…")));
    store.on("built", (e) => this.built(e));
    store.on("buffer", (b) => this.changed(b));
    store.on("debug", () => this.stands(store.look));
    store.on("breakpoints", (key) => {
      if (key === this.file.value) this.showBreakpoints();
    });
    store.on("sourceLine", (at) => void this.goTo(at));
  }

  // --- the list of files

  private list() {
    const was = this.file.value;
    const known = this.store.programs.flatMap((p) => p.files.map((f) => keyOf(p.name, f)));
    // what somebody typed stays, though nothing runs it any more
    const left = this.buffers.dirty().filter((b) => b.program && !known.includes(b.key));
    this.file.replaceChildren(
      ...this.store.programs.flatMap((p) =>
        p.files.map((f) => h("option", { value: keyOf(p.name, f) }, `${p.name} / ${f}`)),
      ),
      ...left.map((b) => h("option", { value: b.key }, `${b.name} (not used)`)),
    );
    if ([...this.file.options].some((o) => o.value === was)) this.file.value = was;
    this.empty.hidden = this.file.options.length > 0;
    this.dots();
    if (this.file.value !== was) void this.open();
    this.findings();
  }
  private dots() {
    for (const option of this.file.options) {
      const b = this.buffers.get(option.value);
      const plain = option.textContent!.replace(/^• /, "");
      option.textContent = b && isDirty(b) ? `• ${plain}` : plain;
    }
  }
  private choose(program: string) {
    const first = [...this.file.options].find((o) => o.value.startsWith(program + "\n"));
    if (!first || this.file.value.startsWith(program + "\n")) return;
    this.file.value = first.value;
    void this.open();
  }

  // --- the file that is shown

  text() {
    return this.editor.text;
  }
  setText(text: string) {
    this.editor.put(text, true);
  }
  get markedLine() {
    return this.editor.markedLine;
  }
  private async open() {
    const key = this.file.value;
    if (!key) return this.editor.show("", undefined);
    const known = this.buffers.get(key);
    this.editor.show(key, known?.read === undefined ? undefined : known.text);
    this.about(known);
    try {
      const [program, file] = key.split("\n");
      const b = await this.buffers.open(program, file);
      if (this.file.value === key) this.changed(b);
    } catch (e) {
      notice((e as Error).message, true);
    }
  }
  /** The buffer is another one now: by a hand, by the disk, saved. */
  private changed(b: Buffer) {
    this.dots();
    if (b.key !== this.file.value) return;
    if (b.read !== undefined) this.editor.show(b.key, b.text);
    this.showBreakpoints();
    this.about(b);
    this.findings();
    this.stands(this.store.look);
  }
  private about(b?: Buffer) {
    this.locked.hidden = !b || b.writable;
    const c = b?.conflict;
    if (!c || !b) {
      this.editor.compare(undefined);
      return this.told.replaceChildren();
    }
    const overwrite = {
      id: "source-overwrite",
      text: "Overwrite",
      title: "What is typed here takes the place of what is on the disk",
      act: () => void this.save(true),
    };
    if (c.text === null)
      return this.told.replaceChildren(
        banner(`${b.file} is gone from the disk.`, [{ ...overwrite, text: "Write it" }]),
      );
    this.told.replaceChildren(
      banner(`${b.file} was changed on the disk by another program.`, [
        {
          id: "source-reload",
          text: "Reload",
          title: "What is on the disk takes the place of what is typed here (Ctrl Z brings it back)",
          act: () => this.buffers.reload(b.key),
        },
        overwrite,
        this.editor.comparison("source-compare", c.text!, () => this.about(b)),
      ]),
    );
  }
  async save(overwrite = false) {
    const key = this.file.value;
    try {
      const result = await this.buffers.save(key, overwrite);
      const name = this.buffers.get(key)?.file;
      if (result === "unread") notice("Nothing was saved: the file's text has not come yet.", true);
      else if (result === "readonly") notice(`${name} may not be written (it is read-only): nothing was saved.`, true);
      else if (result === "conflict") {
        this.store.tell("show", "program");
        notice(
          `${name} was changed on the disk meanwhile: nothing was saved. Choose above the text what counts.`,
          true,
        );
      }
    } catch (e) {
      notice((e as Error).message, true);
    }
  }

  // --- lines of it

  /** Marks the line where the robot's program stands, if it is of this file. */
  private stands(look?: Look) {
    const debugged = this.debug.line(this.file.value);
    const at = this.debug.debugged ? undefined : this.store.sourceOf(look);
    this.editor.mark(debugged || (at && this.file.value === keyOf(at.program, at.file) ? at.line : 0));
  }
  private showBreakpoints() {
    showBreakpoints(this.editor.view, this.debug.of(this.file.value));
  }
  private async askCondition(line: number) {
    const key = this.file.value,
      known = this.debug.of(key).find((b) => b.line === line);
    const condition = await askText(`Stop in line ${line} only if`, known?.condition ?? "");
    if (condition !== undefined) this.debug.condition(key, line, condition);
  }
  private async goTo(at: SourceLine) {
    const value = keyOf(at.program, at.file);
    if (this.file.value !== value) {
      this.file.value = value;
      await this.open();
    }
    this.store.tell("show", "program");
    this.stands(this.store.look);
    this.editor.goTo(at.line, at.column);
  }
  private built(event: { ok: boolean; problems: string[]; took_s: number }) {
    const first = event.problems[0] ?? "not built";
    this.messages.replaceChildren(
      event.ok
        ? h("span", { className: "good" }, `runs, built in ${(1000 * event.took_s).toFixed(0)} ms`)
        : h("span", { className: "bad" }, first),
    );
    this.messages.dataset.ok = String(event.ok);
    this.findings();
  }
  /** What the compiler says of this file, in its lines. */
  private findings() {
    const [program, file] = this.file.value.split("\n"),
      doc = this.editor.view.state.doc;
    const found = this.store.programs.find((p) => p.name === program)?.findings ?? [];
    const marks = found
      .filter((f) => f.file === file && f.line > 0 && f.line <= doc.lines)
      .map((f) => {
        const line = doc.line(f.line);
        return {
          from: Math.min(line.to, line.from + Math.max(0, f.column - 1)),
          to: line.to,
          severity: f.kind === "note" ? ("info" as const) : f.kind,
          message: f.text,
        };
      })
      .sort((a, b) => a.from - b.from);
    this.editor.view.dispatch(setDiagnostics(this.editor.view.state, marks));
  }
}
