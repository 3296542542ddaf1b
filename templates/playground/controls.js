// What the reader chooses, and what follows from it.
const by = (id) => document.getElementById(id);
const steps = Array.from({ length: data.halvings + data.doublings + 1 }, (_, k) => shortest * 2 ** k);
const ownPayload = data.payload ? data.payload.own : 0;
const digits = (value, n = 2) => Number(value.toPrecision(n)).toString();

function seconds(value) {
  return value < 1e-3 ? `${digits(1e6 * value, 3)} µs` : value < 1 ? `${digits(1e3 * value, 3)} ms` : `${digits(value, 3)} s`;
}

function lengthOf(value) {
  if (figure.unit === "rad") return value < 1e-3 ? `${value.toExponential(1)} rad` : `${digits(value)} rad`;
  if (value < 1e-9) return `${value.toExponential(1)} m`;
  const [factor, unit] = [[1e9, "nm"], [1e6, "µm"], [1e3, "mm"], [1, "m"]].find(([f]) => value * f < 1000) ?? [1, "m"];
  return `${digits(factor * value)} ${unit}`;
}

data.methods.forEach((method, number) => {
  by("method").append(new Option(method.name, number));
  const item = document.createElement("span");
  item.textContent = method.name;
  item.style.setProperty("--own", `var(--line-${(number % 6) + 1})`);
  by("legend").append(item);
});
by("step").max = steps.length - 1;
by("payload").max = data.payload ? data.payload.values.length - 1 : 0;
by("payload-label").hidden = !data.payload;
by("load-label").hidden = !data.signals.length;
by("length").textContent = seconds(data.until);
by("fine").textContent = `${seconds(shortest)} with ${data.methods[data.fine].name}`;
for (const id of ["payload-label", "load-label"]) if (by(id).hidden) by(id).style.display = "none";

function scenes() {
  by("method").value = 0;
  by("step").value = data.halvings;
  by("stiffness").value = 0;
  by("payload").value = ownPayload;
  by("load").value = 1;
}

function chosen() {
  return {
    method: Number(by("method").value), step: Number(by("step").value),
    stiffness: 10 ** Number(by("stiffness").value), payload: Number(by("payload").value), load: Number(by("load").value),
  };
}

function tell(settings) {
  by("step-told").textContent = seconds(steps[settings.step]);
  by("stiffness-told").textContent = `× ${digits(settings.stiffness)}`;
  if (data.payload) by("payload-told").textContent = `${data.payload.values[settings.payload]} ${data.payload.unit.replace("^2", "²")}`;
  by("load-told").textContent = `× ${digits(settings.load)}`;
}

const now = { shown: null, fine: null, floor: SMALL, errors: null, settings: null, arm: "", job: 0 };
const [front, back] = [
  await Promise.all(data.methods.map(engine)), await Promise.all(data.methods.map(engine)),
];

function small(element, text, more) {
  element.textContent = text;
  const note = document.createElement("small");
  note.textContent = more;
  element.append(note);
}

function report() {
  const { shown, settings } = now;
  const cost = costOf(settings.method, steps[settings.step]);
  const [size, word] = [[1e9, "billion"], [1e6, "million"], [1e3, "thousand"], [1, ""]].find(([least]) => cost >= least);
  small(by("cost"), `${digits(cost / size, 3)} ${word}`, "operations per simulated second");
  const pace = shown.done ? shown.milliseconds / (shown.done * shown.step) : 0;
  if (pace > 0) small(by("speed"), `${digits(pace)} ms`, `for a simulated second: ${digits(1e3 / pace)} times real time`);
  else small(by("speed"), "at once", "too quick for this clock");
  if (!now.errors) return small(by("error"), "…", "the fine step is under way");
  const most = largest(now.errors);
  by("error").dataset.value = most;
  by("error").dataset.floor = now.floor;
  if (shown.ended) small(by("error"), "stopped", `after ${seconds(shown.done * shown.step)}: ${shown.ended}`);
  else if (most > 1e3 * figure.reach) small(by("error"), "diverges", "steps are too long for the method");
  else if (most <= now.floor) small(by("error"), `below ${lengthOf(now.floor)}`, "less than the fine step knows");
  else if (figure.unit === "rad") small(by("error"), lengthOf(most), "at any instant");
  else small(by("error"), lengthOf(most), `${digits((100 * most) / figure.reach)} % of the reach`);
}

