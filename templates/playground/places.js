// Where the points of the arm are, from a row of a run.
const sum = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];

function places(run, instant) {
  const row = run.states.subarray(instant * width, (instant + 1) * width);
  if (figure.kind === "chain") return [[0, 0, 0], ...Array.from(row, (angle) => [angle, 0, 0])];
  if (figure.kind === "spatial") return placesInSpace(row);
  const found = [figure.floats ? [row[width - 2], row[width - 1], 0] : [0, 0, 0]];
  figure.lengths.forEach((length, k) => {
    found.push(sum(found[figure.hosts[k]], [length * Math.cos(row[k]), length * Math.sin(row[k]), 0]));
  });
  return found;
}

function times(m, v) {
  return [
    m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
    m[6] * v[0] + m[7] * v[1] + m[8] * v[2],
  ];
}

function product(a, b) {
  const found = new Array(9);
  for (let i = 0; i < 9; i += 3) {
    for (let j = 0; j < 3; j++) found[i + j] = a[i] * b[j] + a[i + 1] * b[j + 3] + a[i + 2] * b[j + 6];
  }
  return found;
}

function about(axis, angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  if (axis === 0) return [1, 0, 0, 0, c, -s, 0, s, c];
  if (axis === 1) return [c, 0, s, 0, 1, 0, -s, 0, c];
  return [c, -s, 0, s, c, 0, 0, 0, 1];
}

const turns = (figure.joints ?? []).map((joint) => joint.turn.flat());

function turnOf([w, x, y, z]) {
  // a unit quaternion's rotation, by rows
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
  ];
}

function placesInSpace(row) {
  const base = Array.from(row.subarray(figure.joints.length)); // place and quaternion where it floats
  const [bodies, axes] = figure.floats ? [[base], [turnOf(base.slice(3))]] : [[[0, 0, 0]], [[1, 0, 0, 0, 1, 0, 0, 0, 1]]];
  figure.joints.forEach((joint, k) => {
    bodies.push(sum(bodies[joint.host], times(axes[joint.host], joint.at)));
    axes.push(product(product(axes[joint.host], turns[k]), about(joint.axis, row[k])));
  });
  return figure.spots.map(({ body, at }) => sum(bodies[body], times(axes[body], at)));
}

function tips(run, instant) {
  run.tips ??= new Array(run.total + 1);
  run.tips[instant] ??= figure.tips.map((number) => places(run, instant)[number]);
  return run.tips[instant];
}

// a run may have more instants than a function takes arguments
const largest = (values) => values.reduce((most, value) => Math.max(most, value), 0);

function errors(run, fine) {
  // distance of the farthest tip at each instant, as far as both went
  const ratio = Math.round(run.step / fine.step);
  const found = [];
  for (let k = 0; k <= run.done && k * ratio <= fine.done; k++) {
    const [own, right] = [tips(run, k), tips(fine, k * ratio)];
    found.push(Math.max(...own.map((p, n) => Math.hypot(p[0] - right[n][0], p[1] - right[n][1], p[2] - right[n][2]))));
  }
  return found;
}
