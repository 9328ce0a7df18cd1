// A ball whose rotation can be seen: octants in two shades, great circles between them, the axes numbered.

import {
  CanvasTexture, Color, ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, MeshStandardMaterial, Quaternion,
  SphereGeometry, SRGBColorSpace, Vector3,
} from 'three';

const WIDTH = 1536, HEIGHT = 768; // pixels of the pattern, around and from pole to pole
const MARK = 0.25; // radius of the mark at the end of an axis, in radians
const LINE = 0.016; // half the width of a great circle
const AXES = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
const UP = new Vector3(0, 1, 0); // of three's cylinders and cones

// Grey values, which the colour of the ball tints; made once for all balls.
export function pattern() {
  const canvas = Object.assign(document.createElement('canvas'), { width: WIDTH, height: HEIGHT });
  const context = canvas.getContext('2d');
  const image = context.createImageData(WIDTH, HEIGHT);
  const digits = numerals(128);
  const soft = 1.5 * Math.PI / HEIGHT;
  const turns = Array.from({ length: WIDTH }, (_, column) => (column + 0.5) / WIDTH * 2 * Math.PI);
  const cosines = turns.map(Math.cos), sines = turns.map(Math.sin);
  const shades = new Uint32Array(image.data.buffer);
  for (let row = 0, k = 0; row < HEIGHT; row++) {
    const theta = (row + 0.5) / HEIGHT * Math.PI, sine = Math.sin(theta), z = Math.cos(theta);
    for (let column = 0; column < WIDTH; column++, k++) {
      // Where three's sphere has this pixel, its pole turned to z.
      const shade = Math.round(shadeAt(-cosines[column] * sine, -sines[column] * sine, z, digits, soft));
      shades[k] = 0xff000000 | shade * 0x10101;
    }
  }
  context.putImageData(image, 0, 0);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 8;
  return texture;
}

// Plain numbers, no arrays: a million pixels are made while a reader waits.
function shadeAt(x, y, z, digits, soft) {
  const X = Math.abs(x), Y = Math.abs(y), Z = Math.abs(z), largest = Math.max(X, Y, Z);
  const a = X === largest ? 0 : Y === largest ? 1 : 2;
  const sign = Math.sign(a === 0 ? x : a === 1 ? y : z);
  const u = sign * (a === 0 ? y : a === 1 ? z : x), v = a === 0 ? z : a === 1 ? x : y;
  const away = Math.sqrt(u * u + v * v) / MARK;
  if (away < 1) {
    const digit = digits(a, u / MARK, v / MARK);
    return sign > 0 ? 30 + 225 * digit : 255 - 225 * Math.max(digit, away > 0.88 ? 1 : 0);
  }
  const octant = x * y * z > 0 ? 255 : 150;
  const distance = Math.asin(Math.min(X, Y, Z));
  const line = Math.min(1, Math.max(0, (LINE + soft / 2 - distance) / soft));
  return octant + line * (45 - octant);
}

// The numbers 1, 2, 3: how much ink there is at (u, v) in the unit square around an axis.
function numerals(size) {
  const canvas = Object.assign(document.createElement('canvas'), { width: 3 * size, height: size });
  const context = canvas.getContext('2d', { willReadFrequently: true });
  context.font = `bold ${0.8 * size}px system-ui, sans-serif`;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  ['1', '2', '3'].forEach((text, i) => context.fillText(text, (i + 0.5) * size, 0.54 * size));
  const { data } = context.getImageData(0, 0, 3 * size, size);
  return (i, u, v) => {
    const x = Math.floor((u + 1) / 2 * size), y = Math.floor((1 - v) / 2 * size);
    return data[4 * (y * 3 * size + i * size + x) + 3] / 255;
  };
}

// The unit sphere for `count` balls, rounder for a few; its pole is turned to z, as the pattern has it.
export function sphereFor(count) {
  return new SphereGeometry(1, ...(count > 4 ? [48, 32] : [96, 64])).rotateX(Math.PI / 2);
}

