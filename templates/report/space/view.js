// The motion, and how places in space become places on the canvas.
const motion = JSON.parse(document.getElementById("motion").textContent);
const canvas = document.getElementById("arm");
const pen = canvas.getContext("2d");
const duration = motion.time[motion.time.length - 1];
const reach = motion.reach;

// Axes of the view: the third is upward, against gravity.
const turned = (p) => motion.axes.map((row) => row[0] * p[0] + row[1] * p[1] + row[2] * p[2]);
const instants = motion.points.map((row) => {
  const points = [];
  for (let k = 0; k < row.length; k += 3) {
    points.push(turned([row[k] * motion.unit, row[k + 1] * motion.unit, row[k + 2] * motion.unit]));
  }
  return points;
});

const box = { low: [0, 0, 0], high: [0, 0, 0] };
for (const points of instants) {
  for (const p of points) {
    for (let k = 0; k < 3; k++) {
      box.low[k] = Math.min(box.low[k], p[k]);
      box.high[k] = Math.max(box.high[k], p[k]);
    }
  }
}
// The ground is level with the base, or lower where the arm reaches below that.
const ground = box.low[2] < -0.02 * reach ? box.low[2] - 0.05 * reach : 0;
box.low[2] = Math.min(box.low[2], ground);

function pleasant(size) {
  // 1, 2 or 5 times a power of ten
  const power = 10 ** Math.floor(Math.log10(size));
  return power * [1, 2, 5, 10].find((step) => step * power >= size * (1 - 1e-9));
}

const cell = pleasant(Math.max(box.high[0] - box.low[0], box.high[1] - box.low[1], 0.5 * reach) / 10);
const field = [0, 1].map((k) => [
  Math.floor((box.low[k] - 0.05 * reach) / cell), Math.ceil((box.high[k] + 0.05 * reach) / cell),
]);

function between(time) {
  // straight from instant to instant
  let low = 0;
  let high = motion.time.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (motion.time[middle] <= time) low = middle;
    else high = middle;
  }
  const span = motion.time[high] - motion.time[low];
  const part = span > 0 ? Math.min(1, Math.max(0, (time - motion.time[low]) / span)) : 0;
  const points = instants[low].map((p, n) => p.map((x, k) => x + part * (instants[high][n][k] - x)));
  return { number: part < 1 ? low : high, points };
}

const SIDES = { free: [-1.0, 0.4], front: [-Math.PI / 2, 0], right: [0, 0], top: [-Math.PI / 2, Math.PI / 2] };
const ZOOMED = 60; // times nearer or farther than where all is seen

const view = { azimuth: 0, elevation: 0, distance: 1, fitted: 1, target: [0, 0, 0], parallel: false, own: false };
const size = { width: 1, height: 1, focal: 1 };

function basis() {
  const [ca, sa, ce, se] = [view.azimuth, view.elevation].flatMap((angle) => [Math.cos(angle), Math.sin(angle)]);
  return { right: [-sa, ca, 0], up: [-se * ca, -se * sa, ce], toward: [ce * ca, ce * sa, se] };
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

let frame = basis();

function seen(p) {
  // right, up, and how far before the eye
  const d = [p[0] - view.target[0], p[1] - view.target[1], p[2] - view.target[2]];
  return [dot(d, frame.right), dot(d, frame.up), view.distance - dot(d, frame.toward)];
}

const near = () => 0.02 * view.distance;
const scale = (depth) => size.focal / (view.parallel ? view.distance : Math.max(depth, near()));

function placed([x, y, depth]) {
  const s = scale(depth);
  return [size.width / 2 + s * x, size.height / 2 - s * y];
}

const axes = [0, 1, 2].map((axis) => turned([0, 1, 2].map((k) => (k === axis ? 0.18 * reach : 0))));
const corners = [0, 1, 2, 3].map((k) => [field[0][k & 1] * cell, field[1][k >> 1] * cell, ground]);

function fit() {
  // The nearest eye that has every point at every instant in sight, and what it sees in the middle.
  view.target = [0, 1, 2].map((k) => (box.low[k] + box.high[k]) / 2);
  frame = basis();
  for (let round = 0; round < 4; round++) {
    const bounds = { left: Infinity, right: -Infinity, low: Infinity, high: -Infinity };
    let distance = 0.2 * reach;
    const hold = (p, part) => {
      const d = [p[0] - view.target[0], p[1] - view.target[1], p[2] - view.target[2]];
      const [x, y, toward] = [dot(d, frame.right), dot(d, frame.up), dot(d, frame.toward)];
      const wanted = (size.focal / part) * Math.max(Math.abs(x) / size.width, Math.abs(y) / size.height);
      distance = Math.max(distance, wanted + (view.parallel ? 0 : toward));
      const shrunk = view.parallel || !round ? 1 : view.distance / (view.distance - toward);
      bounds.left = Math.min(bounds.left, x * shrunk);
      bounds.right = Math.max(bounds.right, x * shrunk);
      bounds.low = Math.min(bounds.low, y * shrunk);
      bounds.high = Math.max(bounds.high, y * shrunk);
    };
    for (const p of axes) hold(p, 0.44);
    for (const points of instants) for (const p of points) hold(p, 0.44);
    for (const p of corners) hold(p, 0.49);
    view.distance = view.fitted = distance;
    if (round < 3) {
      const [x, y] = [(bounds.left + bounds.right) / 2, (bounds.low + bounds.high) / 2];
      view.target = view.target.map((value, k) => value + x * frame.right[k] + y * frame.up[k]);
    }
  }
}

function turnTo(side) {
  [view.azimuth, view.elevation] = SIDES[side];
  view.own = false;
  fit();
}

function turn(right, up) {
  view.azimuth -= right;
  view.elevation = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, view.elevation + up));
  view.own = true;
}

function zoom(factor) {
  view.distance = Math.min(ZOOMED * view.fitted, Math.max(view.fitted / ZOOMED, view.distance * factor));
  view.own = true;
}

function shift(right, down) {
  const per = 1 / scale(view.distance);
  view.target = view.target.map((x, k) => x - per * (right * frame.right[k] - down * frame.up[k]));
  view.own = true;
}
