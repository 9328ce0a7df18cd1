// The scene.  Everything is drawn relative to the anchor of the eye, a point of the plane, in doubles: so nothing jitters,
// however far the balls have rolled.

import {
  AmbientLight, BufferAttribute, BufferGeometry, CanvasTexture, Color, DirectionalLight, PerspectiveCamera, Points,
  PointsMaterial, Scene, Vector3, Vector4, WebGLRenderer,
} from 'three';
import { pattern, RollingBall, sphereFor } from 'ball';
import { Eye } from 'eye';
import { Floor, Trace } from 'floor';

const OKABE_ITO = ['#1f83c6', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];
const VIEW = 38; // degrees

export const colourOf = (i, count) =>
  count <= OKABE_ITO.length ? OKABE_ITO[i] : `hsl(${(205 + 360 * i / count) % 360}, 65%, ${i % 2 ? 38 : 55}%)`;

export class Stage {
  constructor(canvas, motion, calm) {
    this.motion = motion;
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(VIEW, 1, 0.1, 100);
    this.camera.up.set(0, 0, 1);
    this.eye = new Eye(this.camera, canvas, calm, () => { this.stale = true; });
    this.sun = new DirectionalLight('#fff', 2.4);
    this.sun.position.set(0.45, -0.35, 1);
    this.sky = new AmbientLight('#fff');
    this.floor = new Floor(motion.balls.length);
    this.scene.add(this.sun, this.sky, this.floor.mesh);
    const texture = pattern(), sphere = sphereFor(motion.balls.length);
    this.colours = motion.balls.map((_, i) => colourOf(i, motion.balls.length));
    this.balls = motion.balls.map((ball, i) => new RollingBall(ball, this.colours[i], texture, sphere, i));
    this.traces = motion.balls.map((ball) => new Trace(ball));
    this.dots = dots(this.colours);
    for (const part of [...this.balls, ...this.traces]) this.scene.add(part.group);
    this.scene.add(this.dots);
    this.followed = 0;
    this.frame = 0;
    this.extent = extent(motion.balls);
    this.look('follow');
  }

  get anchor() { return this.eye.anchor; }

  // Follow a ball, orbit freely, or see all of it from above.
  look(mode, keep = false) {
    this.mode = mode;
    this.eye.fixed = mode === 'top';
    if (!keep) this.reset();
  }

  reset() {
    const { radius } = this.motion.balls[this.followed], { aspect } = this.camera;
    const { middle, size } = this.extent, far = 4 * Math.max(...size) + 60 * radius;
    // What must be seen, in metres, at the narrower side of the window, and how far away that is.
    const away = (wide) => wide / 2 / Math.tan(VIEW * Math.PI / 360);
    if (this.mode === 'top') {
      this.eye.anchor = middle;
      const wide = 1.15 * Math.max(size[1], size[0] / aspect, 6 * radius);
      this.eye.look(0, new Vector3(0, -1e-4, 1), away(wide), [1.3 * radius, far]);
    } else {
      this.eye.anchor = this.motion.balls[this.followed].position(this.frame);
      this.eye.look(radius, new Vector3(-0.55, -1, 0.62), away(6.5 * radius) / Math.min(1, aspect), [1.3 * radius, far]);
    }
  }

  follow(i) { this.followed = i; this.reset(); }

  resize(width, height, ratio) {
    const before = this.camera.aspect;
    this.renderer.setPixelRatio(Math.min(ratio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.perPixel = 2 * Math.tan(VIEW * Math.PI / 360) / height;
    if (before !== this.camera.aspect) this.reset();
    this.restyle();
  }

  restyle() {
    this.traces.forEach((trace, i) => trace.style(this.colours[i], this.paper, this.perPixel));
    this.stale = true;
  }

  // The colours of the page, light or dark.
  colour(paper, line, dark) {
    this.paper = paper;
    this.scene.background = new Color(paper);
    this.floor.colours(paper, line, dark ? 0.75 : 0.5);
    this.sky.intensity = dark ? 1.1 : 1.5;
    this.restyle();
  }

  seek(frame) {
    if (this.mode === 'follow') {
      const ball = this.motion.balls[this.followed];
      const from = ball.position(this.frame), to = ball.position(frame);
      this.eye.anchor = this.anchor.map((x, k) => x + to[k] - from[k]);
    }
    this.frame = frame;
    this.stale = true;
  }

  showArrow(name, on) { for (const { arrows } of this.balls) if (arrows[name]) arrows[name].visible = on; }

  showGhost(on) { for (const { ghosts } of this.traces) ghosts.visible = on; }

  showEllipsoid(on) { for (const ball of this.balls) ball.showEllipsoid(on); }

  showBall(i, on) { this.balls[i].group.visible = this.traces[i].group.visible = on; }

  // Draws if anything has changed; returns the spacing of the grid in metres.
  draw() {
    this.eye.glide();
    if (!this.stale) return this.cell;
    this.stale = false;
    const { distance } = this.eye;
    this.camera.near = distance / 200;
    this.camera.far = distance * 60;
    this.camera.updateProjectionMatrix();
    this.cell = this.floor.fit(distance, this.anchor);
    const at = this.dots.geometry.getAttribute('position');
    const shadows = [];
    this.balls.forEach((one, i) => {
      one.show(this.frame, this.anchor);
      this.traces[i].show(this.frame, this.anchor);
      const { x, y } = one.group.position, { radius } = one.ball;
      const shown = one.group.visible;
      at.setXYZ(i, x, y, shown ? radius : -1e9);
      if (shown) shadows.push(new Vector4(x, y, radius, radius));
    });
    at.needsUpdate = true;
    this.floor.cast(shadows);
    this.renderer.render(this.scene, this.camera);
    return this.cell;
  }
}

// The rectangle of the plane in which all balls roll.
function extent(balls) {
  const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (const { contact, radius } of balls) {
    contact.forEach((x, i) => {
      low[i & 1] = Math.min(low[i & 1], x - radius);
      high[i & 1] = Math.max(high[i & 1], x + radius);
    });
  }
  return { middle: low.map((x, k) => (x + high[k]) / 2), size: low.map((x, k) => high[k] - x) };
}

// A dot for each ball, of the same size at any distance: a small ball far away can still be found.  Drawn before the balls.
function dots(colours) {
  const canvas = Object.assign(document.createElement('canvas'), { width: 32, height: 32 });
  const context = canvas.getContext('2d');
  context.fillStyle = '#fff';
  context.arc(16, 16, 15, 0, 2 * Math.PI);
  context.fill();
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(3 * colours.length), 3));
  const parts = colours.flatMap((colour) => new Color(colour).toArray());
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(parts), 3));
  const material = new PointsMaterial({
    size: 9 * Math.min(devicePixelRatio, 2), sizeAttenuation: false, vertexColors: true, map: new CanvasTexture(canvas),
    alphaTest: 0.5, depthTest: false, depthWrite: false,
  });
  const points = new Points(geometry, material);
  points.frustumCulled = false;
  points.renderOrder = -0.5;
  return points;
}
