// SPDX-License-Identifier: MIT
// The page: a bar with time, a palette, the scene, an inspector beside it, a dock below. All state that counts
// is the server's; what is here is what this page looks at.
import "uplot/dist/uPlot.min.css";
import "./page.css";
import { Connection, readFrame, RobotState } from "./protocol";
import { Playback } from "./playback";
import { TimeLine } from "./timeline";
import type { Frame, Look, Program, Robot, Schema, State, Thing, World } from "./protocol";
import { Scene } from "./scene";
import { Inspector } from "./inspector";
import { Console, Plots, ProblemsPane, ProgramPane, WorldTextPane } from "./dock";
import { imageOf } from "./senses";
import { Touch } from "./touch";
import { byId, css, h, icon } from "./dom";

const kSpeeds: [string, number][] = [["1/16", 1 / 16], ["1/8", 1 / 8], ["1/4", 1 / 4], ["1/2", 1 / 2], ["1", 1], ["2", 2],
  ["4", 4], ["8", 8], ["16", 16], ["64", 64], ["max", 0]];
const kMostTrail = 3000;  // frames, of the paths in what was seen
const kMostPast = 20000;          // frames
const kMostPastBytes = 96 << 20;
const kMostLooks = 3000;
const kRedrawEvery = 4;           // frames, for numbers and plots: nobody reads faster

export class App {
  /** Set in a report: nothing runs, everything is there already. */
  readonly recorded = document.getElementById("report") ? new Playback() : undefined;
  readonly connection = this.recorded ?? new Connection();
  readonly scene = new Scene(byId("stage"));
  world: World = { title: "", file: "", text: "", step_s: 0.032, tick_s: 1 / 512, floor: { colour: [1, 1, 1], image: "" }, things: [], robots: [], elements: [], problems: [] };
  state: State = { playing: false, speed: 1, ended: false, time_s: 0, seed: 1, saved: true, undo: false, redo: false, steering: 0, runs: false };
  programs: Program[] = [];
  schema: Schema = {};
  nameList: string[] = [];
  values = new Map<string, number>();
  selected = 0;
  dark = localStorage.getItem("theme") ? localStorage.getItem("theme") === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  readonly console = new Console(this);
  readonly plots = new Plots(this);
  readonly program = new ProgramPane(this);
  readonly text = new WorldTextPane(this);
  readonly problems = new ProblemsPane(this);
  readonly inspector = new Inspector(this);
  readonly timeline = new TimeLine(this);
  readonly touch = new Touch(this);
  frames = 0;
  /** Milliseconds of script that the last frames took: scene, inspector, plots, but not the drawing of the scene. */
  readonly work: number[] = [];
  frame?: Frame;
  look?: Look;  // what is shown of the selected robot beside numbers
  showView = true;
  private looks: Look[] = [];
  private floorImage = "";
  private me = 0;
  private revision = 0;
  private subscriptions = new Map<number, string[]>();  // names of each, since frames of all are kept
  private rays = new Set<string>();
  private past: { time: number; bytes: ArrayBuffer }[] = [];
  private shownAt = Infinity;  // the frame of the past that the paths lead to; live ones lead to now
  private pastBytes = 0;
  private live = true;
  private traps: string[] = [];
  private diagnoses: string[] = [];
  private noticeTimer = 0;
  private answer?: () => void;  // no, to the question that stands
  private fresh = true;
  private player = 0;  // of a report: the timer

  constructor() {
    this.buildBar();
    this.buildDock();
    this.setTheme(this.dark);
    this.listen();
    addEventListener("keydown", (e) => this.key(e));
    addEventListener("beforeunload", (e) => { if (!this.state.saved) e.preventDefault(); });
    byId("scrub").addEventListener("input", () => this.scrub());
    if (this.recorded) {
      document.body.classList.add("report");
      this.recorded.onPast = (frames) => this.takeReport(frames);
      this.recorded.play();
    }
  }