async function work() {
  // The chosen run at once; then the fine one; then all others for the chart.
  const settings = chosen();
  const job = ++now.job;
  const alive = () => job === now.job;
  const key = `${settings.method}/${settings.step}`;
  const arm = [settings.stiffness, settings.payload, settings.load].join();
  document.body.dataset.state = "busy";
  tell(settings);
  const shown = await taken(front[settings.method], steps[settings.step], settings, alive);
  if (!shown) return;
  Object.assign(now, { shown, settings, errors: null });
  if (arm !== now.arm) {
    Object.assign(now, { fine: null, arm });
    tried.clear();
    report();
    const fine = await taken(back[data.fine], shortest, settings, alive);
    const double = fine && (await taken(back[data.fine], 2 * shortest, settings, alive));
    if (!double) {
      now.arm = alive() ? arm : "";
      return;
    }
    // of the fourth order: the step twice as long is wrong by sixteen times as much
    now.floor = Math.max(SMALL, largest(errors(double, fine)) / 15);
    now.fine = fine;
    fit(fine);
  } else if (!now.fine) return;
  now.errors = errors(shown, now.fine);
  tried.set(key, { error: shown.ended ? Infinity : largest(now.errors) });
  report();
  for (let number = steps.length - 1; number >= 0; number--) {
    for (let method = 0; method < data.methods.length; method++) {
      if (tried.has(`${method}/${number}`)) continue;
      const run = await taken(back[method], steps[number], settings, alive);
      if (!run) return;
      tried.set(`${method}/${number}`, { error: run.ended ? Infinity : largest(errors(run, now.fine)) });
      await pause();
      if (!alive()) return;
    }
  }
  document.body.dataset.state = "ready";
}

const clock = { time: 0, before: 0, playing: !matchMedia("(prefers-reduced-motion: reduce)").matches };
const HOLD = 0.8; // s of rest at the end of a run
const pace = Math.max(1, data.until / 12); // long runs pass faster than they are

function frame(stamp) {
  if (clock.playing && clock.before) clock.time += Math.min(0.1, (stamp - clock.before) / 1000) * pace;
  clock.before = stamp;
  if (clock.time > data.until + HOLD * pace) clock.time = 0;
  const time = Math.min(clock.time, data.until);
  by("clock").textContent = `${time.toFixed(2)} s${pace > 1 ? `, shown ${digits(pace)} times as fast` : ""}`;
  drawArm(now.shown, now.fine, time);
  if (now.settings) {
    drawErrors(now.errors, now.floor, now.shown, time);
    drawCosts(`${now.settings.method}/${now.settings.step}`, now.floor);
  }
  requestAnimationFrame(frame);
}

by("choose").addEventListener("input", work);
by("choose").addEventListener("submit", (event) => event.preventDefault());
by("choose").addEventListener("reset", (event) => {
  event.preventDefault();
  scenes();
  work();
});
by("play").addEventListener("click", () => {
  clock.playing = !clock.playing;
  if (clock.time > data.until) clock.time = 0;
  by("play").textContent = clock.playing ? "Pause" : "Play";
});
by("costs").addEventListener("click", (event) => {
  let [nearest, distance] = ["", 24];
  for (const [key, { x, y }] of tried) {
    const away = Math.hypot(x - event.offsetX, y - event.offsetY);
    if (away < distance) [nearest, distance] = [key, away];
  }
  if (nearest) {
    [by("method").value, by("step").value] = nearest.split("/");
    work();
  }
});
if (figure.kind === "spatial") {
  stage.classList.add("turns");
  stage.addEventListener("pointermove", (event) => {
    if (!event.buttons) return;
    view.azimuth -= 0.008 * event.movementX;
    view.elevation = Math.min(1.57, Math.max(-1.57, view.elevation + 0.008 * event.movementY));
    fit(now.fine ?? now.shown);
  });
}

readColours();
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", readColours);
scenes();
// a link may choose: #method=bathe&step=3; and a page may hold this one in a frame: #embed
document.body.classList.toggle("embedded", /\bembed\b/.test(location.hash));
for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
  const named = key === "method" ? data.methods.findIndex((method) => method.name === value) : Number(value);
  if (["method", "step", "stiffness", "payload", "load"].includes(key) && named >= -1) by(key).value = named;
}
by("play").textContent = clock.playing ? "Pause" : "Play";
if (!clock.playing) clock.time = data.until;
requestAnimationFrame(frame);
await work();
