// SPDX-License-Identifier: MIT
// The scene as a picture (PNG) and as a film (WebM), downloaded.
import { h } from "../dom";
import type { Scene } from "../scene/scene";
import type { Store } from "../store/store";
import { notice } from "./notices";

const kFramesPerSecond = 30;
const kBitsPerSecond = 8e6;
// VP8 before VP9: the processor simulates, too
const kTypes = ["video/webm;codecs=vp8", "video/webm;codecs=vp9", "video/webm"];

function download(blob: Blob, name: string) {
  const href = URL.createObjectURL(blob);
  h("a", { href, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(href), 60000);
}

export class Film {
  private recorder?: MediaRecorder;
  private pieces: Blob[] = [];
  /** Hears that a film begins or ends. */
  readonly onChange: (() => void)[] = [];

  constructor(
    private store: Store,
    private scene: Scene,
  ) {}
  get records() {
    return !!this.recorder;
  }
  /** As the world, with the time that is shown. */
  private name(ending: string) {
    const { world, frame } = this.store,
      stem =
        world.file
          .split("/")
          .pop()!
          .replace(/\.toml$/, "") || "world";
    return `${stem}-${(frame?.time ?? 0).toFixed(3)}s.${ending}`;
  }
  picture() {
    const name = this.name("png");
    // a canvas keeps its picture only until the script has ended
    this.scene.drawNow();
    this.scene.renderer.domElement.toBlob((blob) => {
      if (blob) download(blob, name);
      else notice("The picture cannot be made", true);
    }, "image/png");
  }
  toggle() {
    if (this.recorder) return this.recorder.stop();
    const type =
      typeof MediaRecorder === "undefined" ? undefined : kTypes.find((t) => MediaRecorder.isTypeSupported(t));
    if (!type) return notice("This browser makes no films (WebM)", true);
    const { scene } = this,
      stream = scene.renderer.domElement.captureStream(kFramesPerSecond),
      recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: kBitsPerSecond });
    this.pieces = [];
    recorder.ondataavailable = (e) => {
      if (e.data.size) this.pieces.push(e.data);
    };
    recorder.onerror = () => notice("The film was cut off", true);
    recorder.onstop = () => {
      stream.getTracks().forEach((track) => track.stop());
      scene.canvas.hold(false);
      this.recorder = undefined;
      download(new Blob(this.pieces, { type: "video/webm" }), this.name("webm"));
      this.pieces = [];
      for (const hear of this.onChange) hear();
    };
    this.recorder = recorder;
    scene.canvas.hold(true); // a film has one size
    recorder.start(1000);
    scene.draw();
    for (const hear of this.onChange) hear();
  }
}