  // --- what the server tells

  private listen() {
    const c = this.connection;
    c.on("hello", (e) => {
      this.me = e.you;
      this.schema = e.schema;
      this.nameList = e.names;
      this.takeWorld(e.world, e.revision);
      this.takePrograms(e.programs);
      this.takeState(e.state);
      this.takeDiagnoses(e.diagnoses);
      if (this.world.robots.length === 1) this.select(this.world.robots[0].id);
      else this.inspector.show();
      if (!this.recorded) document.body.dataset.ready = "yes";
    });
    c.on("world", (e) => this.takeWorld(e.world, e.revision));
    c.on("programs", (e) => this.takePrograms(e.programs));
    c.on("state", (e) => this.takeState(e.state));
    c.on("serial", (e) => this.console.say(e.robot + (e.port === 2 ? " uart2" : ""), e.text, "", e.time_s));
    c.on("trace", (e) => this.timeline.take(e));
    c.on("look", (e) => this.takeLook(e));
    c.on("says", (e) => this.console.say("supervisor", e.text + "\n", "dim"));
    c.on("problems", (e) => this.notice(e.problems[0], true));
    c.on("building", () => this.program.building());
    c.on("built", (e) => {
      this.program.built(e);
      this.notice(e.ok ? `${e.program} runs anew` : `${e.program} does not compile: ${e.problems[0]}`, !e.ok);
    });
    c.on("trap", (e) => {
      const text = `${e.robot}: ${e.kind}: ${e.text}, at ${e.place}, ${e.time_s.toFixed(3)} s`;
      this.traps.push(text);
      this.showProblems();
      this.console.say(e.robot, `${e.kind}: ${e.text}, at ${e.place}\n`, "bad");
      this.notice(text, true);
    });
    c.on("diagnoses", (e) => this.takeDiagnoses(e.diagnoses));
    c.onFrame = (frame, bytes) => {
      const begin = performance.now();
      this.takeFrame(frame, bytes);
      // behind what the plots have put off
      queueMicrotask(() => { if (this.work.push(performance.now() - begin) > 600) this.work.shift(); });
    };
    c.onClose = () => {
      document.body.dataset.ready = "gone";
      this.notice("twinpuck view has ended. Start it again and open the address that it prints.", true, true);
    };
  }

  private takeDiagnoses(list: { robot: string; time_s: number; cause: string; place: string; text: string; hint: string }[]) {
    const texts = list.map((d) => `${d.robot}: ${d.cause} at ${d.place}, ${d.time_s.toFixed(3)} s: ${d.text}${d.hint ? "; " + d.hint : ""}`);
    const news = texts.find((t) => !this.diagnoses.includes(t));
    this.diagnoses = texts;
    this.showProblems();
    if (news) this.notice(news, true);
  }
  private showProblems() { this.problems.show([...this.traps, ...this.diagnoses]); }

  private takeWorld(world: World, revision: number) {
    const first = this.revision === 0;
    this.world = world;
    this.revision = revision;
    document.title = `${world.title || world.file.split("/").pop()} – Twinpuck`;
    if (!this.selectedRobot() && !this.selectedThing()) this.selected = 0;
    this.scene.setWorld(world, !first);
    this.select(this.selected);
    this.console.robots(world.robots.map((r) => r.name));
    this.text.show(world.text);
    this.showProblems();
    byId("badges").replaceChildren(...world.problems.slice(0, 8).map((p) => h("button", { className: "bad", onclick: () => { if (p.id) this.select(p.id); this.goToLine(p.line); } }, `⚠ ${p.text}`)));
    this.takeFloor(world.floor.image);
    this.rays.forEach((name) => { if (!world.robots.some((r) => r.name === name)) this.rays.delete(name); });
    this.subscribe().catch(() => {});
  }