// A ball, its arrows and its ellipsoid; `show` puts them where they are at a frame, relative to the anchor.
export class RollingBall {
  constructor(ball, colour, texture, sphere, order) {
    this.ball = ball;
    this.group = new Group();
    this.body = new Group();
    this.body.position.z = ball.radius;
    this.body.scale.setScalar(ball.radius);
    this.group.add(this.body);
    // Balls that start at the same place: the first is drawn in front of the others, always.
    const offset = { polygonOffset: true, polygonOffsetUnits: 4 * order, polygonOffsetFactor: 0 };
    this.material = new MeshStandardMaterial({ map: texture, color: colour, roughness: 0.5, ...offset });
    this.body.add(new Mesh(sphere, this.material));
    this.arrows = {};
    for (const name of Object.keys(ball.vectors)) {
      this.arrows[name] = arrow(name);
      this.arrows[name].visible = false;
      this.arrows[name].position.z = ball.radius;
      this.group.add(this.arrows[name]);
    }
    if (ball.inertia) this.body.add(this.ellipsoid = inertiaEllipsoid(ball.inertia, ball.axes));
  }

  show(frame, anchor) {
    const [x, y] = this.ball.position(frame);
    this.group.position.set(x - anchor[0], y - anchor[1], 0);
    this.ball.quaternion(frame, this.body.quaternion);
    for (const [name, one] of Object.entries(this.arrows)) {
      if (one.visible) point(one, this.ball.inSpace(name, frame, scratch), this.ball.largest[name], this.ball.radius);
    }
  }

  showEllipsoid(on) {
    if (!this.ellipsoid) return;
    this.ellipsoid.visible = on;
    Object.assign(this.material, { transparent: on, opacity: on ? 0.3 : 1, depthWrite: !on, needsUpdate: true });
  }
}

const ARROWS = { gamma: '#009e73', omega: '#e07b00', momentum: '#b8479a' };
const scratch = new Vector3();

function arrow(name) {
  const material = new MeshBasicMaterial({ color: new Color(ARROWS[name]) });
  const shaft = new Mesh(new CylinderGeometry(0.028, 0.028, 1, 16).translate(0, 0.5, 0), material);
  const head = new Mesh(new ConeGeometry(0.09, 0.26, 24).translate(0, -0.13, 0), material);
  const one = new Group().add(shaft, head);
  one.userData = { shaft, head };
  return one;
}

// Points an arrow along v; the longest of the run is 2 radii long.
function point(one, v, largest, radius) {
  const length = largest ? v.length() / largest * 2 : 0;
  one.scale.setScalar(radius);
  one.userData.shaft.scale.y = Math.max(length - 0.2, 1e-6);
  one.userData.head.position.y = length;
  one.userData.head.visible = one.userData.shaft.visible = length > 0.25;
  if (length) one.quaternion.setFromUnitVectors(UP, v.normalize());
}

// The surface on which the kinetic energy of turning is the same: its semi-axes are as 1/√I, along the principal axes.
function inertiaEllipsoid(inertia, axes) {
  const most = Math.max(...inertia);
  const semi = inertia.map((I) => 1 / Math.sqrt(Math.max(I, 1e-3 * most)));
  const scale = 0.92 / Math.max(...semi);
  const group = new Group();
  if (axes) group.quaternion.set(axes[1], axes[2], axes[3], axes[0]);
  const material = new MeshStandardMaterial({ color: '#dde2e6', roughness: 0.7 });
  const surface = new Mesh(new SphereGeometry(1, 64, 48), material);
  surface.scale.set(...semi.map((a) => a * scale));
  group.add(surface);
  AXES.forEach((axis, i) => {
    const rod = new Mesh(new CylinderGeometry(0.014, 0.014, 2.5, 12), new MeshBasicMaterial({ color: '#888' }));
    rod.quaternion.copy(new Quaternion().setFromUnitVectors(UP, axis));
    group.add(rod);
  });
  group.visible = false;
  return group;
}
