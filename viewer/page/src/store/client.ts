// SPDX-License-Identifier: MIT
// Between the server and the store: it hears events and frames, and asks for what panes want.
import type { Answer, Link } from "../link/connection";
import type { Finding, Frame, Program } from "../link/protocol";
import { beginAnew, notice } from "../frame/notices";
import { changedWorld } from "./changes";
import { findingOf, textOfDiagnosis, textOfTrap } from "./problems";
import type { Diagnosis, Store } from "./store";

const kRedrawEvery = 4; // frames, for numbers and plots: nobody reads faster
const kMostWork = 600;

export class Client {
  /** Milliseconds of script that the last frames took: scene, inspector, plots, but not the drawing of the scene. */
  readonly work: number[] = [];
  private fresh = true;
  private recordingWrong?: string;
  private told = false; // what compilers say comes with the programs

  constructor(
    private store: Store,
    readonly link: Link,
  ) {
    link.on("hello", (e) => {
      store.me = e.you;
      store.schema = e.schema;
      store.names = e.names;
      store.noRun = e.problems ?? [];
      this.takeWorld(e);
      this.takePrograms(e.programs);
      this.takeState(e.state);
      store.traps = e.traps ?? [];
      this.takeDiagnoses(e.diagnoses);
      if (store.world.robots.length === 1) store.select(store.world.robots[0].id);
      if (!store.recorded) document.body.dataset.ready = "yes";
    });
    link.on("world", (e) => this.takeWorld(e));
    link.on("world_changed", (e) =>
      this.takeWorld({ world: changedWorld(store.world, e.changes), revision: e.revision }),
    );
    link.on("programs", (e) => this.takePrograms(e.programs));
    link.on("state", (e) => this.takeState(e.state));
    link.on("serial", (e) => store.tell("serial", e));
    link.on("trace", (e) => store.tell("trace", e));
    link.on("look", (e) => store.takeLook(e));
    link.on("says", (e) => store.tell("says", e.text));
    link.on("problems", (e) => {
      store.noRun = e.problems;
      store.tell("problems");
      if (e.problems.length) notice(e.problems[0], true);
    });
    link.on("building", (e) => store.tell("building", e));
    link.on("built", (e) => {
      this.takeBuilt(e);
      store.tell("built", e);
      notice(e.ok ? `${e.program} runs anew` : `${e.program} does not compile: ${e.problems[0]}`, !e.ok);
    });
    link.on("trap", (e) => {
      store.traps.push(e);
      store.tell("trap", e);
      store.tell("problems");
      notice(textOfTrap(e), true);
    });
    link.on("diagnoses", (e) => this.takeDiagnoses(e.diagnoses));
    link.onFrame = (frame, bytes) => {
      const begin = performance.now();
      this.takeFrame(frame, bytes);
      // behind what the plots have put off
      queueMicrotask(() => {
        if (this.work.push(performance.now() - begin) > kMostWork) this.work.shift();
      });
    };
    link.onClose = () => {
      document.body.dataset.ready = "gone";
      notice("twinpuck view has ended. Start it again and open the address that it prints.", true, true);
    };
    store.on("wanted", () => void this.subscribe().catch(() => {}));
    store.on("selection", ({ changed }) => {
      if (!changed) return;
      this.subscribe().catch(() => {});
      const robot = store.selectedRobot();
      if (!store.recorded) this.do("look", { robot: robot && robot.body >= 0 ? robot.name : "" });
    });
  }

