// SPDX-License-Identifier: MIT
// A document for tests of panes, as index.html begins it, and a server that a test plays.
import { GlobalWindow } from "happy-dom";
import { Link } from "../src/link/connection";
import type { Answer } from "../src/link/connection";

const window = new GlobalWindow({ url: "http://127.0.0.1:1/token/" });
const given = globalThis as any;
for (const name of [
  "document",
  "localStorage",
  "HTMLElement",
  "Element",
  "Node",
  "Event",
  "KeyboardEvent",
  "MouseEvent",
  "PointerEvent",
  "ResizeObserver",
  "MutationObserver",
  "getComputedStyle",
  "matchMedia",
  "requestAnimationFrame",
  "cancelAnimationFrame",
])
  given[name] = (window as any)[name];
given.window = given;
for (const name of ["addEventListener", "removeEventListener", "dispatchEvent"])
  given[name] = (window as any)[name].bind(window);
given.location = window.location;
if (!("devicePixelRatio" in given)) given.devicePixelRatio = 1;

/** The page anew, with nothing in it. */
export function freshDocument() {
  document.body.innerHTML = `<header id="bar"></header><nav id="palette"></nav>
<main id="stage"><div id="notice"></div><div id="question"></div><div id="badges"></div></main>
<footer id="past"><input id="scrub" type="range"><output id="clock"></output></footer>
<aside id="side"><section id="tree"></section><section id="inspector"></section></aside><section id="dock"></section>`;
  localStorage.clear();
}

/** A server that answers what the test says, and keeps what it was asked. */
export class FakeLink extends Link {
  readonly asked: { what: string; more: Record<string, any> }[] = [];
  answers: Record<string, (more: Record<string, any>) => Answer | Promise<Answer>> = {};

  async ask(what: string, more: Record<string, any> = {}) {
    this.asked.push({ what, more });
    return (await this.answers[what]?.(more)) ?? (what === "subscribe" ? { subscription: 1 } : {});
  }
  event(name: string, more: Record<string, unknown> = {}) {
    this.tell({ event: name, ...more });
  }
  of(what: string) {
    return this.asked.filter((a) => a.what === what).map((a) => a.more);
  }
}

/** An error of the server's, with what it says beside the sentence. */
export const refuse = (message: string, more: Record<string, unknown> = {}) => {
  throw Object.assign(new Error(message), more);
};
export const settle = () => new Promise((done) => setTimeout(done, 0));
