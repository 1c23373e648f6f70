// SPDX-License-Identifier: MIT
// What is drawn in the scene of things that have no body: where a lamp's light reaches, how far a sound, what a
// camera sees.
import * as THREE from "three";
import type { Thing, Vec } from "../link/protocol";

export interface CameraView {
  at: Vec;
  edges: Vec;
}

const kLight = 0xd98e00,
  kSound = 0xb0488a,
  kCamera = 0x0072b2;
const kCameraReach = 0.25; // m, of the picture that is drawn
const kLightSteps = [0.5, 0.25, 0.125];
const kSoundStep = 10; // dB

function ring(radius: number, colour: number, opacity: number) {
  const points = Array.from(
    { length: 97 },
    (_, i) => new THREE.Vector3(radius * Math.cos((i * Math.PI) / 48), radius * Math.sin((i * Math.PI) / 48), 0.0012),
  );
  return new THREE.Line(
    new THREE.BufferGeometry().setFromPoints(points),
    new THREE.LineBasicMaterial({ color: colour, transparent: true, opacity }),
  );
}
const disc = (radius: number, colour: number, opacity: number) =>
  new THREE.Mesh(
    new THREE.CircleGeometry(radius, 64),
    new THREE.MeshBasicMaterial({ color: colour, transparent: true, opacity, depthWrite: false }),
  ).translateZ(0.001);

/** Rings on the floor where a half, a quarter and an eighth arrive of what arrives below it; a lamp without
 * attenuation is as bright everywhere. */
export function lightMarks(t: Thing): THREE.Object3D[] {
  if (!t.on) return [];
  const z = t.position[2],
    [a, b, c] = t.attenuation!;
  const reaches = kLightSteps
    .map((share) => {
      // a + b d + c d2 is this many times what it is below
      const wanted = (a + b * z + c * z * z) / share;
      const d = c > 0 ? (-b + Math.sqrt(b * b - 4 * c * (a - wanted))) / (2 * c) : b > 0 ? (wanted - a) / b : Infinity;
      return Math.sqrt(Math.max(0, d * d - z * z));
    })
    .filter((r) => r > 0.005 && r < 20);
  const stem = new THREE.Line(
    new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(0, 0, 0), new THREE.Vector3(0, 0, z)]),
    new THREE.LineBasicMaterial({ color: kLight, transparent: true, opacity: 0.6 }),
  );
  return [stem, disc(reaches[0] ?? 0.12, 0xffd54a, 0.2), ...reaches.map((r, i) => ring(r, kLight, 0.9 - 0.25 * i))];
}

/** A small loudspeaker, and rings where 10, 20, 30 dB less arrive than at 1 m; each says its level by its distance. */
export function soundMarks(t: Thing, extent: number): THREE.Object3D[] {
  const rings: THREE.Object3D[] = [];
  for (let db = Math.floor((t.level! + 26) / kSoundStep) * kSoundStep; db >= 30; db -= kSoundStep) {
    const r = 10 ** ((t.level! - db) / 20);
    if (r > 0.03 && r < extent) rings.push(ring(r, kSound, Math.min(0.9, 0.25 + (db - 30) / 80)));
  }
  return rings;
}

/** What robots that sound have around them. */
export const soundingRing = () => new THREE.RingGeometry(0.045, 0.05, 40).translate(0, 0, 0.002);
export const soundingMaterial = () =>
  new THREE.MeshBasicMaterial({ color: kSound, transparent: true, opacity: 0.85, side: THREE.DoubleSide });

/** The pyramid that the picture of a camera covers, in its robot's frame. */
export function frustum(camera: CameraView): THREE.Object3D {
  const [left, right, low, high] = camera.edges,
    eye = new THREE.Vector3(...(camera.at as [number, number, number]));
  // forward x, left y, up z; tangents to the right are those of -y
  const corner = (side: number, up: number) =>
    new THREE.Vector3(kCameraReach, -side * kCameraReach, up * kCameraReach).add(eye);
  const corners = [corner(left, low), corner(right, low), corner(right, high), corner(left, high)];
  const lines = corners.flatMap((p, i) => [eye, p, p, corners[(i + 1) % 4]]),
    faces = corners.flatMap((p, i) => [eye, p, corners[(i + 1) % 4]]);
  return new THREE.Group().add(
    new THREE.LineSegments(
      new THREE.BufferGeometry().setFromPoints(lines),
      new THREE.LineBasicMaterial({ color: kCamera }),
    ),
    new THREE.Mesh(
      new THREE.BufferGeometry().setFromPoints(faces),
      new THREE.MeshBasicMaterial({
        color: kCamera,
        transparent: true,
        opacity: 0.12,
        side: THREE.DoubleSide,
        depthWrite: false,
      }),
    ),
  );
}
