// The eye: dragging turns it about what it looks at, or moves it along the plane; wheel and two fingers bring it nearer.

import { MathUtils, Vector2, Vector3 } from 'three';

const HIGHEST = 1e-4, LOWEST = 1.52; // radians off the vertical: it stays above the plane, and knows which way is up
const GLIDE = 0.05; // the part of a turn that each picture takes, unless motion is unwelcome
const NOTCH = 0.95 ** 0.01; // of the wheel: the part of the distance that is left
const PIXELS = [1, 16, 100]; // in which wheels count: pixels, lines, pages

export class Eye {
  // `changed` is called when something else is seen.
  constructor(camera, canvas, calm, changed) {
    Object.assign(this, { camera, canvas, changed, share: calm ? 1 : GLIDE });
    this.anchor = [0, 0]; // the point of the plane below what it looks at, in metres: the camera's place is relative to it
    this.centre = new Vector3();
    this.fixed = false; // whether dragging moves it, and does not turn it
    this.turn = new Vector2(); // what is left of a turn, in radians
    this.pressed = new Map(); // where the mouse or the fingers are, by their ids
    canvas.addEventListener('pointerdown', (event) => this.press(event));
    canvas.addEventListener('pointermove', (event) => this.drag(event));
    for (const end of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(end, (event) => this.pressed.delete(event.pointerId));
    }
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault(); // the page does not scroll; fingers on a touchpad come as a wheel with the control key
      this.approach(NOTCH ** (-event.deltaY * PIXELS[event.deltaMode] * (event.ctrlKey ? 10 : 1)));
    }, { passive: false });
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  // Looks at a point so high above the anchor, from a direction and a distance, which stays between the limits.
  look(height, direction, distance, limits) {
    this.centre.set(0, 0, height);
    this.limits = limits;
    this.azimuth = Math.atan2(direction.y, direction.x);
    this.polar = Math.atan2(Math.hypot(direction.x, direction.y), direction.z);
    this.turn.set(0, 0);
    this.distance = distance;
    this.approach(1);
  }

  approach(factor) {
    this.distance = MathUtils.clamp(this.distance * factor, ...this.limits);
    this.place();
  }

  // Takes the next part of a turn, for each picture.
  glide() {
    if (this.turn.length() < 1e-5) return;
    this.azimuth -= this.share * this.turn.x;
    this.polar = MathUtils.clamp(this.polar - this.share * this.turn.y, HIGHEST, LOWEST);
    this.turn.multiplyScalar(1 - this.share);
    this.place();
  }

  place() {
    const { azimuth, polar, camera } = this;
    const level = Math.sin(polar);
    camera.position.set(level * Math.cos(azimuth), level * Math.sin(azimuth), Math.cos(polar));
    camera.position.multiplyScalar(this.distance).add(this.centre);
    camera.lookAt(this.centre);
    this.changed();
  }

  press(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.pressed.set(event.pointerId, new Vector2(event.clientX, event.clientY));
    this.moves = this.fixed || event.button > 0 || event.ctrlKey || event.metaKey || event.shiftKey;
  }

  drag(event) {
    if (!this.pressed.has(event.pointerId)) return;
    const before = this.grip();
    this.pressed.set(event.pointerId, new Vector2(event.clientX, event.clientY));
    const after = this.grip();
    const way = after.middle.sub(before.middle).divideScalar(this.canvas.clientHeight);
    if (this.moves || after.gap) this.move(way);
    else this.turn.addScaledVector(way, 2 * Math.PI);
    if (after.gap) this.approach(before.gap / after.gap);
  }

  // The middle of the fingers, and how far two of them are apart.
  grip() {
    const [first, second = first] = this.pressed.values();
    return { middle: first.clone().lerp(second, 0.5), gap: first.distanceTo(second) };
  }

  // Moves along the plane, so that it follows the hand: by parts of the height of the window.
  move(way) {
    const seen = 2 * this.distance * Math.tan(MathUtils.degToRad(this.camera.fov / 2));
    const sine = Math.sin(this.azimuth), cosine = Math.cos(this.azimuth);
    this.anchor = [
      this.anchor[0] + seen * (way.x * sine - way.y * cosine), this.anchor[1] - seen * (way.x * cosine + way.y * sine),
    ];
    this.changed();
  }
}
