// SPDX-License-Identifier: MIT
// Buttons of the view, in the scene's corner: cameras that go with a robot, ruler, picture, film; and the note that says what the
// drawing leaves out.
import { byId, h } from "../dom";
import type { SceneView } from "../scene/scene_view";
import type { Store } from "../store/store";
import { Film } from "./film";
import "./views.css";

export class ViewButtons {
  readonly film: Film;

  constructor(
    private store: Store,
    private view: SceneView,
  ) {
    const { cameras, ruler, scene } = view;
    this.film = new Film(store, scene);
    const button = (id: string, text: string, title: string, act: () => void) =>
      h("button", { id, title, "aria-label": title, onclick: act }, text);
    const follow = button("follow", "Follow", "The view goes with the selected robot (3)", () =>
      this.follow("goes with"),
    );
    const behind = button("behind", "Behind", "The view goes behind the selected robot and turns with it (4)", () =>
      this.follow("goes behind"),
    );
    const measure = button(
      "measure",
      "Ruler",
      "Distance and angle between two places, or between the two pieces that are selected (M)",
      () => ruler.toggle(),
    );
    const film = button("film", "Film", "", () => this.film.toggle());
    byId("stage").append(
      h(
        "div",
        { id: "views", role: "toolbar", "aria-label": "View" },
        follow,
        behind,
        measure,
        button("picture", "Picture", "The scene as a PNG file", () => this.film.picture()),
        film,
      ),
    );
    const set = (b: HTMLElement, on: boolean) => {
      b.classList.toggle("on", on);
      b.setAttribute("aria-pressed", String(on));
    };
    const show = () => {
      set(follow, cameras.going === "goes with");
      set(behind, cameras.going === "goes behind");
      set(measure, ruler.isOn);
      set(film, this.film.records);
      film.textContent = this.film.records ? "■ Stop film" : "Film";
      film.title = this.film.records
        ? "End the film and download it (WebM)"
        : "Film the scene (WebM), until pressed again";
      film.setAttribute("aria-label", film.title);
    };
    for (const list of [cameras.onChange, ruler.onChange, this.film.onChange]) list.push(show);
    show();
    this.addNote();
  }
  private follow(going: "goes with" | "goes behind") {
    const { store, view } = this,
      robot = store.selectedRobot()?.name ?? (view.cameras.followed || store.world.robots[0]?.name);
    if (robot) view.follow(robot, going);
  }
  act(key: string): (() => void) | undefined {
    return (
      {
        "3": () => this.follow("goes with"),
        "4": () => this.follow("goes behind"),
        m: () => this.view.ruler.toggle(),
      } as Record<string, () => void>
    )[key];
  }
  /** Nothing is left out: no note, unless somebody has asked for all. */
  private addNote() {
    const { canvas } = this.view.scene,
      note = h("button", { id: "drawing-note", onclick: () => canvas.setMeasures(!canvas.quality.measures) });
    byId("stage").append(note);
    const show = () => {
      const { leftOut, measures } = canvas.quality;
      note.hidden = measures && leftOut.length === 0;
      note.textContent = measures ? `Fast drawing: without ${leftOut.join(", ")}` : "Full drawing, however slow";
      note.title = measures
        ? "A frame took longer than 50 ms to draw. Click: draw all of it all the same"
        : "Click: leave out what takes too long";
    };
    canvas.onQuality.push(show);
    show();
  }
}
