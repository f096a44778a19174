// The interactive view of the report: bodies of a run in 3-D, through time, coloured by a field.
// scripts/bundle-viewer makes view.js of this file and three.js; the page then needs nothing from outside.
//
// A page holds <div class="view3d"> with a <script type="application/json"> in it, written by sazare/view3d.py:
//   kind "triangles" or "points"; times [s]; fields [{name, unit, low, high}]; colors (256 of "#rrggbb"); up axis;
//   blocks {name: {type, count, data}}, data base64 of zlib: start (3 per vertex), cell (per vertex) and index (3 per triangle), or radius (per point),
//   displacement (3 per vertex and time, 0..65535 of low..high), field<n> (per cell and time, 0..255 of low..high).

import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, HemisphereLight, Mesh, MeshLambertMaterial,
  OrthographicCamera, Points, Scene, ShaderMaterial, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const NUMBERS = { float32: Float32Array, uint16: Uint16Array, uint8: Uint8Array, uint32: Uint32Array };

async function numbers(block) {
  const bytes = Uint8Array.from(atob(block.data), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new NUMBERS[block.type](await new Response(stream).arrayBuffer());
}

async function unpack(blocks) {
  const names = Object.keys(blocks);
  const arrays = await Promise.all(names.map((name) => numbers(blocks[name])));
  return Object.fromEntries(names.map((name, place) => [name, arrays[place]]));
}

// Each point is drawn as a lit ball; balls of the plane, seen from the front, stay balls.
const ballMaterial = () => new ShaderMaterial({
  uniforms: { pixels: { value: 1 } },
  vertexShader: `
    attribute float radius; attribute vec3 color; varying vec3 tone; uniform float pixels;
    void main() {
      tone = color;
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      gl_PointSize = max(2.0 * radius * projectionMatrix[1][1] * pixels, 1.5);
    }`,
  fragmentShader: `
    varying vec3 tone;
    void main() {
      vec2 at = 2.0 * gl_PointCoord - 1.0;
      float square = dot(at, at);
      if (square > 1.0) discard;
      vec3 normal = vec3(at.x, -at.y, sqrt(1.0 - square));
      float light = 0.55 + 0.45 * max(dot(normal, normalize(vec3(-0.4, 0.6, 0.7))), 0.0);
      gl_FragColor = vec4(tone * light, 1.0);
      #include <colorspace_fragment>
    }`,
});

function element(parent, tag, properties = {}) {
  const made = Object.assign(document.createElement(tag), properties);
  parent.append(made);
  return made;
}

const short = (value) => (Math.abs(value) >= 1e4 || (value !== 0 && Math.abs(value) < 1e-2) ? value.toExponential(2) : String(Number(value.toPrecision(3))));

class View {
  constructor(box, data, arrays) {
    Object.assign(this, { box, data, arrays, moment: data.times.length - 1, field: 0, enlarged: data.enlargement });
    this.vertices = arrays.start.length / 3;
    this.cells = arrays.cell ? data.cells : this.vertices;
    this.palette = data.colors.map((text) => new Color(text));
    this.draw = this.draw.bind(this);
    this.makeScene();
    this.makeControls();
    this.readAddress();
    this.update();
    new ResizeObserver(() => this.resize()).observe(this.box);
    this.resize();
    box.dataset.state = "ready";
  }

  makeScene() {
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setClearColor(0xffffff);
    this.box.append(this.renderer.domElement);
    this.scene = new Scene();
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * this.vertices), 3));
    this.geometry.setAttribute("color", new BufferAttribute(new Float32Array(3 * this.vertices), 3));
    if (this.data.kind === "points") {
      this.geometry.setAttribute("radius", new BufferAttribute(this.arrays.radius, 1));
      this.material = ballMaterial();
      this.bodies = new Points(this.geometry, this.material);
    } else {
      this.material = new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, flatShading: true });
      this.bodies = new Mesh(this.geometry, this.material);
    }
    if (this.arrays.index) this.geometry.setIndex(new BufferAttribute(this.arrays.index, 1));
    this.bodies.frustumCulled = false;
    this.scene.add(this.bodies, new HemisphereLight(0xffffff, 0xb8b0a4, 2.2));
    this.camera = new OrthographicCamera(-1, 1, 1, -1, -100, 100);
    const lamp = new DirectionalLight(0xffffff, 1.2);
    lamp.position.set(-1, 1.5, 2);
    this.camera.add(lamp);
    this.scene.add(this.camera);
    this.center = new Vector3(...this.data.center);
    this.camera.up.set(...this.data.up);
    this.camera.position.copy(this.center).addScaledVector(new Vector3(...this.data.from), 3 * this.data.size);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.target.copy(this.center);
    this.controls.addEventListener("change", this.draw);
    this.controls.update();
  }

  makeControls() {
    const bar = element(this.box, "div", { className: "view3d-bar" });
    this.play = element(bar, "button", { type: "button", textContent: "▶", title: "play" });
    this.slider = element(bar, "input", { type: "range", min: 0, max: this.data.times.length - 1, value: this.moment });
    this.slider.setAttribute("aria-label", "time");
    this.clock = element(bar, "span", { className: "view3d-clock" });
    this.choice = element(bar, "select");
    this.choice.setAttribute("aria-label", "colour by");
    for (const [number, field] of this.data.fields.entries()) element(this.choice, "option", { value: number, textContent: field.name });
    this.legend = element(bar, "span", { className: "view3d-legend" });
    const enlarge = element(bar, "label", { textContent: "magnified " });
    this.factor = element(enlarge, "select");
    for (const factor of this.data.enlargements) element(this.factor, "option", { value: factor, textContent: `× ${factor}` });
    this.factor.value = this.enlarged;
    enlarge.hidden = this.data.enlargements.length < 2;
    this.slider.addEventListener("input", () => this.show({ moment: Number(this.slider.value) }));
    this.choice.addEventListener("change", () => this.show({ field: Number(this.choice.value) }));
    this.factor.addEventListener("change", () => this.show({ enlarged: Number(this.factor.value) }));
    this.play.addEventListener("click", () => this.toggle());
  }

  // report.html#view=moment,field begins there; for links to a moment, and for tests.
  readAddress() {
    const found = /#view=(\d+),(\d+)/.exec(location.hash);
    if (!found) return;
    this.moment = Math.min(Number(found[1]), this.data.times.length - 1);
    this.field = Math.min(Number(found[2]), this.data.fields.length - 1);
  }

  show(change) {
    Object.assign(this, change);
    this.update();
    this.draw();
  }

  toggle() {
    if (this.timer) {
      clearInterval(this.timer);
      this.timer = null;
    } else {
      this.timer = setInterval(() => this.show({ moment: (this.moment + 1) % this.data.times.length }), 250);
    }
    this.play.textContent = this.timer ? "❚❚" : "▶";
  }

  update() {
    this.move();
    this.paint();
    this.slider.value = this.moment;
    this.choice.value = this.field;
    this.clock.textContent = `${short(this.data.times[this.moment])} s`;
    const field = this.data.fields[this.field];
    const ramp = this.data.colors.filter((_, place) => place % 32 === 0 || place === 255).join(", ");
    this.legend.innerHTML = "";
    element(this.legend, "span", { textContent: short(field.low) });
    element(this.legend, "i").style.background = `linear-gradient(90deg, ${ramp})`;
    element(this.legend, "span", { textContent: `${short(field.high)} ${field.unit}` });
  }

  move() {
    const { start, displacement } = this.arrays;
    const { low, high } = this.data.displacement;
    const scale = this.enlarged * (high - low) / 65535, offset = this.enlarged * low, first = 3 * this.vertices * this.moment;
    const place = this.geometry.attributes.position;
    for (let i = 0; i < 3 * this.vertices; ++i) place.array[i] = start[i] + offset + scale * displacement[first + i];
    place.needsUpdate = true;
  }

  paint() {
    const values = this.arrays[`field${this.field}`], cell = this.arrays.cell, first = this.cells * this.moment;
    const color = this.geometry.attributes.color;
    for (let i = 0; i < this.vertices; ++i) this.palette[values[first + (cell ? cell[i] : i)]].toArray(color.array, 3 * i);
    color.needsUpdate = true;
  }

  resize() {
    const width = this.box.clientWidth, height = Math.round(Math.min(0.62 * width, 620));
    if (width === 0) return;
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(width, height);
    const half = 0.5 * Math.max(this.data.view[1], this.data.view[0] * height / width) * 1.08, aspect = width / height;
    Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half, near: -10 * this.data.size, far: 10 * this.data.size });
    this.camera.updateProjectionMatrix();
    if (this.material.uniforms) this.material.uniforms.pixels.value = 0.5 * height * window.devicePixelRatio;
    this.draw();
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
  }
}

async function begin(box) {
  const data = JSON.parse(box.querySelector("script").textContent);
  try {
    new View(box, data, await unpack(data.blocks));
  } catch (error) {
    box.dataset.state = "failed";
    element(box, "p", { className: "missing", textContent: `The view cannot be shown in this browser: ${error.message}` });
  }
}

for (const box of document.querySelectorAll(".view3d")) begin(box);
