// SPDX-License-Identifier: MIT
// The other end of a page that is a report: what the run would have told, from the file itself.
import { Link } from "./connection";
import { readFrame } from "./protocol";

interface Piece {
  hello: any;
  events: any[];
  summary: any;
  names: string[];
  units: string[];
  frame_bytes: number;
  sources: Record<string, string>;
  floor: Record<string, any> | null;
}

/** Frames, taken apart byte by byte and deflated (viewer/report.h), as they were. */
async function unpack(text: string, size: number): Promise<ArrayBuffer[]> {
  const deflated = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream("deflate"));
  const plain = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = size ? plain.length / size : 0;
  const frames = Array.from({ length: count }, () => new Uint8Array(size));
  for (let byte = 0, at = 0; byte < size; ++byte) for (let i = 0; i < count; ++i) frames[i][byte] = plain[at++];
  return frames.map((f) => f.buffer);
}

export class Playback extends Link {
  private piece: Piece = JSON.parse(document.getElementById("report")!.textContent!);
  onPast: (frames: { time: number; bytes: ArrayBuffer }[]) => void = () => {};
  get summary() {
    return this.piece.summary;
  }

  /** Tells everything at once; the listeners are there. */
  async play() {
    this.tell(this.piece.hello);
    const frames = await unpack(document.getElementById("frames")!.textContent!, this.piece.frame_bytes);
    this.onPast(frames.map((bytes) => ({ time: readFrame(bytes).time, bytes })));
    this.piece.events.forEach((event) => this.tell(event));
  }
  ask(what: string, more: Record<string, any> = {}): Promise<Record<string, any>> {
    const { program, file } = more,
      { floor } = this.piece;
    if (what === "source" && `${program}/${file}` in this.piece.sources)
      return Promise.resolve({ text: this.piece.sources[`${program}/${file}`] });
    if (what === "floor" && floor) return Promise.resolve(floor);
    if (what !== "subscribe") return Promise.reject(new Error("a report shows what was; it cannot be changed"));
    const unknown = (more.names as string[]).find((n) => !this.piece.names.includes(n) && !n.includes(".var:"));
    if (unknown) return Promise.reject(new Error(`${unknown} is not in this report`));
    return Promise.resolve({ subscription: 0, names: this.piece.names, units: this.piece.units });
  }
}
