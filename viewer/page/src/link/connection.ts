// SPDX-License-Identifier: MIT
// The page's end of docs/connecting.md: one WebSocket, requests with answers, events.
import { readFrame } from "./protocol";
import type { Frame } from "./protocol";

export type Answer = Record<string, any>;
type Listener = (event: any) => void;

/** Who tells this page of a run: a server that runs it, or the file of a report. */
export abstract class Link {
  private listeners = new Map<string, Listener[]>();
  onFrame: (frame: Frame, bytes: ArrayBuffer) => void = () => {};
  onClose: () => void = () => {};
  on(event: string, listener: Listener) {
    this.listeners.set(event, [...(this.listeners.get(event) ?? []), listener]);
  }
  protected tell(event: any) {
    (this.listeners.get(event.event) ?? []).forEach((listener) => listener(event));
  }
  /** The answer; rejected with what is wrong. */
  abstract ask(what: string, more?: Record<string, unknown>): Promise<Answer>;
}

const kGone = "twinpuck view has ended: nothing was done";

/** What start.ts has opened, and heard since then. */
export interface Early {
  socket: WebSocket;
  heard: (string | ArrayBuffer)[];
}

export class Connection extends Link {
  private socket: WebSocket;
  private next = 1;
  private waiting = new Map<number, { done: (a: Answer) => void; fail: (e: Error) => void }>();

  constructor() {
    super();
    const { socket, heard }: Early = (window as any).early;
    this.socket = socket;
    socket.onclose = () => this.end();
    const hear = (message: string | ArrayBuffer) => {
      if (typeof message !== "string") return this.onFrame(readFrame(message), message);
      const data = JSON.parse(message);
      if (!("answer" in data)) return this.tell(data);
      const asked = this.waiting.get(data.answer);
      this.waiting.delete(data.answer);
      if (data.error) asked?.fail(Object.assign(new Error(data.error), data));
      else asked?.done(data);
    };
    socket.onmessage = (message) => hear(message.data);
    // once who listens is there
    queueMicrotask(() => {
      heard.forEach(hear);
      if (socket.readyState > WebSocket.OPEN) this.end();
    });
  }
  /** Nobody answers any more. */
  private end() {
    for (const { fail } of this.waiting.values()) fail(new Error(kGone));
    this.waiting.clear();
    this.onClose();
  }
  ask(what: string, more: Record<string, unknown> = {}): Promise<Answer> {
    if (this.socket.readyState > WebSocket.OPEN) return Promise.reject(new Error(kGone));
    const id = this.next++;
    this.socket.send(JSON.stringify({ id, do: what, ...more }));
    return new Promise((done, fail) => this.waiting.set(id, { done, fail }));
  }
}