  private async takeFloor(image: string) {
    if (image === this.floorImage) return;
    this.floorImage = image;
    try {
      const floor = image ? await this.connection.ask("floor") : undefined;
      if (image === this.floorImage) this.scene.setFloor(floor && imageOf(floor.width, floor.height, floor.rgb));
    } catch { /* the colour will do */ }
  }

  private takeLook(look: Look) {
    this.looks.push(look);
    if (this.looks.length > kMostLooks) this.looks.splice(0, kMostLooks / 4);
    if (this.live) this.showLook(look);
  }
  private showLook(look?: Look) {
    const robot = this.selectedRobot();
    this.look = look && robot?.name === look.robot ? look : undefined;
    this.scene.setView(robot?.body ?? -1, this.showView && this.look?.picture ? this.look.camera : undefined);
    this.inspector.showLook();
    this.program.stands(this.look);
  }
  /** What it runs, which may be another program than its file says (--fw). */
  programOf(robot: Robot) { return this.programs.find((p) => p.robots.includes(robot.name))?.name ?? robot.firmware; }
  /** A file of a controller, as a place names it. */
  sourceOf(look?: Look) {
    const at = look?.place;
    // as it was compiled, which may be from elsewhere
    for (const program of at?.line ? this.programs.filter((p) => p.robots.includes(look!.robot)) : [])
      for (const file of program.files)
        if (`/${program.folder}/${file}`.endsWith(`/${at!.file}`)) return { program: program.name, file, line: at!.line };
  }

  private takePrograms(programs: Program[]) {
    this.programs = programs;
    this.program.programs();
  }

  private takeState(state: State) {
    if (!this.recorded && (state.time_s < this.state.time_s || this.fresh)) this.forgetPast();
    this.fresh = false;
    this.state = state;
    const set = (id: string, on: boolean) => byId(id).toggleAttribute("disabled", !on);
    byId("play").replaceChildren(icon(state.playing ? "pause" : "play"));
    byId("play").title = state.playing ? "Pause (Space)" : "Play (Space)";
    byId("play").setAttribute("aria-label", state.playing ? "Pause" : "Play");
    set("undo", state.undo);
    set("redo", state.redo);
    byId("file").textContent = `${this.world.file.split("/").pop()}${state.saved ? "" : " •"}`;
    byId("save").classList.toggle("strong", !state.saved);
    (byId("speed") as HTMLSelectElement).value = String(state.speed);
    byId("steer").hidden = state.steering === this.me;
    if (state.ended && state.outcome) this.notice(state.outcome.text || "The supervisor has ended the run", state.outcome.code !== 0);
  }

  private takeFrame(frame: Frame, bytes: ArrayBuffer) {
    ++this.frames;
    if (frame.revision !== this.revision) return;
    this.past.push({ time: frame.time, bytes });
    this.pastBytes += bytes.byteLength;
    while (this.past.length > kMostPast || this.pastBytes > kMostPastBytes) this.pastBytes -= this.past.shift()!.bytes.byteLength;
    if (this.takeValues(frame)) this.plots.sample(frame.time, this.plots.names.map((n) => this.values.get(n) ?? null));
    if (this.live) {
      this.show(frame);
      this.shownAt = Infinity;
    }
    if (this.frames % kRedrawEvery === 0 || !frame.running) {
      const scrub = byId("scrub") as HTMLInputElement;
      scrub.max = String(this.past.length - 1);
      if (this.live) scrub.value = scrub.max;
      byId("pace").textContent = frame.running ? `${frame.pace < 10 ? frame.pace.toFixed(1) : frame.pace.toFixed(0)}×` : "";
      this.inspector.update();
      this.plots.draw();
    }
  }

