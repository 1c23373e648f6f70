// SPDX-License-Identifier: MIT
// A canvas's context that keeps what is drawn, for tests.

export type Arc = { x: number; y: number; r: number; from: number; to: number };
export interface Drawn {
  how: "fill" | "stroke" | "rect" | "text";
  colour: string;
  alpha: number;
  /** Corners and arcs of a path; a rectangle's x, y, width, height; where a text stands. */
  points: number[][];
  arcs: Arc[];
  text: string;
}

export class Pen {
  fillStyle = "";
  strokeStyle = "";
  globalAlpha = 1;
  drawn: Drawn[] = [];
  private points: number[][] = [];
  private arcs: Arc[] = [];
  constructor(readonly canvas = { width: 1000, height: 1000 }) {}
  setTransform() {}
  clearRect() {
    this.drawn = [];
  }
  beginPath() {
    this.points = [];
    this.arcs = [];
  }
  closePath() {
    this.points.push(this.points[0]);
  }
  moveTo(...at: number[]) {
    this.points.push(at);
  }
  lineTo(...at: number[]) {
    this.points.push(at);
  }
  arc(x: number, y: number, r: number, from: number, to: number) {
    this.arcs.push({ x, y, r, from, to });
  }
  fill() {
    this.keep("fill", this.fillStyle, this.points);
  }
  stroke() {
    this.keep("stroke", this.strokeStyle, this.points);
  }
  fillRect(...at: number[]) {
    this.keep("rect", this.fillStyle, [at]);
  }
  fillText(text: string, x: number, y: number) {
    this.keep("text", this.fillStyle, [[x, y]], text);
  }
  private keep(how: Drawn["how"], colour: string, points: number[][], text = "") {
    const arcs = how === "fill" || how === "stroke" ? [...this.arcs] : [];
    this.drawn.push({ how, colour, alpha: this.globalAlpha, points: [...points], arcs, text });
  }

  of(how: Drawn["how"], colour?: string) {
    return this.drawn.filter((d) => d.how === how && (colour === undefined || d.colour === colour));
  }
  /** As a test gives it to what draws. */
  get context() {
    return this as unknown as CanvasRenderingContext2D;
  }
}
