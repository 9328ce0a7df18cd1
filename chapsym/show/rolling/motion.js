// The motion between the frames: what chapsym has computed, and the even rolling from one frame to the next.

import { Quaternion, Vector3 } from 'three';

const decoded = (text, Kind) => new Kind(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);
const vector = (array, i, into) => into.set(array[3 * i], array[3 * i + 1], array[3 * i + 2]);
const axis = new Vector3();
const turned = new Quaternion();

class Ball {
  constructor(data) {
    Object.assign(this, data);
    this.attitude = decoded(data.attitude, Float32Array);
    this.turn = data.turn && decoded(data.turn, Float32Array);
    this.contact = decoded(data.contact, Float64Array); // doubles: far from the origin, floats would jitter
    this.vectors = Object.fromEntries(Object.entries(data.vectors).map(([k, text]) => [k, decoded(text, Float32Array)]));
    this.frames = this.attitude.length / 4;
    this.largest = Object.fromEntries(Object.entries(this.vectors).map(([k, array]) => [k, longest(array)]));
  }

  // Frame and fraction, of a frame number that need not be whole; after its last frame the ball stands still.
  at(frame) {
    const i = Math.max(0, Math.min(Math.floor(frame), this.frames - 1));
    return [i, i < this.frames - 1 ? Math.max(0, frame - i) : 0];
  }

  // The contact point in metres, [x, y].  A ball that turns evenly rolls straight.
  position(frame) {
    const [i, s] = this.at(frame);
    const from = (k) => this.contact[2 * i + k];
    return [0, 1].map((k) => (s ? from(k) + s * (this.contact[2 * i + 2 + k] - from(k)) : from(k)));
  }

  // Body axes to space: even turning about one axis from frame to frame, with all whole turns.
  quaternion(frame, into = new Quaternion()) {
    const [i, s] = this.at(frame);
    const [w, x, y, z] = this.attitude.subarray(4 * i, 4 * i + 4);
    into.set(x, y, z, w);
    if (s && this.turn) {
      const angle = vector(this.turn, i, axis).length();
      if (angle) into.premultiply(turned.setFromAxisAngle(axis.divideScalar(angle), s * angle));
    }
    return into.normalize();
  }

  // A vector of the data in body axes.
  inBody(name, frame, into = new Vector3()) {
    const [i, s] = this.at(frame);
    vector(this.vectors[name], i, into);
    return s ? into.lerp(vector(this.vectors[name], i + 1, axis), s) : into;
  }

  // The same in space: there ω and 𝒦 change slowly, also where the ball turns fast.
  inSpace(name, frame, into = new Vector3()) {
    const [i, s] = this.at(frame);
    vector(this.vectors[name], i, into).applyQuaternion(this.quaternion(i, turned));
    if (!s) return into;
    vector(this.vectors[name], i + 1, axis).applyQuaternion(this.quaternion(i + 1, turned));
    return into.lerp(axis, s);
  }
}

function longest(array) {
  let found = 0;
  for (let i = 0; i < array.length; i += 3) found = Math.max(found, Math.hypot(array[i], array[i + 1], array[i + 2]));
  return found;
}

export class Motion {
  constructor(data) {
    this.unit = data.unit;
    this.clock = decoded(data.clock, Float64Array);
    this.balls = data.balls.map((ball) => new Ball(ball));
    this.start = this.clock[0];
    this.end = this.clock[this.clock.length - 1];
  }

  // The frame at a reading of the clock, with its fraction.
  frameAt(time) {
    const { clock } = this;
    let low = 0, high = clock.length - 1;
    if (time >= clock[high]) return high;
    if (time <= clock[0]) return 0;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (clock[middle] <= time) low = middle; else high = middle;
    }
    return low + (time - clock[low]) / (clock[high] - clock[low]);
  }

  timeAt(frame) {
    const i = Math.min(Math.floor(frame), this.clock.length - 1);
    return i < this.clock.length - 1 ? this.clock[i] + (frame - i) * (this.clock[i + 1] - this.clock[i]) : this.end;
  }
}