  private takeValues(frame: Frame) {
    const names = this.subscriptions.get(frame.subscription);
    if (!names) return false;
    names.forEach((n, i) => this.values.set(n, frame.values[i]));
    return true;
  }
  /** Values by name of every frame that is kept; null where it has none. */
  eachKept(names: string[], look: (time: number, values: (number | null)[]) => void) {
    const places = new Map<number, number[]>();  // by subscription
    for (const { bytes } of this.past) {
      const frame = readFrame(bytes);
      let at = places.get(frame.subscription);
      if (!at) places.set(frame.subscription, (at = names.map((n) => (this.subscriptions.get(frame.subscription) ?? []).indexOf(n))));
      look(frame.time, at.map((i) => (i < 0 ? null : frame.values[i])));
    }
  }

  private show(frame: Frame) {
    const began = frame.time > 0 !== (this.frame?.time ?? 0) > 0;
    this.frame = frame;
    if (began) this.scene.select(this.selected, this.touch.handles());
    this.scene.setFrame(frame);
    byId("clock").textContent = `${frame.time.toFixed(3)} s`;
    let stopped = 0;
    for (let i = 0; i < frame.robots; ++i) if (frame.robotWords[2 * i + 1] & RobotState.Stopped) ++stopped;
    byId("stopped").textContent = stopped ? `${stopped} stopped` : "";
  }

  // --- back and forth

  private scrub() {
    const scrub = byId("scrub") as HTMLInputElement, at = Number(scrub.value);
    this.live = at >= this.past.length - 1;
    byId("past").classList.toggle("back", !this.live);
    const kept = this.past[at];
    if (!kept) return;
    // the paths are those of then
    if (at < this.shownAt) {
      this.scene.clearTrails();
      this.shownAt = 0;
    }
    for (let i = this.shownAt, by = Math.max(1, (at - i) / kMostTrail); i < at; i += by) this.scene.addToTrails(readFrame(this.past[Math.floor(i)].bytes));
    this.shownAt = at;
    const frame = readFrame(kept.bytes);
    this.takeValues(frame);
    this.show(frame);
    this.inspector.update();
    this.timeline.goTo(frame.time);
    this.console.shownUntil(this.live ? Infinity : frame.time);
    const name = this.selectedRobot()?.name;
    let i = this.looks.length - 1;
    while (i >= 0 && (this.looks[i].robot !== name || this.looks[i].time_s > frame.time + 1e-9)) --i;
    this.showLook(this.looks[i]);
  }

  // --- a report: all frames are there, and time passes here

  private async takeReport(frames: { time: number; bytes: ArrayBuffer }[]) {
    this.past = frames;
    await this.subscribe();
    const scrub = byId("scrub") as HTMLInputElement;
    scrub.max = String(frames.length - 1);
    scrub.value = "0";
    this.scrub();
    byId("past").classList.remove("back");
    this.showSummary();
    document.body.dataset.ready = "yes";
  }
  private playReport() {
    const begin = performance.now(), scrub = byId("scrub") as HTMLInputElement;
    let at = Number(scrub.value);
    if (at >= this.past.length - 1) at = 0;
    const from = this.past[at]?.time ?? 0;
    const turn = () => {
      const time = from + ((performance.now() - begin) / 1000) * (this.state.speed || 64);
      while (at + 1 < this.past.length && this.past[at + 1].time <= time) ++at;
      scrub.value = String(at);
      this.scrub();
      if (at + 1 < this.past.length) this.player = requestAnimationFrame(turn);
      else this.stopReport();
    };
    this.player = requestAnimationFrame(turn);
    this.takeState({ ...this.state, playing: true });
  }
  private stopReport() {
    cancelAnimationFrame(this.player);
    this.takeState({ ...this.state, playing: false });
  }
  private showSummary() {
    const s = this.recorded!.summary, columns: [string, (r: any) => string][] = [["robot", (r) => r.name], ["program", (r) => r.firmware.split("/").pop()], ["HAL", (r) => r.hal ?? "none"],
      ["x, m", (r) => r.x_m.toFixed(3)], ["y, m", (r) => r.y_m.toFixed(3)], ["path, m", (r) => r.distance_m.toFixed(3)], ["collisions", (r) => r.collisions],
      ["load", (r) => `${(100 * r.cpu_load).toFixed(0)} %`], ["battery used", (r) => `${(1000 * r.battery_used_wh).toFixed(0)} mWh`], ["traps", (r) => r.traps.length], ["diagnoses", (r) => r.diagnoses.length]];
    byId("pane-summary").replaceChildren(
      h("p", {}, `${s.world}: ${s.simulated_s.toFixed(1)} s simulated in ${s.wall_s.toFixed(2)} s (${s.speed.toFixed(0)} times real time), seed ${s.seed}, digest ${s.digest}, Twinpuck ${s.version}`),
      h("table", {}, h("tr", {}, ...columns.map(([name]) => h("th", {}, name))), ...s.robots.slice(0, 200).map((r: any) => h("tr", {}, ...columns.map(([, text]) => h("td", {}, String(text(r))))))));
    this.showDock("summary");
  }
  private forgetPast() {
    this.past = [];
    this.pastBytes = 0;
    this.looks = [];
    this.traps = [];
    this.live = true;
    byId("past").classList.remove("back");
    this.scene.clearTrails();
    this.plots.clear();
    this.timeline.forget();
  }

