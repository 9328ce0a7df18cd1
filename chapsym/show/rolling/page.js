// The page: clock, controls and readout.  The motion is in motion.js, what is drawn in stage.js.

import { Motion } from 'motion';
import { colourOf, Stage } from 'stage';

const find = (selector) => document.querySelector(selector);
const every = (selector, act) => document.querySelectorAll(selector).forEach(act);
const canvas = find('canvas'), scrub = find('#scrub'), play = find('#play'), help = find('dialog');
const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
const dark = matchMedia('(prefers-color-scheme: dark)');

const motion = new Motion(JSON.parse(find('#data').textContent));
const length = motion.end - motion.start;
let stage = null, time = motion.start, playing = false, last = 0;

// Real time if a run can be watched in it; otherwise so fast that it takes about 20 seconds.
let speed = motion.unit === 's' && length > 3 && length < 90 ? 0 : Math.round(Math.log2(length / 20 || 1));

// --- what is told ---

const digits = (x, least) => (least < 1e-12 || least > 1e6 ? x.toExponential(2)
  : x.toFixed(Math.max(0, -Math.floor(Math.log10(least))))).replaceAll('-', '−');
const significant = (x) => Number(x.toPrecision(4)).toString().replace('-', '−');
const reading = (t) => motion.unit === 's' ? `${digits(t, length / 1000 || 1)} s` : `step ${Math.round(t)}`;

function pace() {
  if (motion.unit !== 's') return `${significant(2 ** speed)} steps/s`;
  return speed < 0 ? `×1/${2 ** -speed}` : `×${2 ** speed}`;
}

function metres(x) {
  const unit = [[1e-6, 'µm'], [1e-3, 'mm'], [0.01, 'cm'], [1, 'm'], [1000, 'km']].findLast(([size]) => x >= 0.999 * size);
  return unit ? `${significant(x / unit[0])} ${unit[1]}` : `${x.toPrecision(2)} m`;
}

function tell() {
  const ball = motion.balls[stage ? stage.followed : 0], frame = motion.frameAt(time);
  const least = ball.radius / 100;
  const [x, y] = ball.position(frame).map((v) => digits(v, least));
  write('time', `${reading(time)}${motion.unit === 's' ? '' : ` of ${motion.end}`}`);
  write('position', `${x}, ${y} m`);
  if (ball.vectors.omega) {
    const omega = ball.inBody('omega', frame), step = (ball.largest.omega || 1) / 500;
    const over = ball.stops && frame > ball.frames - 1; // nothing is known of it any more
    write('speed', over ? 'stopped' : `${digits(omega.length(), step)} rad/s`);
    write('omega', over ? '—' : omega.toArray().map((v) => digits(v, step)).join(', ') + ' rad/s');
  }
  find('#now').textContent = motion.unit === 's' ? `${digits(time, length / 1000 || 1)} / ${reading(motion.end)}`
    : `${Math.round(time)} / ${motion.end}`;
  scrub.value = time;
  scrub.style.setProperty('--played', `${length ? 100 * (time - motion.start) / length : 0}%`);
  scrub.setAttribute('aria-valuetext', reading(time));
  every('.balls em', (mark, i) => {
    mark.hidden = !(motion.balls[i].stops && frame >= motion.balls[i].frames - 1);
  });
}

function write(name, text) {
  const place = find(`[data-read=${name}]`);
  if (place && place.textContent !== text) place.textContent = text;
}

// --- the clock ---

function seek(to) {
  time = Math.max(motion.start, Math.min(motion.end, to));
  if (stage) stage.seek(motion.frameAt(time));
  tell();
}

function setPlaying(on) {
  playing = on && length > 0;
  if (playing && time >= motion.end) seek(motion.start);
  play.setAttribute('aria-label', playing ? 'Pause' : 'Play');
}

function setSpeed(to) {
  speed = Math.max(-20, Math.min(30, to));
  find('#speed').textContent = pace();
}

function tick(now) {
  const passed = Math.min(now - last, 100) / 1000; // a page that was hidden goes on where it was
  last = now;
  if (playing) {
    seek(time + passed * 2 ** speed);
    if (time >= motion.end) setPlaying(false);
  }
  const cell = stage.draw();
  const told = `grid ${metres(cell)}`;
  const scale = find('.scale output');
  if (scale.textContent !== told) scale.textContent = told;
  requestAnimationFrame(tick);
}

// --- the controls ---

function look(mode) {
  stage.look(mode, mode === 'free');
  every('[data-look]', (button) => button.setAttribute('aria-pressed', button.dataset.look === mode));
}

