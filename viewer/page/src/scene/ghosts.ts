// SPDX-License-Identifier: MIT
// A robot that is in the file but not in the run: hatched, where the file says, with what is wrong with it.
import * as THREE from "three";
import type { Robot } from "../link/protocol";

const kStripes = 64; // px, of the picture of stripes
const kWrong = "#b3400a",
  kIdle = "#7f7f7f";
const kMostLetters = 60;

const textures = new Map<string, THREE.Texture>();
function hatching(colour: string) {
  let texture = textures.get(colour);
  if (texture) return texture;
  const canvas = document.createElement("canvas"),
    c = canvas.getContext("2d")!;
  canvas.width = canvas.height = kStripes;
  c.fillStyle = "#ffffff";
  c.fillRect(0, 0, kStripes, kStripes);
  c.strokeStyle = colour;
  c.lineWidth = kStripes / 4;
  for (const at of [-kStripes, 0, kStripes]) {
    c.beginPath();
    c.moveTo(at - kStripes / 2, kStripes * 1.5);
    c.lineTo(at + kStripes * 1.5, -kStripes / 2);
    c.stroke();
  }
  texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.colorSpace = THREE.SRGBColorSpace;
  textures.set(colour, texture);
  return texture;
}

/** A line of text that is as large from everywhere. */
function label(text: string) {
  const canvas = document.createElement("canvas"),
    c = canvas.getContext("2d")!,
    font = "500 30px system-ui, sans-serif";
  c.font = font;
  const short = text.length > kMostLetters ? text.slice(0, kMostLetters - 1) + "…" : text;
  canvas.width = Math.ceil(c.measureText(short).width) + 32;
  canvas.height = 52;
  c.font = font;
  c.fillStyle = "#fff1e8";
  c.fillRect(0, 0, canvas.width, canvas.height);
  c.strokeStyle = kWrong;
  c.lineWidth = 3;
  c.strokeRect(1, 1, canvas.width - 2, canvas.height - 2);
  c.fillStyle = "#7c2c07";
  c.fillText(short, 16, 37);
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.SRGBColorSpace;
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map, sizeAttenuation: false, depthTest: false }));
  sprite.scale.set((0.016 * canvas.width) / canvas.height, 0.016, 1);
  sprite.center.set(0.5, -0.6);
  sprite.renderOrder = 6;
  sprite.raycast = () => {};
  return sprite;
}

/** `message`: what is wrong with it; empty: it only does not run. */
export function ghost(robot: Robot, message: string): THREE.Object3D {
  const group = new THREE.Group(),
    map = hatching(message ? kWrong : kIdle).clone();
  map.repeat.set(6, 1.5);
  const top = hatching(message ? kWrong : kIdle).clone();
  top.repeat.set(2.5, 2.5);
  const side = new THREE.MeshBasicMaterial({ map }),
    lid = new THREE.MeshBasicMaterial({ map: top });
  const height = Math.max(robot.height, 0.01);
  const body = new THREE.Mesh(
    new THREE.CylinderGeometry(robot.radius, robot.radius, height, 40).rotateX(Math.PI / 2).translate(0, 0, height / 2),
    [side, lid, lid],
  );
  // where it would look
  const nose = new THREE.Mesh(
    new THREE.ShapeGeometry(
      new THREE.Shape(
        [
          [robot.radius * 0.8, 0],
          [robot.radius * 0.1, robot.radius * 0.4],
          [robot.radius * 0.3, 0],
          [robot.radius * 0.1, -robot.radius * 0.4],
        ].map((p) => new THREE.Vector2(p[0], p[1])),
      ),
    ).translate(0, 0, height + 0.001),
    new THREE.MeshBasicMaterial({ color: 0x222222 }),
  );
  group.add(body, nose);
  if (message) {
    const said = label(`⚠ ${message}`);
    said.position.set(0, 0, height);
    group.add(said);
  }
  group.position.set(robot.position[0], robot.position[1], robot.z0);
  group.rotation.z = robot.heading;
  group.userData.id = robot.id;
  return group;
}