  // --- asking

  async do(what: string, more: Record<string, unknown> = {}): Promise<Record<string, any> | undefined> {
    try {
      return await this.connection.ask(what, more);
    } catch (e) {
      const { message, anew } = e as Error & { anew?: boolean };
      if (!anew) this.notice(message, true);
      else if (await this.question(message)) return this.do(what, { ...more, anew: true });
      return undefined;
    }
  }
  change(edit: Record<string, unknown>) { return this.do("edit", edit); }
  /** What an edit would cost, before it is done. A later question takes the place of this one. */
  private question(text: string) {
    return new Promise<boolean>((done) => {
      const answer = (yes: boolean) => () => { byId("question").replaceChildren(); this.answer = undefined; done(yes); };
      this.answer?.();
      this.answer = answer(false);
      byId("question").replaceChildren(h("span", {}, text), h("button", { id: "anew", className: "strong", onclick: answer(true) }, "Begin anew"), h("button", { id: "leave", onclick: answer(false) }, "Leave it"));
    });
  }
  set(thing: number, values: Record<string, unknown>, group = 0) { return this.change({ op: "set", thing, values, group }); }

  async subscribe() {
    const names = [...new Set([...this.inspector.names(), ...this.plots.names])];
    const answer = await this.connection.ask("subscribe", { names });
    this.subscriptions.set(answer.subscription, answer.names ?? names);
    if (!this.recorded) this.connection.ask("rays", { robots: [...this.rays] }).catch(() => {});
  }
  toggleRays(robot?: string) {
    const all = this.world.robots.map((r) => r.name);
    if (robot) this.rays.has(robot) ? this.rays.delete(robot) : this.rays.add(robot);
    else this.rays = new Set(this.rays.size ? [] : all);
    byId("rays").classList.toggle("on", this.rays.size > 0);
    this.do("rays", { robots: [...this.rays] });
  }
  leds(body: number) { return this.frame && body < this.frame.robots ? this.frame.robotWords[2 * body] : 0; }
  toggleView() {
    this.showView = !this.showView;
    this.showLook(this.look);
  }
  follow(robot: string) {
    this.scene.followed = this.scene.followed === robot ? "" : robot;
    this.notice(this.scene.followed ? `the view goes with ${robot}` : "the view stays");
  }

  // --- selection

