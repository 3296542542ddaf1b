// Time passes, and the reader turns the arm.
const [play, slider, clock, pace, side, parallel, reset, tips] = [
  "play", "time", "clock", "pace", "side", "parallel", "reset", "tips",
].map((id) => document.getElementById(id));
const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
const PACES = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];
const state = { time: 0, playing: false, last: 0, asked: false };

const short = (value, digits) => (Math.abs(value) < 0.5 * 10 ** -digits ? 0 : value).toFixed(digits);
const seconds = (time) => short(time, Math.max(0, Math.min(6, 3 - Math.ceil(Math.log10(duration || 1)))));

function redraw() {
  if (state.asked) return;
  state.asked = true;
  requestAnimationFrame((now) => {
    state.asked = false;
    if (state.playing) {
      // a page that was hidden goes on where it was
      const passed = Math.min(0.1, Math.max(0, now - state.last) / 1000) * Number(pace.value);
      state.time = state.time + passed > duration ? 0 : state.time + passed;
      state.last = now;
      slider.value = String(Math.round((1000 * state.time) / (duration || 1)));
    }
    show();
    if (state.playing) redraw();
  });
}

const names = motion.tips.map((tip, k) => {
  const item = tips.appendChild(document.createElement("li"));
  item.appendChild(document.createElement("b")).style.background = `var(--tip-${(k % 5) + 1})`;
  return item.appendChild(document.createElement("span"));
});
const digits = Math.max(0, Math.min(6, 3 - Math.floor(Math.log10(reach))));
const outward = (p) => [0, 1, 2].map((k) => dot(motion.axes.map((row) => row[k]), p));

function show() {
  const points = draw(state.time);
  clock.textContent = `${seconds(state.time)} of ${seconds(duration)} s`;
  slider.setAttribute("aria-valuetext", `${seconds(state.time)} seconds`);
  motion.tips.forEach((tip, k) => {
    const at = outward(points[tip.spot]).map((x) => short(x, digits).replace("-", "\u2212"));
    names[k].textContent = `${tip.name}: ${at.join(", ")} m`;
  });
}

function setPlaying(playing) {
  state.playing = playing;
  state.last = performance.now();
  play.textContent = playing ? "Pause" : "Play";
  redraw();
}

function setTime(time) {
  state.playing = false;
  play.textContent = "Play";
  state.time = Math.min(duration, Math.max(0, time));
  slider.value = String(Math.round((1000 * state.time) / (duration || 1)));
  redraw();
}

function toInstant(by) {
  const { number } = between(state.time);
  setTime(motion.time[Math.min(motion.time.length - 1, Math.max(0, number + by))]);
}

function whole() {
  turnTo(side.value);
  redraw();
}

for (const value of PACES) pace.add(new Option(`${value} ×`, String(value)));
// in real time, unless that is over in a moment or takes long
const slow = PACES.filter((value) => duration / value >= 2);
const quick = PACES.filter((value) => duration / value <= 20);
pace.value = String(duration < 2 ? (slow.length ? Math.max(...slow) : PACES[0])
  : duration > 20 ? (quick.length ? Math.min(...quick) : 100) : 1);

play.addEventListener("click", () => setPlaying(!state.playing));
slider.addEventListener("input", () => setTime((Number(slider.value) / 1000) * duration));
side.addEventListener("change", whole);
reset.addEventListener("click", whole);
parallel.addEventListener("change", () => {
  view.parallel = parallel.checked;
  if (!view.own) fit();
  redraw();
});
document.getElementById("controls").addEventListener("submit", (event) => event.preventDefault());

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const control = event.target.closest?.("button, input, select, summary");
  if (control && (event.key !== " " || control !== slider)) {
    // controls keep the keys that are theirs
    if (event.key === " " || event.key === "Home" || event.key in ARROWS) return;
  }
  if (event.key === " ") setPlaying(!state.playing);
  else if (event.key in ARROWS) turn(...ARROWS[event.key].map((by) => 0.1 * by));
  else if (event.key === "+" || event.key === "=") zoom(1 / 1.15);
  else if (event.key === "-") zoom(1.15);
  else if (event.key === ",") toInstant(-1);
  else if (event.key === ".") toInstant(1);
  else if (event.key === "Home") whole();
  else return;
  event.preventDefault();
  redraw();
});

const fingers = new Map();
canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  fingers.set(event.pointerId, [event.clientX, event.clientY]);
});
canvas.addEventListener("pointermove", (event) => {
  const before = fingers.get(event.pointerId);
  if (!before) return;
  const now = [event.clientX, event.clientY];
  const [right, down] = [now[0] - before[0], now[1] - before[1]];
  if (fingers.size > 1) {
    const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
    const gap = (at) => Math.max(10, Math.hypot(at[0] - other[0], at[1] - other[1]));
    zoom(gap(before) / gap(now));
    shift(right / 2, down / 2);
  } else if (event.shiftKey || event.buttons & 2) shift(right, down);
  else turn(0.008 * right, 0.008 * down);
  fingers.set(event.pointerId, now);
  redraw();
});
for (const name of ["pointerup", "pointercancel"]) {
  canvas.addEventListener(name, (event) => fingers.delete(event.pointerId));
}
canvas.addEventListener("contextmenu", (event) => event.preventDefault());
canvas.addEventListener("dblclick", whole);
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  zoom(Math.exp(0.0015 * event.deltaY * (event.deltaMode ? 20 : 1)));
  redraw();
}, { passive: false });

new ResizeObserver(() => {
  const [dense, room] = [devicePixelRatio || 1, canvas.parentElement];
  [size.width, size.height] = [Math.max(1, room.clientWidth), Math.max(1, room.clientHeight)];
  [canvas.width, canvas.height] = [size.width * dense, size.height * dense];
  [canvas.style.width, canvas.style.height] = [`${size.width}px`, `${size.height}px`];
  pen.setTransform(dense, 0, 0, dense, 0, 0);
  size.focal = 1.6 * Math.min(size.width, size.height);
  if (!view.own) fit();
  show();
}).observe(canvas.parentElement);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  readColours();
  redraw();
});

document.getElementById("grid").textContent = `grid: ${Number(cell.toPrecision(1))} m`;
readColours();
[view.azimuth, view.elevation] = SIDES.free;
setPlaying(!still && duration > 0);
