// SPDX-License-Identifier: MIT
// The page put together: a bar with time, a palette, the scene, an inspector beside it, a dock below.
import "uplot/dist/uPlot.min.css";
import "./panes/panes.css";
import "./frame/page.css";
import { h } from "./dom";
import { showBadges } from "./frame/badges";
import { Bar, setTheme } from "./frame/bar";
import { Dock } from "./frame/dock";
import type { Tab } from "./frame/dock";
import { listenToClipboard } from "./frame/clipboard";
import { listenToKeys } from "./frame/keys";
import { beginLayout } from "./frame/layout";
import { notice } from "./frame/notices";
import { PastBar } from "./frame/past_bar";
import { Report } from "./frame/report";
import { ViewButtons } from "./frame/views";
import { WorldFile } from "./frame/save";
import { Connection } from "./link/connection";
import { Playback } from "./link/playback";
import { Console } from "./panes/console";
import { showCursorIn } from "./panes/cursor_lines";
import { DebuggerPane } from "./panes/debugger";
import { Inspector } from "./panes/inspector";
import { Plots } from "./panes/plots";
import "./panes/time.css";
import { ProblemsPane } from "./panes/problems";
import { ProgramPane } from "./panes/program";
import { TimeLine } from "./panes/timeline";
import { Tree } from "./panes/tree";
import { WorldTextPane } from "./panes/world_text";
import { SceneView } from "./scene/scene_view";
import { Touch } from "./scene/touch";
import { Buffers } from "./store/buffers";
import { Client } from "./store/client";
import { Debugging } from "./store/debugging";
import { Pieces } from "./store/pieces";
import { Store } from "./store/store";

const playback = document.getElementById("report") ? new Playback() : undefined;
const store = new Store();
store.recorded = !!playback;
const systemsDark = matchMedia("(prefers-color-scheme: dark)");
store.dark = localStorage.getItem("theme") ? localStorage.getItem("theme") === "dark" : systemsDark.matches;
const client = new Client(store, playback ?? new Connection());
const buffers = new Buffers(store, client);
const debug = new Debugging(store, client);
const pieces = new Pieces(store, client);

// the scene hears of a world before the hand that pulls at it
const view = new SceneView(store, client);
const touch = new Touch(store, client, pieces, view.scene);
const tree = new Tree(store, pieces);
const inspector = new Inspector(store, client, pieces);
const past = new PastBar(store);
const report = playback && new Report(store, client, past, playback);
const views = { fit: (above: boolean) => view.cameras.fit(above), toggleTrails: () => view.toggleTrails() };
const console_ = new Console(store, client);
showCursorIn(console_.pane.querySelector("#console-lines")!, store);
const plots = new Plots(store, client);
const debugger_ = new DebuggerPane(store, debug);
const program = new ProgramPane(store, buffers, debug, debugger_);
const text = new WorldTextPane(store, buffers);
const file = new WorldFile(store, client, buffers, text);
const bar = new Bar(store, client, past, file, views, report);
const viewButtons = new ViewButtons(store, view);
const timeline = new TimeLine(store, client);
const problems = new ProblemsPane(store);
showBadges(store);
const tabs: Tab[] = [
  { id: "console", text: "Console", pane: console_.pane },
  { id: "plots", text: "Plots", pane: plots.pane },
  { id: "program", text: "Program", pane: program.pane },
  { id: "timeline", text: "Time line", pane: timeline.pane },
  { id: "text", text: "World file", pane: text.pane },
  { id: "problems", text: "Problems", pane: problems.pane },
];
if (report) tabs.unshift({ id: "summary", text: "Summary", pane: h("div", { className: "pane pad" }) });
const dock = new Dock(store, tabs);
dock.show("console");
beginLayout();
listenToClipboard(pieces);
listenToKeys({ store, client, pieces, bar, file, views, touch, inspector, viewButtons });
setTheme(store, store.dark, false);
systemsDark.addEventListener("change", () => {
  if (!localStorage.getItem("theme")) setTheme(store, systemsDark.matches, false);
});
addEventListener("beforeunload", (e) => {
  if (!store.state.saved || buffers.dirty().length) e.preventDefault();
});
playback?.play();

// tests and the curious find it by this name
const shown = {
  store,
  client,
  connection: client.link,
  buffers,
  debug,
  file,
  pieces,
  scene: view.scene,
  view,
  film: viewButtons.film,
  touch,
  tree,
  inspector,
  console: console_,
  plots,
  program,
  text,
  timeline,
  problems,
  work: client.work,
  notice,
  do: client.do.bind(client),
  set: client.set.bind(client),
  leds: store.leds.bind(store),
  select: store.select.bind(store),
  selectedRobot: store.selectedRobot.bind(store),
  selectedThing: store.selectedThing.bind(store),
  showDock: dock.show.bind(dock),
  togglePlay: bar.togglePlay.bind(bar),
  get world() {
    return store.world;
  },
  get state() {
    return store.state;
  },
  get programs() {
    return store.programs;
  },
  get frame() {
    return store.frame;
  },
  get look() {
    return store.look;
  },
  get frames() {
    return store.frames;
  },
  get values() {
    return store.values;
  },
  get selected() {
    return store.selected;
  },
};
export type Twinpuck = typeof shown;
(window as any).twinpuck = shown;