  selectedRobot(): Robot | undefined { return this.world.robots.find((r) => r.id === this.selected); }
  selectedThing(): Thing | undefined { return this.world.things.find((t) => t.id === this.selected); }
  select(id: number) {
    const changed = id !== this.selected;
    this.selected = id;
    this.scene.select(id, this.touch.handles());
    this.inspector.show();
    const robot = this.selectedRobot();
    if (robot && changed) {
      this.console.choose(robot.name);
      this.program.choose(this.programOf(robot));
    }
    if (changed) this.subscribe().catch(() => {});
    if (changed && this.timeline.shown) this.timeline.watch(true);
    if (changed && !this.recorded) this.do("look", { robot: robot?.name ?? "" });
    if (changed) this.showLook(this.looks.filter((l) => l.robot === robot?.name).pop());
  }
  copySelected() {
    const piece = this.selectedRobot() ?? this.selectedThing();
    if (!piece) return;
    const values: Record<string, unknown> = {};
    if ("points" in piece && piece.points) values.points = piece.points.map((p) => [p[0] + 0.05, p[1] - 0.05]);
    else values.position = [piece.position[0] + 0.1, piece.position[1] - 0.1, ...piece.position.slice(2)];
    if (piece.kind === "robot") values.name = this.freeName(piece.name!);
    else if (piece.name) values.name = this.freeName(piece.name);
    this.do("edit", { op: "copy", thing: piece.id, values }).then((a) => { if (a?.thing) this.select(a.thing); });
  }
  freeName(like: string) {
    const stem = like.replace(/[ _]?\d+$/, "") || "thing", gap = /\s\d+$/.test(like) ? " " : "";
    for (let i = 2; ; ++i) if (![...this.world.robots, ...this.world.things].some((o) => o.name === `${stem}${gap}${i}`)) return `${stem}${gap}${i}`;
  }
  removeSelected() {
    if (this.selected) this.do("edit", { op: "remove", thing: this.selected });
  }
  turnSelected(degrees: number) {
    const piece = this.selectedRobot() ?? this.selectedThing();
    if (!piece || piece.heading === undefined) return;
    this.touch.place(piece, piece.position, piece.heading + (degrees * Math.PI) / 180);
  }

  // --- the frame of the page

  private buildBar() {
    const button = (id: string, text: string, title: string, act: () => void) => h("button", { id, title, onclick: act, "aria-label": title }, icon(text) || text);
    const speed = h("select", { id: "speed", title: "How fast: simulated seconds for each second (, slower . faster)", onchange: () => this.setSpeed(Number((speed as HTMLSelectElement).value)) },
      ...kSpeeds.map(([text, value]) => h("option", { value: String(value) }, text === "max" ? "max" : `${text}×`)));
    byId("bar").replaceChildren(
      h("span", { className: "brand" }, "Twinpuck"), h("span", { id: "file" }),
      h("span", { className: "group" },
        button("restart", "restart", "Restart from time 0 (Ctrl R)", () => this.do("restart", { play: false })),
        button("play", "play", "Play (Space)", () => this.togglePlay()),
        button("step", "step", "One control step (N); with Shift one tick", () => this.do("step", { unit: "control" })),
        button("step-irq", "irq", "Up to the selected robot's next interrupt (I)", () => this.stepInterrupt()), speed, h("output", { id: "pace" })),
      h("span", { className: "group" }, button("undo", "undo", "Undo (Ctrl Z)", () => this.do("undo")), button("redo", "redo", "Redo (Ctrl Y)", () => this.do("redo")),
        button("save", "Save", "Save the world file (Ctrl S)", () => this.save()), button("save-as", "Save as…", "Save under another name", () => this.saveAs())),
      h("span", { className: "group" }, button("above", "Top", "Seen from above (1)", () => this.scene.fit(true)), button("perspective", "3D", "Seen aslant (2)", () => this.scene.fit(false)),
        button("rays", "Rays", "Rays of all proximity sensors (Y)", () => this.toggleRays()), button("trails", "Paths", "Paths of the robots (P)", () => this.toggleTrails())),
      h("span", { className: "space" }), h("output", { id: "stopped", className: "bad" }),
      h("button", { id: "steer", hidden: true, title: "Another page steers; from then on this one does", onclick: () => this.do("steer") }, "Take the wheel"),
      button("theme", "theme", "Dark or light", () => this.setTheme(!this.dark)),
      button("help", "?", "Keys", () => byId("keys").toggleAttribute("hidden")));
    byId("trails").classList.add("on");
    const keys: [string, string][] = [["Space", "play, pause"], ["N, Shift N", "one control step, one tick"], ["I", "to the next interrupt"], [", .", "slower, faster"], ["Ctrl R", "restart"],
      ["1 2 F", "from above, aslant, fit"], ["Y P K", "rays, paths, what the camera sees"], ["V W B C O L R", "select; wall, box, cylinder, ball, lamp, robot"], ["Q E", "turn by 15°, with Shift 1°"], ["Arrows", "move by 1 cm, with Shift 1 mm"],
      ["Ctrl D, Del", "copy, delete"], ["Ctrl Z Y S", "undo, redo, save"], ["Shift while dragging", "without the grid of 1 cm"], ["Left, right drag, wheel", "move the view, turn it, zoom"], ["Esc", "nothing selected"]];
    byId("stage").append(h("div", { id: "keys", hidden: true }, h("h3", {}, "Keys"), ...keys.map(([k, text]) => h("div", {}, h("kbd", {}, k), text))));
  }

