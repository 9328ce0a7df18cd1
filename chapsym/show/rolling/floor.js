// The plane: a metric grid, the shadows of the balls, and the traces of their contact points.

import {
  Color, InstancedBufferAttribute, InstancedBufferGeometry, BufferAttribute, Group, Mesh, PlaneGeometry, ShaderMaterial,
  Vector2, Vector3, Vector4,
} from 'three';

const PIECE = 512; // segments that share an origin: near it, float32 is exact enough for any trace
const LIGHT = new Vector3(0.45, -0.35, 1).normalize();

export class Floor {
  constructor(count) {
    this.uniforms = {
      offset: { value: new Vector2() }, cell: { value: 1 }, reach: { value: 1 }, light: { value: LIGHT },
      paper: { value: new Color() }, line: { value: new Color() }, shade: { value: 0.5 },
      balls: { value: Array.from({ length: count }, () => new Vector4()) }, count: { value: 0 },
    };
    const material = new ShaderMaterial({
      uniforms: this.uniforms, depthWrite: false,
      vertexShader: `varying vec2 place;
        void main() {
          vec4 world = modelMatrix * vec4(position, 1.);
          place = world.xy;
          gl_Position = projectionMatrix * viewMatrix * world;
        }`,
      fragmentShader: `varying vec2 place;
        uniform vec2 offset; uniform float cell, reach, shade; uniform vec3 paper, line, light;
        uniform vec4 balls[${count}]; uniform int count;
        float grid(vec2 p) {
          vec2 wide = fwidth(p), to = abs(fract(p - .5) - .5) / wide;
          return (1. - min(min(to.x, to.y), 1.)) * (1. - smoothstep(.15, .5, max(wide.x, wide.y)));
        }
        // How much light the sphere takes: of the sun (soft, more so farther from the ball) and of the sky.
        float shadow(vec4 ball) {
          vec3 to = vec3(ball.xy - place, ball.z);
          float along = dot(to, light), beside = sqrt(max(dot(to, to) - along * along, 0.));
          float soft = .06 * abs(along) + .02 * ball.w;
          float sun = along > 0. ? 1. - smoothstep(ball.w - soft, ball.w + soft, beside) : 0.;
          float far = length(to), sky = to.z / far * (ball.w * ball.w) / (far * far);
          return 1. - (1. - .62 * sun) * (1. - .75 * sky);
        }
        void main() {
          vec2 p = (place + offset) / cell;
          vec3 colour = mix(paper, line, max(.4 * grid(p), .9 * grid(p / 10.)));
          float lit = 1.;
          for (int i = 0; i < ${count}; i++) if (i < count) lit = min(lit, 1. - shade * shadow(balls[i]));
          colour *= lit;
          gl_FragColor = vec4(mix(colour, paper, smoothstep(.3, 1., length(place) / reach)), 1.);
          #include <colorspace_fragment>
        }`,
    });
    this.mesh = new Mesh(new PlaneGeometry(2, 2), material);
    this.mesh.renderOrder = -3;
    this.mesh.frustumCulled = false;
  }

  // The spacing that suits a view of this size: 1, 10, 100 ... of a unit; a heavier line at every tenth.
  fit(distance, anchor) {
    const cell = 10 ** Math.floor(Math.log10(distance / 4));
    this.uniforms.cell.value = cell;
    this.uniforms.offset.value.set(...anchor.map((x) => x - Math.floor(x / (10 * cell)) * 10 * cell));
    this.uniforms.reach.value = 14 * distance;
    this.mesh.scale.setScalar(14 * distance);
    return cell;
  }

  cast(balls) {
    balls.forEach((ball, i) => this.uniforms.balls.value[i].copy(ball));
    this.uniforms.count.value = balls.length;
  }

  colours(paper, line, shade) {
    this.uniforms.paper.value.set(paper);
    this.uniforms.line.value.set(line);
    this.uniforms.shade.value = shade;
  }
}