function toggle(button, act) {
  button.addEventListener('click', () => {
    const on = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', on);
    act(on);
    stage.stale = true;
  });
}

const hop = (event, way) => {
  if (!event.shiftKey) return seek(time + way * length / 100);
  const frame = motion.frameAt(time);
  return seek(motion.timeAt(way > 0 ? Math.floor(frame + 1) : Math.max(0, Math.ceil(frame - 1))));
};

const KEYS = {
  ' ': () => setPlaying(!playing),
  ArrowLeft: (event) => hop(event, -1),
  ArrowRight: (event) => hop(event, 1),
  Home: () => seek(motion.start),
  End: () => seek(motion.end),
  '+': () => setSpeed(speed + 1),
  '=': () => setSpeed(speed + 1),
  '-': () => setSpeed(speed - 1),
  f: () => look('follow'),
  t: () => look('top'),
  o: () => look('free'),
  r: () => stage.reset(),
  '?': () => help.showModal(),
};

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || help.open) return;
  const act = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  // Elements keep the keys that are theirs: space on a button, arrows in a list of balls.
  const own = event.target.closest('button, summary, input:not([type=range])');
  if (!act || own && (event.key === ' ' || event.key.startsWith('Arrow'))) return;
  event.preventDefault();
  act(event);
}

function connect() {
  play.addEventListener('click', () => setPlaying(!playing));
  scrub.addEventListener('input', () => seek(Number(scrub.value)));
  find('#slower').addEventListener('click', () => setSpeed(speed - 1));
  find('#faster').addEventListener('click', () => setSpeed(speed + 1));
  find('#reset').addEventListener('click', () => stage.reset());
  find('#help').addEventListener('click', () => help.showModal());
  every('[data-look]', (button) => button.addEventListener('click', () => look(button.dataset.look)));
  every('[data-arrow]', (button) => toggle(button, (on) => stage.showArrow(button.dataset.arrow, on)));
  every('#ghost', (button) => toggle(button, (on) => stage.showGhost(on)));
  every('#ellipsoid', (button) => toggle(button, (on) => stage.showEllipsoid(on)));
  every('[name=followed]', (input) => input.addEventListener('change', () => { stage.follow(Number(input.value)); tell(); }));
  every('.seen input', (input) => input.addEventListener('change', () => {
    stage.showBall(Number(input.value), input.checked);
    stage.stale = true;
  }));
  document.addEventListener('keydown', onKey);
}

// --- the stage ---

function trouble(text) {
  find('.trouble').textContent = text;
  find('.trouble').hidden = !text;
}

function colours() {
  const style = getComputedStyle(document.documentElement);
  const plane = style.getPropertyValue('--plane').trim(), grid = style.getPropertyValue('--grid').trim();
  stage.colour(plane, grid, dark.matches);
}

function begin() {
  if (innerWidth < 768) find('.balls').open = false;
  every('.balls i', (mark, i) => mark.style.setProperty('--c', colourOf(i, motion.balls.length)));
  Object.assign(scrub, { min: motion.start, max: motion.end, disabled: !length });
  play.disabled = !length;
  setSpeed(speed);
  tell();
  try {
    stage = new Stage(canvas, motion, calm);
  } catch {
    trouble('This page draws with WebGL, which this browser does not offer: turn on hardware acceleration, or try another browser.');
    return;
  }
  canvas.addEventListener('webglcontextlost', () => { // three asks for it back
    trouble('The browser has taken the graphics away from this page; the picture returns when it gives them back, or reload.');
  });
  canvas.addEventListener('webglcontextrestored', () => { trouble(''); stage.stale = true; });
  new ResizeObserver(([{ contentRect: { width, height } }]) => {
    if (width && height) stage.resize(width, height, devicePixelRatio);
  }).observe(canvas);
  dark.addEventListener('change', colours);
  connect();
  find('.scale').hidden = false;
  colours();
  stage.resize(canvas.clientWidth || 1, canvas.clientHeight || 1, devicePixelRatio);
  setPlaying(!calm);
  requestAnimationFrame((now) => { last = now; tick(now); });
}

// For tests and the curious: the frame that is shown, and what is drawn at any frame (scalar first; of ball `b`).
window.chapsym = {
  get frame() { return motion.frameAt(time); },
  get playing() { return playing; },
  get stage() { return stage; },
  motion,
  seek: (frame) => seek(motion.timeAt(frame)),
  position: (i, b = 0) => motion.balls[b].position(i),
  quaternion: (i, b = 0) => { const { w, x, y, z } = motion.balls[b].quaternion(i); return [w, x, y, z]; },
};

begin();