  private buildDock() {
    const tabs: [string, string, HTMLElement][] = [["console", "Console", this.console.pane], ["plots", "Plots", this.plots.pane], ["program", "Program", this.program.pane], ["timeline", "Time line", this.timeline.pane], ["text", "World file", this.text.pane], ["problems", "Problems", this.problems.pane]];
    if (this.recorded) tabs.unshift(["summary", "Summary", h("div", { className: "pane pad" })]);
    byId("dock").replaceChildren(h("div", { className: "tabs", role: "tablist" }, ...tabs.map(([id, text]) => h("button", { id: `tab-${id}`, role: "tab", onclick: () => this.showDock(id) }, text)),
      h("span", { className: "space" }), h("button", { title: "Larger or smaller", onclick: () => document.body.classList.toggle("tall") }, "⇕")), ...tabs.map(([id, , pane]) => ((pane.id = `pane-${id}`), pane)));
    this.plots.build();
    this.showDock("console");
  }
  showDock(id: string) {
    for (const tab of byId("dock").querySelectorAll(".tabs [id]")) tab.classList.toggle("on", tab.id === `tab-${id}`);
    for (const pane of byId("dock").querySelectorAll<HTMLElement>(".pane")) pane.hidden = pane.id !== `pane-${id}`;
    if (id === "plots") this.plots.draw();
    if ((id === "timeline") !== this.timeline.shown) this.timeline.watch(id === "timeline");
  }
  goToLine(line: number) {
    if (!line) return;
    this.showDock("text");
    this.text.goTo(line);
  }

