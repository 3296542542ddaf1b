// The arm on its canvas: the fine one below, broad and light; the chosen one above.
const colours = {};

function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["paper", "ink", "faint", "grid", "arm", "fine", "fine-ink"]) {
    colours[name] = style.getPropertyValue(`--${name}`).trim();
  }
  colours.lines = data.methods.map((_, k) => style.getPropertyValue(`--line-${(k % 6) + 1}`).trim());
}

function sized(canvas) {
  // pen, width and height in CSS pixels
  const [wide, high] = [canvas.clientWidth, canvas.clientHeight];
  const ratio = window.devicePixelRatio || 1;
  if (canvas.width !== Math.round(wide * ratio) || canvas.height !== Math.round(high * ratio)) {
    canvas.width = Math.round(wide * ratio);
    canvas.height = Math.round(high * ratio);
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, wide, high);
  pen.font = "12px system-ui, 'DejaVu Sans', sans-serif";
  return { pen, wide, high };
}

const stage = document.getElementById("arm");
const view = { azimuth: -1.0, elevation: 0.35, box: null };
const limbs = figure.lines ?? [];

function flat(p) {
  // from space onto the canvas, in metres
  if (figure.kind !== "spatial") return [p[0], p[1]];
  const [x, y, z] = figure.axes.map((axis) => axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2]);
  const [ca, sa, ce, se] = [view.azimuth, view.elevation].flatMap((angle) => [Math.cos(angle), Math.sin(angle)]);
  return [-sa * x + ca * y, -se * (ca * x + sa * y) + ce * z];
}

function fit(run) {
  // a box around all that a run passes through
  const box = { left: 0, right: 0, low: 0, high: 0 };
  const hold = ([x, y]) => {
    box.left = Math.min(box.left, x);
    box.right = Math.max(box.right, x);
    box.low = Math.min(box.low, y);
    box.high = Math.max(box.high, y);
  };
  for (let k = 0; k <= 60; k++) places(run, Math.round((k * run.done) / 60)).map(flat).forEach(hold);
  for (const corner of groundCorners()) hold(flat(corner));
  const pad = 0.08 * figure.reach;
  view.box = { left: box.left - pad, right: box.right + pad, low: box.low - pad, high: box.high + pad };
}

function groundCorners() {
  if (figure.kind !== "spatial" || figure.floats) return [];
  const half = 0.5 * figure.reach;
  const level = (x, y) => [0, 1, 2].map((k) => x * figure.axes[0][k] + y * figure.axes[1][k]);
  return [level(-half, -half), level(half, -half), level(half, half), level(-half, half)];
}

function line(pen, points, colour, thick) {
  pen.strokeStyle = colour;
  pen.lineWidth = thick;
  pen.lineCap = pen.lineJoin = "round";
  pen.beginPath();
  points.forEach(([x, y], k) => (k ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.stroke();
}

function dot(pen, [x, y], radius, colour) {
  pen.fillStyle = colour;
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fill();
}

const last = (run, time) => Math.min(run.done, Math.round(time / run.step));

function drawArm(shown, fine, time) {
  const { pen, wide, high } = sized(stage);
  if (!shown) return;
  if (figure.kind === "chain") return drawShaft(pen, wide, high, shown, fine, time);
  if (!view.box) fit(shown);
  const { left, right, low, high: top } = view.box;
  const scale = Math.min(wide / (right - left), high / (top - low));
  const onto = (p) => {
    const [x, y] = flat(p);
    return [wide / 2 + scale * (x - (left + right) / 2), high / 2 - scale * (y - (low + top) / 2)];
  };
  const ground = groundCorners().map(onto);
  if (ground.length) line(pen, [...ground, ground[0]], colours.grid, 1.5);
  for (const [run, colour, broad] of [[fine, colours.fine, 12], [shown, colours.arm, 4]]) {
    if (!run) continue;
    const now = last(run, time);
    const every = Math.max(1, Math.floor(now / 300));
    figure.tips.forEach((_, n) => {
      const way = [];
      for (let k = 0; k < now; k += every) way.push(onto(tips(run, k)[n]));
      way.push(onto(tips(run, now)[n]));
      pen.globalAlpha = 0.5;
      line(pen, way, colour, run === fine ? 4 : 1.2);
      pen.globalAlpha = 1;
    });
    const points = places(run, now).map(onto);
    const pieces = limbs.length ? limbs : figure.hosts.map((host, k) => [host, k + 1]);
    for (const piece of pieces) line(pen, piece.map((number) => points[number]), colour, broad);
    if (run === shown && points.length < 60) for (const point of points) dot(pen, point, 3, colours.arm);
    for (const number of figure.tips) dot(pen, points[number], run === fine ? 11 : 7, colour);
    if (run === shown) drawBase(pen, points[0]);
  }
}

function drawBase(pen, [x, y]) {
  pen.fillStyle = colours.ink;
  if (figure.turns) {
    dot(pen, [x, y], 9, colours.ink);
    dot(pen, [x, y], 5, colours.paper);
  } else pen.fillRect(x - 7, y - 7, 14, 14);
}

function drawShaft(pen, wide, high, shown, fine, time) {
  // discs along a shaft, each with a hand, and the line through the hands' ends: it shows the wave of twist
  const stations = figure.hosts.length;
  const crowded = stations > 30; // then only the line shows, as high as there is room for
  const radius = crowded ? 0.32 * high : Math.min(0.32 * high, (0.8 * wide) / stations);
  const edge = Math.max(0.06 * wide, 0.35 * radius + 12);
  const across = (k) => edge + (k * (wide - 2 * edge)) / stations;
  const end = (k, angle) => [across(k) + 0.35 * radius * Math.sin(angle), high / 2 - radius * Math.cos(angle)];
  line(pen, [[across(0), high / 2], [across(stations), high / 2]], colours.faint, 4);
  for (let k = 0; k <= (crowded ? 0 : stations); k++) {
    pen.strokeStyle = k ? colours.grid : colours.ink;
    pen.lineWidth = k ? 1.5 : 3;
    pen.beginPath();
    pen.ellipse(across(k), high / 2, 0.35 * radius, radius, 0, 0, 2 * Math.PI);
    pen.stroke();
  }
  for (const [run, colour, broad] of [[fine, colours.fine, 10], [shown, colours.arm, 3.5]]) {
    if (!run) continue;
    const ends = places(run, last(run, time)).map(([angle], k) => end(k, angle));
    figure.hosts.forEach((host, k) => line(pen, [ends[host], ends[k + 1]], colour, broad));
    if (!crowded) ends.forEach((point, k) => line(pen, [[across(k), high / 2], point], colour, 0.5 * broad));
    for (const number of figure.tips) dot(pen, ends[number], run === fine ? 10 : 6, colour);
  }
}