  private takeWorld(e: { world: any; revision: number }) {
    this.store.takeWorld(e.world, e.revision);
    this.subscribe().catch(() => {});
  }
  private takeState(state: any) {
    const { store } = this;
    if (!store.recorded && (state.time_s < store.state.time_s || this.fresh)) store.forget();
    this.fresh = false;
    store.takeState(state);
    const wrong: string | undefined = state.recording?.error;
    if (wrong && wrong !== this.recordingWrong) notice(`The recording ${state.recording.file}: ${wrong}`, true, true);
    this.recordingWrong = wrong;
    if (state.ended && state.outcome)
      notice(state.outcome.text || "The supervisor has ended the run", state.outcome.code !== 0);
  }
  private takeDiagnoses(list: Diagnosis[]) {
    const { store } = this;
    const said = (d: Diagnosis) => JSON.stringify(d);
    const known = new Set(store.diagnoses.map(said));
    const news = list.find((d) => !known.has(said(d)));
    store.diagnoses = list;
    store.tell("problems");
    if (news) notice(textOfDiagnosis(news), true);
  }
  /** Servers before version 2 tell what a compiler says in one line each, and only once. */
  private takeBuilt(e: { program: string; ok: boolean; problems: string[]; warnings: string[]; findings?: Finding[] }) {
    const program = this.store.programs.find((p) => p.name === e.program);
    if (!program || this.told) return;
    program.built = true;
    program.ok = e.ok;
    program.findings = [
      ...e.problems.map((t) => findingOf(t, "error", program.files)),
      ...e.warnings.map((t) => findingOf(t, "warning", program.files)),
    ];
    this.store.takePrograms(this.store.programs);
  }
  private takePrograms(programs: Program[]) {
    const { store } = this;
    this.told = programs.some((p) => p.findings !== undefined);
    if (!this.told)
      for (const p of programs) {
        const before = store.programs.find((q) => q.name === p.name);
        Object.assign(p, { ok: before?.ok, built: before?.built, findings: before?.findings });
      }
    store.takePrograms(programs);
  }
  private takeFrame(frame: Frame, bytes: ArrayBuffer) {
    const { store } = this;
    ++store.frames;
    if (frame.revision !== store.revision) return;
    store.past.keep(frame.time, bytes);
    if (store.takeValues(frame)) store.tell("sample", frame.time);
    if (store.live) store.show(frame);
    if (store.frames % kRedrawEvery === 0 || !frame.running) store.tell("pulse");
  }

  // --- asking

  /** The answer; rejected with what is wrong. */
  ask(what: string, more: Record<string, unknown> = {}): Promise<Answer> {
    return this.link.ask(what, more);
  }
  /** The answer; undefined where it was not done, which a notice has told. Asks before a run is lost. */
  async do(what: string, more: Record<string, unknown> = {}): Promise<Answer | undefined> {
    try {
      return await this.link.ask(what, more);
    } catch (e) {
      const { message, anew } = e as Error & { anew?: boolean };
      if (!anew) notice(message, true);
      else if (await beginAnew(message)) return this.do(what, { ...more, anew: true });
      return undefined;
    }
  }
  edit(edit: Record<string, unknown>) {
    return this.do("edit", edit);
  }
  set(thing: number, values: Record<string, unknown>, group = 0) {
    return this.edit({ op: "set", thing, values, group });
  }
  /** Asks for the values that panes want, and for rays. */
  async subscribe() {
    const { store } = this;
    const names = [...new Set(store.wanted.flatMap((want) => want()))];
    const answer = await this.link.ask("subscribe", { names });
    const known: string[] = answer.names ?? names;
    store.past.names.set(answer.subscription, known);
    answer.units?.forEach((unit: string, i: number) => store.units.set(known[i], unit));
    if (!store.recorded) this.link.ask("rays", { robots: [...store.rays] }).catch(() => {});
  }
  /** Rays of that robot's proximity sensors, or of all robots'. */
  toggleRays(robot?: string) {
    const { store } = this,
      { rays } = store;
    if (robot) rays.has(robot) ? rays.delete(robot) : rays.add(robot);
    else if (rays.size) rays.clear();
    else store.world.robots.forEach((r) => rays.add(r.name));
    store.tell("rays", rays);
    this.do("rays", { robots: [...rays] });
  }
}
