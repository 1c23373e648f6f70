// SPDX-License-Identifier: MIT
// Pictures of what a robot senses: proximity sensors as a fan, microphones and loudspeaker, the camera's picture.
import type { Robot } from "../link/protocol";
import type { Picture } from "../link/protocol_types";
import { css } from "../dom";

const kFarCounts = 4095;
const kMics = [
  [0.008, -0.031],
  [0.008, 0.031],
  [-0.022, 0],
]; // m, right, left, back
const kLoudestCounts = 400,
  kQuietestCounts = 0.3;
type Value = (name: string) => number | undefined;
/** Colours of the theme, asked for once a picture. */
const colours = () => ({
  line: css("--line"),
  accent: css("--accent"),
  text: css("--text"),
  panel: css("--panel2"),
  dim: css("--dim"),
  good: css("--good"),
});

function body(c: CanvasRenderingContext2D, x: number, y: number, r: number, k: ReturnType<typeof colours>) {
  c.fillStyle = k.panel;
  c.strokeStyle = k.dim;
  c.beginPath();
  c.arc(x, y, r, 0, 7);
  c.fill();
  c.stroke();
  c.beginPath();
  c.moveTo(x, y - 0.82 * r);
  c.lineTo(x - 0.25 * r, y - 0.4 * r);
  c.lineTo(x + 0.25 * r, y - 0.4 * r);
  c.closePath();
  c.fillStyle = k.text;
  c.fill();
}

export function drawFan(c: CanvasRenderingContext2D, robot: Robot, leds: number, value: Value) {
  const { width: w, height: hgt } = c.canvas,
    mx = w / 2,
    my = hgt / 2 + 10,
    r0 = 62,
    r1 = 185,
    k = colours();
  c.clearRect(0, 0, w, hgt);
  c.lineWidth = 2;
  c.font = "600 21px system-ui";
  c.textAlign = "center";
  robot.sensors.forEach((s, i) => {
    const counts = value(`ir${i}`) ?? 0,
      a = -s[3] - Math.PI / 2,
      half = 0.2;
    const reach = r0 + (r1 - r0) * Math.min(1, Math.sqrt(Math.max(0, counts) / kFarCounts));
    c.fillStyle = k.line;
    c.beginPath();
    c.arc(mx, my, r1, a - half, a + half);
    c.arc(mx, my, r0, a + half, a - half, true);
    c.fill();
    c.fillStyle = k.accent;
    c.beginPath();
    c.arc(mx, my, reach, a - half, a + half);
    c.arc(mx, my, r0, a + half, a - half, true);
    c.fill();
    c.fillStyle = k.text;
    c.fillText(`${counts.toFixed(0)}`, mx + (r1 + 26) * Math.cos(a) * 1.08, my + (r1 + 18) * Math.sin(a) + 4);
  });
  body(c, mx, my, r0 - 6, k);
  for (let i = 0; i < 8; ++i) {
    const a = -Math.PI / 2 + (i * Math.PI) / 4;
    c.fillStyle = leds & (1 << i) ? "#ff3b30" : k.line;
    c.beginPath();
    c.arc(mx + 44 * Math.cos(a), my + 44 * Math.sin(a), 6, 0, 7);
    c.fill();
  }
}

/** 0 where nothing is heard, 1 where it is as loud as the picture shows. */
const loudness = (counts: number) =>
  Math.min(
    1,
    Math.max(0, Math.log(Math.max(counts, 1e-9) / kQuietestCounts) / Math.log(kLoudestCounts / kQuietestCounts)),
  );

export function drawEars(c: CanvasRenderingContext2D, value: Value) {
  const { width: w, height: hgt } = c.canvas,
    mx = 120,
    my = hgt / 2,
    r = 72,
    k = colours();
  const levels = [0, 1, 2].map((i) => value(`mic_level${i}`) ?? 0),
    speaker = value("speaker") ?? 0;
  const loud = loudness(Math.max(...levels));
  c.clearRect(0, 0, w, hgt);
  c.lineWidth = 2;
  body(c, mx, my, r, k);
  kMics.forEach(([x, y], i) => {
    c.fillStyle = k.good;
    c.globalAlpha = 0.75;
    c.beginPath();
    c.arc(mx - (y / 0.037) * r, my - (x / 0.037) * r, 5 + 17 * loudness(levels[i]), 0, 7);
    c.fill();
    c.globalAlpha = 1;
  });
  if (loud > 0) {
    // an arrow from where the sound comes
    const a = -((value("sound_bearing") ?? 0) * Math.PI) / 180 - Math.PI / 2,
      at = (d: number, turn = 0): [number, number] => [mx + d * Math.cos(a + turn), my + d * Math.sin(a + turn)];
    c.strokeStyle = c.fillStyle = k.good;
    c.lineWidth = 4;
    c.beginPath();
    c.moveTo(...at(r + 44));
    c.lineTo(...at(r + 18));
    c.stroke();
    c.beginPath();
    c.moveTo(...at(r + 6));
    c.lineTo(...at(r + 22, 0.12));
    c.lineTo(...at(r + 22, -0.12));
    c.closePath();
    c.fill();
  }
  c.font = "600 21px system-ui";
  const bar = (row: number, name: string, share: number, text: string, colour: string) => {
    const y = 40 + 42 * row,
      from = 350,
      wide = 170;
    c.fillStyle = k.text;
    c.textAlign = "left";
    c.fillText(name, 252, y + 6);
    c.textAlign = "right";
    c.fillText(text, w - 4, y + 6);
    c.fillStyle = k.line;
    c.fillRect(from, y - 7, wide, 12);
    c.fillStyle = colour;
    c.fillRect(from, y - 7, wide * share, 12);
  };
  ["right", "left", "back"].forEach((name, i) => bar(i, name, loudness(levels[i]), levels[i].toFixed(1), k.good));
  bar(3, "speaker", Math.min(1, speaker / 50), `${speaker.toFixed(0)} %`, k.accent);
}

export function drawPicture(canvas: HTMLCanvasElement, picture: Picture) {
  canvas.width = picture.columns;
  canvas.height = picture.rows;
  canvas.getContext("2d")!.putImageData(imageOf(picture.columns, picture.rows, picture.rgb), 0, 0);
}
/** Three bytes a pixel in base64, as a picture. */
export function imageOf(width: number, height: number, rgb: string) {
  const image = new ImageData(width, height),
    bytes = atob(rgb);
  for (let i = 0, o = 0; i < bytes.length; i += 3, o += 4) {
    for (let k = 0; k < 3; ++k) image.data[o + k] = bytes.charCodeAt(i + k);
    image.data[o + 3] = 255;
  }
  return image;
}
