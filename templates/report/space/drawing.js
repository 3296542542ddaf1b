// The arm on its ground: what is far is drawn first.
const THICK = 0.015; // of the arm, as a share of its reach

const colours = {};

function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["paper", "ink", "faint", "grid", "shadow", "arm"]) {
    colours[name] = style.getPropertyValue(`--${name}`).trim();
  }
  colours.tips = motion.tips.map((_, k) => style.getPropertyValue(`--tip-${(k % 5) + 1}`).trim());
}

function stroke(colour, width, path) {
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.beginPath();
  path();
  pen.stroke();
}

function along(places) {
  // a path through places in space; what lies behind the eye is cut off
  const limit = view.parallel ? -Infinity : near();
  let last = null;
  let drawn = false;
  for (const place of places) {
    const now = seen(place);
    if (last) {
      const [a, b] = [last[2] >= limit, now[2] >= limit];
      if (a || b) {
        const part = a && b ? 0 : (limit - last[2]) / (now[2] - last[2]);
        const cut = last.map((x, k) => x + part * (now[k] - x));
        if (!drawn || !a) pen.moveTo(...placed(a ? last : cut));
        pen.lineTo(...placed(b ? now : cut));
      }
      drawn = b;
    }
    last = now;
  }
}

function drawGround() {
  const [[left, right], [front, back]] = field;
  stroke(colours.grid, 1, () => {
    for (let k = left; k <= right; k++) along([[k * cell, front * cell, ground], [k * cell, back * cell, ground]]);
    for (let k = front; k <= back; k++) along([[left * cell, k * cell, ground], [right * cell, k * cell, ground]]);
  });
  if (ground < 0) {
    pen.setLineDash([4, 4]);
    stroke(colours.shadow, 1, () => along([[0, 0, 0], [0, 0, ground]]));
    pen.setLineDash([]);
  }
  const half = 0.045 * reach;
  const plate = [[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0], [-half, -half, 0]];
  pen.fillStyle = colours.shadow;
  pen.beginPath();
  along(plate);
  pen.fill();
}

function drawShadow(points) {
  const below = (p) => [p[0], p[1], ground];
  const width = Math.max(2, 0.8 * THICK * reach * scale(view.distance));
  stroke(colours.shadow, width, () => motion.lines.forEach((line) => along(line.map((n) => below(points[n])))));
  pen.setLineDash([2, 4]);
  stroke(colours.shadow, 1, () => motion.tips.forEach((tip) => along([points[tip.spot], below(points[tip.spot])])));
  pen.setLineDash([]);
}

function drawTraces(number, points) {
  motion.tips.forEach((tip, k) => {
    const way = instants.map((each) => each[tip.spot]);
    pen.globalAlpha = 0.3;
    stroke(colours.tips[k], 1, () => along(way));
    pen.globalAlpha = 1;
    stroke(colours.tips[k], 2, () => along([...way.slice(0, number + 1), points[tip.spot]]));
  });
}

function disc(place, radius, fill, edge) {
  const at = seen(place);
  if (!view.parallel && at[2] < near()) return;
  pen.beginPath();
  pen.arc(...placed(at), radius, 0, 2 * Math.PI);
  pen.fillStyle = fill;
  pen.fill();
  if (edge) {
    pen.strokeStyle = edge;
    pen.lineWidth = Math.max(1.5, 0.4 * radius);
    pen.stroke();
  }
}

function pieces(points) {
  const found = [];
  const thick = (depth) => Math.min(40, Math.max(2.5, THICK * reach * scale(depth)));
  const add = (depth, draw) => found.push({ depth, draw: () => draw(thick(depth)) });
  const depths = points.map((p) => seen(p)[2]);
  // joints and tips come after the pieces that end in them
  const nearest = [...depths];
  for (const line of motion.lines) {
    for (let k = 1; k < line.length; k++) {
      const [a, b] = [line[k - 1], line[k]];
      const depth = (depths[a] + depths[b]) / 2;
      for (const spot of [a, b]) nearest[spot] = Math.min(nearest[spot], depth);
      add(depth, (width) => {
        // an edge in the colour of the paper tells what passes before what; it spares the neighbours
        const long = Math.max(1, scale(depth) * Math.hypot(...points[a].map((x, k) => x - points[b][k])));
        const part = Math.min(0.5, width / long);
        const inner = [[a, b], [b, a]].map(([m, n]) => points[m].map((x, k) => x + part * (points[n][k] - x)));
        pen.lineCap = "butt";
        stroke(colours.paper, width + 3, () => along(inner));
        pen.lineCap = "round";
        stroke(colours.arm, width, () => along([points[a], points[b]]));
      });
    }
  }
  for (const [spot, end] of motion.pins) {
    const [middle, far] = [points[spot], points[end]];
    const other = far.map((x, k) => 2 * middle[k] - x);
    add(nearest[spot] - 0.001 * reach, (width) => {
      pen.lineCap = "butt";
      stroke(colours.ink, 0.5 * width, () => along([far, other]));
      disc(middle, 0.6 * width, colours.paper, colours.ink);
    });
  }
  motion.tips.forEach((tip, k) => add(nearest[tip.spot] - 0.002 * reach, (width) => {
    disc(points[tip.spot], Math.max(4, 0.8 * width), colours.tips[k]);
  }));
  return found.sort((a, b) => b.depth - a.depth);
}

function drawAxes() {
  // over the arm, which often stands along one of them
  pen.lineCap = "butt";
  pen.font = "600 13px system-ui, 'DejaVu Sans', sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  const foot = placed(seen([0, 0, 0]));
  ["x", "y", "z"].forEach((name, axis) => {
    const end = axes[axis];
    const depth = seen(end)[2];
    if (!view.parallel && depth < near()) return;
    stroke(colours.ink, 1.5, () => along([[0, 0, 0], end]));
    const tip = placed(seen(end));
    const long = Math.hypot(tip[0] - foot[0], tip[1] - foot[1]);
    if (long < 12) return; // it points at the reader
    const [right, down] = [(tip[0] - foot[0]) / long, (tip[1] - foot[1]) / long];
    const beside = 4 + Math.min(20, 0.6 * THICK * reach * scale(depth));
    const place = [tip[0] + 4 * right + beside * down, tip[1] + 4 * down - beside * right];
    pen.strokeStyle = colours.paper;
    pen.lineWidth = 4;
    pen.strokeText(name, ...place);
    pen.fillStyle = colours.ink;
    pen.fillText(name, ...place);
  });
}

function draw(time) {
  const { number, points } = between(time);
  frame = basis();
  pen.clearRect(0, 0, size.width, size.height);
  pen.lineJoin = "round";
  pen.lineCap = "butt";
  drawGround();
  drawShadow(points);
  drawTraces(number, points);
  for (const piece of pieces(points)) piece.draw();
  drawAxes();
  return points;
}