  private setTheme(dark: boolean) {
    this.dark = dark;
    localStorage.setItem("theme", dark ? "dark" : "light");
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    this.scene.setBackground(css("--sky"));
    this.program.setDark(dark);
    this.text.setDark(dark);
    this.plots.build();
    this.inspector.update();
  }
  private toggleTrails() {
    this.scene.showTrails = !this.scene.showTrails;
    byId("trails").classList.toggle("on", this.scene.showTrails);
    if (this.frame) this.scene.setFrame(this.frame);
  }
  togglePlay() {
    if (this.recorded) return this.state.playing ? this.stopReport() : this.playReport();
    if (!this.live) { (byId("scrub") as HTMLInputElement).value = byId("scrub").getAttribute("max")!; this.scrub(); }
    return this.do(this.state.playing ? "pause" : "play");
  }
  private setSpeed(value: number) {
    if (!this.recorded) return this.do("speed", { factor: value === 0 ? "max" : value });
    if (this.state.playing) this.stopReport();
    this.takeState({ ...this.state, speed: value });
  }
  private faster(by: number) {
    const at = kSpeeds.findIndex(([, v]) => v === this.state.speed);
    this.setSpeed(kSpeeds[Math.max(0, Math.min(kSpeeds.length - 1, (at < 0 ? 4 : at) + by))][1]);
  }
  private stepInterrupt() {
    const robot = this.selectedRobot() ?? this.world.robots[0];
    if (robot) this.do("step", { unit: "interrupt", robot: robot.name });
  }
  async save() {
    if (await this.do("save")) this.notice("saved");
  }
  async saveAs() {
    const name = prompt("Save in the same folder as", this.world.file.split("/").pop());
    if (!name) return;
    const full = name.endsWith(".toml") ? name : name + ".toml";
    try {
      await this.connection.ask("save_as", { name: full });
      this.notice(`saved as ${full}`);
    } catch (e) {
      if (!/overwrite/.test((e as Error).message)) return this.notice((e as Error).message, true);
      if (confirm(`${full} is there already. Overwrite it?`)) await this.do("save_as", { name: full, overwrite: true });
    }
  }
  notice(text: string, bad = false, stays = false) {
    const notice = byId("notice");
    notice.textContent = text;
    notice.className = bad ? "bad shown" : "shown";
    clearTimeout(this.noticeTimer);
    if (!stays) this.noticeTimer = window.setTimeout(() => (notice.className = ""), bad ? 8000 : 2500);
  }

  private key(e: KeyboardEvent) {
    const typing = (e.target as HTMLElement).closest("input:not([type=range]):not([type=checkbox]),textarea,select,.cm-editor");
    const ctrl = e.ctrlKey || e.metaKey, key = e.key.length === 1 ? e.key.toLowerCase() : e.key;
    const act = (f: () => unknown) => { e.preventDefault(); f(); };
    if (ctrl && key === "s" && !(e.target as HTMLElement).closest(".cm-editor")) return act(() => this.save());
    if (typing) { if (key === "Escape") (e.target as HTMLElement).blur(); return; }
    if (ctrl) {
      const keys: Record<string, () => unknown> = { z: () => this.do(e.shiftKey ? "redo" : "undo"), y: () => this.do("redo"), d: () => this.copySelected(), r: () => this.do("restart", { play: false }) };
      if (keys[key]) act(keys[key]);
      return;
    }
    const move = (x: number, y: number) => this.touch.nudge(x, y, e.shiftKey ? 0.001 : 0.01);
    const keys: Record<string, () => unknown> = {
      " ": () => this.togglePlay(), n: () => this.do("step", { unit: e.shiftKey ? "tick" : "control" }), i: () => this.stepInterrupt(), ",": () => this.faster(-1), ".": () => this.faster(1),
      "1": () => this.scene.fit(true), "2": () => this.scene.fit(false), f: () => this.scene.fit(true), y: () => this.toggleRays(), p: () => this.toggleTrails(),
      q: () => this.turnSelected(e.shiftKey ? 1 : 15), e: () => this.turnSelected(e.shiftKey ? -1 : -15), Delete: () => this.removeSelected(), Backspace: () => this.removeSelected(),
      k: () => this.toggleView(), Escape: () => { this.answer?.(); this.touch.choose("select"); this.select(0); }, ArrowLeft: () => move(-1, 0), ArrowRight: () => move(1, 0), ArrowUp: () => move(0, 1), ArrowDown: () => move(0, -1),
      v: () => this.touch.choose("select"), w: () => this.touch.choose("wall"), b: () => this.touch.choose("box"), c: () => this.touch.choose("cylinder"), o: () => this.touch.choose("ball"), l: () => this.touch.choose("lamp"), r: () => this.touch.choose("robot"),
      "?": () => byId("keys").toggleAttribute("hidden"),
    };
    if (keys[key]) act(keys[key]);
  }
}

// tests and the curious find it by this name
(window as any).twinpuck = new App();