// Lines of the same width everywhere, in pixels, painted on the plane: a rectangle for each segment.
function paint(colour, pixels) {
  return new ShaderMaterial({
    depthWrite: false,
    uniforms: { colour: { value: new Color(colour) }, pixels: { value: pixels }, perPixel: { value: 0 } },
    vertexShader: `attribute vec4 ends; uniform float pixels, perPixel;
      void main() {
        vec2 way = ends.zw - ends.xy, middle = mix(ends.xy, ends.zw, position.x);
        float far = length(way);
        vec2 along = far > 0. ? way / far : vec2(1., 0.);
        vec4 seen = projectionMatrix * modelViewMatrix * vec4(middle, 0., 1.);
        float half_ = .5 * pixels * perPixel * seen.w;
        middle += half_ * ((2. * position.x - 1.) * along + position.y * vec2(-along.y, along.x));
        gl_Position = projectionMatrix * modelViewMatrix * vec4(middle, 0., 1.);
      }`,
    fragmentShader: `uniform vec3 colour;
      void main() { gl_FragColor = vec4(colour, 1.);
        #include <colorspace_fragment>
      }`,
  });
}

function segments(ends) {
  const geometry = new InstancedBufferGeometry();
  geometry.setIndex([0, 1, 2, 2, 1, 3]);
  geometry.setAttribute('position', new BufferAttribute(new Float32Array([0, -1, 0, 1, -1, 0, 0, 1, 0, 1, 1, 0]), 3));
  geometry.setAttribute('ends', new InstancedBufferAttribute(ends, 4));
  return geometry;
}

function line(geometry, material, order) {
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = order;
  return mesh;
}

// The trace of one ball: all of it, faint, and what has been rolled so far.
export class Trace {
  constructor(ball) {
    this.ball = ball;
    this.materials = [paint('#888', 2), paint('#888', 4)];
    this.ghosts = new Group();
    this.group = new Group().add(this.ghosts);
    this.pieces = [];
    for (let first = 0; first < ball.frames - 1; first += PIECE) this.add(first);
    this.tip = line(segments(new Float32Array(4)), this.materials[1], -1);
    this.group.add(this.tip);
  }

  add(first) {
    const { contact, frames } = this.ball;
    const count = Math.min(PIECE, frames - 1 - first);
    const origin = [contact[2 * first], contact[2 * first + 1]];
    const ends = Float32Array.from({ length: 4 * count }, (_, k) => {
      const i = first + (k >> 2), end = (k >> 1) & 1;
      return contact[2 * (i + end) + (k & 1)] - origin[k & 1];
    });
    const whole = segments(ends), rolled = segments(ends);
    whole.instanceCount = count;
    const ghost = line(whole, this.materials[0], -2), solid = line(rolled, this.materials[1], -1);
    this.ghosts.add(ghost);
    this.group.add(solid);
    this.pieces.push({ first, count, origin, ghost, solid });
  }

  show(frame, anchor) {
    const [i, s] = this.ball.at(frame);
    for (const { first, count, origin, ghost, solid } of this.pieces) {
      const rolled = Math.max(0, Math.min(count, i - first));
      solid.geometry.instanceCount = rolled;
      solid.visible = rolled > 0;
      for (const mesh of [ghost, solid]) mesh.position.set(origin[0] - anchor[0], origin[1] - anchor[1], 0);
    }
    const ends = this.tip.geometry.getAttribute('ends');
    const from = this.ball.position(i), to = this.ball.position(i + s);
    ends.array.set([0, 0, to[0] - from[0], to[1] - from[1]]);
    ends.needsUpdate = true;
    this.tip.geometry.instanceCount = 1;
    this.tip.visible = s > 0;
    this.tip.position.set(from[0] - anchor[0], from[1] - anchor[1], 0);
  }

  style(colour, paper, perPixel) {
    this.materials[0].uniforms.colour.value.set(paper).lerp(new Color(colour), 0.5);
    this.materials[1].uniforms.colour.value.set(colour);
    for (const { uniforms } of this.materials) uniforms.perPixel.value = perPixel;
  }
}
